#include "floatframe/decks/number_sizes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/math/vector_text.hpp"

namespace floatframe {

std::string huge_constant(const Material& m) {
  const auto text = [](const char* what, double value) {
    return fmt::format("its {} is {:g}, expected a number whose square does not overflow", what,
                       value);
  };
  const auto huge = [](double x) { return !std::isfinite(x * x); };
  if (huge(m.density)) return text("density", m.density);
  if (m.elasticity) {
    for (const double x : m.elasticity->reshaped())
      if (huge(x)) return text("elasticity", x);
  } else if (huge(m.young)) {
    return text("Young's modulus", m.young);
  }
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
        "its middle is {:g} beside its nodes, expected a number whose square does not overflow",
        shell.offset);
  return {};
}

std::string huge_mass(double mass, const Mat3& J) {
  const double inertia = J.cwiseAbs().maxCoeff();
  const bool by_mass = !std::isfinite(mass * mass);
  if (!by_mass && std::isfinite(inertia * inertia)) return {};
  return fmt::format("its {} is {:g}, expected a number whose square does not overflow",
                     by_mass ? "mass" : "moment of inertia", by_mass ? mass : inertia);
}

std::string huge_place(const Vec3& p) {
  const double size = p.cwiseAbs().sum();
  if (std::isfinite(size * size * size)) return {};
  return fmt::format("it is at {}, expected numbers whose cubes do not overflow", vector_text(p));
}

}  // namespace floatframe
