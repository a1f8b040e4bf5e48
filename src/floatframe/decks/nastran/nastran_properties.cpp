// Property cards of solids, shells and bars. The element's y axis is in the plane of its axis and
// the orientation vector (plane 1), so I1 = int y^2 dA is Iz of a section and I2 is Iy. Plies of
// PCOMP and PCOMPG are listed from the bottom, the first at Z0 from the nodes along the normal.
#include <cmath>
#include <numbers>

#include "floatframe/decks/nastran/nastran_content.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_stations = 50, most_plies = 10000;

void read_psolid(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  p.material_system = f.integer(2, "CORDM", 0);
  const std::string_view in = f.text(3), isop = f.text(5);
  const bool points = in == "2" || in == "3" || same_word(in, "TWO") || same_word(in, "THREE");
  p.full_integration = points && (isop == "1" || same_word(isop, "FULL"));
  if (!f.blank(6) && !same_word(f.text(6), "SMECH"))
    f.error(ErrorCode::unsupported, "FCTN is {}, only solids (SMECH) are read", shown(f.text(6)));
}

void read_pshell(NastranFields& f, NastranProperty& p) {
  // A material 0 is blank: pre-processors write it for a missing one.
  const auto blank = [&](std::size_t i) { return f.blank(i) || parse_integer(f.text(i)) == 0; };
  if (blank(1) && !blank(3))
    return f.error(ErrorCode::unsupported,
                   "MID1 is blank: a plate without stiffness in its plane is not supported");
  p.material = f.label(1, "the material");
  p.thickness = f.real(2, "the thickness");
  p.membrane = blank(3);
  if (p.membrane) {
    for (const auto& [at, name] : {std::pair{5, "MID3"}, std::pair{10, "MID4"}})
      if (!blank(at))
        f.error(ErrorCode::contradiction,
                "{} is {}, but MID2 is blank: a membrane has neither bending nor transverse shear",
                name, shown(f.text(at)));
  } else if (f.text(3) == "-1") {
    f.error(ErrorCode::unsupported, "MID2 is -1: plane strain is not supported");
  } else {
    p.bending = f.label(3, "MID2");
  }
  p.bending_factor = f.real(4, "12I/T**3", 1.0, NastranRange::positive);
  if (!blank(5) && !p.membrane) {
    p.shear_material = f.label(5, "MID3");
    p.shell_shear = f.real(6, "TS/T", 5.0 / 6.0) * p.thickness;
    if (!(p.shell_shear > 0.0))
      f.error(ErrorCode::out_of_range, "TS/T is {}, expected more than 0", shown(f.text(6)));
  }
  p.nonstructural = f.real(7, "the nonstructural mass", 0.0);
  if (!blank(10) && !p.membrane) p.coupling = f.label(10, "MID4");
}

/// One ply of four fields; blank materials and thicknesses are those of the ply before.
void read_nastran_ply(NastranFields& f, std::size_t first, NastranProperty& p) {
  const std::string what = fmt::format("ply {}", p.plies.size() + 1);
  const bool before = !p.plies.empty();
  ShellPly ply = before ? p.plies.back() : ShellPly{};
  if (!f.blank(first) || !before)
    ply.material = f.label(first, ("the material of " + what).c_str());
  if (!f.blank(first + 1) || !before)
    ply.thickness = f.real(first + 1, ("the thickness of " + what).c_str(), std::nullopt,
                           NastranRange::positive);
  ply.angle = f.real(first + 2, ("the angle of " + what).c_str(), 0.0) * std::numbers::pi / 180.0;
  p.plies.push_back(ply);
}

/// LAM: the side given, or the part of the stiffness that counts. True: the plies are one half.
bool read_lam(NastranFields& f, NastranProperty& p) {
  const std::string_view lam = f.text(7);
  const bool symmetric = same_word(lam, "SYM");
  p.smeared = same_word(lam, "SMEAR");
  p.membrane = same_word(lam, "MEM");
  if (!lam.empty() && !symmetric && !p.smeared && !p.membrane)
    f.error(ErrorCode::wrong_value,
            "LAM is {}, expected blank, SYM, MEM or SMEAR (BEND has no stiffness in the plane)",
            shown(lam));
  return symmetric;
}

void read_pcomp(NastranFields& f, NastranProperty& p) {
  const bool global = f.name() == "PCOMPG";
  p.z0 = f.real_if_given(1, "Z0");
  p.nonstructural = f.real(2, "the nonstructural mass", 0.0, NastranRange::not_negative);
  const bool symmetric = read_lam(f, p);
  const std::size_t step = global ? 8 : 4, offset = global ? 1 : 0;
  for (std::size_t i = 8; i < f.size() && p.plies.size() < most_plies; i += step) {
    bool there = false;
    for (std::size_t k = 0; k < step; ++k) there = there || !f.blank(i + k);
    if (there) read_nastran_ply(f, i + offset, p);
  }
  if (p.plies.empty()) return f.error(ErrorCode::missing, "it has no plies");
  if (symmetric)
    for (std::size_t k = p.plies.size(); k-- > 0;) p.plies.push_back(p.plies[k]);
  p.material = p.plies.front().material;
  for (const ShellPly& ply : p.plies) p.thickness += ply.thickness;
  p.shell_shear = 5.0 / 6.0 * p.thickness;
}

void read_pshear(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  p.thickness = f.real(2, "the thickness");
  p.nonstructural = f.real(3, "the nonstructural mass", 0.0);
  p.edge_factors[0] = f.real(4, "F1", 0.0, NastranRange::not_negative);
  p.edge_factors[1] = f.real(5, "F2", 0.0, NastranRange::not_negative);
}

/// K1 and K2 at a place; 0 is no shear deformation.
std::array<double, 2> shear_factors(NastranFields& f, std::size_t at, double otherwise) {
  const double k1 = f.real(at, "K1", otherwise), k2 = f.real(at + 1, "K2", otherwise);
  if (k1 < 0.0 || k2 < 0.0) f.error(ErrorCode::out_of_range, "a shear factor (K1, K2) is negative");
  return {k1, k2};
}

void set_shear(const std::array<double, 2>& factors, double A, BeamSection& s) {
  s.shear_y = factors[0] * A;
  s.shear_z = factors[1] * A;
}

/// I12 rotates the principal axes, about which I1 and I2 would not be those of the card.
void check_product(NastranFields& f, const NastranSection& s) {
  if (s.I12 == 0.0 || (s.I1 > 0.0 && s.I2 > 0.0 && s.I12 * s.I12 < s.I1 * s.I2)) return;
  f.error(ErrorCode::out_of_range,
          "I12 is {:g}, I1 is {:g} and I2 is {:g}, expected I1 and I2 of more than 0 and an I12^2 "
          "of less than I1 I2",
          s.I12, s.I1, s.I2);
}

void read_pbar(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const double A = f.real(2, "A", 0.0), I1 = f.real(3, "I1", 0.0), I2 = f.real(4, "I2", 0.0);
  NastranSection section{A, I1, I2, f.real(18, "I12", 0.0), f.real(5, "J", 0.0)};
  check_product(f, section);
  section.nonstructural = f.real(6, "the nonstructural mass", 0.0);
  set_nastran_section(p, section);
  set_shear(shear_factors(f, 16, 0.0), p.section.A, p.section);
}

/// End A and stations. Blanks of end B are as at end A, other blanks are interpolated between
/// the ends.
void read_pbeam(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const auto is_word = [&f](std::size_t i) {
    return same_word(f.text(i), "YES") || same_word(f.text(i), "YESA") ||
           same_word(f.text(i), "NO");
  };
  std::vector<NastranStation> stations(1);
  std::vector<std::array<std::optional<double>, 6>> given(1);
  for (std::size_t k = 0; k < 6; ++k)
    given[0][k] = f.real(2 + k, nastran_section_values[k].name,
                         k < 3 ? std::optional<double>{} : std::optional<double>{0.0});
  // Stress points of end A are on the next line, unless it begins with a station.
  std::size_t i = is_word(8) ? 8 : 16, end = 0;
  for (; is_word(i); i += same_word(f.text(i), "YES") ? 16 : 8) {
    if (stations.size() > most_stations)
      return f.error(ErrorCode::wrong_count, "it has too many stations");
    NastranStation& s = stations.emplace_back();
    s.field = i + 1;
    s.x = f.real(i + 1, "X/XB", 1.0);
    if (s.x == 1.0) end = given.size();
    given.emplace_back();
    for (std::size_t k = 0; k < 6; ++k)
      given.back()[k] = f.real_if_given(i + 2 + k, nastran_section_values[k].name);
  }
  const std::array<double, 2> factors = shear_factors(f, i, 1.0);
  for (std::size_t n = 0; n < stations.size(); ++n) {
    NastranStation& s = stations[n];
    for (std::size_t k = 0; k < 6; ++k) {
      const double a = *given[0][k], b = given[end][k].value_or(a);
      s.section.*nastran_section_values[k].member =
          given[n][k].value_or(s.x == 1.0 ? b : a + s.x * (b - a));
    }
    set_shear(factors, s.section.A, s.shape);
  }
  set_nastran_section(p, stations[0].section);
  set_shear(factors, p.section.A, p.section);
  if (stations.size() == 1) check_product(f, stations[0].section);
  if (stations.size() > 1) read_nastran_beam_stations(f, p, std::move(stations));
  // K1 K2 S1 S2 NSI(A) NSI(B) CW(A) CW(B), then offsets of mass and neutral axis.
  f.must_be_zero(i + 4, "the nonstructural inertia NSI");
  f.must_be_zero(i + 6, "the warping coefficient CW");
  for (std::size_t k = 8; k < 16; ++k)
    f.must_be_zero(i + k, "an offset of the mass or of the neutral axis");
}

void read_prod(NastranFields& f, NastranProperty& p) { read_nastran_rod_section(f, 1, p); }

void read_ptube(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const double outer = f.real(2, "OD"), wall = f.real(3, "T", 0.5 * outer);
  const double end = f.real(5, "OD2", outer);
  if (std::abs(end - outer) > 1e-6 * std::abs(outer))
    f.error(ErrorCode::unsupported, "a tapered tube is not supported: OD is {} and OD2 is {}",
            shown(f.text(2)), shown(f.text(5)));
  if (!(outer > 0.0) || wall < 0.0 || wall > 0.5 * outer)
    return f.error(ErrorCode::geometry, "OD is {:g} and T is {:g}, expected a tube", outer, wall);
  p.section = BeamSection::hollow_round(outer, wall == 0.0 ? 0.0 : outer - 2.0 * wall);
  p.nonstructural = f.real(4, "the nonstructural mass", 0.0);
}

template <void (*read)(NastranFields&, NastranProperty&)>
void read_nastran_property(NastranFields& f, NastranContent& c) {
  NastranProperty p;
  read(f, p);
  NastranEntity& entity = p;
  entity = f.entity<NastranEntity>("the number of the property");
  f.keep(c.properties, std::move(p));
}

}  // namespace

void read_nastran_rod_section(NastranFields& f, std::size_t first, NastranProperty& p) {
  p.material = f.label(first, "the material");
  p.section.A = f.real(first + 1, "A");
  p.section.J = f.real(first + 2, "J", 0.0, NastranRange::not_negative);
  p.nonstructural = f.real(first + 4, "the nonstructural mass", 0.0);
}

std::span<const NastranCardReader> nastran_property_cards() {
  static constexpr NastranCardReader cards[] = {
      {"PSOLID", read_nastran_property<read_psolid>},
      {"PSHELL", read_nastran_property<read_pshell>},
      {"PCOMP PCOMPG", read_nastran_property<read_pcomp>},
      {"PSHEAR", read_nastran_property<read_pshear>},
      {"PBAR", read_nastran_property<read_pbar>},
      {"PBEAM", read_nastran_property<read_pbeam>},
      {"PBARL PBEAML", read_nastran_property<read_nastran_named_section>},
      {"PROD", read_nastran_property<read_prod>},
      {"PTUBE", read_nastran_property<read_ptube>}};
  return cards;
}

}  // namespace floatframe
