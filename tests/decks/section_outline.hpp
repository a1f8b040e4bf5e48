#pragma once
// Outlines of beam sections and the integrals over them, by Green's theorem.
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe::test {

using SectionOutline = std::vector<Vec2>;

/// The outline whose half beyond the second axis is given, from below.
inline std::vector<SectionOutline> mirrored(SectionOutline half) {
  for (std::size_t k = half.size(); k-- > 0;) half.emplace_back(-half[k](0), half[k](1));
  return {half};
}

struct OutlineSums {
  double A = 0.0, Sy = 0.0, Sz = 0.0, Iyy = 0.0, Izz = 0.0, Iyz = 0.0;
};

/// Of polygons, counter-clockwise; holes clockwise.
inline OutlineSums outline_sums(const std::vector<SectionOutline>& outlines) {
  OutlineSums s;
  for (const SectionOutline& o : outlines)
    for (std::size_t k = 0; k < o.size(); ++k) {
      const Vec2 &p = o[k], &q = o[(k + 1) % o.size()];
      const double c = p(0) * q(1) - q(0) * p(1);
      s.A += c / 2;
      s.Sy += c * (p(0) + q(0)) / 6;
      s.Sz += c * (p(1) + q(1)) / 6;
      s.Izz += c * (p(0) * p(0) + p(0) * q(0) + q(0) * q(0)) / 12;
      s.Iyy += c * (p(1) * p(1) + p(1) * q(1) + q(1) * q(1)) / 12;
      s.Iyz += c * (2 * p(0) * p(1) + p(0) * q(1) + q(0) * p(1) + 2 * q(0) * q(1)) / 24;
    }
  s.Izz -= s.Sy * s.Sy / s.A;
  s.Iyy -= s.Sz * s.Sz / s.A;
  s.Iyz -= s.Sy * s.Sz / s.A;
  return s;
}

}  // namespace floatframe::test
