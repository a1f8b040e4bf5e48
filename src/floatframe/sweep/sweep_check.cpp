#include "floatframe/sweep/sweep_check.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

using What = ServiceRequest::What;

class Checker {
 public:
  Checker(const SweepOptions& options, SweepWorkers& workers, const std::atomic<bool>& stop)
      : options_(options), workers_(workers), stop_(stop) {
    out_.worker.assign(options.plan.runs.size(), 0);
  }

  CheckedRuns check(const std::function<void(const SweepProgress&)>& progress) {
    // The first run run_first: the cache then holds its reduced part when the others need it.
    if (open() && run_first(What::check)) {
      others(progress);
      if (!out_.stopped) refuse_errors();
      if (!out_.stopped && !out_.lost.contains(0)) run_first(What::build);
      refuse_errors();
    }
    if (out_.stopped) workers_.give_up();
    return std::move(out_);
  }

 private:
  /// The file and the names must be valid for any run.
  bool open() {
    const auto answer = workers_.ask(0, {What::open, 0}, stop_);
    if (!answer) return !(out_.stopped = true);
    if (!answer->lost.empty())
      throw RunError(ErrorCode::worker_lost,
                     fmt::format("{}: reading it {}", options_.model, answer->lost));
    if (!answer->errors.empty()) throw InputError(answer->errors);
    return true;
  }

  bool run_first(What what) {
    const auto answer = workers_.ask(0, {what, 0}, stop_);
    if (!answer) return !(out_.stopped = true);
    take(*answer, what);
    return true;
  }

  void take(const SweepWorkers::Answer& answer, What what = What::check) {
    ++done_;
    out_.worker[answer.run] = answer.worker;
    if (!answer.lost.empty())
      out_.lost[answer.run] = fmt::format("{} while its model was {}", answer.lost,
                                          what == What::build ? "built" : "read");
    if (!answer.errors.empty()) errors_[answer.run] = answer.errors;
    out_.stopped = out_.stopped || answer.kind == ServiceAnswer::Kind::cancelled;
  }

  void others(const std::function<void(const SweepProgress&)>& progress) {
    const std::size_t count = options_.plan.runs.size();
    std::size_t next = 1;
    while (done_ < count) {
      if (stop_.load()) {
        out_.stopped = true;
        return;
      }
      for (int worker = 0; worker < workers_.size() && next < count; ++worker)
        if (workers_.idle(worker)) workers_.give(worker, {What::check, next++});
      for (const SweepWorkers::Answer& answer : workers_.answers(std::chrono::milliseconds(50)))
        take(answer);
      progress({SweepProgress::Stage::checking, done_, count, 0, 0.0});
    }
  }

  void refuse_errors() {
    std::vector<ErrorEntry> all;
    std::set<std::string> seen;
    for (const auto& [run, list] : errors_)
      for (const ErrorEntry& f : list)
        if (seen.insert(f.text()).second) all.push_back(f);
    constexpr std::size_t most_shown = 20;
    if (all.size() > most_shown) {
      std::size_t more = 0;
      for (std::size_t k = most_shown; k < all.size(); ++k) more += all[k].count;
      all.resize(most_shown);
      all.push_back(
          {{}, all.back().code, fmt::format("and {} more errors of other runs", more), more});
    }
    if (!all.empty()) throw InputError(std::move(all));
  }

  const SweepOptions& options_;
  SweepWorkers& workers_;
  const std::atomic<bool>& stop_;
  CheckedRuns out_;
  std::size_t done_ = 0;
  std::map<std::size_t, std::vector<ErrorEntry>> errors_;
};

}  // namespace

CheckedRuns check_runs(const SweepOptions& options, SweepWorkers& workers,
                       const std::atomic<bool>& stop,
                       const std::function<void(const SweepProgress&)>& progress) {
  return Checker(options, workers, stop).check(progress);
}

}  // namespace floatframe
