// *NONSTRUCTURAL MASS: mass smeared over elements, for paint, cables or omitted details. A total
// mass is distributed over the elements in proportion to their mass (which scales densities) or
// to its volume (which adds the same density to all). Solids, beams and rods get it as density,
// shells and membranes as mass per area at their middle.
#include <algorithm>
#include <cmath>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Units = AbaqusNonstructuralMass::Units;

class SmearedMass {
 public:
  explicit SmearedMass(AbaqusBuild& build)
      : b_(build), m_(build.model), size_(m_.elements.size()), more_(size_.size(), 0.0) {}

  void add(const AbaqusNonstructuralMass& raw) {
    const std::size_t before = b_.source.errors();
    const std::vector<int> list = elements_of(raw);
    if (b_.source.errors() != before) return;
    if (list.empty())
      return error(ErrorCode::missing, raw, "names {}, which has no elements with stiffness",
                   b_.content.text(raw.where, "element"));
    double sum = 0.0;  // sum of the weights of a total mass
    if (raw.units == Units::total)
      for (const int e : list) sum += raw.by_volume ? size(e).volume : size(e).mass;
    if (raw.units == Units::total && !(sum > 0.0))
      return error(ErrorCode::contradiction, raw,
                   "shares a mass among elements without mass: give their materials *DENSITY, or "
                   "DISTRIBUTION=VOLUME PROPORTIONAL");
    if (!std::isfinite(sum))
      return error(ErrorCode::not_finite, raw,
                   "shares a mass among elements whose {} is {:g}, expected a finite number",
                   raw.by_volume ? "volume" : "mass", sum);
    double mass = 0.0;
    for (const int e : list) {
      const Size& s = size(e);
      double more = raw.units == Units::total ? raw.value / sum : raw.value;
      if (raw.units == Units::length)
        more /= m_.sections[m_.elements[e].section].A;
      else if (raw.units == Units::total && !raw.by_volume)
        more *= s.density;
      else if (raw.units != Units::area)
        more *= s.measure;
      more_[e] += more;
      mass += (s.density + more_[e]) * (s.volume / s.measure);
      if (std::isfinite(s.density + more_[e])) continue;
      return error(ErrorCode::not_finite, raw, "gives {} a {} of {:g}, expected a finite number",
                   label_of(e),
                   has_shell_section(m_.elements[e].type) ? "mass over area" : "density",
                   s.density + more_[e]);
    }
    if (!std::isfinite(mass))
      return error(ErrorCode::not_finite, raw,
                   "gives its {} elements a mass of {:g}, expected a finite number", list.size(),
                   mass);
    b_.note(raw.where.at, "*NONSTRUCTURAL MASS is added to {} elements of {}", list.size(),
            b_.content.text(raw.where, "element"));
  }

  /// Elements of one section get the same value, so few new materials and sections are needed.
  void finish() {
    if (b_.source.errors() > 0) return;
    for (std::size_t k = 0; k < more_.size(); ++k)
      if (more_[k] != 0.0) give(m_.elements[k], more_[k]);
  }

 private:
  struct Size {
    bool known = false;
    double mass = 0.0, volume = 0.0;  ///< by itself
    /// For sheets mass per area and thickness; else density and 1.
    double density = 0.0, measure = 1.0;
  };

  template <class... Values>
  void error(ErrorCode code, const AbaqusNonstructuralMass& raw, fmt::format_string<Values...> text,
             Values&&... values) {
    b_.source.error(code, raw.where.at, "*NONSTRUCTURAL MASS {}",
                    fmt::format(text, std::forward<Values>(values)...));
  }

  std::string label_of(int index) const {
    const auto it = std::find(b_.element_index.begin(), b_.element_index.end(), index);
    return abaqus_label(
        b_.content.elements[static_cast<std::size_t>(it - b_.element_index.begin())]);
  }

  /// Indices in the model; an error for an element that cannot have such a mass.
  std::vector<int> elements_of(const AbaqusNonstructuralMass& raw) {
    std::vector<int> list;
    for (const int e : b_.elements.resolve(raw.where)) {
      const int index = b_.element_index[e];
      const AbaqusElement& deck = b_.content.elements[e];
      if (index < 0 && is_abaqus_point(deck.type->family)) continue;
      const FeElementType type = index < 0 ? FeElementType::beam2 : m_.elements[index].type;
      std::string why;
      if (index < 0)
        why = "has no section here";
      else if (raw.units == Units::area && !has_shell_section(type))
        why = "is no shell or membrane, but the mass is one over area";
      else if (raw.units == Units::length && !is_beam(type) && !is_rod(type))
        why = "is no beam or rod, but the mass is one over length";
      else if (missing_density(m_.elements[index]))
        why = "is of a material without *DENSITY, which must stand in the deck then";
      if (why.empty()) {
        list.push_back(index);
        continue;
      }
      error(ErrorCode::wrong_value, raw, "names {}, which {}", abaqus_label(deck), why);
      return {};
    }
    return list;
  }

  bool missing_density(const FeElement& e) const {
    if (m_.without_density.contains(e.material)) return true;
    if (!has_shell_section(e.type)) return false;
    for (const ShellPly& ply : m_.shells[e.section].plies)
      if (m_.without_density.contains(ply.material)) return true;
    return false;
  }

  const Size& size(int index) {
    Size& s = size_[index];
    if (s.known) return s;
    s.known = true;
    const FeElement& e = m_.elements[index];
    const ElementKernel& kernel = element_kernel(e.type);
    ElementInput in = gather(m_, e);
    const bool sheet = has_shell_section(e.type);
    s.density = sheet ? layers_of(in).mass : in.material.density;
    if (sheet) s.measure = in.shell.thickness;
    if (sheet) {  // of unit mass over area
      in.layers.reset();
      in.shell.plies.clear();
      in.shell.mass = 1.0;
    }
    in.material = {in.material.young, 0.0, sheet ? 0.0 : 1.0};
    MatX M;
    kernel.scalar_mass(in, M);
    const double extent = M.sum();  // area or volume
    s.mass = extent * s.density;
    s.volume = extent * s.measure;
    return s;
  }

  void give(FeElement& e, double more) {
    if (has_shell_section(e.type)) {
      e.section = changed_copy(m_.shells, e.section, sections_, {e.section, more},
                               [&](ShellSection& s) { s.mass += more; });
      return;
    }
    const int old = e.material;
    e.material = changed_copy(m_.materials, old, materials_, {old, more}, [&](Material& material) {
      material.density += more;
      m_.material_names.push_back(m_.material_names[old] + " and nonstructural mass");
    });
  }

  AbaqusBuild& b_;
  FeModel& m_;
  std::vector<Size> size_;
  std::vector<double> more_;  ///< of each element: density, for sheets mass per area
  std::map<std::pair<int, double>, int> sections_, materials_;
};

}  // namespace

void read_abaqus_nonstructural_mass(AbaqusCard& card) {
  constexpr std::array units{
      std::pair{"TOTALMASS", Units::total}, std::pair{"MASSPERVOLUME", Units::volume},
      std::pair{"MASSPERAREA", Units::area}, std::pair{"MASSPERLENGTH", Units::length}};
  AbaqusNonstructuralMass mass;
  card.required("ELSET");
  const std::string unit = abaqus_name(card.required("UNITS"));
  const std::string distribution = card.word("DISTRIBUTION");
  const auto known =
      std::find_if(units.begin(), units.end(), [&](const auto& u) { return unit == u.first; });
  if (known != units.end())
    mass.units = known->second;
  else if (!card.wrong())
    card.error(
        ErrorCode::wrong_value,
        "has the units {}, expected TOTAL MASS, MASS PER VOLUME, MASS PER AREA or MASS PER LENGTH",
        shown(card.value("UNITS")));
  mass.by_volume = distribution == "VOLUMEPROPORTIONAL";
  if (!distribution.empty() && !mass.by_volume && distribution != "MASSPROPORTIONAL")
    card.error(ErrorCode::wrong_value,
               "has the distribution {}, expected MASS PROPORTIONAL or VOLUME PROPORTIONAL",
               shown(card.value("DISTRIBUTION")));
  if (card.needs_line()) {
    mass.value = card.positive(0, "nonstructural mass");
    card.no_more(1);
  }
  if (card.content.only_nodes || card.wrong()) return;
  mass.where = card.named("ELSET");
  card.content.nonstructural.push_back(mass);
}

void build_abaqus_nonstructural_mass(AbaqusBuild& build) {
  if (build.content.nonstructural.empty() || build.source.errors() > 0) return;
  SmearedMass smeared(build);
  for (const AbaqusNonstructuralMass& mass : build.content.nonstructural) smeared.add(mass);
  smeared.finish();
}

}  // namespace floatframe
