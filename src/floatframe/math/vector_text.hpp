#pragma once
// Vectors in messages.
#include <string>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// "(0.5, 0, -1.25)", with this number of digits.
std::string vector_text(const Vec3& v, int digits = 6);

}  // namespace floatframe
