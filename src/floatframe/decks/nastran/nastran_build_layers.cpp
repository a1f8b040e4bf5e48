// Materials with axes, shell sections and the axes of elements. Axis 1 of a shell is at THETA from
// its side G1-G2, or the x axis of the system MCID projected on it.
#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/fe/elasticity.hpp"
#include "floatframe/fe/shell_layers.hpp"

namespace floatframe {
namespace {

int system_orientation(NastranBuild& build, int system, const FeSource& at) {
  const auto [it, fresh] =
      build.orientation_of.try_emplace(system, static_cast<int>(build.model.orientations.size()));
  if (!fresh) return it->second;
  build.model.orientations.push_back(build.frame(system, at));
  return it->second;
}

/// TS of a PSHELL by the shear modulus of its first material.
double shear_thickness(NastranBuild& build, const NastranProperty& p,
                       const std::function<int(int)>& material) {
  if (p.shear_material == 0 || p.shear_material == p.material) return p.shell_shear;
  const int first = material(p.material), other = material(p.shear_material);
  const std::vector<Material>& all = build.model.materials;
  if (all[first].elasticity || all[other].elasticity) {
    build.error(ErrorCode::unsupported, p, "MID3 is not MID1: that is read of MAT1 only");
    return 0.0;
  }
  return p.shell_shear * all[other].shear() / all[first].shear();
}

/// MID4: no elasticity, so its constants may have any sign.
Mat3 coupling_of(NastranBuild& build, const NastranProperty& p) {
  const auto it = build.content.materials.find(p.coupling);
  if (it != build.content.materials.end() && it->second.plane)
    return build.content.stiffness_factor *
           plane_stress(anisotropic_material(*it->second.elasticity, true, 0.0));
  build.error(ErrorCode::wrong_value, p, "MID4 is {}, expected a MAT2", p.coupling);
  return Mat3::Zero();
}

}  // namespace

ShellSection nastran_shell_section(NastranBuild& build, const NastranElement& e,
                                   const NastranProperty& p,
                                   const std::function<int(int)>& material) {
  ShellSection s;
  s.thickness = p.thickness;
  s.offset = e.offset;
  if (p.plies.empty()) {
    if (p.bending != 0 && p.bending != p.material) s.bending = material(p.bending);
    if (p.coupling != 0) s.coupling = coupling_of(build, p);
    s.shear = shear_thickness(build, p, material);
    s.bending_factor = p.bending_factor;
    return s;
  }
  s.shear = p.shell_shear;
  s.smeared = p.smeared;
  s.mass = p.nonstructural * build.content.mass_factor;
  s.plies = p.plies;
  for (ShellPly& ply : s.plies) ply.material = material(ply.material);
  if (!p.z0) return s;
  const double middle = *p.z0 + 0.5 * p.thickness;
  if (e.offset != 0.0 && std::abs(middle) > 1e-6 * p.thickness)
    build.error(ErrorCode::exclusive, e,
                "it has an offset ZOFFS, and its {} a Z0 of {:g}: give one of them", p.label(),
                *p.z0);
  s.offset += middle;
  return s;
}

void orient_nastran_shell(NastranBuild& build, const NastranElement& e, FeElement& result) {
  const ShellSection& section = build.model.shells[result.section];
  if (is_plain(section, build.model.materials[result.material])) return;
  result.angle = e.theta;
  if (e.material_system < 0) return;
  result.orientation = system_orientation(build, e.material_system, e.at);
  if (build.model.orientations[result.orientation].kind != Orientation::Kind::rectangular)
    build.error(
        ErrorCode::unsupported, e,
        "its material system MCID {} is cylindrical or spherical, expected a rectangular one",
        e.material_system);
}

void orient_nastran_solid(NastranBuild& build, const NastranProperty& p, FeElement& result) {
  if (!build.model.materials[result.material].elasticity || p.material_system == 0) return;
  if (p.material_system < 0)
    return build.source.error(
        ErrorCode::unsupported, p.at,
        "PSOLID: CORDM is {}: axes of the element are not read, give a coordinate system",
        p.material_system);
  result.orientation = system_orientation(build, p.material_system, p.at);
}

/// Shells that are read as others.
void note_nastran_shells(NastranBuild& build) {
  struct Kind {
    std::string_view card;
    FeElementType type;
    const char* text;
    bool bends = false;  // only for shells
    NastranCount count = {};
  };
  Kind kinds[] = {
      {"CTRIA6", FeElementType::tri6, "CTRIA6 elements are four flat triangles each", true},
      {"CQUAD8", FeElementType::quad8, "CQUAD8 elements are flat triangles between all their nodes",
       true},
      {"CTRIA6", FeElementType::tri3, "CTRIA6 elements without mid-side nodes are read as CTRIA3"},
      {"CQUAD8", FeElementType::quad4, "CQUAD8 elements without mid-side nodes are read as CQUAD4"},
      {"CTRIAR", FeElementType::tri3, "CTRIAR elements are read as CTRIA3"},
      {"CQUADR", FeElementType::quad4, "CQUADR elements are read as CQUAD4"}};
  const auto membrane = [&](const NastranElement& e) {
    const auto property = build.content.properties.find(e.property);
    return property != build.content.properties.end() && property->second.membrane;
  };
  for (const NastranElement& e : build.content.elements)
    for (Kind& k : kinds)
      if (e.surface && e.type == k.type && e.card == k.card && !(k.bends && membrane(e)))
        k.count.add(e.at);
  for (const Kind& k : kinds) build.note(k.count, k.text);
}

}  // namespace floatframe
