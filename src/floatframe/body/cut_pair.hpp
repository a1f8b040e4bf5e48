#pragma once
// Pairs of modes. A round part bends alike in all directions across its axis: its bending modes
// come in pairs of equal frequency. A number of modes that keeps one of a pair makes it softer in
// one direction than in the other.
#include <optional>
#include <string>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// Frequencies closer than this part belong to one shape and its turned one: meshes are not quite
/// round.
inline constexpr double equal_frequencies = 2e-3;

inline bool equal_frequency(double a, double b) noexcept {
  return a > 0.0 && b > 0.0 && (a > b ? a - b : b - a) <= equal_frequencies * (a > b ? a : b);
}

struct CutPair {
  int kept = 0;            ///< normal modes
  double frequency = 0.0;  ///< of the last of them, whose partner is left out [Hz]
};

/// Of a frame of bars, whose normal modes are the last of the body; across this axis (body frame),
/// or across the one that its other pairs tell. None: no pair is cut, or nothing tells.
std::optional<CutPair> cut_pair(const FlexibleBody& body,
                                const std::optional<Vec3>& axis = std::nullopt);

/// "normal_modes: 13 cuts a pair of modes of equal frequency (123.4 Hz), take 12 or 14"
std::string cut_pair_text(const CutPair& pair, const std::string& key);

}  // namespace floatframe
