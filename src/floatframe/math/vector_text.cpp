#include "floatframe/math/vector_text.hpp"

#include <fmt/format.h>

namespace floatframe {

std::string vector_text(const Vec3& v, int digits) {
  return fmt::format("({:.{}g}, {:.{}g}, {:.{}g})", v.x(), digits, v.y(), digits, v.z(), digits);
}

}  // namespace floatframe
