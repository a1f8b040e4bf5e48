// Property cards of Nastran. The element's y axis lies in the plane of its axis and the orientation
// vector (plane 1), so I1 = int y^2 dA is Iz of a section and I2 is Iy.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "floatframe/formats/nastran/nastran_content.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

void psolid(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  p.material_system = f.integer(2, "CORDM", 0);
  const std::string_view in = f.text(3), isop = f.text(5);
  const bool points = in == "2" || in == "3" || same_word(in, "TWO") || same_word(in, "THREE");
  p.full_integration = points && (isop == "1" || same_word(isop, "FULL"));
  if (!f.blank(6) && !same_word(f.text(6), "SMECH")) {
    f.error(fmt::format("FCTN is {}, only solids (SMECH) are read", shown(f.text(6))));
  }
}

/// K1 and K2 at a place; 0 is no shear deformation.
void shear_factors(NastranFields& f, std::size_t at, double otherwise, BeamSection& s) {
  const double k1 = f.real(at, "K1", otherwise), k2 = f.real(at + 1, "K2", otherwise);
  if (k1 < 0.0 || k2 < 0.0) f.error("a shear factor (K1, K2) is negative");
  s.shear_y = k1 * s.A;
  s.shear_z = k2 * s.A;
}

void pbar(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  set_nastran_section(p, {f.real(2, "A", 0.0), f.real(3, "I1", 0.0), f.real(4, "I2", 0.0),
                          f.real(18, "I12", 0.0), f.real(5, "J", 0.0)});
  p.nonstructural = f.real(6, "the nonstructural mass", 0.0);
  shear_factors(f, 16, 0.0, p.section);
}

/// End A and stations. Those of a taper within 20 % become their mean along the beam (remark).
void pbeam(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const char* const names[] = {"A", "I1", "I2", "I12", "J", "NSM"};
  double first[6], last[6], mean[6] = {}, last_x = 0.0, most = 0.0;
  for (std::size_t k = 0; k < 6; ++k) {
    first[k] = last[k] = k < 3 ? f.real(2 + k, names[k]) : f.real(2 + k, names[k], 0.0);
  }
  // Stress points of end A are on the next line, unless it begins with a station.
  const auto station = [&f](std::size_t i) {
    return same_word(f.text(i), "YES") || same_word(f.text(i), "YESA") ||
           same_word(f.text(i), "NO");
  };
  std::size_t i = station(8) ? 8 : 16;
  for (; station(i); i += same_word(f.text(i), "YES") ? 16 : 8) {
    const double x = f.real(i + 1, "X/XB", 1.0);
    for (std::size_t k = 0; k < 6; ++k) {
      const double here = f.real(i + 2 + k, names[k], first[k]);
      const double away = std::abs(here - first[k]);
      mean[k] += 0.5 * (x - last_x) * (here + last[k]);
      last[k] = here;
      if (away <= 1e-3 * std::abs(first[k])) continue;
      most = std::max(most, away / std::max(std::abs(first[k]), 1e-300));
      if (away <= 0.2 * std::abs(first[k])) continue;
      f.error(
          fmt::format("a tapered beam is not supported: {} is {} at end A and {} at a station; "
                      "divide it into beams of constant section",
                      names[k], shown(f.text(2 + k)), shown(f.text(i + 2 + k))));
      return;
    }
    last_x = x;
  }
  if (most > 0.0) {
    for (std::size_t k = 0; k < 6; ++k) mean[k] += 0.5 * (1.0 - last_x) * (last[k] + first[k]);
    p.remarks.push_back(
        fmt::format("its section changes by {:.1f} % along the beam: it is read with "
                    "its mean",
                    100.0 * most));
    std::copy(std::begin(mean), std::end(mean), std::begin(first));
  }
  set_nastran_section(p, {first[0], first[1], first[2], first[3], first[4]});
  p.nonstructural = first[5];
  shear_factors(f, i, 1.0, p.section);
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
      f.error(fmt::format("{} is {:g}, expected no negative number", name, p.edge_factors[k]));
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
