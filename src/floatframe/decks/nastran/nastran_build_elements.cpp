#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {
namespace {

/// Of a mass per length or area; a size that is not positive has a separate error.
double density_of(double mass, double size) { return size > 0.0 ? mass / size : 0.0; }

class ElementBuilder {
 public:
  ElementBuilder(NastranBuild& build, const FeReadOptions& options)
      : b_(build),
        c_(build.content),
        options_(options),
        bars_(build),
        materials_(build),
        tapers_(nastran_tapers(build)) {}

  void build() {
    mesh_only_ = c_.properties.empty() && c_.materials.empty() && c_.other_materials.empty();
    if (mesh_only_ && options_.material) {
      b_.model.materials.push_back(*options_.material);
      b_.model.material_names.emplace_back();
    }
    std::unordered_map<int, FeSource> seen;
    for (const NastranElement& e : c_.elements) {
      const auto [it, fresh] = seen.try_emplace(e.id, e.at);
      if (!fresh && e.id > 0)
        b_.error(ErrorCode::duplicate, e,
                 "this element number is in the file twice, first in line {}", it->second.line);
      if (mesh_only_ &&
          (e.surface || e.type == FeElementType::beam2 || e.type == FeElementType::rod2)) {
        skin(e);
      } else {
        element(e);
      }
    }
    bars_.finish();
    notes();
  }

 private:
  std::vector<std::string> set_names(int property) const {
    std::vector<std::string> names = {fmt::format("PID {}", property)};
    const auto it = c_.names.properties.find(property);
    if (it != c_.names.properties.end() && it->second != names[0]) names.push_back(it->second);
    return names;
  }

  /// A surface or line of a mesh without properties: its nodes are a set.
  void skin(const NastranElement& e) {
    skins_.add(e.at);
    for (int k = 0; k < e.count; ++k) {
      const int node = b_.node(e.nodes[k], e);
      if (node < 0) return;
      for (const std::string& name : set_names(e.property))
        if (members_[name].insert(node).second) b_.model.node_sets[name].push_back(node);
    }
  }

  /// The cards that its property may be; the first is expected.
  static std::array<std::string_view, 3> property_cards(const NastranElement& e) {
    if (e.type == FeElementType::shear4) return {"PSHEAR"};
    if (e.surface) return {"PSHELL", "PCOMP", "PCOMPG"};
    if (e.card == "CBAR") return {"PBAR", "PBARL"};
    if (e.card == "CBEAM") return {"PBEAM", "PBEAML"};
    if (e.type == FeElementType::rod2) return {e.card == "CTUBE" ? "PTUBE" : "PROD", "CONROD"};
    return {"PSOLID"};
  }

  /// Null with an error.
  const NastranProperty* property(const NastranElement& e) {
    const auto it = c_.properties.find(e.property);
    if (it == c_.properties.end()) {
      if (missing_.insert(e.property).second)
        b_.error(ErrorCode::not_found, e, "property {} is not in the file", e.property);
      return nullptr;
    }
    const auto cards = property_cards(e);
    if (std::find(cards.begin(), cards.end(), it->second.card) != cards.end()) return &it->second;
    b_.error(ErrorCode::wrong_value, e, "property {} is a {}, expected a {}", e.property,
             it->second.card, cards[0]);
    return nullptr;
  }

  void element(const NastranElement& e) {
    FeElement result;
    result.type = e.type;
    result.id = e.id;
    result.source = e.at;
    for (int k = 0; k < e.count; ++k) {
      result.nodes[k] = b_.node(e.nodes[k], e);
      if (result.nodes[k] < 0) return;
    }
    if (mesh_only_) {
      result.material = options_.material ? 0 : -1;
      return add(e, result);
    }
    const NastranProperty* const p = property(e);
    if (p == nullptr) return;
    if (e.type == FeElementType::shear4) {
      result.material = materials_.index(*p, density_of(p->nonstructural, p->thickness));
      result.section = shell(e, *p, p->thickness);
      edge_rods(*p, result);
    } else if (e.surface) {
      if (e.other)
        return b_.error(ErrorCode::incomplete, e,
                        "only a part of its mid-side nodes is given; all or none must be");
      // A PCOMP has its nonstructural mass in its section.
      const double t = thickness(e, *p);
      if (p->membrane) result.type = membrane_of(e.type);
      result.material =
          materials_.index(*p, p->plies.empty() ? density_of(p->nonstructural, t) : 0.0);
      result.section = shell(e, *p, t);
      orient_nastran_shell(b_, e, result);
    } else if (e.type == FeElementType::beam2 || e.type == FeElementType::rod2) {
      const bool beam = e.type == FeElementType::beam2;
      if (!p->stations.empty()) return tapered(e, *p, result);
      if (beam && is_weak_nastran_bar(*p, e.ends < 0 ? nullptr : &c_.bar_ends[e.ends]))
        return weak(e, *p, result);
      if (beam && !bars_.place(e, p->turn, true, result)) return;
      result.material = materials_.index(*p, density_of(p->nonstructural, p->section.A));
      result.section = section(e, *p, p->section, beam);
    } else {
      result.material = materials_.index(*p, 0.0);
      orient_nastran_solid(b_, *p, result);
      if (e.type == FeElementType::hex8 && !p->full_integration) result.type = FeElementType::hex8i;
    }
    add(e, result);
  }

  void add(const NastranElement& e, const FeElement& result) {
    if (e.property > 0)  // a CONROD has none
      for (const std::string& name : set_names(e.property))
        b_.model.element_sets[name].push_back(static_cast<int>(b_.model.elements.size()));
    b_.model.elements.push_back(result);
  }

  /// A bar without some of its stiffness: a rod, and springs where it bends.
  void weak(const NastranElement& e, const NastranProperty& p, FeElement& result) {
    const bool bends = p.section.Iy > 0.0 || p.section.Iz > 0.0;
    if (!bends) result.type = FeElementType::rod2;
    if (!bars_.place(e, bends ? p.turn : 0.0, false, result)) return;
    result.type = FeElementType::rod2;
    result.material = materials_.index(p, p.nonstructural / p.section.A);
    result.section = section(e, p, p.section, false);
    if (weak_.insert(e.property).second)
      b_.note(p.at, fmt::format("{}: {}", p.label(), weak_nastran_bar_note(p)));
    const double shear =
        b_.model.materials[result.material].shear() * materials_.own_shear(p.material);
    if (bends) add_nastran_bending(b_, result, p.section, shear, e);
    add(e, result);
  }

  /// A chain of beams of constant section between the ends of a tapered one.
  void tapered(const NastranElement& e, const NastranProperty& p, FeElement& whole) {
    if (!bars_.place(e, 0.0, true, whole)) return;
    const std::vector<NastranPiece>& pieces = tapers_.at(e.property);
    const Vec3 a = b_.model.positions[whole.nodes[0]], b = b_.model.positions[whole.nodes[1]];
    Mat3 T;
    if (!find_nastran_bar_axes(b_, e, b - a, whole.reference, T)) return;
    int last = whole.nodes[0];
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const NastranPiece& piece = pieces[k];
      FeElement part = whole;
      part.nodes[0] = last;
      if (k + 1 < pieces.size())
        part.nodes[1] = b_.add_node(a + piece.to * (b - a), e.at, e.label());
      last = part.nodes[1];
      part.reference = std::cos(piece.turn) * T.col(1) + std::sin(piece.turn) * T.col(2);
      part.material = materials_.index(p, density_of(piece.nonstructural, piece.section.A));
      part.section = section(e, p, piece.section, true, k);
      add(e, part);
    }
  }

  static FeElementType membrane_of(FeElementType shell) {
    switch (shell) {
      case FeElementType::tri3:
        return FeElementType::membrane3;
      case FeElementType::quad4:  // its shear is that of the middle in Nastran too
        return FeElementType::membrane4s;
      case FeElementType::tri6:
        return FeElementType::membrane6;
      default:
        return FeElementType::membrane8;
    }
  }

  /// Of an element's property, or a piece of it if it is tapered.
  int section(const NastranElement& e, const NastranProperty& p, const BeamSection& own, bool beam,
              std::size_t piece = 0) {
    const auto [it, fresh] =
        sections_.try_emplace({e.property, piece}, static_cast<int>(b_.model.sections.size()));
    if (!fresh) return it->second;
    if (!beam) must_be_positive(p, "A", p.section.A);
    if (beam && piece == 0) judge_section(p);
    b_.model.sections.push_back(own);
    const double ratio = materials_.own_shear(p.material);
    BeamSection& s = b_.model.sections.back();
    for (double* x : {&s.J, &s.shear_y, &s.shear_z}) *x *= ratio;
    return it->second;
  }

  /// Errors in a section of bars, and its approximations.
  void judge_section(const NastranProperty& p) {
    const std::pair<const char*, double> values[] = {
        {"A", p.section.A}, {"I1", p.section.Iz}, {"I2", p.section.Iy}, {"J", p.section.J}};
    for (const auto& [name, value] : values) must_be_positive(p, name, value);
    for (const std::string& remark : p.remarks)
      b_.note(p.at, fmt::format("{}: {}", p.label(), remark));
  }

  void must_be_positive(const NastranProperty& p, const char* what, double value) {
    if (!(value > 0.0))
      b_.error(ErrorCode::out_of_range, p, "{} is {:g}, expected more than 0", what, value);
  }

  /// The mean of the corners.
  double thickness(const NastranElement& e, const NastranProperty& p) {
    if (!e.own_thickness) return p.thickness;
    if (!p.plies.empty()) {
      b_.error(ErrorCode::contradiction, e,
               "it has thicknesses of its corners, and its property {} is a {}", p.id, p.card);
      return p.thickness;
    }
    const int corners = e.type == FeElementType::tri3 || e.type == FeElementType::tri6 ? 3 : 4;
    double sum = 0.0, least = 1e300, most = 0.0;
    for (int k = 0; k < corners; ++k) {
      const double own = e.corner_thickness[k];
      const double t = own < 0.0 ? p.thickness : e.relative_thickness ? own * p.thickness : own;
      sum += t;
      least = std::min(least, t);
      most = std::max(most, t);
    }
    const double mean = sum / corners;
    if (most - least > 1e-6 * mean) {
      uneven_.add(e.at);
      unevenness_ = std::max(unevenness_, (most - least) / mean);
      return mean;
    }
    return most;
  }

  int shell(const NastranElement& e, const NastranProperty& p, double t) {
    const auto [it, fresh] =
        shells_.try_emplace({e.property, e.offset, t}, static_cast<int>(b_.model.shells.size()));
    if (!fresh) return it->second;
    must_be_positive(p, "the thickness", t);
    ShellSection section;
    if (e.type == FeElementType::shear4) {
      section.shear = t * materials_.own_shear(p.material);
    } else {
      section = nastran_shell_section(b_, e, p, [&](int id) {
        // For plies the mass counts, for a PSHELL that of its first material.
        return materials_.index(p, 0.0, id, !p.plies.empty());
      });
      if (e.own_thickness && p.thickness > 0.0) section.shear *= t / p.thickness;
    }
    section.thickness = t;
    b_.model.shells.push_back(std::move(section));
    return it->second;
  }

  /// For a panel: F1 along the edges 12 and 34, F2 along the others; without mass. Up to 1.01 a
  /// factor is a fraction of the panel, above a width in thicknesses.
  void edge_rods(const NastranProperty& p, const FeElement& panel) {
    const auto at = [&](int k) { return b_.model.positions[panel.nodes[k % 4]]; };
    const double area = 0.5 * (at(2) - at(0)).cross(at(3) - at(1)).norm();
    for (int k = 0; k < 4; ++k) {
      const double factor = p.edge_factors[k % 2], t = p.thickness;
      const double along = (at(k + 1) - at(k)).norm() + (at(k + 3) - at(k + 2)).norm();
      if (factor == 0.0 || !(along > 0.0)) continue;
      FeElement rod;
      rod.type = FeElementType::rod2;
      rod.source = panel.source;
      rod.nodes[0] = panel.nodes[k];
      rod.nodes[1] = panel.nodes[(k + 1) % 4];
      rod.material = materials_.massless(panel.material);
      rod.section = static_cast<int>(b_.model.sections.size());
      b_.model.sections.push_back({});
      b_.model.sections.back().A = factor > 1.01 ? 0.5 * factor * t * t : factor * t * area / along;
      b_.model.elements.push_back(rod);
    }
  }

  void notes() {
    const bool nothing = b_.model.elements.empty() && c_.springs.empty();
    if (nothing && b_.source.errors() == 0)
      b_.source.error(
          ErrorCode::missing, {0, 0},
          mesh_only_ && skins_.number > 0
              ? "the file has no solid elements, and its shells and bars have no properties"
              : "the file has no solid, shell, bar, rod or spring; of masses and rigid elements "
                "alone there is no flexible part");
    b_.note(skins_, "surfaces and lines of the mesh have no property: they only make node sets");
    b_.note(uneven_, fmt::format("shells have corners of different thickness, by {:.1f} % at most: "
                                 "each has the mean of its corners",
                                 100.0 * unevenness_));
    if (mesh_only_ && !options_.material && !b_.model.elements.empty())
      b_.note(b_.model.elements[0].source, "the file has no material");
    if (!mesh_only_ && options_.material)
      b_.note(FeSource{0, 1}, "the file has materials of its own; the one given is not used");
  }

  NastranBuild& b_;
  const NastranContent& c_;
  const FeReadOptions& options_;
  NastranBars bars_;
  NastranMaterials materials_;
  std::map<int, std::vector<NastranPiece>> tapers_;
  bool mesh_only_ = false;
  NastranCount skins_;
  std::set<int> missing_, weak_;
  std::map<std::string, std::set<int>> members_;
  std::map<std::pair<int, std::size_t>, int> sections_;
  std::map<std::tuple<int, double, double>, int> shells_;
  NastranCount uneven_;  // shells whose corners differ in thickness
  double unevenness_ = 0.0;
};

}  // namespace

void build_nastran_elements(NastranBuild& build, const FeReadOptions& options) {
  ElementBuilder(build, options).build();
}

}  // namespace floatframe
