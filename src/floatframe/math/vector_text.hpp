#pragma once
// Vectors in messages.
#include <string>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// "(0.5, 0, -1.25)", with so many digits.
std::string vector_text(const Vec3& v, int digits = 6);

}  // namespace floatframe
