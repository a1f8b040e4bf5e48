// Property cards of Nastran. The element's y axis lies in the plane of its axis and the orientation
// vector (plane 1), so I1 = int y^2 dA is Iz of a section and I2 is Iy.
#include <fmt/format.h>

#include <cmath>
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

/// A, I1, I2, J as one section.
BeamSection section(double A, double I1, double I2, double J) {
  BeamSection s;
  s.A = A;
  s.Iz = I1;
  s.Iy = I2;
  s.J = J;
  return s;
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
  p.section =
      section(f.real(2, "A", 0.0), f.real(3, "I1", 0.0), f.real(4, "I2", 0.0), f.real(5, "J", 0.0));
  p.nonstructural = f.real(6, "the nonstructural mass", 0.0);
  f.must_be_zero(18, "I12");
  shear_factors(f, 16, 0.0, p.section);
}

/// The sections of PBARL and PBEAML that a beam without warping has, by the dimensions of Nastran.
void named_section(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const std::string type = upper_case(f.text(3));
  const std::pair<const char*, std::size_t> types[] = {
      {"ROD", 1}, {"TUBE", 2}, {"TUBE2", 2}, {"BAR", 2}, {"BOX", 4}};
  std::size_t count = 0;
  for (const auto& [name, n] : types) {
    if (type == name) count = n;
  }
  if (count == 0) {
    f.error(
        fmt::format("the section {} is not read (ROD, TUBE, TUBE2, BAR and BOX are); give A, I1, "
                    "I2 and J with {}",
                    shown(f.text(3)), f.name() == "PBARL" ? "PBAR" : "PBEAM"));
    return;
  }
  double d[4] = {};
  for (std::size_t i = 0; i < count; ++i) {
    d[i] = f.real(8 + i, "a dimension of the section");
    if (d[i] < 0.0) f.error("a dimension of the section is negative");
  }
  p.nonstructural = f.real(8 + count, "the nonstructural mass", 0.0);
  if (f.size() > 9 + count) f.error("a tapered beam is not supported");
  if ((type == "TUBE" || type == "TUBE2") && d[1] > d[0]) {
    f.error(fmt::format("the {} of the {} is more than its outer radius",
                        type == "TUBE" ? "inner radius" : "wall", type));
  }
  if (type == "ROD") {
    p.section = BeamSection::solid_round(2.0 * d[0]);
  } else if (type == "TUBE") {
    p.section = BeamSection::hollow_round(2.0 * d[0], 2.0 * d[1]);
  } else if (type == "TUBE2") {
    p.section = BeamSection::hollow_round(2.0 * d[0], 2.0 * (d[0] - d[1]));
  } else if (type == "BAR") {
    p.section = BeamSection::rectangle(d[1], d[0]);
  } else {
    const double w = d[0], h = d[1], th = d[2], tw = d[3], wi = w - 2.0 * tw, hi = h - 2.0 * th;
    if (wi <= 0.0 || hi <= 0.0) f.error("the walls of the BOX are thicker than the box");
    const double denominator = w * tw + h * th - tw * tw - th * th;
    p.section = section(w * h - wi * hi, (w * h * h * h - wi * hi * hi * hi) / 12.0,
                        (h * w * w * w - hi * wi * wi * wi) / 12.0,
                        2.0 * tw * th * (w - tw) * (w - tw) * (h - th) * (h - th) / denominator);
  }
  nastran_shear_of_shape(type, d, p.section);
}

/// End A; stations must repeat it.
void pbeam(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const double A = f.real(2, "A"), I1 = f.real(3, "I1"), I2 = f.real(4, "I2");
  p.section = section(A, I1, I2, f.real(6, "J", 0.0));
  f.must_be_zero(5, "I12");
  p.nonstructural = f.real(7, "the nonstructural mass", 0.0);
  // Stress points of end A are on the next line, unless it begins with a station.
  const auto station = [&f](std::size_t i) {
    return same_word(f.text(i), "YES") || same_word(f.text(i), "YESA") ||
           same_word(f.text(i), "NO");
  };
  std::size_t i = station(8) ? 8 : 16;
  while (station(i)) {
    const char* const names[] = {"A", "I1", "I2", "I12", "J", "NSM"};
    for (std::size_t k = 0; k < 6; ++k) {
      const double first = f.real(2 + k, names[k], 0.0), here = f.real(i + 2 + k, names[k], first);
      if (std::abs(here - first) > 1e-6 * std::abs(first)) {
        f.error(
            fmt::format("a tapered beam is not supported: {} is {} at end A and {} at a station",
                        names[k], shown(f.text(2 + k)), shown(f.text(i + 2 + k))));
        return;
      }
    }
    i += same_word(f.text(i), "YES") ? 16 : 8;
  }
  shear_factors(f, i, 1.0, p.section);
  // K1 K2 S1 S2 NSI(A) NSI(B) CW(A) CW(B), then offsets of mass and neutral axis.
  f.must_be_zero(i + 4, "the nonstructural inertia NSI");
  f.must_be_zero(i + 6, "the warping coefficient CW");
  for (std::size_t k = 8; k < 16; ++k) {
    f.must_be_zero(i + k, "an offset of the mass or of the neutral axis");
  }
}

}  // namespace

bool read_nastran_property(NastranFields& f, NastranProperty& p) {
  const std::pair<const char*, void (*)(NastranFields&, NastranProperty&)> readers[] = {
      {"PSOLID", psolid},
      {"PSHELL", read_nastran_pshell},
      {"PCOMP", read_nastran_pcomp},
      {"PCOMPG", read_nastran_pcomp},
      {"PBAR", pbar},
      {"PBARL", named_section},
      {"PROD", read_nastran_rod_property},
      {"PTUBE", read_nastran_rod_property},
      {"PBEAM", pbeam},
      {"PBEAML", named_section}};
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
