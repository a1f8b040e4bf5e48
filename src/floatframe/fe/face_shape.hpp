#pragma once
// Shape functions of the faces of elements, of membranes too.
#include <array>

namespace floatframe {

/// Shape functions of a face and their derivatives, in the order of its nodes. Triangles: area
/// coordinates r, s of the second and third corner; quadrilaterals: -1 <= r, s <= 1.
struct FaceShape {
  int count = 0;
  std::array<double, 8> N{}, r{}, s{};
};

FaceShape face_shape(int corners, int count, double r, double s);

}  // namespace floatframe
