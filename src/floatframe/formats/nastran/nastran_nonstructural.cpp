// NSM, NSM1, NSML, NSML1: mass over length or area that the case control selects, of elements by
// their properties or their own numbers; NSML and NSML1 give the mass of all together. It is added
// to the density of the material, or to the section of laminates, as that of the properties is.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/nastran/nastran_build.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Properties whose TYPE may be meant by one another's name.
struct MassType {
  const char* name;
  std::array<const char*, 3> cards;
};
constexpr MassType mass_types[] = {{"PSHELL", {"PSHELL"}},
                                   {"PCOMP", {"PCOMP", "PCOMPG"}},
                                   {"PBAR", {"PBAR", "PBARL"}},
                                   {"PBARL", {"PBARL", "PBAR"}},
                                   {"PBEAM", {"PBEAM", "PBEAML"}},
                                   {"PBEAML", {"PBEAML", "PBEAM"}},
                                   {"PROD", {"PROD"}},
                                   {"CONROD", {"CONROD"}},
                                   {"PTUBE", {"PTUBE"}},
                                   {"PSHEAR", {"PSHEAR"}},
                                   {"ELEMENT", {}}};

const MassType* type_called(std::string_view name) {
  const auto it = std::find_if(std::begin(mass_types), std::end(mass_types),
                               [&](const MassType& t) { return name == t.name; });
  return it == std::end(mass_types) ? nullptr : it;
}

bool is_card_of(const MassType& type, std::string_view card) {
  return std::any_of(type.cards.begin(), type.cards.end(),
                     [&](const char* c) { return c != nullptr && card == c; });
}

/// What elements have the property of a card.
std::string_view kind_of(std::string_view card) {
  if (card == "PSHELL" || card.starts_with("PCOMP")) return "shell";
  if (card.starts_with("PBAR")) return "bar";
  return card.starts_with("PBEAM") ? "beam" : card;
}

constexpr int everything = std::numeric_limits<int>::max();

}  // namespace

void read_nastran_nonstructural(NastranFields& f, NastranContent& c) {
  NastranNonstructural m;
  m.at = f.at();
  m.lumped = f.name().starts_with("NSML");
  m.card = m.lumped ? (f.name() == "NSML" ? "NSML" : "NSML1") : f.name() == "NSM" ? "NSM" : "NSM1";
  m.set = f.label(0, "the set");
  m.type = upper_case(f.text(1));
  if (type_called(m.type) == nullptr)
    return f.error(
        fmt::format("the type is {}, expected PSHELL, PCOMP, PBAR, PBARL, PBEAM, PBEAML, "
                    "PROD, CONROD, PTUBE, PSHEAR or ELEMENT; others are not read",
                    shown(f.text(1))));
  const bool pairs = !f.name().ends_with("1");
  if (!pairs) m.value = f.real(2, "the value");
  for (std::size_t i = pairs ? 2 : 3; i < f.size(); ++i) {
    if (f.blank(i)) continue;
    if (same_word(f.text(i), "DISTR")) return f.error("DISTR is not read");
    if (same_word(f.text(i), "ALL")) {
      m.ranges.push_back({1, everything, 1, true});
    } else if (pairs) {
      const int number = f.label(i, "a number of the list");
      m.ranges.push_back({number, number, 1, false});
    } else {
      const std::size_t before = i;
      const auto [first, last] = f.range(i, "a number of the list");
      m.ranges.push_back({first, last, 1, i > before});
      if (i > before && same_word(f.text(i + 1), "BY")) {
        m.ranges.back().step = f.label(i + 2, "the step BY");
        i += 2;
      }
    }
    if (!pairs) continue;
    m.value = f.real(++i, "the value of a number");
    c.nonstructural.push_back(m);
    m.ranges.clear();
  }
  if (pairs) return;
  if (m.ranges.empty()) return f.error("it has no elements or properties");
  c.nonstructural.push_back(std::move(m));
}

void read_nastran_nonstructural_add(NastranFields& f, NastranContent& c) {
  std::vector<int>& sets = c.added_mass_sets[f.label(0, "the set")];
  for (std::size_t i = 1; i < f.size(); ++i)
    if (!f.blank(i)) sets.push_back(f.label(i, "a set"));
}

namespace {

class NonstructuralBuilder {
 public:
  explicit NonstructuralBuilder(NastranBuild& build) : b_(build), c_(build.content) {}

  void build() {
    std::set<int> there;
    for (const NastranNonstructural& m : c_.nonstructural) there.insert(m.set);
    const std::set<int> selected =
        selected_nastran_sets(b_, c_.control.nonstructural, c_.added_mass_sets, there, "NSM");
    if (selected.empty()) return;
    for (std::size_t e = 0; e < b_.model.elements.size(); ++e)
      if (b_.model.elements[e].id > 0)
        elements_of_[b_.model.elements[e].id].push_back(static_cast<int>(e));
    extra_.assign(b_.model.elements.size(), 0.0);
    negative_.assign(b_.model.elements.size(), nullptr);
    int applied = 0;
    for (const NastranNonstructural& m : c_.nonstructural) {
      if (!selected.contains(m.set)) continue;
      ++applied;
      add(m);
    }
    if (applied == 0 && b_.source.errors() == 0) {
      const auto& [id, at] = c_.control.nonstructural.front();
      b_.source.error(
          at, fmt::format("the case control selects NSM set {}, which is not in the file", id));
    }
    if (b_.source.errors() > 0) return;
    apply();
    if (missing_ > 0)
      b_.note(first_missing_,
              fmt::format("{} numbers of nonstructural mass (NSM) are no elements or "
                          "properties of their type in the file: they are "
                          "ignored, as in Nastran",
                          missing_));
    b_.note(c_.control.nonstructural.front().second,
            fmt::format("the nonstructural mass of set {} (NSM) is added, {:.6g} in all",
                        c_.control.nonstructural.front().first, total_ * c_.mass_factor));
  }

 private:
  std::string label(const NastranNonstructural& m) const {
    return fmt::format("{} {}", m.card, m.set);
  }

  /// Elements that can have such mass, by their own number or that of their property.
  const NastranNumbers& numbers(const std::string& type) {
    const auto it = numbers_.find(type);
    if (it != numbers_.end()) return it->second;
    std::vector<std::pair<int, int>> list;
    const MassType& t = *type_called(type);
    for (const auto& e : c_.elements) {
      const auto property = c_.properties.find(e.property);
      if (property == c_.properties.end() || !elements_of_.contains(e.id)) continue;
      const std::string_view card = property->second.card;
      const bool own = type == "ELEMENT" || type == "CONROD";
      if (type == "ELEMENT" ? card == "PSOLID" : !is_card_of(t, card)) continue;
      list.emplace_back(own ? e.id : e.property, static_cast<int>(&e - c_.elements.data()));
    }
    return numbers_.try_emplace(type, std::move(list)).first->second;
  }

  /// Indices in the content, each once.
  std::vector<int> members(const NastranNonstructural& m) {
    std::vector<int> out, found;
    const bool own = m.type == "ELEMENT" || m.type == "CONROD";
    for (const NastranNonstructural::Range& r : m.ranges) {
      found.clear();
      numbers(m.type).append(r.first, r.last, found);
      b_.spend(found.size(), m.at);
      for (const int i : found) {
        const int number = own ? c_.elements[i].id : c_.elements[i].property;
        if ((number - r.first) % r.step == 0) out.push_back(i);
      }
      if (found.empty() && !r.several && missing_++ == 0) first_missing_ = m.at;
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  /// ALL of bars and shells leaves open whether the other card of the same elements is meant.
  bool is_clear(const NastranNonstructural& m) {
    if (m.type == "ELEMENT" || std::none_of(m.ranges.begin(), m.ranges.end(), [](const auto& r) {
          return r.first == 1 && r.last == everything;
        }))
      return true;
    for (const auto& [id, p] : c_.properties) {
      if (kind_of(p.card) != kind_of(m.type) || p.card == m.type) continue;
      b_.source.error(m.at, fmt::format("{}: it is for ALL {}, but the file has {} too, which may "
                                        "or may not be meant; list the properties by number",
                                        label(m), m.type, p.card));
      return false;
    }
    return true;
  }

  /// Length of a line, area of a surface.
  double extent(const Element& e) const {
    const ElementKernel& kernel = element_kernel(e.type);
    ElementInput in;
    for (int k = 0; k < kernel.nodes; ++k) in.p[k] = b_.model.positions[e.nodes[k]];
    in.reference = e.reference;
    in.material.density = in.section.A = in.shell.thickness = 1.0;
    MatX M;
    kernel.scalar_mass(in, M);
    return M.sum();
  }

  void add(const NastranNonstructural& m) {
    if (!is_clear(m)) return;
    double sum = 0.0;
    const std::vector<int> list = members(m);
    std::vector<std::pair<int, double>> found;  // element of the model, its extent
    bool lines = false, surfaces = false;
    for (const int i : list) {
      (c_.elements[i].surface ? surfaces : lines) = true;
      for (const int e : elements_of_.at(c_.elements[i].id)) {
        found.emplace_back(e, extent(b_.model.elements[e]));
        sum += found.back().second;
      }
    }
    if (found.empty()) return;
    if (m.lumped && lines && surfaces) {
      b_.source.error(m.at,
                      fmt::format("{}: some of its elements have a length and others an area; "
                                  "a mass is spread over one of both",
                                  label(m)));
      return;
    }
    if (!(sum > 0.0)) {
      b_.source.error(m.at, fmt::format("{}: its elements have no length or area", label(m)));
      return;
    }
    const double each = m.lumped ? m.value / sum : m.value;
    for (const auto& [e, size] : found) {
      extra_[e] += each;
      if (each < 0.0) negative_[e] = &m;
    }
    total_ += each * sum;
  }

  /// Of the material or the section of an element to which its mass is added.
  void expect_mass(std::size_t i, const char* what, double found) {
    const NastranNonstructural* m = negative_[i];
    if (found < 0.0 && m != nullptr)
      b_.source.error(
          m->at, fmt::format("{}: its mass makes the {} of element {} {:g}, expected "
                             "no negative number",
                             label(*m), what, b_.model.elements[i].id, found / c_.mass_factor));
  }

  void apply() {
    std::map<std::tuple<int, double, double>, int> materials;  // material, thickness, mass
    std::map<std::pair<int, double>, int> sections;
    FeModel& model = b_.model;
    for (std::size_t i = 0; i < extra_.size(); ++i) {
      Element& e = model.elements[i];
      const double mass = extra_[i] * c_.mass_factor;
      if (mass == 0.0) continue;
      const bool surface = has_shell_section(e.type);
      if (surface && !model.shells[e.section].plies.empty()) {
        const auto [it, fresh] =
            sections.try_emplace({e.section, mass}, static_cast<int>(model.shells.size()));
        if (fresh) {
          model.shells.push_back(model.shells[e.section]);
          model.shells.back().mass += mass;
          expect_mass(i, "mass beside its plies", model.shells.back().mass);
        }
        e.section = it->second;
        continue;
      }
      const double across =
          surface ? model.shells[e.section].thickness : model.sections[e.section].A;
      const auto [it, fresh] = materials.try_emplace({e.material, across, mass},
                                                     static_cast<int>(model.materials.size()));
      if (fresh) {
        model.materials.push_back(model.materials[e.material]);
        model.materials.back().density += mass / across;
        if (const auto missing = model.without_density.find(e.material);
            missing != model.without_density.end())
          model.without_density[it->second] = MissingDensity(missing->second);
        else
          expect_mass(i, "density", model.materials.back().density);
        model.material_names.push_back(model.material_names[e.material]);
      }
      e.material = it->second;
    }
    // Materials that no element has any more need no density.
    std::set<int> used;
    for (const Element& e : model.elements) used.insert(e.material);
    for (const ShellSection& s : model.shells)
      for (const ShellPly& ply : s.plies) used.insert(ply.material);
    std::erase_if(model.without_density, [&](const auto& m) { return !used.contains(m.first); });
  }

  NastranBuild& b_;
  const NastranContent& c_;
  std::map<int, std::vector<int>> elements_of_;  // of the model, by their number
  std::map<std::string, NastranNumbers> numbers_;
  std::vector<double> extra_;                          // mass over length or area of each element
  std::vector<const NastranNonstructural*> negative_;  // the last card that takes mass from it
  double total_ = 0.0;
  int missing_ = 0;
  FeSource first_missing_;
};

}  // namespace

void build_nastran_nonstructural(NastranBuild& build) {
  if (!build.content.control.nonstructural.empty()) NonstructuralBuilder(build).build();
}

}  // namespace floatframe
