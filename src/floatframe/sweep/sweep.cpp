#include "floatframe/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <filesystem>
#include <set>
#include <thread>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/simulation/simulation.hpp"
#include "floatframe/sweep/program_identity.hpp"
#include "floatframe/sweep/sweep_journal.hpp"
#include "floatframe/sweep/sweep_run.hpp"
#include "floatframe/sweep/worker_pool.hpp"

namespace floatframe {
namespace {

// Messages between processes: one word, a blank, the rest.
//   worker -> 0:  hello <study>   the first message; the study as this process understood it
//                 want <n>        may be sent n more runs
//                 done <line>     a finished run
//                 fault <text>    something that ends the study
//   0 -> worker:  run <number>    to be done
//                 stop            it is over
std::string word_of(const std::string& text) { return text.substr(0, text.find(' ')); }
std::string rest_of(const std::string& text) {
  const std::size_t blank = text.find(' ');
  return blank == std::string::npos ? "" : text.substr(blank + 1);
}

std::string plan_hash(const SweepPlan& plan) {
  ContentHash hash;
  for (const std::string& name : plan.names) hash.add(name);
  for (const auto& run : plan.runs)
    for (const std::string& value : run) hash.add(value);
  return hash.text();
}

/// What all processes must agree upon before they work together; with the content of the files that
/// the first run reads.
std::string study_hash(const SweepOptions& o, const SweepRunner& runner) {
  ContentHash hash;
  hash.add(program_identity())
      .add(plan_hash(o.plan))
      .add(static_cast<std::uint64_t>(o.keep_results));
  for (const SweepSetting& s : o.fixed) hash.add(s.name).add(s.value);
  for (const SweepMeasure& m : o.measures) hash.add(m.output).add(m.statistic);
  return hash.add(runner.files_of_first_run()).text();
}

SweepIdentity identity_of(const SweepOptions& o, const std::map<std::string, std::string>& files) {
  SweepIdentity identity{{"made by another build of the program", program_identity()}};
  std::string fixed, measures;
  for (const SweepSetting& s : o.fixed) fixed += s.name + '=' + s.value + '\n';
  for (const SweepMeasure& m : o.measures) measures += m.output + ':' + m.statistic + '\n';
  identity.emplace_back("the varied parameters or their values differ", plan_hash(o.plan));
  identity.emplace_back("the values that are the same for all runs differ", fixed);
  identity.emplace_back("the outputs measured differ", measures);
  identity.emplace_back("one keeps the results of its runs, the other does not",
                        o.keep_results ? "yes" : "no");
  // Names relative to the model file: a folder may be moved or reached by another path.
  const auto folder = std::filesystem::path(o.model).parent_path();
  for (const auto& [file, hash] : files) {
    const std::string relative =
        folder.empty() ? "" : std::filesystem::path(file).lexically_relative(folder).string();
    identity.emplace_back(
        fmt::format("the file '{}' has changed", relative.empty() ? file : relative), hash);
  }
  return identity;
}

/// Checks all runs on all threads; all faults of all runs, each once, in the order of the runs.
void check_runs(SweepRunner& runner, const SweepOptions& o, const std::atomic<bool>& stop,
                const std::function<void(const SweepProgress&)>& progress) {
  const std::size_t count = o.plan.runs.size();
  std::atomic<std::size_t> next{0};
  std::vector<std::vector<InputFault>> faults(count);
  std::exception_ptr other;
  std::mutex mutex;
  const auto work = [&](bool first) {
    for (std::size_t run = next++; run < count && !stop.load(std::memory_order_relaxed);
         run = next++) {
      try {
        runner.keep(run, runner.prepare(run));
      } catch (const InputError& error) {
        faults[run] = error.faults();
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!other) other = std::current_exception();
        return;
      }
      if (first) progress({SweepProgress::Stage::checking, run, count, 0, 0.0});
    }
  };
  std::vector<std::thread> threads;
  for (int k = 1;
       k < std::min<int>(o.threads, static_cast<int>(std::min<std::size_t>(count, 4096))); ++k)
    threads.emplace_back(work, false);
  work(true);
  for (std::thread& t : threads) t.join();
  if (other) std::rethrow_exception(other);
  std::vector<InputFault> all;
  std::set<std::string> seen;
  for (const auto& list : faults)
    for (const InputFault& f : list)
      if (seen.insert(f.text()).second) all.push_back(f);
  constexpr std::size_t most_shown = 20;
  if (all.size() > most_shown) {
    const std::size_t more = all.size() - most_shown;
    all.resize(most_shown);
    all.push_back({{}, fmt::format("and {} more faults of other runs", more)});
  }
  if (!all.empty()) throw InputError(std::move(all));
}

/// What earlier calls left in the folder, except the journal.
void remove_results(const std::string& folder) {
  remove_file((std::filesystem::path(folder) / "sweep.csv").string());
  std::error_code ignored;
  std::vector<std::filesystem::path> runs;
  for (std::filesystem::directory_iterator it(std::filesystem::path(folder) / "runs", ignored), end;
       !ignored && it != end; it.increment(ignored))
    if (it->path().filename().string().find_first_not_of("0123456789") == std::string::npos)
      runs.push_back(it->path());
  for (const auto& run : runs) {
    for (const char* name : {"results.csv", "summary.json"}) remove_file((run / name).string());
    std::filesystem::remove(run, ignored);  // only if nothing else is in it
  }
}

/// Process 0: hands out runs, takes their lines.
class Coordinator {
 public:
  /// `give_up` ends the runs in work; it is set when the study ends before its end.
  Coordinator(const SweepOptions& options, SweepRunner& runner, SweepJournal& journal, Ranks* ranks,
              std::atomic<bool>& give_up)
      : options_(options),
        journal_(journal),
        ranks_(ranks),
        give_up_(give_up),
        study_(ranks ? study_hash(options, runner) : ""),
        credit_(ranks ? static_cast<std::size_t>(ranks->size()) : 0, 0),
        pool_(options.threads, [&runner](std::size_t run, int, std::atomic<double>& progress) {
          return runner.line(run, progress);
        }) {}
  /// The pool, destroyed after this body, waits for the runs in work: those that are left then are
  /// of no use.
  ~Coordinator() { give_up_.store(true); }
  Coordinator(const Coordinator&) = delete;
  Coordinator& operator=(const Coordinator&) = delete;

  /// True if all runs are finished, false if it was stopped.
  bool work(const std::atomic<bool>& stop,
            const std::function<void(const SweepProgress&)>& progress) {
    const std::size_t total = options_.plan.runs.size(), before = journal_.finished().size();
    for (std::size_t run = 0; run < total; ++run)
      if (!journal_.finished().contains(run)) pool_.push(run);
    while (journal_.finished().size() < total) {
      // Messages of other processes have to be asked for.
      const std::chrono::milliseconds patience(ranks_ ? 1 : 50);
      bool given_up = stop.load();
      if (given_up) give_up_.store(true);
      for (WorkerPool::Finished& f : pool_.finished(patience)) {
        if (!f.fault) {
          journal_.add(f.line);
          continue;
        }
        try {
          std::rethrow_exception(f.fault);
        } catch (const RunGivenUp&) {
          given_up = true;
        }
      }
      RankMessage message;
      while (ranks_ && ranks_->receive(message)) given_up = !take(message) || given_up;
      progress({SweepProgress::Stage::running, journal_.finished().size(), total, before,
                pool_.in_work()});
      if (given_up) {
        pool_.clear();
        journal_.flush();
        return false;
      }
    }
    journal_.flush();
    return true;
  }

 private:
  /// False if the sender was interrupted.
  bool take(const RankMessage& message) {
    const std::string word = word_of(message.text);
    long& credit = credit_[static_cast<std::size_t>(message.from)];
    if (word == "hello") {
      if (rest_of(message.text) != study_)
        throw RunError(fmt::format(
            "process {} runs another build of the program, sees another model file or was "
            "given other arguments",
            message.from));
    } else if (word == "want") {
      credit += std::stol(rest_of(message.text));
    } else if (word == "done") {
      journal_.add(rest_of(message.text));
    } else if (word == "interrupted") {
      return false;
    } else {
      throw RunError(fmt::format("process {}: {}", message.from, rest_of(message.text)));
    }
    for (; credit > 0; --credit) {
      const auto run = pool_.take();
      if (!run) break;
      ranks_->send(message.from, fmt::format("run {}", *run));
    }
    return true;
  }

  const SweepOptions& options_;
  SweepJournal& journal_;
  Ranks* ranks_;
  std::atomic<bool>& give_up_;
  std::string study_;
  std::vector<long> credit_;
  WorkerPool pool_;
};

SweepReport report_of(const SweepOptions& o, const SweepJournal& journal, std::size_t before) {
  SweepReport report;
  report.runs = o.plan.runs.size();
  report.finished = journal.finished().size();
  report.before = before;
  for (const auto& [run, row] : journal.finished()) {
    if (row.status == "completed") continue;
    if (++report.failed == 1) {
      report.first_failed = run + 1;
      report.first_message = row.message;
    }
  }
  return report;
}

}  // namespace

SweepReport run_sweep(const SweepOptions& o, Ranks* ranks, const std::atomic<bool>& stop,
                      const std::function<void(const SweepProgress&)>& progress) {
  std::atomic<bool> give_up{false};
  SweepRunner runner(o, give_up);
  check_runs(runner, o, stop, progress);
  if (stop.load()) {
    SweepReport report;
    report.runs = o.plan.runs.size();
    report.interrupted = true;
    return report;
  }
  // A model that cannot be built with the values of the first run is refused before anything is
  // written; the others may fail one by one.
  runner.model(0, runner.prepare(0));

  try {
    make_output_folder(o.folder);
  } catch (const OutputError& error) {
    throw InputError(error.what());
  }
  const std::string journal_path = (std::filesystem::path(o.folder) / "sweep.journal").string();
  const std::string table_path = (std::filesystem::path(o.folder) / "sweep.csv").string();
  SweepJournal journal(journal_path, identity_of(o, runner.files()), o.plan.runs.size(), o.fresh);
  const std::size_t before = journal.finished().size();
  if (before == 0) remove_results(o.folder);

  bool complete = false;
  {
    Coordinator coordinator(o, runner, journal, ranks, give_up);
    complete = coordinator.work(stop, progress);
  }
  SweepReport report = report_of(o, journal, before);
  report.journal = journal_path;
  report.interrupted = !complete;
  if (complete) {
    std::vector<SweepRow> rows;
    for (const auto& [run, row] : journal.finished()) rows.push_back(row);
    write_file(table_path, sweep_csv(o.plan.names, o.plan.runs, rows));
    report.table = table_path;
  }
  return report;
}

void dismiss_ranks(Ranks& ranks) {
  for (int k = 1; k < ranks.size(); ++k) ranks.send(k, "stop");
}

void serve_sweep(const SweepOptions& o, Ranks& ranks, const std::atomic<bool>& stop) {
  std::atomic<bool> over{false};
  bool dismissed = false;
  try {
    SweepRunner runner(o, over);
    WorkerPool pool(o.threads, [&](std::size_t run, int, std::atomic<double>& progress) {
      return runner.line(run, progress);
    });
    ranks.send(0, "hello " + study_hash(o, runner));
    ranks.send(0, fmt::format("want {}", o.threads));
    bool ahead = false;
    while (!dismissed) {
      for (const WorkerPool::Finished& f : pool.finished(std::chrono::milliseconds(1))) {
        if (over.load()) continue;
        if (f.fault) {
          over.store(true);
          std::rethrow_exception(f.fault);
        }
        ranks.send(0, "done " + f.line);
        // Short runs: a second run a thread lies ready, so that no thread waits for the answer.
        const bool short_run = !ahead && f.seconds < 0.1;
        ranks.send(0, fmt::format("want {}", short_run ? 1 + o.threads : 1));
        ahead = ahead || short_run;
      }
      if (stop.load() && !over.load()) {
        over.store(true);
        ranks.send(0, "interrupted");
      }
      RankMessage message;
      while (!dismissed && ranks.receive(message)) {
        dismissed = word_of(message.text) == "stop";
        if (!dismissed && !over.load()) pool.push(std::stoul(rest_of(message.text)));
      }
    }
    over.store(true);  // gives up what is in work
  } catch (const std::exception& error) {
    if (!dismissed) ranks.send(0, std::string("fault ") + error.what());
  }
  while (!dismissed) {
    RankMessage message;
    while (!dismissed && ranks.receive(message)) dismissed = word_of(message.text) == "stop";
    if (!dismissed) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace floatframe
