#include "floatframe/body/cut_pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace floatframe {

std::optional<CutPair> cut_pair(const VecX& frequencies, int equal_left_out) {
  const Eigen::Index kept = frequencies.size();
  if (kept == 0 || equal_left_out <= 0) return std::nullopt;
  Eigen::Index below = kept - 1;
  while (below > 0 && equal_frequency(frequencies[below - 1], frequencies[kept - 1])) --below;
  return CutPair{static_cast<int>(kept), static_cast<int>(below),
                 static_cast<int>(kept) + equal_left_out, frequencies[kept - 1]};
}

const char* mode_number_key(const FlexibleBody& body) {
  const bool bars = std::ranges::any_of(
      body.mode_names, [](const std::string& name) { return name.starts_with("normal "); });
  return bars ? "normal_modes" : "modes";
}

std::string cut_pair_text(const CutPair& pair, const std::string& key) {
  const int size = pair.above - pair.below;
  return fmt::format("{}: {} cuts a {} of equal frequency ({:.6g} Hz), take {} or {}", key,
                     pair.kept,
                     size == 2 ? "pair of modes" : fmt::format("group of {} modes", size),
                     pair.frequency, pair.below, pair.above);
}

}  // namespace floatframe
