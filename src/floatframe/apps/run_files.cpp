#include "floatframe/apps/run_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "floatframe/apps/earlier_result.hpp"
#include "floatframe/apps/own_file.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/output_place.hpp"
#include "floatframe/page/run_page.hpp"
#include "floatframe/page/scene_frames.hpp"
#include "floatframe/page/scene_json.hpp"
#include "floatframe/results/results_csv.hpp"
#include "floatframe/results/results_reader.hpp"
#include "floatframe/results/summary_json.hpp"
#include "floatframe/run/state_layout.hpp"

namespace floatframe {
namespace {

/// ", which has reached 1.25 s", or nothing if the checkpoint cannot be read.
std::string progress_of(const std::string& checkpoint) {
  try {
    return fmt::format(", which has reached {:g} s", read_checkpoint(checkpoint).run.time);
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace

RunPaths::RunPaths(const std::string& where)
    : folder(where),
      results((std::filesystem::path(where) / "results.csv").string()),
      states((std::filesystem::path(where) / "states.ffr").string()),
      report((std::filesystem::path(where) / "report.html").string()),
      summary((std::filesystem::path(where) / "summary.json").string()),
      checkpoint((std::filesystem::path(where) / "run.checkpoint").string()) {}

RunFiles::RunFiles(const RunPaths& paths, Options options)
    : paths_(paths),
      options_(std::move(options)),
      lock_(paths.folder),
      streams_(is_replaceable(paths.results)) {
  remove_remains();
  if (!streams_ && (options_.resume || options_.checkpoint_every > 0.0))
    throw InputError(
        ErrorCode::unreadable,
        fmt::format(
            "'{}' is not a regular file, expected one that a run with checkpoints can continue",
            paths_.results));
  if (keeps_states() && !is_replaceable(paths_.states))
    throw InputError(ErrorCode::unreadable,
                     fmt::format("'{}' is not a regular file, expected one that states can be "
                                 "written to, or --record none",
                                 paths_.states));
  if (!options_.overwrite && !options_.resume) require_own_files();
  holds_completed_ = holds_completed_run(paths_);
  if (options_.resume) {
    resume();
    return;
  }
  // A completed run has a checkpoint only if it was killed before it could be removed.
  holds_checkpoint_ = !holds_completed_ && std::filesystem::exists(paths_.checkpoint);
  if (holds_checkpoint_ && !options_.overwrite) require_no_unfinished_run();
}

void RunFiles::require_own_files() const {
  const auto refuse = [](const std::string& path) {
    throw InputError(ErrorCode::exists,
                     fmt::format("the file '{}' was not written by this program; give another "
                                 "--out, or --overwrite to replace it",
                                 path));
  };
  for (const std::string& path : {paths_.summary, paths_.report, paths_.states})
    if (!is_own_file(path)) refuse(path);
  // A checkpoint to be resumed is read, and rejected if it is invalid.
  if (!options_.resume && !is_own_file(paths_.checkpoint)) refuse(paths_.checkpoint);
  if (!is_own_results(paths_.results)) refuse(paths_.results);
}

void RunFiles::require_no_unfinished_run() const {
  throw InputError(ErrorCode::exists, fmt::format("the folder '{}' holds an unfinished run{}: "
                                                  "--resume continues it, --overwrite begins anew",
                                                  paths_.folder, progress_of(paths_.checkpoint)));
}

void RunFiles::resume() {
  const EarlierRun earlier = earlier_run(paths_.summary, options_.summary);
  complete_ = earlier == EarlierRun::completed;
  if (complete_) {
    // If the run was killed before it could do so.
    if (is_own_file(paths_.checkpoint)) remove_file(paths_.checkpoint);
    remove_set_aside(paths_);
    return;
  }
  if (earlier == EarlierRun::other && !std::filesystem::exists(paths_.checkpoint))
    throw InputError(ErrorCode::mismatch,
                     fmt::format("--resume: the run in '{}' is complete, and of another model or "
                                 "with other options; expected one of these that has not ended",
                                 paths_.folder));
  from_ = read_checkpoint(paths_.checkpoint);
  if (const std::string text = origin_difference(from_->origin, options_.origin); !text.empty())
    throw InputError(ErrorCode::mismatch,
                     fmt::format("the checkpoint '{}' {}", paths_.checkpoint, text));
  if (!options_.overwrite) require_own_files();
  if (!(options_.checkpoint_every > 0.0)) options_.checkpoint_every = from_->every;
}

/// Removes temporary files of a process that was killed while it wrote them.
void RunFiles::remove_remains() const {
  std::vector<std::filesystem::path> torn;
  std::error_code ignored;
  for (std::filesystem::directory_iterator it(paths_.folder, ignored), end; !ignored && it != end;
       it.increment(ignored))
    for (const std::string& path :
         {paths_.results, paths_.report, paths_.summary, paths_.checkpoint})
      if (const std::string name = it->path().filename().string();
          is_temporary_name(name) &&
          name.starts_with(std::filesystem::path(path).filename().string() + ".part-"))
        torn.push_back(it->path());
  for (const auto& file : torn) remove_file(file.string());
}

void RunFiles::begin(const std::vector<Column>& columns) {
  // Files to be continued are checked before anything is changed.
  if (from_ && keeps_states()) GrowingFile::require(paths_.states, from_->states);
  if (from_) results_.emplace(paths_.results, columns, from_->results);
  if (!from_ && holds_completed_) set_aside(paths_);
  options_.summary.status = "running";
  options_.summary.message = "not complete: the run has not ended, or was killed";
  write_file(paths_.summary, summary_json(options_.summary));
  remove_file(paths_.report);
  if (from_) return;
  remove_file(paths_.checkpoint);
  remove_file(paths_.states);
  results_.emplace(paths_.results, columns, options_.checkpoint_every > 0.0);
}

template <class Write>
void RunFiles::watched(const Write& write) {
  try {
    write();
  } catch (const OutputError&) {
    cut_at_ = results_ ? results_->last_time() : 0.0;
    throw;
  }
}

void RunFiles::take(const std::vector<Column>& columns, std::span<const double> numbers) {
  watched([&] {
    if (!results_) begin(columns);
    if (!numbers.empty()) results_->append(numbers);
  });
}

void RunFiles::take_states(const StateLayout& layout, std::span<const double> numbers) {
  watched([&] {
    if (!states_ && from_)
      states_.emplace(paths_.states, from_->states, static_cast<std::size_t>(layout.columns));
    if (!states_)
      states_.emplace(paths_.states, options_.history(layout), options_.checkpoint_every > 0.0);
    states_->append(numbers);
  });
}

void RunFiles::keep(const RunCheckpoint& checkpoint) {
  watched([&] {
    results_->to_disk();  // rows must be on disk before the checkpoint
    if (states_) states_->to_disk();
    write_file(
        paths_.checkpoint,
        checkpoint_bytes({options_.origin, options_.checkpoint_every, results_->position(),
                          states_ ? states_->position() : GrowingFile::Position(), checkpoint}));
  });
}

void RunFiles::write_report(const Report& report) const {
  if (page_template().empty()) return;
  const ResultTable& table = report.result.table;
  PageCurves curves;
  if (results_) {
    ResultsReader rows(paths_.results);
    curves = page_curves(rows, results_->rows());
  } else {
    curves = page_curves(table);
  }
  PageBuffer buffer;
  auto page = run_page(report, curves, buffer);
  if (states_ && options_.model) {
    add_states(page, *options_.model, paths_.states, options_.simulation, buffer);
  } else if (options_.model && report.result.table.columns.empty()) {  // the run could not start
    page["scene"] =
        scene_json(*options_.model, scene_frames(*options_.model, SystemState()), buffer);
    page["status"]["sentences"].push_back(
        "The view shows the design configuration, where the model file puts the bodies.");
  }
  write_file(paths_.report, page_html(page_template(), page, buffer));
}

/// A full disk has already been reported.
void RunFiles::finish_states(const RunSummary& summary, std::vector<std::string>& failed) {
  try {
    const bool good = summary.status == "completed" || summary.strict;
    states_->finish(good ? "completed" : summary.status, summary.message);
    states_->to_disk();
  } catch (const OutputError& error) {
    if (!cut_at_) failed.emplace_back(error.what());
  }
}

std::vector<std::string> RunFiles::finish(Report& report) {
  if (from_ && !results_) return {};  // not begun: nothing has changed
  const RunResult& result = report.result;
  untouched_ = !results_ && result.table.rows() == 0 && (holds_completed_ || holds_checkpoint_);
  if (untouched_) return {};
  report.rows_end = cut_at_;
  std::vector<std::string> failed;
  const auto attempt = [&](const std::function<void()>& write) {
    try {
      write();
    } catch (const OutputError& error) {
      failed.emplace_back(error.what());
    }
  };
  // The files of a run belong together: remove files of an earlier run that this run does not
  // write.
  if (results_)
    attempt([&] { results_->to_disk(); });
  else if (result.table.rows() > 0)
    attempt([&] { write_file(paths_.results, results_csv(result.table)); });
  else
    remove_file(paths_.results);
  if (!states_) remove_file(paths_.states);
  remove_file(paths_.report);
  if (options_.report) attempt([&] { write_report(report); });
  lock_.release_space();
  if (states_) finish_states(result.summary, failed);
  attempt([&] { write_file(paths_.summary, summary_json(result.summary)); });
  // Last: a run killed before this point can be resumed.
  const bool completed = result.summary.status == "completed";
  if (completed || !results_) remove_file(paths_.checkpoint);
  if ((completed || result.summary.strict) && failed.empty()) remove_set_aside(paths_);
  return failed;
}

std::vector<std::string> RunFiles::rewrite(const Report& report) {
  try {
    if (options_.report) write_report(report);
    write_file(paths_.summary, summary_json(report.result.summary));
    return {};
  } catch (const OutputError& error) {
    return {error.what()};
  }
}

std::string RunFiles::kept_sentence() const {
  if (untouched_)
    return fmt::format("the {} run in {} is left as it was",
                       holds_completed_ ? "completed" : "unfinished", paths_.folder);
  std::error_code ignored;
  if (!std::filesystem::exists(std::filesystem::path(previous_folder(paths_)) / "summary.json",
                               ignored))
    return {};
  return fmt::format("the completed run that was there before is kept in {}",
                     previous_folder(paths_));
}

}  // namespace floatframe
