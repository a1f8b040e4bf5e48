#include "floatframe/decks/number_sizes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/math/vector_text.hpp"

namespace floatframe {

namespace {

bool has_huge_square(double x) { return !std::isfinite(x * x); }

std::string huge_square(const char* what, double value) {
  return fmt::format("its {} is {:g}, expected a number whose square does not overflow", what,
                     value);
}

}  // namespace

std::string huge_constant(const Material& m) {
  if (has_huge_square(m.density)) return huge_square("density", m.density);
  if (!m.elasticity) return has_huge_square(m.young) ? huge_square("Young's modulus", m.young) : "";
  for (const double x : m.elasticity->reshaped())
    if (has_huge_square(x)) return huge_square("elasticity", x);
  return {};
}

std::string huge_sheet(const ShellSection& shell, double density,
                       const std::vector<Material>& materials) {
  const double t = shell.thickness;
  if (!std::isfinite(t * t * t))
    return fmt::format("its thickness is {:g}, expected a number whose cube does not overflow", t);
  double mass = shell.mass + (shell.plies.empty() ? t * density : 0.0);
  for (const ShellPly& ply : shell.plies) mass += ply.thickness * materials[ply.material].density;
  if (!std::isfinite(mass))
    return fmt::format("its mass over area is {:g}, expected a finite number", mass);
  if (!std::isfinite(shell.offset * shell.offset * t))
    return fmt::format(
        "its mid-surface is {:g} away from its nodes, expected a number whose square does not "
        "overflow",
        shell.offset);
  return {};
}

std::string huge_mass(double mass, const Mat3& J) {
  const double inertia = J.cwiseAbs().maxCoeff();
  if (has_huge_square(mass)) return huge_square("mass", mass);
  return has_huge_square(inertia) ? huge_square("moment of inertia", inertia) : "";
}

std::string huge_place(const Vec3& p) {
  const double size = p.cwiseAbs().sum();
  if (std::isfinite(size * size * size)) return {};
  return fmt::format("it is at {}, expected numbers whose cubes do not overflow", vector_text(p));
}

}  // namespace floatframe
