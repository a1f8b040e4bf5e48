#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/folder_lock.hpp"
#include "floatframe/core/output_files.hpp"
#include "floatframe/model_file/model_fingerprint.hpp"
#include "floatframe/page/page_writer.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/sweep/run_queue.hpp"
#include "floatframe/sweep/sweep_check.hpp"
#include "floatframe/sweep/sweep_identity.hpp"
#include "floatframe/sweep/sweep_journal.hpp"
#include "floatframe/sweep/sweep_page.hpp"
#include "floatframe/sweep/sweep_ranks.hpp"
#include "floatframe/sweep/sweep_run.hpp"
#include "floatframe/sweep/sweep_workers.hpp"

namespace floatframe {
namespace {

using What = ServiceRequest::What;
using Clock = std::chrono::steady_clock;

/// Removes runs recorded in the folder by earlier calls. The table of an earlier study is kept
/// until the new one is written.
void remove_results(const std::string& folder) {
  std::error_code ignored;
  std::vector<std::filesystem::path> runs;
  for (std::filesystem::directory_iterator it(std::filesystem::path(folder) / "runs", ignored), end;
       !ignored && it != end; it.increment(ignored))
    if (it->path().filename().string().find_first_not_of("0123456789") == std::string::npos)
      runs.push_back(it->path());
  for (const auto& run : runs) {
    {
      const FolderLock held(run.string());  // a single run may be using the folder
      for (const char* name : {"results.csv", "summary.json"}) remove_file((run / name).string());
    }
    std::filesystem::remove(run, ignored);  // only if empty
  }
}

/// Process 0: distributes runs and collects their lines.
class Coordinator {
 public:
  Coordinator(const SweepOptions& options, SweepWorkers& workers, const CheckedRuns& checked,
              SweepJournal& journal, Ranks* ranks)
      : options_(options),
        workers_(workers),
        journal_(journal),
        ranks_(ranks),
        credit_(ranks ? static_cast<std::size_t>(ranks->size()) : 0, 0),
        queue_(workers.size()) {
    for (const auto& [run, reason] : checked.lost)
      if (!journal.finished().contains(run)) journal.add(lost_line(options, run, reason));
    for (std::size_t run = 0; run < options.plan.runs.size(); ++run)
      if (!journal.finished().contains(run)) queue_.push(run, checked.worker[run]);
  }

  /// True if all runs are finished, false if stopped.
  bool work(std::size_t before, const std::atomic<bool>& stop,
            const std::function<void(const SweepProgress&)>& progress) {
    const std::size_t total = options_.plan.runs.size();
    bool cancelled = false;
    if (ranks_) {
      const auto files = first_run_files(options_, workers_, stop);
      cancelled = !files;
      if (files) study_ = study_hash(options_, *files);
    }
    while (!cancelled && journal_.finished().size() < total) {
      hand_out();
      // Messages of other processes must be polled.
      for (const SweepWorkers::Answer& answer :
           workers_.answers(std::chrono::milliseconds(ranks_ ? 1 : 50)))
        cancelled = !take(answer) || cancelled;
      RankMessage message;
      while (ranks_ && ranks_->receive(message)) cancelled = !take(message) || cancelled;
      progress({SweepProgress::Stage::running, journal_.finished().size(), total, before,
                workers_.in_work()});
      cancelled = cancelled || stop.load();
    }
    if (cancelled) cancel_running();
    journal_.flush();
    return !cancelled;
  }

 private:
  void hand_out() {
    for (int worker = 0; worker < workers_.size(); ++worker) {
      if (!workers_.idle(worker)) continue;
      const auto run = queue_.take(worker);
      if (!run) return;
      workers_.give(worker, {What::run, *run});
    }
  }

  /// Cancels running jobs, which react after some steps; workers of jobs that do not react are
  /// terminated.
  void cancel_running() {
    workers_.give_up();
    const auto end = Clock::now() + std::chrono::seconds(2);
    while (!workers_.all_idle() && Clock::now() < end)
      for (const SweepWorkers::Answer& answer : workers_.answers(std::chrono::milliseconds(50)))
        if (answer.lost.empty()) take(answer);
  }

  /// False if the run was cancelled.
  bool take(const SweepWorkers::Answer& answer) {
    const auto line = line_of(options_, answer);
    if (line) journal_.add(*line);
    return line.has_value();
  }

  /// False if the sender was interrupted.
  bool take(const RankMessage& message) {
    const std::string word = word_of(message.text);
    long& credit = credit_[message.from];
    if (word == "hello") {
      if (rest_of(message.text) != study_)
        throw RunError(ErrorCode::mismatch,
                       fmt::format("process {} runs another build of the program, sees another "
                                   "model file or was given other arguments",
                                   message.from));
    } else if (word == "want") {
      credit += std::stol(rest_of(message.text));
    } else if (word == "done") {
      journal_.add(rest_of(message.text));
    } else if (word == "interrupted") {
      return false;
    } else {
      throw RunError(ErrorCode::worker_lost,
                     fmt::format("process {}: {}", message.from, rest_of(message.text)));
    }
    for (; credit > 0; --credit) {
      const auto run = queue_.take();
      if (!run) break;
      ranks_->send(message.from, fmt::format("run {}", *run));
    }
    return true;
  }

  const SweepOptions& options_;
  SweepWorkers& workers_;
  SweepJournal& journal_;
  Ranks* ranks_;
  std::string study_;
  std::vector<long> credit_;
  RunQueue queue_;
};

void add_warnings(std::size_t run, const SweepRow& row, SweepReport& report) {
  report.warned += row.warnings.empty() ? 0 : 1;
  for (const RangeWarning& warning : row.warnings) {
    auto known = std::find_if(report.warnings.begin(), report.warnings.end(),
                              [&](const SweepWarnings& w) { return w.limit == warning.limit; });
    if (known == report.warnings.end())
      known = report.warnings.insert(known, {warning.limit, 0, run + 1, warning.sentence});
    ++known->runs;
  }
}

SweepReport report_of(const SweepOptions& o, const SweepJournal& journal, std::size_t before) {
  SweepReport report;
  report.runs = o.plan.runs.size();
  report.finished = journal.finished().size();
  report.before = before;
  for (const auto& [run, row] : journal.finished()) {
    add_warnings(run, row, report);
    if (row.status == "completed") continue;
    if (++report.failed == 1) {
      report.first_failed = run + 1;
      report.first_message = row.message;
    }
  }
  return report;
}

}  // namespace

namespace {

void check_page(const SweepOptions& o) {
  if (o.report.empty()) return;
  if (page_template().empty())
    throw InputError(ErrorCode::unavailable,
                     "this program was built without the viewer and writes no page");
  if (o.plan.runs.size() > most_runs_of_page)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("found {} runs, expected at most {} for a page",
                                 o.plan.runs.size(), most_runs_of_page));
}

/// False if stopped.
bool page_written(const SweepOptions& o, const std::vector<SweepRow>& rows,
                  const std::atomic<bool>& stop, SweepReport& report) {
  try {
    write_sweep_page(o, rows, stop, report);
  } catch (const RunCancelled&) {
    return false;
  }
  report.page = o.report;
  return true;
}

}  // namespace

SweepReport run_sweep(const SweepOptions& o, SweepWorkers& workers, Ranks* ranks,
                      const std::atomic<bool>& stop,
                      const std::function<void(const SweepProgress&)>& progress) {
  check_page(o);
  const CheckedRuns checked = check_runs(o, workers, stop, progress);
  if (checked.stopped) {
    SweepReport report;
    report.runs = o.plan.runs.size();
    report.interrupted = true;
    return report;
  }
  try {
    make_output_folder(o.folder);
    if (const auto place = std::filesystem::path(o.report).parent_path(); !place.empty())
      make_output_folder(place.string());
  } catch (const OutputError& error) {
    throw InputError(ErrorCode::unreadable, error.what());
  }
  const std::string journal_path = (std::filesystem::path(o.folder) / "sweep.journal").string();
  const std::string table_path = (std::filesystem::path(o.folder) / "sweep.csv").string();
  std::vector<std::string> inputs;
  for (const auto& [file, hash] : workers.files()) inputs.push_back(file);
  std::vector<OutputFile> outputs{{"--out", table_path}, {"--out", journal_path}};
  if (!o.report.empty()) outputs.push_back({"--report", o.report});
  require_distinct(outputs, inputs);
  try {
    check_writable(table_path);
    if (!o.report.empty()) check_writable(o.report);
  } catch (const OutputError& error) {
    throw InputError(ErrorCode::unreadable, error.what());
  }
  SweepJournal journal(journal_path, identity_of(o), o.plan.runs.size(), o.fresh,
                       relative_to_model(o.model, workers.files()));
  if (o.retry_failed) journal.forget_failed();
  const std::size_t before = journal.finished().size();
  if (before == 0) remove_results(o.folder);

  const bool complete =
      Coordinator(o, workers, checked, journal, ranks).work(before, stop, progress);
  SweepReport report = report_of(o, journal, before);
  report.journal = journal_path;
  report.interrupted = !complete;
  if (complete) {
    std::vector<SweepRow> rows;
    for (const auto& [run, row] : journal.finished()) rows.push_back(row);
    write_file(table_path, sweep_csv(o.plan.names, o.plan.runs, rows));
    report.table = table_path;
    report.interrupted = !o.report.empty() && !page_written(o, rows, stop, report);
  }
  return report;
}

namespace {

/// Adds an origin for each run. Throws InputError for an inconsistent plan.
SweepOptions completed(SweepOptions options) {
  SweepPlan& plan = options.plan;
  if (plan.runs.empty())
    throw InputError(ErrorCode::out_of_range, "found a plan without runs, expected at least one");
  for (std::size_t k = 0; k < plan.runs.size(); ++k)
    if (plan.runs[k].size() != plan.names.size())
      throw InputError(
          ErrorCode::wrong_count,
          fmt::format("run {} of the plan: found {} values, expected {}: one for each name", k + 1,
                      plan.runs[k].size(), plan.names.size()));
  if (plan.origins.empty())
    for (std::size_t k = 0; k < plan.runs.size(); ++k)
      plan.origins.push_back(fmt::format("run {} of the plan", k + 1));
  if (plan.origins.size() != plan.runs.size())
    throw InputError(
        ErrorCode::wrong_count,
        fmt::format("found {} origins in a plan of {} runs, expected one for each run or none",
                    plan.origins.size(), plan.runs.size()));
  if (options.threads < 1)
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("threads: found {}, expected at least 1", options.threads));
  return options;
}

}  // namespace

SweepReport run_sweep(const SweepOptions& options, const std::atomic<bool>& stop,
                      const std::function<void(const SweepProgress&)>& progress) {
  const SweepOptions whole = completed(options);
  SweepWorkers workers(whole);
  return run_sweep(
      whole, workers, nullptr, stop, progress ? progress : [](const SweepProgress&) {});
}

}  // namespace floatframe
