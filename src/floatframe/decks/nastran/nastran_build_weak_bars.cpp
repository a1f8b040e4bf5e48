// Bars of which I1, I2 or J is 0. They have no stiffness there, so as beams they would leave
// rotations of nodes without any, which Nastran takes out one by one (AUTOSPC). Here they are rods
// with springs for what stiffness they have, since rotations that springs alone hold are condensed
// (fe/springs.hpp). In a plane with EI and L, phi = 12 EI/(G As L^2), the beam is
//   12 EI/(L^3 (1 + phi)) of v_2 - v_1 - L/2 (r_1 + r_2)  and  EI/L of r_2 - r_1,
// exactly; torsion comes with the rod (build_nastran_torsion).
#include <fmt/format.h>

#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {

bool is_weak_nastran_bar(const NastranProperty& p, const NastranBarEnds* ends) {
  const BeamSection& s = p.section;
  if (!(s.A > 0.0) || s.Iy < 0.0 || s.Iz < 0.0 || s.J < 0.0) return false;  // an error
  if (s.Iy == 0.0 && s.Iz == 0.0) return true;
  const bool plain =
      ends == nullptr || (ends->pins[0] == 0 && ends->pins[1] == 0 && ends->offset[0].isZero(0.0) &&
                          ends->offset[1].isZero(0.0));
  return plain && (s.Iy == 0.0 || s.Iz == 0.0 || s.J == 0.0);
}

std::string weak_nastran_bar_note(const NastranProperty& p) {
  const BeamSection& s = p.section;
  std::string zero;
  const std::pair<const char*, double> values[] = {{"I1", s.Iz}, {"I2", s.Iy}, {"J", s.J}};
  for (const auto& [name, value] : values)
    if (value == 0.0) zero += fmt::format("{}{}", zero.empty() ? "" : ", ", name);
  const bool bends = s.Iy > 0.0 || s.Iz > 0.0;
  return fmt::format("without {} its elements are rods{}{}", zero, s.J > 0.0 ? " with torsion" : "",
                     bends ? " and springs that bend as the beam does (without rotary inertia, "
                             "stress and stress stiffness of bending)"
                           : "");
}

void add_nastran_bending(NastranBuild& build, const Element& rod, const BeamSection& s,
                         double shear_modulus, const std::string& who) {
  FeModel& model = build.model;
  const Vec3 d = model.positions[rod.nodes[1]] - model.positions[rod.nodes[0]];
  const Mat3 T = nastran_bar_axes(d, rod.reference);
  if (!(T.squaredNorm() > 2.5)) return nastran_bar_without_axes(build, rod.source, who);
  const double L = d.norm(), E = model.materials[rod.material].young;
  for (const bool xz : {false, true}) {
    const double EI = E * (xz ? s.Iy : s.Iz), area = xz ? s.shear_z : s.shear_y;
    if (EI == 0.0) continue;
    const double phi = area > 0.0 ? 12.0 * EI / (shear_modulus * area * L * L) : 0.0;
    // The slope of the deflection is r about z, and -r about y.
    const Vec3 across = T.col(xz ? 2 : 1), about = xz ? Vec3(-T.col(1)) : Vec3(T.col(2));
    Spring shear, moment;
    for (Spring* spring : {&shear, &moment}) {
      spring->nodes = {rod.nodes[0], rod.nodes[1]};
      spring->name = fmt::format("the bending of {}", who);
      spring->source = rod.source;
    }
    shear.stiffness = 12.0 * EI / (L * L * L * (1.0 + phi));
    shear.directions[0] << -across, -0.5 * L * about;
    shear.directions[1] << across, -0.5 * L * about;
    moment.stiffness = EI / L;
    moment.directions[0].tail<3>() = -about;
    moment.directions[1].tail<3>() = about;
    model.springs.push_back(std::move(shear));
    model.springs.push_back(std::move(moment));
  }
}

}  // namespace floatframe
