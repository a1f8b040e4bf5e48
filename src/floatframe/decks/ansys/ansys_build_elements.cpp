// Solids, shells, beams and rods; of beams and rods also their sections, axes and ends.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/fe/solid_shapes.hpp"

namespace floatframe {
namespace {

/// BEAM4: AREA, IZZ, IYY, TKZ, TKY, THETA, ISTRN, IXX, SHEARZ, SHEARY, SPIN, ADDMAS.
std::optional<AnsysBeam> beam_of_constants(AnsysBuild& b, const AnsysElement& e) {
  const AnsysReal* real = b.needed_real(e);
  if (real == nullptr) return std::nullopt;
  AnsysBeam beam;
  const auto r = [&](std::size_t k) { return real->value(k); };
  BeamSection& s = beam.section;
  s.A = r(0);
  s.Iz = r(1);
  s.Iy = r(2);
  s.J = r(7) != 0.0 ? r(7) : r(1) + r(2);
  if (r(8) > 0.0) s.shear_z = s.A / r(8);
  if (r(9) > 0.0) s.shear_y = s.A / r(9);
  beam.turn = r(5) * ansys_degree;
  beam.mass = r(11);
  if (!(s.A > 0.0 && s.Iz > 0.0 && s.Iy > 0.0)) {
    b.error_once(
        ErrorCode::out_of_range, real->at,
        "real constants {}: AREA, IZZ and IYY are {:g}, {:g} and {:g}, expected more than 0",
        e.real, s.A, s.Iz, s.Iy);
    return std::nullopt;
  }
  if (const std::string misfit = ansys_beam_misfit(beam); !misfit.empty()) {
    b.error_once(ErrorCode::wrong_value, real->at, "real constants {}: {}", e.real, misfit);
    return std::nullopt;
  }
  return beam;
}

std::optional<AnsysBeam> beam_section_of(AnsysBuild& b, const AnsysElement& e,
                                         const AnsysType& type) {
  if (type.number == 4) return beam_of_constants(b, e);
  const char* const kind = type.number == 288 || type.number == 289 ? "PIPE" : "BEAM";
  const AnsysSection* s = b.section(e, kind);
  if (s == nullptr) {
    b.shared_error(ErrorCode::not_found, e, "its section {} is no SECTYPE,{},{}", e.section,
                   e.section, kind);
    return std::nullopt;
  }
  return ansys_beam_section(b, *s, e);
}

/// Local y: from the orientation node, which is towards z; without one parallel to the global
/// xy plane, for an element along z the global y.
Vec3 local_y(const Vec3& along, const Vec3* towards_z) {
  const Vec3 x = along.normalized();
  if (towards_z != nullptr) return towards_z->cross(x);
  const Vec3 y = Vec3::UnitZ().cross(x);
  return y.norm() > 1e-4 ? y : Vec3(Vec3::UnitY());
}

int add_section(FeModel& model, const BeamSection& s) {
  const auto key = [](const BeamSection& x) {
    return std::tie(x.A, x.Iy, x.Iz, x.J, x.shear_y, x.shear_z, x.outline, x.width, x.height,
                    x.bore);
  };
  for (std::size_t k = model.sections.size(); k-- > 0;)
    if (key(model.sections[k]) == key(s)) return static_cast<int>(k);
  model.sections.push_back(s);
  return static_cast<int>(model.sections.size()) - 1;
}

bool rod(AnsysBuild& b, const AnsysElement& e, const AnsysType& type, FeElement& element) {
  BeamSection s;
  double mass = 0.0;
  bool one_way = false;
  const AnsysSection* section = type.number == 180 ? b.section(e, "LINK") : nullptr;
  if (section != nullptr && !section->rows.empty()) {
    s.A = ansys_value(section->rows.front(), 0);
    mass = ansys_value(section->control, 0);
    one_way = ansys_value(section->control, 1) != 0.0;
  } else if (const AnsysReal* real = b.real(e)) {
    s.A = real->value(0);
    if (type.number == 180) mass = real->value(1);
    one_way = type.number == 180 && real->value(2) != 0.0;
  }
  if (one_way)
    return b.shared_error(ErrorCode::unsupported, e,
                          "it is for tension or compression alone (TENSKEY), which is not linear");
  if (!(s.A > 0.0))
    return b.shared_error(
        ErrorCode::missing, e,
        "neither its section {} (SECTYPE,{},LINK) nor its real constants {} give an area above 0",
        e.section, e.section, e.real);
  element.type = FeElementType::rod2;
  element.material = b.material(e.material, e, mass / s.A);
  element.section = add_section(b.model, s);
  return true;
}

bool build_line(AnsysBuild& b, const AnsysElement& e, const AnsysType& type,
                const std::vector<int>& nodes, FeElement& element) {
  const AnsysFamily family = ansys_library_element(type.number)->family;
  const std::size_t count = family == AnsysFamily::beam3 ? 3 : 2;
  if (nodes.size() < count || std::any_of(nodes.begin(), nodes.begin() + static_cast<int>(count),
                                          [](int n) { return n < 0; }))
    return b.error(ErrorCode::wrong_count, e, "it has fewer than {} nodes", count);
  const std::vector<Vec3>& p = b.model.positions;
  const Vec3 along = p[nodes[1]] - p[nodes[0]];
  element.nodes[0] = nodes[0];
  element.nodes[1] = nodes[1];
  if (!(along.norm() > 0.0)) return b.error(ErrorCode::geometry, e, "its ends are at one place");
  if (family == AnsysFamily::rod) return rod(b, e, type, element);
  const auto beam = beam_section_of(b, e, type);
  if (!beam) return false;
  element.type = family == AnsysFamily::beam3 ? FeElementType::beam3 : FeElementType::beam2;
  if (family == AnsysFamily::beam3) {  // ends, middle there; end, middle, end here
    element.nodes[1] = nodes[2];
    element.nodes[2] = nodes[1];
  }
  const bool oriented = nodes.size() > count && nodes[count] >= 0;
  const Vec3 towards = oriented ? Vec3(p[nodes[count]] - p[nodes[0]]) : Vec3::Zero();
  const Vec3 x = along.normalized();
  if (oriented && !(x.cross(towards).norm() > 1e-8 * towards.norm()))
    return b.error(ErrorCode::geometry, e, "its node for the orientation is on its axis");
  const Vec3 y = local_y(along, oriented ? &towards : nullptr);
  const Vec3 unit_y = (y - y.dot(x) * x).normalized(), z = x.cross(unit_y);
  element.reference = std::cos(beam->turn) * unit_y + std::sin(beam->turn) * z;
  element.material = b.material(e.material, e, beam->mass / beam->section.A);
  element.section = add_section(b.model, beam->section);
  const Vec3 arm = beam->arm_y * unit_y + beam->arm_z * z;
  if (!arm.isZero(0.0))
    for (std::size_t k = 0; k < count; ++k)
      element.nodes[k] = b.arms.end(b.model, b.source, element.nodes[k], arm, e.at);
  return true;
}

using F = AnsysFamily;

class AnsysElementBuilder {
 public:
  explicit AnsysElementBuilder(AnsysBuild& build) : b_(build) {}

  void build() {
    const auto& elements = b_.content.elements;
    b_.index.assign(elements.size(), -1);
    for (std::size_t k = 0; k < elements.size(); ++k) one(elements[k], b_.index[k]);
    b_.report_shared();
    const bool springs = std::any_of(elements.begin(), elements.end(), [&](const auto& e) {
      const auto* library = b_.known(e).second;
      return library != nullptr && (library->family == F::spring || library->family == F::matrix);
    });
    if (b_.model.elements.empty() && !springs && b_.source.errors() == 0)
      b_.source.stop(ErrorCode::missing, {0, 0},
                     "the file has {} elements and none of them is a solid, a shell, a beam, a rod "
                     "or a spring",
                     elements.size());
    notes();
  }

 private:
  void one(const AnsysElement& e, int& index) {
    const AnsysType* type = b_.type(e);
    if (type == nullptr) return;
    const AnsysLibraryElement& library = *ansys_library_element(type->number);
    if (library.family == F::ignored) ++ignored_[library.name];
    const bool line =
        library.family == F::beam2 || library.family == F::beam3 || library.family == F::rod;
    const bool solid =
        library.family == F::brick || library.family == F::brick20 || library.family == F::tet;
    if (!line && !solid && library.family != F::shell) return;
    if (!b_.nodes_of(e, nodes_)) return;
    FeElement element;
    element.id = e.id;
    element.source = e.at;
    if (line ? !build_line(b_, e, *type, nodes_, element) : !volume(e, *type, library, element))
      return;
    if (b_.content.lumped) element.mass_form = MassForm::lumped;
    index = static_cast<int>(b_.model.elements.size());
    b_.model.elements.push_back(std::move(element));
  }

  /// Solids and shells.
  bool volume(const AnsysElement& e, const AnsysType& type, const AnsysLibraryElement& library,
              FeElement& element) {
    if (static_cast<int>(nodes_.size()) > library.nodes &&
        std::any_of(nodes_.begin() + library.nodes, nodes_.end(), [](int n) { return n >= 0; }))
      return b_.error(ErrorCode::wrong_count, e, "it has {} nodes, at most {} are expected",
                      nodes_.size(), library.nodes);
    for (int& n : nodes_) ++n;  // 0: none
    const auto shape = ansys_shape(library, type, nodes_);
    if (!shape)
      return b_.error(ErrorCode::missing, e,
                      "its nodes are repeated or missing in a way that makes no element");
    element.type = shape->type;
    for (int k = 0; k < shape->count; ++k) element.nodes[k] = shape->nodes[k] - 1;
    middles(e, *shape, element);
    if (library.family != F::shell && ansys_has_layers(b_, e, type))
      return build_ansys_layers(b_, e, type, element);
    element.material = b_.material(e.material, e);
    if (library.family == F::shell)
      build_ansys_shell(b_, e, type, element);
    else if (b_.model.materials[element.material].elasticity)
      element.orientation = b_.orientation(e.system, e.at, b_.label(e));
    return true;
  }

  /// An edge without its mid-side node is straight: a generated node there moves as the mean of
  /// the ends.
  void middles(const AnsysElement& e, const AnsysShape& shape, FeElement& element) {
    const std::span<const shape::Edge> edges = edges_of(shape.type);
    const int corners = shape.count - static_cast<int>(edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k) {
      int& middle = element.nodes[corners + k];
      if (middle >= 0) continue;
      const int a = element.nodes[edges[k][0]], b = element.nodes[edges[k][1]];
      const auto [it, fresh] = middles_.try_emplace(std::minmax(a, b), b_.model.nodes());
      middle = it->second;
      if (!fresh) continue;
      add_generated_node(b_.model, b_.source, 0.5 * (b_.model.positions[a] + b_.model.positions[b]),
                         e.at, b_.largest_node);
      for (int axis = 0; axis < 3; ++axis) {
        b_.model.equations.push_back(
            {{{middle, axis, 1.0}, {a, axis, -0.5}, {b, axis, -0.5}}, e.at});
      }
    }
  }

  static std::span<const shape::Edge> edges_of(FeElementType type) {
    switch (type) {
      case FeElementType::tet10:
        return shape::tet_edges;
      case FeElementType::hex20:
      case FeElementType::hex20r:
        return shape::hex_edges;
      case FeElementType::wedge15:
        return shape::wedge_edges;
      case FeElementType::pyramid13:
        return shape::pyramid_edges;
      case FeElementType::tri6:
        return shape::tri_edges;
      case FeElementType::quad8:
        return shape::quad_edges;
      default:
        return {};
    }
  }

  void notes() {
    for (const auto& [name, count] : ignored_)
      b_.file_note("{} {} have neither stiffness nor mass and are left out", count, name);
    if (!middles_.empty())
      b_.file_note("{} edges without their mid-side node are kept straight, by equations",
                   middles_.size());
    const auto layered = std::count_if(b_.model.elements.begin(), b_.model.elements.end(),
                                       [](const FeElement& e) { return e.layup >= 0; });
    if (layered > 0)
      b_.file_note(
          "{} solids have layers: each layer has the points of its element here, in ANSYS as many "
          "through its thickness as SECDATA gives",
          layered);
    if (b_.content.materials.empty() && !b_.options.material)
      b_.file_note("the file has no material");
  }

  AnsysBuild& b_;
  std::vector<int> nodes_;
  std::map<std::string, int> ignored_;
  std::map<std::pair<int, int>, int> middles_;
};

}  // namespace

void build_ansys_elements(AnsysBuild& build) { AnsysElementBuilder(build).build(); }

}  // namespace floatframe
