// Layers of solids: SOLID185 and 186 with KEYOPT(3) = 1, and SOLSH190 with a SHELL section. The
// thicknesses of a section are shares of that of the element, from the face I-J-K-L to M-N-O-P;
// angles count from the x axis of ESYS projected on the layer, else from the first natural
// direction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// As many as ANSYS has.
constexpr std::size_t most_layers = 250;

/// Layers with a thickness; empty with an error.
std::vector<ShellPly> solid_plies(AnsysBuild& b, const AnsysSection& section,
                                  const AnsysElement& e) {
  const std::string who = fmt::format("section {}", e.section);
  const auto refuse = [&](ErrorCode code, const std::string& text) {
    b.source.error(code, section.at, who + text);
    return std::vector<ShellPly>();
  };
  std::vector<ShellPly> plies;
  for (const std::vector<double>& row : section.rows) {
    const double t = ansys_value(row, 0);
    if (!row.empty() && t == 0.0) continue;  // a layer that is dropped
    if (!(t > 0.0) || !std::isfinite(t))
      return refuse(ErrorCode::out_of_range,
                    fmt::format(": a layer is {:g} thick, expected more than 0", t));
    const std::optional<int> material = b.layer_material(ansys_value(row, 1), e, section.at);
    if (!material) return {};
    plies.push_back({*material, t, ansys_value(row, 2) * std::numbers::pi / 180.0});
  }
  double thick = 0.0, mass = 0.0;
  for (const ShellPly& ply : plies) {
    thick += ply.thickness;
    mass += ply.thickness * b.model.materials[ply.material].density;
  }
  if (!std::isfinite(thick + mass))
    return refuse(ErrorCode::not_finite,
                  fmt::format(": the thickness of its layers is {:g} and their mass over area "
                              "{:g}, expected finite numbers",
                              thick, mass));
  if (plies.empty()) return refuse(ErrorCode::missing, " has no layer with a thickness (SECDATA)");
  if (plies.size() > most_layers)
    return refuse(
        ErrorCode::too_large,
        fmt::format(" has {} layers, expected at most {} in a solid", plies.size(), most_layers));
  if (!section.offset.empty() && section.offset != "MID")
    return refuse(
        ErrorCode::unsupported,
        fmt::format(": SECOFFSET,{} of layers of solids is not read: they fill their element",
                    section.offset));
  if (std::any_of(section.control.begin(), section.control.end(),
                  [](double x) { return x != 0.0; }))
    return refuse(ErrorCode::unsupported, ": SECCONTROL of layers of solids is not read");
  return plies;
}

/// Index in FeModel::layups, once for each section and material of elements; -1 with an error.
int layup_of(AnsysBuild& b, const AnsysElement& e) {
  const auto [it, fresh] = b.layups.try_emplace({e.section, e.material}, -1);
  if (!fresh) return it->second;
  const AnsysSection* section = b.section(e, "SHEL");
  if (section == nullptr) {
    b.error(ErrorCode::contradiction, e,
            fmt::format("it has layers (KEYOPT(3) = 1), but its section {} is no SECTYPE,{},SHELL",
                        e.section, e.section));
    return -1;
  }
  std::vector<ShellPly> plies = solid_plies(b, *section, e);
  if (plies.empty()) return -1;
  b.model.layups.push_back({std::move(plies)});
  return it->second = static_cast<int>(b.model.layups.size()) - 1;
}

/// Is axis 1 far enough from the normal of the layers, in the middle of the element?
bool layers_oriented(AnsysBuild& b, const AnsysElement& e, const Element& element) {
  const std::size_t corners = element_kernel(element.type).shape.neighbours.size();
  const std::size_t side = corners / 2;  // the others are above
  std::vector<Vec3> p;
  Vec3 middle = Vec3::Zero();
  for (std::size_t k = 0; k < side; ++k) {
    const std::vector<Vec3>& all = b.model.positions;
    p.emplace_back(0.5 * (all[element.nodes[k]] + all[element.nodes[k + side]]));
    middle += p.back() / static_cast<double>(side);
  }
  const Vec3 x = b.model.orientations[element.orientation].at(middle).col(0);
  if (std::abs(x.dot(shell_normal(p))) <= std::numbers::sqrt2 / 2.0) return true;
  b.error(ErrorCode::geometry, e,
          fmt::format("the x axis of its coordinate system {} is nearer to the normal of its "
                      "layers than 45 degrees",
                      e.system));
  return false;
}

}  // namespace

bool ansys_has_layers(const AnsysBuild& b, const AnsysElement& e, const AnsysType& type) {
  if (type.number == 190) return b.section(e, "SHEL") != nullptr;
  return (type.number == 185 || type.number == 186) && type.keyopt[3] != 0;
}

bool build_ansys_layers(AnsysBuild& b, const AnsysElement& e, const AnsysType& type,
                        Element& element) {
  const int layup = layup_of(b, e);
  if (layup < 0) return false;
  const std::vector<ShellPly>& plies = b.model.layups[layup].plies;
  element.material = plies.front().material;
  const bool uniform = std::all_of(plies.begin(), plies.end(), [&](const ShellPly& ply) {
    return ply.material == plies.front().material;
  });
  // Layers of SOLID185 have enhanced strains, whatever its KEYOPT(2).
  const bool brick = element.type == ElementType::hex8 || element.type == ElementType::hex8r;
  if (brick && type.number == 185) element.type = ElementType::hex8i;
  if (uniform && !b.model.materials[element.material].elasticity) return true;
  if (element_kernel(element.type).nodal_ply == nullptr) {
    b.error(ErrorCode::unsupported, e,
            "its layers are those of a pyramid or tetrahedron, expected a brick or a wedge");
    return false;
  }
  element.layup = layup;
  element.orientation = b.orientation(e.system, e.at, b.label(e));
  if (e.system == 0) return true;
  return element.orientation >= 0 && layers_oriented(b, e, element);
}

}  // namespace floatframe
