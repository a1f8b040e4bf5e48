#include "floatframe/sweep/sweep_workers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

int worker_count(const SweepOptions& options) {
  const std::size_t runs = std::min<std::size_t>(options.plan.runs.size(), 1000000);
  return std::clamp(options.threads, 1, std::max(1, static_cast<int>(runs)));
}

/// Each worker has its own service, created by its first request.
ProcessPool::Work work_of(const SweepOptions& options) {
  return [&options, service = std::shared_ptr<SweepService>()](
             const std::string& request, WorkerState& state, const SharedFlags& flags) mutable {
    if (!service) service = std::make_shared<SweepService>(options, flags.give_up);
    return service->serve(request, state);
  };
}

}  // namespace

SweepWorkers::SweepWorkers(const SweepOptions& options)
    : pool_(worker_count(options), options.limits, work_of(options)), run_of_(pool_.size()) {}

void SweepWorkers::give(int worker, const ServiceRequest& request) {
  run_of_[worker] = request.run;
  pool_.give(worker, encode(request));
}

SweepWorkers::Answer SweepWorkers::understood(ProcessPool::Answer&& raw) {
  Answer answer;
  if (raw.lost.empty() && !decode(raw.text, answer)) {
    answer = {};
    raw.lost = "gave an answer that cannot be read";
  }
  answer.worker = raw.worker;
  answer.run = run_of_[raw.worker];
  answer.lost = std::move(raw.lost);
  answer.seconds = raw.seconds;
  for (const auto& [file, hash] : answer.files)
    if (files_.emplace(file, hash).first->second != hash)
      throw RunError(ErrorCode::mismatch,
                     fmt::format("'{}' was changed while the study was running", file));
  if (answer.kind == ServiceAnswer::Kind::error)
    throw RunError(ErrorCode::worker_lost, answer.text);
  return answer;
}

std::vector<SweepWorkers::Answer> SweepWorkers::answers(std::chrono::milliseconds timeout) {
  std::vector<Answer> list;
  for (ProcessPool::Answer& raw : pool_.answers(timeout))
    list.push_back(understood(std::move(raw)));
  return list;
}

std::optional<SweepWorkers::Answer> SweepWorkers::ask(int worker, const ServiceRequest& request,
                                                      const std::atomic<bool>& stop) {
  run_of_[worker] = request.run;
  auto raw = pool_.ask(worker, encode(request), stop);
  if (!raw) return std::nullopt;
  return understood(std::move(*raw));
}

}  // namespace floatframe
