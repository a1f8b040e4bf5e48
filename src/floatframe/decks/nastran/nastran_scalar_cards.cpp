// Cards of springs, bushings, masses and scalar points.
#include "floatframe/decks/nastran/nastran_content.hpp"

namespace floatframe {
namespace {

void read_nastran_scalar_points(NastranFields& f, NastranContent& c) {
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (f.blank(i)) continue;
    const auto [first, last] = f.range(i, "a scalar point");
    if (first > 0) c.scalar_points.add(first, last);
  }
}

void note_damping(NastranFields& f, std::size_t i, NastranContent& c) {
  if (f.real(i, "the damping", 0.0) != 0.0 && !c.damping) c.damping = f.at();
}

/// Blank or 0: the ground.
bool is_there(const NastranFields& f, std::size_t i) { return !f.blank(i) && f.text(i) != "0"; }

/// With its property, or a direct value: CELAS2, CELAS4, CMASS2, CMASS4.
template <class FeElement>
FeElement scalar_element(NastranFields& f, const char* value) {
  auto e = f.entity<FeElement>("the number of the element");
  if (f.name().ends_with('2') || f.name().ends_with('4'))
    e.value = f.real(1, value);
  else
    e.property = f.label(1, "the property", e.id);
  return e;
}

/// CELAS3, CELAS4, CMASS3, CMASS4.
void read_points(NastranFields& f, NastranScalarElement& e, NastranContent& c) {
  e.components = {-1, -1};
  for (std::size_t end = 0; end < 2; ++end) {
    if (!is_there(f, 2 + end)) continue;
    const int point = e.nodes[end] = f.label(2 + end, "a scalar point");
    if (point > 0) c.scalar_points.add(point, point);
  }
}

void read_nastran_spring(NastranFields& f, NastranContent& c) {
  auto s = scalar_element<NastranSpring>(f, "K");
  const bool points = f.name() == "CELAS3" || f.name() == "CELAS4";
  if (points) read_points(f, s, c);
  if (f.name() == "CELAS2") note_damping(f, 6, c);
  for (std::size_t end = 0; end < 2 && !points; ++end) {
    const std::size_t i = 2 + 2 * end;
    if (!is_there(f, i)) continue;
    s.nodes[end] = f.label(i, end == 0 ? "node G1" : "node G2");
    s.components[end] = f.component(i + 1, false);
  }
  if (s.nodes[0] == 0) {  // the ground comes second
    std::swap(s.nodes[0], s.nodes[1]);
    std::swap(s.components[0], s.components[1]);
  }
  if (s.nodes[0] == 0)
    return f.error(ErrorCode::missing, "{}", points ? "it has no scalar point" : "it has no node");
  c.springs.push_back(std::move(s));
}

void read_nastran_mass_of_points(NastranFields& f, NastranContent& c) {
  auto m = scalar_element<NastranScalarElement>(f, "M");
  read_points(f, m, c);
  c.scalar_masses.push_back(std::move(m));
}

void read_nastran_scalar_mass(NastranFields& f, NastranContent& c) {
  auto e = scalar_element<NastranScalarElement>(f, "M");
  const auto point = [&](std::size_t i) { return is_there(f, i) && !is_there(f, i + 1); };
  const bool both = is_there(f, 2) && is_there(f, 4);
  // An end without component is a scalar point.
  if (both ? point(2) && point(4) : point(2) || point(4)) {
    for (std::size_t end = 0; end < 2; ++end)
      if (point(2 + 2 * end)) e.nodes[end] = f.label(2 + 2 * end, "the node");
    return c.scalar_masses.push_back(std::move(e));
  }
  if (both)
    return f.error(ErrorCode::unsupported,
                   "a mass between two nodes is not supported; give CONM2 at each");
  const std::size_t end = is_there(f, 2) ? 2 : 4;
  NastranMassMatrix m;
  NastranEntity& entity = m;
  entity = e;
  m.property = e.property;
  m.system = -1;  // of the node's displacements
  m.node = f.label(end, "the node");
  const int component = f.component(end + 1, true);
  if (component == 6) return;
  m.M(component, component) = e.value.value_or(1.0);
  c.mass_matrices.push_back(std::move(m));
}

/// Two PELAS or four PMASS on a card.
void read_nastran_scalar_property(NastranFields& f, NastranContent& c) {
  const bool spring = f.name() == "PELAS";
  for (std::size_t i = 0; i == 0 || (i < 8 && !f.blank(i)); i += spring ? 4 : 2) {
    auto p = f.entity<NastranScalarProperty>("the number of the property", i);
    p.value = f.real(i + 1, spring ? "K" : "M");
    f.keep(spring ? c.pelas : c.pmass, std::move(p));
    if (spring) note_damping(f, i + 2, c);
  }
}

void read_nastran_bush(NastranFields& f, NastranContent& c) {
  auto s = f.entity<NastranSpring>("the number of the element");
  s.property = f.label(1, "the property", s.id);
  s.nodes[0] = f.label(2, "node GA");
  s.nodes[1] = f.label(3, "node GB", 0);
  if (f.name() == "CBUSH1D") {
    s.system = f.integer(4, "the coordinate system CID", -1);
    return c.springs.push_back(std::move(s));
  }
  read_nastran_direction(f, "node GO", s.orientation);
  s.system = f.integer(7, "the coordinate system CID", -1);
  s.place = f.real(8, "the place S", 0.5);
  s.offset_system = f.integer(9, "the coordinate system OCID", -1);
  s.offset = f.vector(10, "the offset");
  c.springs.push_back(std::move(s));
}

/// Lines "K", "B", "GE", ... with a value for each direction.
void read_nastran_pbush(NastranFields& f, NastranContent& c) {
  auto p = f.entity<NastranBushing>("the number of the property");
  for (std::size_t line = 0; line < f.size(); line += 8) {
    const std::string_view word = f.text(line + 1);
    const bool stiffness = same_word(word, "K"),
               lost = same_word(word, "B") || same_word(word, "GE");
    if (word.empty() || same_word(word, "RCV")) continue;
    if (!stiffness && !lost)
      return f.error(ErrorCode::unsupported,
                     "found the line {}, expected K, B, GE or RCV; others are not read",
                     shown(word));
    for (int i = 0; i < 6; ++i) {
      const std::size_t at = line + 2 + i;
      if (lost)
        note_damping(f, at, c);
      else if (same_word(f.text(at), "RIGID"))
        f.error(ErrorCode::not_a_number,
                "RIGID is not a stiffness; give a number, or join the nodes with RBE2");
      else
        p.stiffness(i) = f.real(at, "a stiffness", 0.0);
    }
  }
  f.keep(c.pbush, std::move(p));
}

/// K, C and M, then lines of what is not linear: dampers do not count, springs would.
void read_nastran_pbush1d(NastranFields& f, NastranContent& c) {
  auto p = f.entity<NastranScalarProperty>("the number of the property");
  p.value = f.real(1, "K", 0.0);
  note_damping(f, 2, c);
  f.must_be_zero(3, "the mass M");
  for (std::size_t i = 8; i < f.size(); i += 8) {
    const std::string_view word = f.text(i);
    const bool damper = same_word(word, "SHOCKA") || same_word(word, "DAMPER");
    if (damper && !c.damping) c.damping = f.at();
    if (same_word(word, "SPRING") || same_word(word, "GENER"))
      f.error(ErrorCode::unsupported,
              "{} gives a stiffness that is not linear; give its slope at rest as K",
              upper_case(word));
  }
  f.keep(c.pbush1d, std::move(p));
}

void read_nastran_mass_matrix(NastranFields& f, NastranContent& c) {
  auto m = f.entity<NastranMassMatrix>("the number of the element");
  m.node = f.label(1, "the node");
  m.system = f.integer(2, "the coordinate system CID", 0);
  std::size_t k = 3;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      const std::string name = fmt::format("M{}{}", i + 1, j + 1);
      m.M(i, j) = m.M(j, i) = f.real(k++, name.c_str(), 0.0);
    }
  c.mass_matrices.push_back(std::move(m));
}

void read_nastran_mass(NastranFields& f, NastranContent& c) {
  auto m = f.entity<NastranMass>("the number of the element");
  m.node = f.label(1, "the node");
  m.system = f.integer(2, "the coordinate system CID", 0);
  m.mass = f.real(3, "the mass", std::nullopt, NastranRange::not_negative);
  m.offset = f.vector(4, "the offset");
  std::size_t k = 8;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) {
      const std::string name = fmt::format("I{}{}", i + 1, j + 1);
      m.J(i, j) = m.J(j, i) = (i == j ? 1.0 : -1.0) * f.real(k++, name.c_str(), 0.0);
    }
  c.masses.push_back(std::move(m));
}

}  // namespace

std::span<const NastranCardReader> nastran_scalar_cards() {
  static constexpr NastranCardReader cards[] = {
      {"SPOINT", read_nastran_scalar_points},
      {"CELAS1 CELAS2 CELAS3 CELAS4", read_nastran_spring},
      {"PELAS PMASS", read_nastran_scalar_property},
      {"CBUSH CBUSH1D", read_nastran_bush},
      {"PBUSH", read_nastran_pbush},
      {"PBUSH1D", read_nastran_pbush1d},
      {"CMASS1 CMASS2", read_nastran_scalar_mass},
      {"CMASS3 CMASS4", read_nastran_mass_of_points},
      {"CONM1", read_nastran_mass_matrix},
      {"CONM2", read_nastran_mass}};
  return cards;
}

}  // namespace floatframe
