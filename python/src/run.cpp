// Runs and their results. Python arrays share the memory of the run and keep it alive.

#include "step_callback.hpp"

namespace floatframe::python {
namespace {

/// The function is called in the thread of the run.
Controller controller_of(const Model& model, const nb::object& function, const nb::object& period) {
  std::vector<std::string> inputs;
  for (const Input& input : model.inputs) inputs.push_back(input.name);
  const auto callback =
      std::make_shared<StepCallback>(function, std::move(inputs), model.outputs.size());
  Controller controller;
  controller.period = period_of(period);
  controller.on_step = [callback](double time, std::span<const double> outputs,
                                  std::span<double> changed) {
    Locked lock;
    (*callback)(time, outputs, changed);
  };
  return controller;
}

std::shared_ptr<KeptRun> run_model(const LoadedModel& model, const nb::object& duration,
                                   const nb::object& progress, bool verify, const Keywords& given,
                                   const std::string& model_file,
                                   const std::vector<std::string>& settings,
                                   const nb::object& on_step, const nb::object& period) {
  SimulationDescription simulation = described(model, options_of(given));
  if (!duration.is_none()) {
    simulation.duration = number("duration", duration);
    simulation.given_by("", "duration");
  }
  std::atomic<bool> stop{false};
  std::atomic<double> fraction{0.0};
  RunOptions options;
  options.keep_state = true;
  options.stop = &stop;
  options.progress = [&fraction](double f) { fraction = f; };
  Controller controller;
  if (!on_step.is_none()) controller = controller_of(model, on_step, period);
  if (!on_step.is_none() && verify)
    throw InputError(ErrorCode::contradiction,
                     "verify: found a run with on_step, whose function may remember, expected one "
                     "that can be made again");
  auto result = std::make_shared<KeptRun>();
  interruptible(
      stop,
      [&] {
        RunOptions first = options;
        if (verify) first.progress = [&fraction](double f) { fraction = f / 7.0; };
        *result = run_and_keep(model, simulation, first, controller);
        RunSummary& summary = result->result.summary;
        if (!verify || summary.status == "interrupted" || summary.steps == 0) return;
        options.progress = [&fraction](double f) { fraction = (1.0 + 6.0 * f) / 7.0; };
        summary.verification = verify_steps(model, simulation, summary.duration,
                                            rows_of(result->result.table), options);
      },
      [&] {
        if (!progress.is_none()) progress(fraction.load());
      });
  if (result->result.thrown)
    throw RunError(ErrorCode::step_failed, result->result.summary.message, result->result.thrown);
  if (!progress.is_none()) progress(1.0);
  result->model_file = model_file;
  result->settings = settings;
  result->source = model.source;
  return result;
}

using Table = nb::ndarray<nb::numpy, double, nb::ndim<2>>;

/// The table of a result, sharing its memory.
Table table_of(const std::shared_ptr<KeptRun>& result) {
  ResultTable& table = result->result.table;
  nb::capsule owner(new std::shared_ptr<KeptRun>(result),
                    [](void* p) noexcept { delete static_cast<std::shared_ptr<KeptRun>*>(p); });
  return Table(table.data.data(), {table.rows(), table.columns.size()}, owner);
}

std::vector<std::pair<std::string, std::string>> columns_of(const KeptRun& kept) {
  std::vector<std::pair<std::string, std::string>> columns;
  for (const Column& c : kept.result.table.columns) columns.emplace_back(c.name, c.unit);
  return columns;
}

}  // namespace

void bind_run(nb::module_& m) {
  nb::class_<KeptRun>(m, "Run")
      .def_prop_ro(
          "table", [](const std::shared_ptr<KeptRun>& r) { return table_of(r); },
          nb::rv_policy::reference)
      .def_prop_ro("columns", columns_of)
      .def_prop_ro("state",
                   [](const KeptRun& r) -> std::optional<SystemState> {
                     if (!r.result.state) return std::nullopt;
                     return *r.result.state;
                   })
      .def_prop_ro("summary_json", [](const KeptRun& r) { return summary_json(r.result.summary); })
      .def_prop_ro("warnings",
                   [](const KeptRun& r) {
                     std::vector<std::pair<std::string, std::string>> list;
                     for (const RangeWarning& w : r.result.summary.warnings)
                       list.emplace_back(range_limit_names[static_cast<std::size_t>(w.limit)],
                                         w.sentence);
                     return list;
                   })
      .def_prop_ro("results_csv", [](const KeptRun& r) { return results_csv(r.result.table); })
      .def("save", [](const KeptRun& r, const LoadedModel& model, const std::string& folder,
                      const std::string& model_file) {
        KeptRun run = r;
        run.model_file = model_file;
        run.source = model.source;
        Unlocked released;
        save_run(model, run, folder);
      });
  m.def("run", run_model, nb::arg("model"), nb::arg("duration").none(), nb::arg("progress").none(),
        nb::arg("verify"), nb::arg("options"), nb::arg("model_file"), nb::arg("settings"),
        nb::arg("on_step") = nb::none(), nb::arg("period") = nb::none());
}

}  // namespace floatframe::python
