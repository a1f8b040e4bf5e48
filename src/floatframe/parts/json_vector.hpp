#pragma once
#include <array>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// A vector in JSON: three numbers.
inline std::array<double, 3> json_vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace floatframe
