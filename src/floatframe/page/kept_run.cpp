#include "floatframe/page/kept_run.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/folder_lock.hpp"
#include "floatframe/history/history_content.hpp"
#include "floatframe/history/states_file.hpp"
#include "floatframe/page/page_writer.hpp"
#include "floatframe/page/run_page.hpp"
#include "floatframe/results/results_csv.hpp"
#include "floatframe/results/summary_json.hpp"
#include "floatframe/run/state_layout.hpp"

namespace floatframe {

struct KeptRun::States {
  StateLayout layout;
  std::vector<double> rows;
};

KeptRun run_and_keep(const Model& model, const SimulationDescription& options,
                     const RunOptions& run_options, const Controller& controller) {
  KeptRun kept;
  kept.options = options;
  RunOptions own = run_options;
  own.rows = {};
  own.states = {};
  const auto states = std::make_shared<KeptRun::States>();
  if (options.record.states != RecordDescription::States::none)
    own.states = [&states](const StateLayout& layout, std::span<const double> numbers) {
      if (states->layout.columns == 0) states->layout = layout;
      states->rows.insert(states->rows.end(), numbers.begin(), numbers.end());
    };
  kept.result =
      controller.on_step ? run(model, options, own, controller) : run(model, options, own);
  if (states->layout.columns > 0) kept.states = states;
  return kept;
}

KeptRun keep_recording(Recording& recording) {
  KeptRun kept;
  kept.result = recording.result();
  kept.options = recording.options();
  if (recording.instants() == 0) return kept;
  const auto states = std::make_shared<KeptRun::States>();
  states->layout = recording.layout();
  states->rows = recording.states();
  kept.states = states;
  return kept;
}

namespace {

HistoryContent kept_content(const std::string& folder, const Model& model, const KeptRun& run) {
  const bool known = !run.source.files.empty();
  HistoryOrigin origin = history_origin(run.model_file, folder);
  if (!known) origin.from_here.clear();
  origin.settings = run.settings;
  if (known) {
    origin.files = run.source.relative;
    origin.text = run.source.text;
  }
  return history_content(model, run.options, run.states->layout, std::move(origin));
}

void write_kept_states(const std::string& folder, const std::string& path, const Model& model,
                       const KeptRun& run) {
  StatesFile file(path, kept_content(folder, model, run), false);
  file.append(run.states->rows);
  file.finish(run.result.summary.status, run.result.summary.message);
}

std::string kept_page(const Model& model, const KeptRun& run, const RunSummary& summary,
                      const std::string& states_path) {
  Report report;
  describe_model(model, report);
  report.result.table = run.result.table;
  report.result.summary = summary;
  report.subjects = channel_subjects(model);
  report.facts.push_back(setting_facts(run.model_file, run.settings, run.options));
  report.software = build_description();
  report.processor = processor_name();
  PageBuffer buffer;
  auto page = run_page(report, page_curves(report.result.table), buffer);
  if (run.states) add_states(page, model, states_path, &run.options, buffer);
  return page_html(page_template(), page, buffer);
}

}  // namespace

std::string states_of_run(const Model& model, const KeptRun& run) {
  if (!run.states) return {};
  const RunSummary& summary = run.result.summary;
  return states_bytes(kept_content(".", model, run), run.states->rows, summary.status,
                      summary.message);
}

void save_run(const Model& model, const KeptRun& run, const std::string& folder) {
  if (folder.empty())
    throw InputError(ErrorCode::missing, "found an empty path, expected that of a folder");
  make_output_folder(folder);
  FolderLock lock(folder);
  const auto path = [&](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  if (std::filesystem::exists(path("run.checkpoint")))
    throw InputError(ErrorCode::exists,
                     "the folder '" + folder +
                         "' holds an unfinished run (run.checkpoint), expected another one");
  for (const char* name : {"states.ffr", "report.html"}) remove_file(path(name));
  RunSummary summary = run.result.summary;
  summary.settings = run.settings;
  summary.files = run.source.files;
  write_file(path("results.csv"), results_csv(run.result.table));
  if (run.states) write_kept_states(folder, path("states.ffr"), model, run);
  if (!page_template().empty())
    write_file(path("report.html"), kept_page(model, run, summary, path("states.ffr")));
  write_file(path("summary.json"), summary_json(summary));
}

}  // namespace floatframe
