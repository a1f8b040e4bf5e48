#include "floatframe/fe/plate_section.hpp"

#include <algorithm>

namespace floatframe {

PlateSums plate_sums(std::span<const SectionPlate> plates) {
  PlateSums s;
  for (const SectionPlate& p : plates) {
    const double a = p.height * p.width;
    s.A += a;
    s.y += a * p.y;
    s.z += a * p.z;
  }
  s.y /= s.A;
  s.z /= s.A;
  for (const SectionPlate& p : plates) {
    const double a = p.height * p.width, dy = p.y - s.y, dz = p.z - s.z,
                 thin = std::min(p.height, p.width);
    s.Iz += a * (p.height * p.height / 12.0 + dy * dy);
    s.Iy += a * (p.width * p.width / 12.0 + dz * dz);
    s.Iyz += a * dy * dz;
    s.thin_J += std::max(p.height, p.width) * thin * thin * thin / 3.0;
  }
  return s;
}

double bredt_torsion(double w, double h, double top, double bottom, double left, double right) {
  const double b = w - (left + right) / 2.0, a = h - (top + bottom) / 2.0;
  return 4.0 * a * a * b * b / (b / top + b / bottom + a / left + a / right);
}

}  // namespace floatframe
