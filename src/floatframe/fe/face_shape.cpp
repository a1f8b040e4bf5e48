#include "floatframe/fe/face_shape.hpp"

namespace floatframe {
namespace {

FaceShape triangle_shape(int count, double r, double s) {
  FaceShape f{count};
  const double t = 1.0 - r - s;
  if (count == 3) {
    f.N = {t, r, s};
    f.r = {-1, 1, 0};
    f.s = {-1, 0, 1};
    return f;
  }
  f.N = {t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t};
  f.r = {1 - 4 * t, 4 * r - 1, 0, 4 * (t - r), 4 * s, -4 * s};
  f.s = {1 - 4 * t, 0, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)};
  return f;
}

FaceShape quadrilateral_shape(int count, double r, double s) {
  FaceShape f{count};
  constexpr double R[] = {-1, 1, 1, -1, 0, 1, 0, -1}, S[] = {-1, -1, 1, 1, -1, 0, 1, 0};
  for (int i = 0; i < 4; ++i) {
    const double a = 1 + R[i] * r, b = 1 + S[i] * s;
    const double c = count == 4 ? 1.0 : R[i] * r + S[i] * s - 1;
    f.N[i] = a * b * c / 4;
    f.r[i] = R[i] * (b * c + (count == 4 ? 0.0 : a * b)) / 4;
    f.s[i] = S[i] * (a * c + (count == 4 ? 0.0 : a * b)) / 4;
  }
  for (int i = 4; i < count; ++i) {
    const double a = R[i] == 0 ? 1 - r * r : 1 + R[i] * r, b = S[i] == 0 ? 1 - s * s : 1 + S[i] * s;
    f.N[i] = a * b / 2;
    f.r[i] = (R[i] == 0 ? -2 * r : R[i]) * b / 2;
    f.s[i] = (S[i] == 0 ? -2 * s : S[i]) * a / 2;
  }
  return f;
}

}  // namespace

FaceShape face_shape(int corners, int count, double r, double s) {
  return corners == 3 ? triangle_shape(count, r, s) : quadrilateral_shape(count, r, s);
}

}  // namespace floatframe
