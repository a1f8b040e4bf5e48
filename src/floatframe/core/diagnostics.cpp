#include "floatframe/core/diagnostics.hpp"

#include <iterator>

namespace floatframe {

const char* error_code_name(ErrorCode code) noexcept {
  static constexpr const char* names[] = {
      "unknown_key",   "not_found",      "missing",        "incomplete",  "exclusive",
      "duplicate",     "wrong_value",    "not_a_number",   "not_finite",  "out_of_range",
      "wrong_count",   "contradiction",  "geometry",       "dependent",   "cycle",
      "singular",      "unsupported",    "unavailable",    "wrong_file",  "damaged",
      "mismatch",      "unreadable",     "too_large",      "in_use",      "exists",
      "not_assembled", "no_equilibrium", "no_convergence", "step_failed", "not_steady",
      "resonance",     "worker_lost"};
  static_assert(std::size(names) == static_cast<std::size_t>(ErrorCode::worker_lost) + 1);
  return names[static_cast<std::size_t>(code)];
}

std::string SourceMark::before(const std::string& message) const {
  if (file.empty()) return message;
  std::string place = file;
  if (line > 0) place += ":" + std::to_string(line);
  if (line > 0 && column > 0) place += ":" + std::to_string(column);
  return place + ": " + message;
}

}  // namespace floatframe
