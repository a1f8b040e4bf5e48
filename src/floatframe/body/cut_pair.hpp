#pragma once
// Pairs of modes. A round part bends equally in all directions across its axis: its bending modes
// come in pairs of equal frequency, and in larger groups where it has spans of equal length. A
// number of modes that cuts a group leaves modes that are any combinations of it, and so a part
// that bends more easily in one direction than in another.
#include <optional>
#include <string>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// Frequencies closer than this fraction belong to one shape and its rotated copy: meshes are not
/// exactly round.
inline constexpr double equal_frequencies = 2e-3;

inline bool equal_frequency(double a, double b) noexcept {
  return a > 0.0 && b > 0.0 && (a > b ? a - b : b - a) <= equal_frequencies * (a > b ? a : b);
}

struct CutPair {
  int kept = 0;              ///< dynamic modes
  int below = 0, above = 0;  ///< numbers that keep the group of the last out, or whole
  double frequency = 0.0;    ///< of the last [Hz]
};

/// For modes with these frequencies, ascending, and the number omitted that are as high as the
/// last. None: no group is cut.
std::optional<CutPair> cut_pair(const VecX& frequencies, int equal_left_out);
inline std::optional<CutPair> cut_pair(const FlexibleBody& body) {
  return cut_pair(body.fixed_interface_frequencies, body.equal_left_out);
}

/// The key of the number of modes: of bars or of a part.
const char* mode_number_key(const FlexibleBody& body);

/// "normal_modes: 13 cuts a pair of modes of equal frequency (123.4 Hz), take 12 or 14"
std::string cut_pair_text(const CutPair& pair, const std::string& key);

}  // namespace floatframe
