// Sections of PBARL and PBEAML by name. Element y points up in the figures of Nastran, z to the
// right. All but round ones and solid bars are made of plates along y and z (plate_section.hpp). J
// of open sections is sum b t^3/3 of the plates, of a box that of Bredt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/decks/nastran/nastran_tapers.hpp"
#include "floatframe/fe/plate_section.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Plates = std::vector<SectionPlate>;
using Dimensions = const double*;

Plates plates_of_i(Dimensions d) {
  const double web = d[0] - d[4] - d[5];
  return {
      {d[4] / 2, 0, d[4], d[1]}, {d[4] + web / 2, 0, web, d[3]}, {d[0] - d[5] / 2, 0, d[5], d[2]}};
}

Plates plates_of_i1(Dimensions d) {
  const double t = (d[3] - d[2]) / 2, y = (d[3] - t) / 2, w = d[0] + d[1];
  return {{-y, 0, t, w}, {0, 0, d[2], d[1]}, {y, 0, t, w}};
}

Plates plates_of_t(Dimensions d) {
  const double web = d[1] - d[2];
  return {{web + d[2] / 2, 0, d[2], d[0]}, {web / 2, 0, web, d[3]}};
}

Plates plates_of_t1(Dimensions d) {
  return {{0, d[2] / 2, d[0], d[2]}, {0, -d[1] / 2, d[3], d[1]}};
}

Plates plates_of_t2(Dimensions d) {
  const double web = d[1] - d[2];
  return {{d[2] / 2, 0, d[2], d[0]}, {d[2] + web / 2, 0, web, d[3]}};
}

Plates plates_of_chan(Dimensions d) {
  const double flange = d[0] - d[2], y = (d[1] - d[3]) / 2, z = d[2] + flange / 2;
  return {{0, d[2] / 2, d[1], d[2]}, {y, z, d[3], flange}, {-y, z, d[3], flange}};
}

Plates plates_of_chan1(Dimensions d) {
  const double t = (d[3] - d[2]) / 2, y = (d[3] - t) / 2, z = d[1] + d[0] / 2;
  return {{0, d[1] / 2, d[3], d[1]}, {y, z, t, d[0]}, {-y, z, t, d[0]}};
}

Plates plates_of_chan2(Dimensions d) {
  const double leg = d[2] - d[1], y = d[1] + leg / 2, z = (d[3] - d[0]) / 2;
  return {{d[1] / 2, 0, d[1], d[3]}, {y, z, leg, d[0]}, {y, -z, leg, d[0]}};
}

Plates plates_of_z(Dimensions d) {
  const double t = (d[3] - d[2]) / 2, y = (d[3] - t) / 2, z = (d[0] + d[1]) / 2;
  return {{0, 0, d[3], d[1]}, {y, -z, t, d[0]}, {-y, z, t, d[0]}};
}

Plates plates_of_h(Dimensions d) {
  const double z = d[0] / 2 + d[1] / 4;
  return {{0, 0, d[3], d[0]}, {0, z, d[2], d[1] / 2}, {0, -z, d[2], d[1] / 2}};
}

Plates plates_of_cross(Dimensions d) {
  const double z = d[1] / 2 + d[0] / 4;
  return {{0, 0, d[2], d[1]}, {0, z, d[3], d[0] / 2}, {0, -z, d[3], d[0] / 2}};
}

Plates plates_of_hat(Dimensions d) {
  const double t = d[1], leg = d[0] - 2 * t, foot = d[3] + t, y = t + leg / 2, z = (d[2] - t) / 2,
               outside = d[2] / 2 - t + foot / 2;
  return {{d[0] - t / 2, 0, t, d[2]},
          {y, z, leg, t},
          {y, -z, leg, t},
          {t / 2, outside, t, foot},
          {t / 2, -outside, t, foot}};
}

Plates plates_of_l(Dimensions d) {
  const double web = d[1] - d[2];
  return {{d[2] / 2, d[0] / 2, d[2], d[0]}, {d[2] + web / 2, d[3] / 2, web, d[3]}};
}

Plates plates_of_box1(Dimensions d) {
  const double wall = d[1] - d[2] - d[3], y = (d[3] - d[2]) / 2;
  return {{(d[1] - d[2]) / 2, 0, d[2], d[0]},
          {-(d[1] - d[3]) / 2, 0, d[3], d[0]},
          {y, -(d[0] - d[4]) / 2, wall, d[4]},
          {y, (d[0] - d[5]) / 2, wall, d[5]}};
}

struct PlateSection {
  std::size_t dimensions;
  Plates (*plates)(Dimensions);
  bool centred;  ///< the shear centre is the centroid
};

const std::map<std::string_view, PlateSection>& plate_sections() {
  static const std::map<std::string_view, PlateSection> sections = {
      {"I", {6, plates_of_i, false}},         {"I1", {4, plates_of_i1, true}},
      {"T", {4, plates_of_t, false}},         {"T1", {4, plates_of_t1, false}},
      {"T2", {4, plates_of_t2, false}},       {"CHAN", {4, plates_of_chan, false}},
      {"CHAN1", {4, plates_of_chan1, false}}, {"CHAN2", {4, plates_of_chan2, false}},
      {"Z", {4, plates_of_z, true}},          {"H", {4, plates_of_h, true}},
      {"CROSS", {4, plates_of_cross, true}},  {"HAT", {4, plates_of_hat, false}},
      {"L", {4, plates_of_l, false}},         {"BOX1", {6, plates_of_box1, false}}};
  return sections;
}

NastranSection made_of(const Plates& plates) {
  const PlateSums s = plate_sums(plates);
  return {s.A, s.Iz, s.Iy, s.Iyz, s.thin_J};
}

/// Sections that are not of plates; those with a shape that is known for stress.
bool plain_section(std::string_view type, Dimensions d, BeamSection& s) {
  if (type == "ROD") {
    s = BeamSection::solid_round(2.0 * d[0]);
  } else if (type == "TUBE") {
    s = BeamSection::hollow_round(2.0 * d[0], 2.0 * d[1]);
  } else if (type == "TUBE2") {
    s = BeamSection::hollow_round(2.0 * d[0], 2.0 * (d[0] - d[1]));
  } else if (type == "BAR") {
    s = BeamSection::rectangle(d[1], d[0]);
  } else {
    return false;
  }
  return true;
}

std::size_t dimensions_of(std::string_view type) {
  if (type == "ROD") return 1;
  if (type == "TUBE" || type == "TUBE2" || type == "BAR") return 2;
  if (type == "BOX") return 4;
  const auto it = plate_sections().find(type);
  return it == plate_sections().end() ? 0 : it->second.dimensions;
}

/// The raw section about y and z of the element goes to `raw`.
void named_shape(NastranFields& f, NastranProperty& p, const std::string& type, Dimensions d,
                 NastranSection& raw) {
  if ((type == "TUBE" || type == "TUBE2") && d[1] > d[0]) {
    f.error(ErrorCode::contradiction, "the {} of the {} is more than its outer radius",
            type == "TUBE" ? "inner radius" : "wall", type);
  }
  if (plain_section(type, d, p.section)) {
    raw = {p.section.A, p.section.Iz, p.section.Iy, 0.0, p.section.J};
    return nastran_shear_of_shape(type, d, p.section);
  }
  const double box[6] = {d[0], d[1], d[2], d[2], d[3], d[3]};
  const bool closed = type == "BOX" || type == "BOX1";
  const double* const of_box = type == "BOX" ? box : d;
  const PlateSection& made = plate_sections().at(type == "BOX" ? "BOX1" : type.c_str());
  const Plates plates = made.plates(closed ? of_box : d);
  for (const SectionPlate& plate : plates) {
    if (plate.height > 0.0 && plate.width > 0.0) continue;
    if (type == "BOX")
      return f.error(ErrorCode::geometry, "the walls of the BOX are thicker than the box");
    return f.error(ErrorCode::geometry,
                   "the dimensions of the {} do not fit: a wall of it would be {:g} by {:g}", type,
                   plate.height, plate.width);
  }
  NastranSection s = made_of(plates);
  if (closed) {
    if (!(of_box[4] + of_box[5] < of_box[0])) {
      return f.error(ErrorCode::geometry, "the walls of the {} are thicker than the box", type);
    }
    s.J = bredt_torsion(of_box[0], of_box[1], of_box[2], of_box[3], of_box[4], of_box[5]);
  } else {
    p.remarks.push_back(
        fmt::format("the torsion constant of the section {} is the sum of b t^3/3 of its plates, "
                    "{:.6g}; warping and shear deformation are left out",
                    type, s.J));
  }
  raw = s;
  set_nastran_section(p, s);
  nastran_shear_of_shape(type, d, p.section);
  if (f.name() == "PBEAML" && !made.centred && type != "BOX") {
    p.remarks.push_back(fmt::format(
        "the shear centre of the section {} is taken as its centroid, on the line of the element",
        type));
  }
}

/// Stations of a PBEAML: SO, X/XB, dimensions, nonstructural mass; what end B leaves blank is as at
/// end A.
void named_stations(NastranFields& f, NastranProperty& p, const std::string& type,
                    std::size_t count, Dimensions d, const NastranStation& first) {
  const auto is_word = [&f](std::size_t i) {
    return same_word(f.text(i), "YES") || same_word(f.text(i), "NO");
  };
  std::vector<NastranStation> stations{first};
  for (std::size_t i = 9 + count; i < f.size(); i += count + 3) {
    if (!is_word(i)) {
      return f.error(ErrorCode::wrong_value,
                     "found {} after the section, expected YES or NO of a station",
                     shown(f.text(i)));
    }
    if (stations.size() > 50) return f.error(ErrorCode::wrong_count, "it has too many stations");
    NastranStation s;
    s.field = i + 1;
    s.x = f.real(i + 1, "X/XB", 1.0);
    double here[6] = {};
    for (std::size_t k = 0; k < count; ++k) {
      if (f.blank(i + 2 + k) && s.x != 1.0)
        return f.error(ErrorCode::missing, "dimension {} of the station at X/XB = {:g} is missing",
                       k + 1, s.x);
      here[k] = f.real(i + 2 + k, "a dimension of a station", d[k]);
      if (here[k] < 0.0)
        return f.error(ErrorCode::out_of_range, "a dimension of a station is negative");
    }
    NastranProperty other;
    other.card = p.card;
    const std::size_t before = f.errors();
    named_shape(f, other, type, here, s.section);
    if (!(first.section.A > 0.0)) return;  // an error later
    if (!(s.section.A > 0.0)) {
      if (f.errors() == before)
        f.error(ErrorCode::out_of_range, "A is {:g} at X/XB = {:g}, expected more than 0",
                s.section.A, s.x);
      return;
    }
    s.nonstructural = f.real(i + 2 + count, "the nonstructural mass", first.nonstructural);
    s.shape = other.section;
    stations.push_back(s);
  }
  if (stations.size() > 1) read_nastran_beam_stations(f, p, std::move(stations));
}

}  // namespace

/// Turned to its principal axes: tan 2a = 2 I12 / (I1 - I2), from y towards z.
void set_nastran_section(NastranProperty& p, const NastranSection& s) {
  const double a = s.I12 == 0.0 ? 0.0 : 0.5 * std::atan2(2.0 * s.I12, s.I1 - s.I2);
  const double c = std::cos(a), b = std::sin(a);
  p.section = BeamSection{};
  p.section.A = s.A;
  p.section.Iz = s.I1 * c * c + s.I2 * b * b + 2.0 * s.I12 * b * c;
  p.section.Iy = s.I1 * b * b + s.I2 * c * c - 2.0 * s.I12 * b * c;
  p.section.J = s.J;
  p.turn = a;
}

void read_nastran_named_section(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const std::string type = upper_case(f.text(3));
  const std::size_t count = dimensions_of(type);
  if (count == 0) {
    f.error(ErrorCode::unsupported,
            "the section {} is not read (BAR, BOX, BOX1, CHAN, CHAN1, CHAN2, CROSS, H, HAT, I, I1, "
            "L, ROD, T, T1, T2, TUBE, TUBE2 and Z are); give A, I1, I2 and J with {}",
            shown(f.text(3)), f.name() == "PBARL" ? "PBAR" : "PBEAM");
    return;
  }
  double d[6] = {};
  for (std::size_t i = 0; i < count; ++i) {
    d[i] = f.real(8 + i, "a dimension of the section");
    if (d[i] < 0.0)
      return f.error(ErrorCode::out_of_range, "a dimension of the section is negative");
  }
  p.nonstructural = f.real(8 + count, "the nonstructural mass", 0.0);
  NastranStation first;
  named_shape(f, p, type, d, first.section);
  first.nonstructural = p.nonstructural;
  first.shape = p.section;
  named_stations(f, p, type, count, d, first);
}

}  // namespace floatframe
