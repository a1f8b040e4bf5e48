// Property cards of Nastran. The element's y axis lies in the plane of its axis and the orientation
// vector (plane 1), so I1 = int y^2 dA is Iz of a section and I2 is Iy.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/decks/nastran/nastran_tapers.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_stations = 50;

void psolid(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  p.material_system = f.integer(2, "CORDM", 0);
  const std::string_view in = f.text(3), isop = f.text(5);
  const bool points = in == "2" || in == "3" || same_word(in, "TWO") || same_word(in, "THREE");
  p.full_integration = points && (isop == "1" || same_word(isop, "FULL"));
  if (!f.blank(6) && !same_word(f.text(6), "SMECH")) {
    f.error(ErrorCode::unsupported, "FCTN is {}, only solids (SMECH) are read", shown(f.text(6)));
  }
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

/// I12 turns the principal axes, about which I1 and I2 would not be those of the card.
void check_product(NastranFields& f, const NastranSection& s) {
  if (s.I12 == 0.0 || (s.I1 > 0.0 && s.I2 > 0.0 && s.I12 * s.I12 < s.I1 * s.I2)) return;
  f.error(ErrorCode::out_of_range,
          "I12 is {:g}, I1 is {:g} and I2 is {:g}, expected I1 and I2 of more than 0 and an I12^2 "
          "of less than I1 I2",
          s.I12, s.I1, s.I2);
}

void pbar(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const double A = f.real(2, "A", 0.0), I1 = f.real(3, "I1", 0.0), I2 = f.real(4, "I2", 0.0);
  const NastranSection section{A, I1, I2, f.real(18, "I12", 0.0), f.real(5, "J", 0.0)};
  check_product(f, section);
  set_nastran_section(p, section);
  p.nonstructural = f.real(6, "the nonstructural mass", 0.0);
  set_shear(shear_factors(f, 16, 0.0), p.section.A, p.section);
}

/// End A and stations. What end B leaves blank is as at end A, what others leave blank lies between
/// the ends.
void pbeam(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const char* const names[] = {"A", "I1", "I2", "I12", "J", "NSM"};
  const auto word = [&f](std::size_t i) {
    return same_word(f.text(i), "YES") || same_word(f.text(i), "YESA") ||
           same_word(f.text(i), "NO");
  };
  struct Place {
    double x = 0.0;
    std::optional<double> values[6];
    std::size_t field = 0;
  };
  std::vector<Place> places(1);
  for (std::size_t k = 0; k < 6; ++k)
    places[0].values[k] = k < 3 ? f.real(2 + k, names[k]) : f.real(2 + k, names[k], 0.0);
  // Stress points of end A are on the next line, unless it begins with a station.
  std::size_t i = word(8) ? 8 : 16, end = 0;
  for (; word(i); i += same_word(f.text(i), "YES") ? 16 : 8) {
    if (places.size() > most_stations)
      return f.error(ErrorCode::wrong_count, "it has too many stations");
    Place& place = places.emplace_back();
    place.field = i + 1;
    place.x = f.real(i + 1, "X/XB", 1.0);
    if (place.x == 1.0) end = places.size() - 1;
    for (std::size_t k = 0; k < 6; ++k)
      if (!f.blank(i + 2 + k)) place.values[k] = f.real(i + 2 + k, names[k]);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const double a = *places[0].values[k], b = places[end].values[k].value_or(a);
    for (Place& place : places)
      if (!place.values[k]) place.values[k] = place.x == 1.0 ? b : a + place.x * (b - a);
  }
  std::vector<NastranStation> stations;
  const std::array<double, 2> factors = shear_factors(f, i, 1.0);
  for (const Place& place : places) {
    NastranStation& s = stations.emplace_back();
    const auto value = [&](std::size_t k) { return *place.values[k]; };
    s.x = place.x;
    s.field = place.field;
    s.section = {value(0), value(1), value(2), value(3), value(4)};
    s.nonstructural = value(5);
    set_shear(factors, value(0), s.shape);
  }
  set_nastran_section(p, stations[0].section);
  p.nonstructural = stations[0].nonstructural;
  set_shear(factors, p.section.A, p.section);
  if (stations.size() == 1) check_product(f, stations[0].section);
  if (stations.size() > 1) read_nastran_beam_stations(f, p, std::move(stations));
  // K1 K2 S1 S2 NSI(A) NSI(B) CW(A) CW(B), then offsets of mass and neutral axis.
  f.must_be_zero(i + 4, "the nonstructural inertia NSI");
  f.must_be_zero(i + 6, "the warping coefficient CW");
  for (std::size_t k = 8; k < 16; ++k) {
    f.must_be_zero(i + k, "an offset of the mass or of the neutral axis");
  }
}

void pshear(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  p.thickness = f.real(2, "the thickness");
  p.nonstructural = f.real(3, "the nonstructural mass", 0.0);
  for (int k = 0; k < 2; ++k) {
    const char* const name = k == 0 ? "F1" : "F2";
    p.edge_factors[k] = f.real(4 + k, name, 0.0);
    if (p.edge_factors[k] < 0.0)
      f.error(ErrorCode::out_of_range, "{} is {:g}, expected no negative number", name,
              p.edge_factors[k]);
  }
}

}  // namespace

bool read_nastran_property(NastranFields& f, NastranProperty& p) {
  const std::pair<const char*, void (*)(NastranFields&, NastranProperty&)> readers[] = {
      {"PSOLID", psolid},
      {"PSHELL", read_nastran_pshell},
      {"PCOMP", read_nastran_pcomp},
      {"PCOMPG", read_nastran_pcomp},
      {"PSHEAR", pshear},
      {"PBAR", pbar},
      {"PBARL", read_nastran_named_section},
      {"PROD", read_nastran_rod_property},
      {"PTUBE", read_nastran_rod_property},
      {"PBEAM", pbeam},
      {"PBEAML", read_nastran_named_section}};
  for (const auto& [name, read] : readers) {
    if (f.name() != name) continue;
    p.card = name;
    p.at = f.at();
    read(f, p);
    return true;
  }
  return false;
}

}  // namespace floatframe
