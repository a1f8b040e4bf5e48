// floatframe stress: locations and times of the largest stresses in the parts of a run.
#include <filesystem>

#include "floatframe/apps/commands.hpp"
#include "floatframe/apps/progress_bar.hpp"
#include "floatframe/apps/recorded_run.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/export/stress_field.hpp"
#include "floatframe/export/stress_report.hpp"
#include "floatframe/history/recorded_motion.hpp"
#include "floatframe/loops/run_error.hpp"

namespace floatframe {
namespace {

struct StressArguments {
  RecordedRunArguments run;
  SelectionArguments selection;
  int top = 10;
  std::string out;
  bool json = false, overwrite = false;
};

bool has_stress(const Body& body) {
  const auto& stress = body.data->stress;
  return stress && !(stress->places.empty() && stress->sections.empty());
}

/// Splits the selected bodies into those with stress data and flexible ones without.
StressReport bodies_of(const RecordedRun& run, const Model& model,
                       const ExportSelection& selection) {
  StressReport report;
  report.model = &model;
  for (const int b : selected_bodies(run.history, model, selection)) {
    const Body& body = model.bodies[static_cast<std::size_t>(b)];
    if (has_stress(body) && body.modes() > 0) {
      report.bodies.push_back({b, {}, {}, {}});
    } else if (!selection.bodies.empty()) {
      throw InputError(ErrorCode::missing, "--body: body '" + body.name +
                                               (body.modes() == 0 ? "' is rigid and has no stress"
                                                                  : "' has no stress data") +
                                               ", expected a flexible body with stress");
    } else if (body.modes() > 0) {
      report.without.push_back(body.name);
    }
  }
  if (!report.bodies.empty()) return report;
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (has_stress(model.bodies[b]) && run.history.header().bodies[b].pose < 0)
      throw InputError(ErrorCode::missing, {run.history.name(), 0, 0},
                       "found no states of a body with stress data, those of '" +
                           model.bodies[b].name + "' were not recorded (record)");
  throw InputError(ErrorCode::missing, {run.history.name(), 0, 0},
                   "found no body with stress data, expected a flexible body of bars, or a "
                   "part reduced with stresses");
}

void replay(const RecordedRun& run, const ExportSelection& selection, StressReport& report) {
  const Model& model = *report.model;
  std::vector<StressEnvelopeOf> envelopes;
  for (const StressedBody& b : report.bodies) {
    const Body& body = model.bodies[static_cast<std::size_t>(b.body)];
    envelopes.emplace_back(*body.data->stress, body.modes());
  }
  const std::vector<std::size_t> instants = selected_instants(run.history, selection);
  RecordedMotion motion(run.history, model, recorded_options(run));
  ProgressBar bar(true, static_cast<double>(instants.size()), "instants");
  for (const std::size_t k : instants) {
    if (report.instants % 64 == 0)
      bar.show(static_cast<double>(report.instants) / static_cast<double>(instants.size()));
    const SystemMotion& view = motion.at(k);
    if (report.instants++ == 0) report.from = view.t;
    report.to = view.t;
    for (std::size_t i = 0; i < envelopes.size(); ++i) {
      const int b = report.bodies[i].body;
      envelopes[i].add(view.t, body_motion(view, b).y, stress_loads(view, b));
    }
  }
  for (std::size_t i = 0; i < envelopes.size(); ++i)
    report.bodies[i].envelope = envelopes[i].result();
}

int stress(const StressArguments& arguments) {
  const ExportSelection selection = arguments.selection.selection();
  const RecordedRun run = load_recorded_run(arguments.run);
  const Model model = build_model(run.description);
  StressReport report = bodies_of(run, model, selection);
  const std::filesystem::path out = arguments.out;
  if (!arguments.out.empty()) {
    require_folder(arguments.out);
    require_writable({{"--out", (out / "envelope.npz").string()},
                      {"--out", (out / "hot_spots.csv").string()},
                      {"--out", (out / "section_forces.csv").string()}},
                     run.inputs, arguments.overwrite);
  }
  try {
    replay(run, selection, report);
  } catch (const RunError& error) {
    say(std::string("the model cannot be started: ") + error.what());
    return exit_code::failed;
  }
  for (StressedBody& b : report.bodies) {
    const FlexibleBody& body = *model.bodies[static_cast<std::size_t>(b.body)].data;
    b.hot_spots = hot_spots(body, b.envelope, arguments.top);
    b.peaks = section_peaks(*body.stress, b.envelope);
  }
  if (!arguments.out.empty()) {
    write_file((out / "envelope.npz").string(), envelope_npz(report));
    write_file((out / "hot_spots.csv").string(), hot_spots_csv(report));
    write_file((out / "section_forces.csv").string(), section_forces_csv(report));
  }
  print(arguments.json ? stress_json(report) : stress_text(report));
  return exit_code::done;
}

}  // namespace

Command stress_command() {
  const auto a = std::make_shared<StressArguments>();
  return {
      .name = "stress",
      .help = "Where and when the parts of a run were stressed most",
      .options = joined(
          joined(
              {recorded_result_position(a->run),
               whole_option("--top", a->top, 0, 1'000'000, "Hot spots of each body"),
               text_option(
                   "--out", a->out, "DIR",
                   "Folder for envelope.npz (every place), hot_spots.csv and section_forces.csv"),
               flag("--json", a->json, "JSON on standard output"), overwrite_option(a->overwrite)},
              a->selection.table()),
          {recorded_model_option(a->run)}),
      .footer =
          "The model file and all files that it names must be unchanged since the run.\n"
          "Exit codes: 0 done, 1 the model cannot be started or a file not be written, 2 bad "
          "input.",
      .run = [a] { return stress(*a); }};
}

}  // namespace floatframe
