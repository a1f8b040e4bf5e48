#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/fe/elasticity.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/formats/nastran/nastran_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

class ElementBuilder {
 public:
  ElementBuilder(NastranBuild& build, const FeReadOptions& options)
      : b_(build), c_(build.content), options_(options), bars_(build) {}

  void build() {
    mesh_only_ = c_.properties.empty() && c_.materials.empty() && c_.other_materials.empty();
    if (mesh_only_ && options_.material) {
      b_.model.materials.push_back(*options_.material);
      b_.model.material_names.emplace_back();
    }
    std::unordered_map<int, FeSource> seen;
    for (const NastranElement& e : c_.elements) {
      const auto [it, fresh] = seen.try_emplace(e.id, e.at);
      if (!fresh && e.id > 0) {
        b_.source.error(e.at, fmt::format("{}: this element number is in the file twice, first in "
                                          "line {}",
                                          label(e), it->second.line));
      }
      if (mesh_only_ &&
          (e.surface || e.type == ElementType::beam2 || e.type == ElementType::rod2)) {
        skin(e);
      } else {
        element(e);
      }
    }
    bars_.finish();
    notes();
  }

 private:
  static std::string label(const NastranElement& e) { return fmt::format("{} {}", e.card, e.id); }

  std::vector<std::string> set_names(int property) const {
    std::vector<std::string> names = {fmt::format("PID {}", property)};
    const auto it = c_.property_names.find(property);
    if (it != c_.property_names.end() && it->second != names[0]) names.push_back(it->second);
    return names;
  }

  /// A surface or line of a mesh without properties: its nodes are a set.
  void skin(const NastranElement& e) {
    if (skins_++ == 0) first_skin_ = e.at;
    for (int k = 0; k < e.count; ++k) {
      const int node = b_.node(e.nodes[k], e.at, label(e));
      if (node < 0) return;
      for (const std::string& name : set_names(e.property)) {
        if (members_[name].insert(node).second) b_.model.node_sets[name].push_back(node);
      }
    }
  }

  /// The element's property, of one of the given cards; null with an error.
  const NastranProperty* property(const NastranElement& e,
                                  std::initializer_list<const char*> cards) {
    const auto it = c_.properties.find(e.property);
    if (it == c_.properties.end()) {
      if (missing_.insert(e.property).second) {
        b_.source.error(e.at,
                        fmt::format("{}: property {} is not in the file", label(e), e.property));
      }
      return nullptr;
    }
    const std::string_view card = it->second.card;
    if (std::find(cards.begin(), cards.end(), card) == cards.end()) {
      b_.source.error(e.at, fmt::format("{}: property {} is a {}, expected a {}", label(e),
                                        e.property, card, *cards.begin()));
      return nullptr;
    }
    return &it->second;
  }

  void element(const NastranElement& e) {
    Element result;
    result.type = e.type;
    result.id = e.id;
    result.source = e.at;
    for (int k = 0; k < e.count; ++k) {
      const std::size_t i = k;
      result.nodes[i] = b_.node(e.nodes[i], e.at, label(e));
      if (result.nodes[i] < 0) return;
    }
    if (mesh_only_) {
      result.material = options_.material ? 0 : -1;
    } else if (e.surface) {
      const NastranProperty* p = property(e, {"PSHELL", "PCOMP", "PCOMPG"});
      if (p == nullptr) return;
      if (e.other) {
        b_.source.error(e.at, fmt::format("{}: only a part of its mid-side nodes is given; all "
                                          "or none must be",
                                          label(e)));
        return;
      }
      // A PCOMP has its nonstructural mass in its section.
      result.material =
          material(*p, p->plies.empty() ? p->nonstructural / std::max(p->thickness, 1e-300) : 0.0);
      result.section = shell(e, *p);
      orient_nastran_shell(b_, e, result);
    } else if (e.type == ElementType::beam2) {
      const bool bar = e.card == std::string_view("CBAR");
      const NastranProperty* p =
          bar ? property(e, {"PBAR", "PBARL"}) : property(e, {"PBEAM", "PBEAML"});
      if (p == nullptr || !bars_.place(e, p->turn, result)) return;
      result.material = material(*p, p->nonstructural / std::max(p->section.A, 1e-300));
      result.section = section(e.property, *p);
    } else if (e.type == ElementType::rod2) {
      const bool tube = e.card == std::string_view("CTUBE");
      const NastranProperty* p = property(e, {tube ? "PTUBE" : "PROD", "CONROD"});
      if (p == nullptr) return;
      result.material = material(*p, p->nonstructural / std::max(p->section.A, 1e-300));
      result.section = rod_section(e.property, *p);
    } else {
      const NastranProperty* p = property(e, {"PSOLID"});
      if (p == nullptr) return;
      result.material = material(*p, 0.0);
      orient_nastran_solid(b_, *p, result);
      if (e.type == ElementType::hex8 && !p->full_integration) result.type = ElementType::hex8i;
    }
    if (e.property > 0)  // a CONROD has none
      for (const std::string& name : set_names(e.property)) {
        b_.model.element_sets[name].push_back(static_cast<int>(b_.model.elements.size()));
      }
    b_.model.elements.push_back(result);
  }

  int section(int id, const NastranProperty& p) {
    const auto [it, fresh] = sections_.try_emplace(id, static_cast<int>(b_.model.sections.size()));
    if (!fresh) return it->second;
    const std::pair<const char*, double> values[] = {
        {"A", p.section.A}, {"I1", p.section.Iz}, {"I2", p.section.Iy}, {"J", p.section.J}};
    for (const auto& [name, value] : values) must_be_positive(p, id, name, value);
    for (const std::string& remark : p.remarks)
      b_.note(p.at, fmt::format("{} {}: {}", p.card, id, remark));
    b_.model.sections.push_back(p.section);
    BeamSection& own = b_.model.sections.back();
    const double ratio = own_shear(p.material);
    for (double* x : {&own.J, &own.shear_y, &own.shear_z}) *x *= ratio;
    return it->second;
  }

  int rod_section(int id, const NastranProperty& p) {
    const auto [it, fresh] = sections_.try_emplace(id, static_cast<int>(b_.model.sections.size()));
    if (!fresh) return it->second;
    must_be_positive(p, std::abs(id), "A", p.section.A);
    b_.model.sections.push_back(p.section);
    b_.model.sections.back().J *= own_shear(p.material);
    return it->second;
  }

  void must_be_positive(const NastranProperty& p, int id, const char* what, double value) {
    if (!(value > 0.0))
      b_.source.error(
          p.at, fmt::format("{} {}: {} is {:g}, expected more than 0", p.card, id, what, value));
  }

  /// G of a material over that of its E and NU: bars twist and shear by the G of the card, whatever
  /// E and NU are, and nothing else of a bar depends on it.
  double own_shear(int id) {
    const auto it = c_.materials.find(id);
    if (it == c_.materials.end()) return 1.0;
    const NastranMaterial& m = it->second;
    if (!m.young || !m.shear || !m.poisson) return 1.0;
    if (!(*m.shear > 0.0)) {
      b_.source.error(
          m.at, fmt::format("MAT1 {}: G is {:g}, expected more than 0 for bars", id, *m.shear));
      return 1.0;
    }
    return *m.shear * 2.0 * (1.0 + *m.poisson) / *m.young;
  }

  int shell(const NastranElement& e, const NastranProperty& p) {
    const auto [it, fresh] =
        shells_.try_emplace({e.property, e.offset}, static_cast<int>(b_.model.shells.size()));
    if (!fresh) return it->second;
    must_be_positive(p, e.property, "the thickness", p.thickness);
    b_.model.shells.push_back(nastran_shell_section(b_, e, p, [&](int id) {
      // Of plies the mass counts, of a PSHELL that of its first material.
      return material(p, 0.0, id, !p.plies.empty());
    }));
    return it->second;
  }

  /// Index of a material; one with nonstructural mass (over volume) is a material of its own.
  int material(const NastranProperty& p, double nonstructural) {
    return material(p, nonstructural, p.material, true);
  }
  int material(const NastranProperty& p, double nonstructural, int id, bool weighs) {
    const auto key = std::tuple{id, nonstructural, weighs};
    const auto it = materials_.find(key);
    if (it != materials_.end()) return it->second;
    Material m;
    const auto found = c_.materials.find(id);
    if (found != c_.materials.end()) {
      const std::string misfit = nastran_material_misfit(found->second, p.card);
      if (!misfit.empty())
        b_.source.error(p.at, fmt::format("{}: material {} is a {}, expected a {}", p.card, id,
                                          found->second.card, misfit));
      m = elastic(found->first, found->second);
      m.density = (found->second.density.value_or(0.0) + nonstructural) * c_.mass_factor;
      if (!found->second.density && nonstructural == 0.0 && weighs)
        b_.model.without_density[static_cast<int>(b_.model.materials.size())] = {found->second.at,
                                                                                 c_.mass_factor};
      if (nonstructural != 0.0) {
        b_.note(p.at, fmt::format("{}: its nonstructural mass is added to the density of its "
                                  "material",
                                  p.card));
      }
    } else {
      const auto other = c_.other_materials.find(id);
      b_.source.error(p.at, other == c_.other_materials.end()
                                ? fmt::format("{}: material {} is not in the file", p.card, id)
                                : fmt::format("{}: material {} is a {}, which is not read", p.card,
                                              id, other->second));
    }
    const int index = static_cast<int>(b_.model.materials.size());
    b_.model.materials.push_back(m);
    const auto name = c_.material_names.find(id);
    b_.model.material_names.push_back(
        name == c_.material_names.end()
            ? fmt::format("{} {}", found == c_.materials.end() ? "MAT1" : found->second.card, id)
            : name->second);
    return materials_[key] = index;
  }

  /// E, G and NU: two give the third.
  Material elastic(int id, const NastranMaterial& m) {
    Material result;
    if (m.elasticity && checked_.insert(id).second) {
      const std::string error = nastran_plane_error(m);
      if (!error.empty()) b_.source.error(m.at, fmt::format("{} {}: {}", m.card, id, error));
    }
    if (m.elasticity)
      return anisotropic_material(c_.stiffness_factor * *m.elasticity, m.plane, 0.0);
    if (m.card != std::string_view("MAT1")) return result;  // refused already
    const int given = (m.young ? 1 : 0) + (m.shear ? 1 : 0) + (m.poisson ? 1 : 0);
    if (given < 2) {
      b_.source.error(m.at, fmt::format("MAT1 {}: {} of E, G and NU given, expected two", id,
                                        given == 0 ? "none" : "one"));
      return result;
    }
    result.young = m.young ? *m.young : 2.0 * (1.0 + *m.poisson) * *m.shear;
    if (m.poisson) {
      result.poisson = *m.poisson;
    } else if (*m.shear > 0.0) {
      result.poisson = *m.young / (2.0 * *m.shear) - 1.0;
    } else {
      // The same sentence for each use of the material would not help.
      if (checked_.insert(id).second)
        b_.source.error(m.at, fmt::format("MAT1 {}: G is {:g}, expected more than 0 where it gives "
                                          "NU with E",
                                          id, *m.shear));
      return result;
    }
    if (given == 3 && std::abs(result.shear() - *m.shear) > 0.01 * std::abs(*m.shear) &&
        inconsistent_.insert(id).second) {
      b_.note(m.at, fmt::format("MAT1 {}: G is {:.6g}, but E and NU give {:.6g}: bars twist by G, "
                                "shells and solids have E and NU, as in Nastran",
                                id, *m.shear, result.shear()));
    }
    if (!checked_.insert(id).second) return scaled(result);
    const auto expect = [&](bool valid, const char* what, double found, const std::string& origin,
                            const char* expected) {
      if (!valid)
        b_.source.error(m.at, fmt::format("MAT1 {}: {} is {:g}{}, expected {}", id, what, found,
                                          origin, expected));
    };
    const auto from = [](const std::optional<double>& own, const char* a, double x, const char* b,
                         double y) {
      return own ? "" : fmt::format(" (from {} = {:g} and {} = {:g})", a, x, b, y);
    };
    const double shear = m.shear.value_or(0.0);
    expect(result.young > 0.0, "E", result.young, from(m.young, "G", shear, "NU", result.poisson),
           "more than 0");
    expect(result.poisson > -1.0 && result.poisson < 0.5, "NU", result.poisson,
           from(m.poisson, "E", result.young, "G", shear), "more than -1 and less than 0.5");
    const double density = m.density.value_or(0.0);
    expect(density >= 0.0, "RHO", density, "", "no negative density");
    return scaled(result);
  }

  Material scaled(Material m) const {
    m.young *= c_.stiffness_factor;
    return m;
  }

  void notes() {
    if (b_.model.elements.empty() && b_.source.errors() == 0) {
      b_.source.error({0, 0},
                      mesh_only_ && skins_ > 0
                          ? "the file has no solid elements, and its shells and bars have no "
                            "properties"
                          : "the file has no element with stiffness");
    }
    if (skins_ > 0) {
      b_.note(first_skin_,
              fmt::format("{} surfaces and lines of the mesh have no property: they only "
                          "make node sets",
                          skins_));
    }
    if (mesh_only_ && !options_.material && !b_.model.elements.empty()) {
      b_.note(b_.model.elements[0].source, "the file has no material");
    }
    if (!mesh_only_ && options_.material) {
      b_.note({0, 1}, "the file has materials of its own; the one given is not used");
    }
  }

  NastranBuild& b_;
  const NastranContent& c_;
  const FeReadOptions& options_;
  NastranBars bars_;
  bool mesh_only_ = false;
  int skins_ = 0;
  FeSource first_skin_;
  std::set<int> missing_, inconsistent_, checked_;
  std::map<std::string, std::set<int>> members_;
  std::map<int, int> sections_;
  std::map<std::pair<int, double>, int> shells_;
  std::map<std::tuple<int, double, bool>, int> materials_;
};

}  // namespace

void build_nastran_elements(NastranBuild& build, const FeReadOptions& options) {
  ElementBuilder(build, options).build();
}

}  // namespace floatframe
