#include "floatframe/fe/section_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floatframe {
namespace {

enum Force { N, Vy, Vz, T, My, Mz };

SectionPoint bent(const BeamSection& s, double y, double z) {
  SectionPoint p;
  p.y = y;
  p.z = z;
  p.S(0, N) = 1.0 / s.A;
  p.S(0, My) = z / s.Iy;
  p.S(0, Mz) = -y / s.Iz;
  return p;
}

std::vector<SectionPoint> round_points(const BeamSection& s) {
  const double R = 0.5 * s.width, r = 0.5 * s.bore;
  const double k = 4.0 / 3.0 * (R * R + R * r + r * r) / (R * R + r * r);
  std::vector<SectionPoint> out;
  for (int i = 0; i < 8; ++i) {
    const double phi = 0.25 * std::numbers::pi * i, c = std::cos(phi), d = std::sin(phi);
    SectionPoint p = bent(s, R * c, R * d);
    // Along the circle: (-sin, cos) in y and z.
    const double shear[3] = {-k / s.A * d, k / s.A * c, R / s.J};
    for (int f = 0; f < 3; ++f) {
      p.S(1, Vy + f) = -shear[f] * d;
      p.S(2, Vy + f) = shear[f] * c;
    }
    out.push_back(p);
  }
  return out;
}

/// In a rectangle 2 a along y and 2 b along z at the middles of its sides, per G theta': -tau_xy at
/// z = b and tau_xz at y = a.
struct Torsion {
  double at_b = 0.0, at_a = 0.0;
  Torsion(double a, double b) {
    const double c = std::numbers::pi * a / (2.0 * b);
    double cosh_sum = 0.0, tanh_sum = 0.0;
    for (int n = 1; n < 400; n += 2) {
      cosh_sum += 1.0 / (n * n * std::cosh(std::min(n * c, 700.0)));
      tanh_sum += (n % 4 == 1 ? 1.0 : -1.0) * std::tanh(n * c) / (n * n);
    }
    const double pi2 = std::numbers::pi * std::numbers::pi;
    at_b = 2.0 * b * (1.0 - 8.0 / pi2 * cosh_sum);
    at_a = 16.0 * b / pi2 * tanh_sum;
  }
};

std::vector<SectionPoint> rectangle_points(const BeamSection& s) {
  const double a = 0.5 * s.width, b = 0.5 * s.height;
  const Torsion torsion(a, b);
  std::vector<SectionPoint> out;
  // Corners and middles in order, from +y on towards +z.
  constexpr int at[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  for (const auto& [i, j] : at) {
    SectionPoint p = bent(s, i * a, j * b);
    if (i == 0) {
      p.S(1, Vy) = 1.5 / s.A;
      p.S(1, T) = -j * torsion.at_b / s.J;
    } else if (j == 0) {
      p.S(2, Vz) = 1.5 / s.A;
      p.S(2, T) = i * torsion.at_a / s.J;
    }
    out.push_back(p);
  }
  return out;
}

}  // namespace

std::vector<SectionPoint> section_points(const BeamSection& section) {
  switch (section.outline) {
    case BeamSection::Outline::round:
      return round_points(section);
    case BeamSection::Outline::rectangle:
      return rectangle_points(section);
    case BeamSection::Outline::unknown:
      break;
  }
  return {};
}

}  // namespace floatframe
