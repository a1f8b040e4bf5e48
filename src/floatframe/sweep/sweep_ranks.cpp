#include "floatframe/sweep/sweep_ranks.hpp"

#include <fmt/format.h>

#include <chrono>
#include <deque>
#include <thread>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/sweep/sweep_identity.hpp"

namespace floatframe {
void dismiss_ranks(Ranks& ranks) {
  for (int k = 1; k < ranks.size(); ++k) ranks.send(k, "stop");
}

namespace {

/// A process other than 0: executes the requests it receives.
class RankWorker {
 public:
  RankWorker(const SweepOptions& options, SweepWorkers& workers, Ranks& ranks)
      : options_(options), workers_(workers), ranks_(ranks) {}

  /// Until process 0 ends the study (true), or `stop` (false).
  bool work(const std::atomic<bool>& stop) {
    const auto files = first_run_files(options_, workers_, stop);
    if (!files) return false;
    ranks_.send(0, "hello " + study_hash(options_, *files));
    want(workers_.size());
    while (!stop.load()) {
      for (int k = 0; k < workers_.size() && !queue_.empty(); ++k) {
        if (!workers_.idle(k)) continue;
        workers_.give(k, {ServiceRequest::What::run, queue_.front()});
        queue_.pop_front();
      }
      for (const SweepWorkers::Answer& answer : workers_.answers(std::chrono::milliseconds(1)))
        take(answer);
      RankMessage message;
      while (ranks_.receive(message)) {
        if (word_of(message.text) == "stop") return true;
        queue_.push_back(std::stoul(rest_of(message.text)));
      }
    }
    return false;
  }

 private:
  void want(int runs) { ranks_.send(0, fmt::format("want {}", runs)); }

  void take(const SweepWorkers::Answer& answer) {
    const auto line = line_of(options_, answer);
    if (!line) return;
    ranks_.send(0, "done " + *line);
    // Short runs: each worker has a second run queued, so that none waits for process 0.
    const bool short_run = !ahead_ && answer.seconds < 0.1;
    want(short_run ? 1 + workers_.size() : 1);
    ahead_ = ahead_ || short_run;
  }

  const SweepOptions& options_;
  SweepWorkers& workers_;
  Ranks& ranks_;
  std::deque<std::size_t> queue_;
  bool ahead_ = false;
};

}  // namespace

void serve_sweep(const SweepOptions& options, SweepWorkers* workers, Ranks& ranks,
                 const std::atomic<bool>& stop) {
  bool dismissed = false;
  try {
    if (workers) dismissed = RankWorker(options, *workers, ranks).work(stop);
    if (workers && !dismissed) ranks.send(0, "interrupted");
  } catch (const std::exception& error) {
    ranks.send(0, std::string("error ") + error.what());
  }
  while (!dismissed) {
    RankMessage message;
    while (!dismissed && ranks.receive(message)) dismissed = word_of(message.text) == "stop";
    if (!dismissed) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

std::string word_of(const std::string& text) { return text.substr(0, text.find(' ')); }

std::string rest_of(const std::string& text) {
  const std::size_t blank = text.find(' ');
  return blank == std::string::npos ? "" : text.substr(blank + 1);
}

std::optional<std::string> line_of(const SweepOptions& options,
                                   const SweepWorkers::Answer& answer) {
  if (!answer.lost.empty()) return lost_line(options, answer.run, answer.lost);
  if (answer.kind == ServiceAnswer::Kind::cancelled) return std::nullopt;
  if (!answer.errors.empty()) throw InputError(answer.errors);
  return answer.text;
}

std::optional<std::string> first_run_files(const SweepOptions& options, SweepWorkers& workers,
                                           const std::atomic<bool>& stop) {
  const auto answer = workers.ask(0, {ServiceRequest::What::files, 0}, stop);
  if (!answer) return std::nullopt;
  if (!answer->lost.empty())
    throw RunError(ErrorCode::worker_lost,
                   fmt::format("{}: reading it {}", options.model, answer->lost));
  if (!answer->errors.empty()) throw InputError(answer->errors);
  return answer->text;
}

}  // namespace floatframe
