#pragma once
// The deformation of a picture as a sum of fixed fields with weights of 0 to 1,
//   u = sum_k weight_k field_k,
// a field for each direction of each mode and, for bodies with geometric stiffening, of each
// product of two amplitudes; weights are positive because Blender 4.2 clamps negative weights of
// animations to zero. Between key frames the sum is still linear. Fields that move no point by more
// than `least_target` in the whole motion are omitted.
#include <algorithm>
#include <string>
#include <vector>

#include "floatframe/export/body_picture.hpp"

namespace floatframe {

struct MorphTarget {
  int a = 0, b = -1;   ///< target of y_a, or of y_a y_b
  double sign = 1.0;   ///< direction, 1 or -1
  double scale = 1.0;  ///< largest value in this direction
  std::string name;
  VecX field;  ///< 3 x points, one after the other [m]
  double weight(const double* y) const noexcept {
    return std::max(0.0, sign * (b < 0 ? y[a] : y[a] * y[b])) / scale;
  }
};

inline constexpr double least_target = 1e-8;  ///< [m]

/// `amplitudes`: of all instants and of all bodies with this picture, in sequence.
std::vector<MorphTarget> morph_targets(const BodyPicture& picture, const FlexibleBody& body,
                                       const std::vector<const std::vector<double>*>& amplitudes);

}  // namespace floatframe
