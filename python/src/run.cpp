// Runs and their results. Numbers stay where the run left them; arrays of Python look at them and
// keep them alive.

#include "bindings.hpp"

namespace floatframe::python {
namespace {

std::shared_ptr<RunResult> run_model(const Model& model, std::optional<double> duration,
                                     const nb::object& progress, const nb::dict& given) {
  SimulationDescription simulation = described(model, options_of(given));
  if (duration) {
    simulation.duration = *duration;
    simulation.given_by("", "duration");
  }
  std::atomic<bool> stop{false};
  std::atomic<double> fraction{0.0};
  RunOptions options;
  options.keep_state = true;
  options.stop = &stop;
  options.progress = [&fraction](double f) { fraction = f; };
  auto result = std::make_shared<RunResult>();
  interruptible(
      stop, [&] { *result = run(model, simulation, options); },
      [&] {
        if (!progress.is_none()) progress(fraction.load());
      });
  if (!progress.is_none()) progress(1.0);
  return result;
}

using Table = nb::ndarray<nb::numpy, double, nb::ndim<2>>;

/// The table of a result, with its memory.
Table table_of(const std::shared_ptr<RunResult>& result) {
  ResultTable& table = result->table;
  nb::capsule owner(new std::shared_ptr<RunResult>(result),
                    [](void* p) noexcept { delete static_cast<std::shared_ptr<RunResult>*>(p); });
  return Table(table.data.data(), {table.rows(), table.columns.size()}, owner);
}

std::vector<std::pair<std::string, std::string>> columns_of(const RunResult& result) {
  std::vector<std::pair<std::string, std::string>> columns;
  for (const Column& c : result.table.columns) columns.emplace_back(c.name, c.unit);
  return columns;
}

}  // namespace

void bind_run(nb::module_& m) {
  nb::class_<RunResult>(m, "RunResult")
      .def_prop_ro(
          "table", [](const std::shared_ptr<RunResult>& r) { return table_of(r); },
          nb::rv_policy::reference)
      .def_prop_ro("columns", columns_of)
      .def_prop_ro("state",
                   [](const RunResult& r) { return r.state ? nb::cast(*r.state) : nb::none(); })
      .def_prop_ro("summary_json", [](const RunResult& r) { return summary_json(r.summary); })
      .def_prop_ro("results_csv", [](const RunResult& r) { return results_csv(r.table); });
  m.def("run", run_model, nb::arg("model"), nb::arg("duration").none(), nb::arg("progress").none(),
        nb::arg("options"));
}

}  // namespace floatframe::python
