// Solids, shells, beams and rods.

#include <algorithm>
#include <map>
#include <span>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/fe/solid_shapes.hpp"

namespace floatframe {
namespace {

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
    if (library.family == F::passed_over) ++passed_over_[library.name];
    const bool line =
        library.family == F::beam2 || library.family == F::beam3 || library.family == F::rod;
    const bool solid =
        library.family == F::brick || library.family == F::brick20 || library.family == F::tet;
    if (!line && !solid && library.family != F::shell) return;
    if (!b_.nodes_of(e, nodes_)) return;
    Element element;
    element.id = e.id;
    element.source = e.at;
    if (line ? !build_ansys_line(b_, e, *type, nodes_, element)
             : !volume(e, *type, library, element))
      return;
    if (b_.content.lumped) element.mass_form = MassForm::lumped;
    index = static_cast<int>(b_.model.elements.size());
    b_.model.elements.push_back(std::move(element));
  }

  /// Solids and shells.
  bool volume(const AnsysElement& e, const AnsysType& type, const AnsysLibraryElement& library,
              Element& element) {
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
    if (library.family == F::shell) {
      build_ansys_shell(b_, e, type, element);
    } else if (b_.model.materials[element.material].elasticity) {
      element.orientation = b_.orientation(e.system, e.at, b_.label(e));
    }
    return true;
  }

  /// An edge without its mid-side node is straight: a node of its own there moves as the mean of
  /// the ends.
  void middles(const AnsysElement& e, const AnsysShape& shape, Element& element) {
    const std::span<const shape::Edge> edges = edges_of(shape.type);
    const int corners = shape.count - static_cast<int>(edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k) {
      int& middle = element.nodes[corners + k];
      if (middle >= 0) continue;
      const int a = element.nodes[edges[k][0]], b = element.nodes[edges[k][1]];
      const auto [it, fresh] = middles_.try_emplace(std::minmax(a, b), b_.model.nodes());
      middle = it->second;
      if (!fresh) continue;
      add_own_node(b_.model, b_.source, 0.5 * (b_.model.positions[a] + b_.model.positions[b]), e.at,
                   b_.largest_node);
      for (int axis = 0; axis < 3; ++axis) {
        LinearEquation equation;
        equation.terms = {{middle, axis, 1.0}, {a, axis, -0.5}, {b, axis, -0.5}};
        equation.source = e.at;
        b_.model.equations.push_back(std::move(equation));
      }
    }
  }

  static std::span<const shape::Edge> edges_of(ElementType type) {
    switch (type) {
      case ElementType::tet10:
        return shape::tet_edges;
      case ElementType::hex20:
      case ElementType::hex20r:
        return shape::hex_edges;
      case ElementType::wedge15:
        return shape::wedge_edges;
      case ElementType::pyramid13:
        return shape::pyramid_edges;
      case ElementType::tri6:
        return shape::tri_edges;
      case ElementType::quad8:
        return shape::quad_edges;
      default:
        return {};
    }
  }

  void notes() {
    for (const auto& [name, count] : passed_over_)
      b_.file_note("{} {} have neither stiffness nor mass and are left out", count, name);
    if (!middles_.empty())
      b_.file_note("{} edges without their mid-side node are kept straight, by equations",
                   middles_.size());
    const auto layered = std::count_if(b_.model.elements.begin(), b_.model.elements.end(),
                                       [](const Element& e) { return e.layup >= 0; });
    if (layered > 0)
      b_.file_note(
          "{} solids have layers: each layer has the points of its element here, in ANSYS as many "
          "through its thickness as SECDATA says",
          layered);
    if (b_.content.materials.empty() && !b_.options.material)
      b_.file_note("the file has no material");
  }

  AnsysBuild& b_;
  std::vector<int> nodes_;
  std::map<std::string, int> passed_over_;
  std::map<std::pair<int, int>, int> middles_;
};

}  // namespace

void build_ansys_elements(AnsysBuild& build) { AnsysElementBuilder(build).build(); }

}  // namespace floatframe
