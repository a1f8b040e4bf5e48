#include "floatframe/sweep/sweep_messages.hpp"

#include <fmt/format.h>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {

std::string word_of(const std::string& text) { return text.substr(0, text.find(' ')); }

std::string rest_of(const std::string& text) {
  const std::size_t blank = text.find(' ');
  return blank == std::string::npos ? "" : text.substr(blank + 1);
}

std::optional<std::string> line_of(const SweepOptions& options,
                                   const SweepWorkers::Answer& answer) {
  if (!answer.lost.empty()) return lost_line(options, answer.run, answer.lost);
  if (answer.kind == ServiceAnswer::Kind::given_up) return std::nullopt;
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
