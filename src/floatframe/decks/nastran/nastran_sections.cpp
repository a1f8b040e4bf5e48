// Sections of PBARL and PBEAML by name. Element y points up in the figures of Nastran, z to the
// right. All but round ones and solid bars consist of plates along y and z (plate_section.hpp). J
// of open sections is sum b t^3/3 of the plates, of a box that of Bredt. Shear deformation is as
// in Nastran.
#include <cmath>

#include "floatframe/decks/nastran/nastran_content.hpp"
#include "floatframe/fe/plate_section.hpp"

namespace floatframe {
namespace {

using Plates = std::vector<SectionPlate>;
using Dimensions = const double*;

struct PlateSection {
  std::string_view type;
  std::size_t dimensions;
  bool centred;  ///< the shear centre is the centroid
  Plates (*plates)(Dimensions);
};

constexpr PlateSection plate_sections[] = {
    {"I", 6, false,
     [](Dimensions d) -> Plates {
       const double web = d[0] - d[4] - d[5];
       return {{d[4] / 2, 0, d[4], d[1]},
               {d[4] + web / 2, 0, web, d[3]},
               {d[0] - d[5] / 2, 0, d[5], d[2]}};
     }},
    {"I1", 4, true,
     [](Dimensions d) -> Plates {
       const double t = (d[3] - d[2]) / 2, y = (d[3] - t) / 2, w = d[0] + d[1];
       return {{-y, 0, t, w}, {0, 0, d[2], d[1]}, {y, 0, t, w}};
     }},
    {"T", 4, false,
     [](Dimensions d) -> Plates {
       const double web = d[1] - d[2];
       return {{web + d[2] / 2, 0, d[2], d[0]}, {web / 2, 0, web, d[3]}};
     }},
    {"T1", 4, false,
     [](Dimensions d) -> Plates {
       return {{0, d[2] / 2, d[0], d[2]}, {0, -d[1] / 2, d[3], d[1]}};
     }},
    {"T2", 4, false,
     [](Dimensions d) -> Plates {
       const double web = d[1] - d[2];
       return {{d[2] / 2, 0, d[2], d[0]}, {d[2] + web / 2, 0, web, d[3]}};
     }},
    {"CHAN", 4, false,
     [](Dimensions d) -> Plates {
       const double flange = d[0] - d[2], y = (d[1] - d[3]) / 2, z = d[2] + flange / 2;
       return {{0, d[2] / 2, d[1], d[2]}, {y, z, d[3], flange}, {-y, z, d[3], flange}};
     }},
    {"CHAN1", 4, false,
     [](Dimensions d) -> Plates {
       const double t = (d[3] - d[2]) / 2, y = (d[3] - t) / 2, z = d[1] + d[0] / 2;
       return {{0, d[1] / 2, d[3], d[1]}, {y, z, t, d[0]}, {-y, z, t, d[0]}};
     }},
    {"CHAN2", 4, false,
     [](Dimensions d) -> Plates {
       const double leg = d[2] - d[1], y = d[1] + leg / 2, z = (d[3] - d[0]) / 2;
       return {{d[1] / 2, 0, d[1], d[3]}, {y, z, leg, d[0]}, {y, -z, leg, d[0]}};
     }},
    {"Z", 4, true,
     [](Dimensions d) -> Plates {
       const double t = (d[3] - d[2]) / 2, y = (d[3] - t) / 2, z = (d[0] + d[1]) / 2;
       return {{0, 0, d[3], d[1]}, {y, -z, t, d[0]}, {-y, z, t, d[0]}};
     }},
    {"H", 4, true,
     [](Dimensions d) -> Plates {
       const double z = d[0] / 2 + d[1] / 4;
       return {{0, 0, d[3], d[0]}, {0, z, d[2], d[1] / 2}, {0, -z, d[2], d[1] / 2}};
     }},
    {"CROSS", 4, true,
     [](Dimensions d) -> Plates {
       const double z = d[1] / 2 + d[0] / 4;
       return {{0, 0, d[2], d[1]}, {0, z, d[3], d[0] / 2}, {0, -z, d[3], d[0] / 2}};
     }},
    {"HAT", 4, false,
     [](Dimensions d) -> Plates {
       const double t = d[1], leg = d[0] - 2 * t, foot = d[3] + t, y = t + leg / 2;
       const double z = (d[2] - t) / 2, outside = d[2] / 2 - t + foot / 2;
       return {{d[0] - t / 2, 0, t, d[2]},
               {y, z, leg, t},
               {y, -z, leg, t},
               {t / 2, outside, t, foot},
               {t / 2, -outside, t, foot}};
     }},
    {"L", 4, false,
     [](Dimensions d) -> Plates {
       const double web = d[1] - d[2];
       return {{d[2] / 2, d[0] / 2, d[2], d[0]}, {d[2] + web / 2, d[3] / 2, web, d[3]}};
     }},
    {"BOX1", 6, false, [](Dimensions d) -> Plates {
       const double wall = d[1] - d[2] - d[3], y = (d[3] - d[2]) / 2;
       return {{(d[1] - d[2]) / 2, 0, d[2], d[0]},
               {-(d[1] - d[3]) / 2, 0, d[3], d[0]},
               {y, -(d[0] - d[4]) / 2, wall, d[4]},
               {y, (d[0] - d[5]) / 2, wall, d[5]}};
     }}};

/// Sections that do not consist of plates, with a known shape for stress.
struct PlainSection {
  std::string_view type;
  std::size_t dimensions;
  double shear;  ///< area over that of the section
  BeamSection (*section)(Dimensions);
};

constexpr PlainSection plain_sections[] = {
    {"ROD", 1, 0.9, [](Dimensions d) { return BeamSection::solid_round(2.0 * d[0]); }},
    {"TUBE", 2, 0.5,
     [](Dimensions d) { return BeamSection::hollow_round(2.0 * d[0], 2.0 * d[1]); }},
    {"TUBE2", 2, 0.5,
     [](Dimensions d) { return BeamSection::hollow_round(2.0 * d[0], 2.0 * (d[0] - d[1])); }},
    {"BAR", 2, 5.0 / 6.0, [](Dimensions d) { return BeamSection::rectangle(d[1], d[0]); }}};

/// Entry for a type; null if there is none.
template <class Section, std::size_t n>
const Section* of_type(const Section (&sections)[n], std::string_view type) {
  const Section* const it = std::find_if(std::begin(sections), std::end(sections),
                                         [type](const Section& s) { return s.type == type; });
  return it == std::end(sections) ? nullptr : it;
}

/// 0: there is no such type.
std::size_t dimensions_of(std::string_view type) {
  if (type == "BOX") return 4;
  if (const PlainSection* const plain = of_type(plain_sections, type)) return plain->dimensions;
  const PlateSection* const made = of_type(plate_sections, type);
  return made == nullptr ? 0 : made->dimensions;
}

/// The raw section about y and z of the element goes to `raw`.
void named_shape(NastranFields& f, NastranProperty& p, const std::string& type, Dimensions d,
                 NastranSection& raw) {
  if ((type == "TUBE" || type == "TUBE2") && d[1] > d[0])
    f.error(ErrorCode::contradiction, "the {} of the {} is more than its outer radius",
            type == "TUBE" ? "inner radius" : "wall", type);
  if (const PlainSection* const plain = of_type(plain_sections, type)) {
    BeamSection& s = p.section = plain->section(d);
    s.shear_y = s.shear_z = plain->shear * s.A;
    raw = {s.A, s.Iz, s.Iy, 0.0, s.J, raw.nonstructural};
    return;
  }
  const bool box = type == "BOX", closed = box || type == "BOX1";
  const double walls_of_box[6] = {d[0], d[1], d[2], d[2], d[3], d[3]};
  const double* const of_box = box ? walls_of_box : d;
  const PlateSection& made = *of_type(plate_sections, box ? "BOX1" : type);
  const Plates plates = made.plates(closed ? of_box : d);
  for (const SectionPlate& plate : plates) {
    if (plate.height > 0.0 && plate.width > 0.0) continue;
    if (box) return f.error(ErrorCode::geometry, "the walls of the BOX are thicker than the box");
    return f.error(ErrorCode::geometry,
                   "the dimensions of the {} do not fit: a wall of it would be {:g} by {:g}", type,
                   plate.height, plate.width);
  }
  const PlateSums sums = plate_sums(plates);
  NastranSection s{sums.A, sums.Iz, sums.Iy, sums.Iyz, sums.thin_J, raw.nonstructural};
  if (closed) {
    if (!(of_box[4] + of_box[5] < of_box[0]))
      return f.error(ErrorCode::geometry, "the walls of the {} are thicker than the box", type);
    s.J = bredt_torsion(of_box[0], of_box[1], of_box[2], of_box[3], of_box[4], of_box[5]);
  } else {
    p.remarks.push_back(
        fmt::format("the torsion constant of the section {} is the sum of b t^3/3 of its plates, "
                    "{:.6g}; warping and shear deformation are left out",
                    type, s.J));
  }
  raw = s;
  set_nastran_section(p, s);
  if (box) {  // the walls along the force, between the middles of the others
    p.section.shear_y = 2.0 * d[3] * (d[1] - d[2]);
    p.section.shear_z = 2.0 * d[2] * (d[0] - d[3]);
  } else if (f.name() == "PBEAML" && !made.centred) {
    p.remarks.push_back(fmt::format(
        "the shear centre of the section {} is taken as its centroid, on the line of the element",
        type));
  }
}

/// Stations of a PBEAML: SO, X/XB, dimensions, nonstructural mass; what end B leaves blank is as at
/// end A.
void named_stations(NastranFields& f, NastranProperty& p, const std::string& type,
                    std::size_t count, Dimensions d, const NastranStation& first) {
  std::vector<NastranStation> stations{first};
  for (std::size_t i = 9 + count; i < f.size(); i += count + 3) {
    if (!same_word(f.text(i), "YES") && !same_word(f.text(i), "NO"))
      return f.error(ErrorCode::wrong_value,
                     "found {} after the section, expected YES or NO of a station",
                     shown(f.text(i)));
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
    const std::size_t before = f.errors();
    named_shape(f, other, type, here, s.section);
    if (!(first.section.A > 0.0)) return;  // an error later
    if (!(s.section.A > 0.0)) {
      if (f.errors() == before)
        f.error(ErrorCode::out_of_range, "A is {:g} at X/XB = {:g}, expected more than 0",
                s.section.A, s.x);
      return;
    }
    s.section.nonstructural =
        f.real(i + 2 + count, "the nonstructural mass", first.section.nonstructural);
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
  p.section.A = s.A;
  p.section.Iz = s.I1 * c * c + s.I2 * b * b + 2.0 * s.I12 * b * c;
  p.section.Iy = s.I1 * b * b + s.I2 * c * c - 2.0 * s.I12 * b * c;
  p.section.J = s.J;
  p.turn = a;
  p.nonstructural = s.nonstructural;
}

void read_nastran_named_section(NastranFields& f, NastranProperty& p) {
  p.material = f.label(1, "the material");
  const std::string type = upper_case(f.text(3));
  const std::size_t count = dimensions_of(type);
  if (count == 0)
    return f.error(
        ErrorCode::unsupported,
        "the section {} is not read (BAR, BOX, BOX1, CHAN, CHAN1, CHAN2, CROSS, H, HAT, I, I1, "
        "L, ROD, T, T1, T2, TUBE, TUBE2 and Z are); give A, I1, I2 and J with {}",
        shown(f.text(3)), f.name() == "PBARL" ? "PBAR" : "PBEAM");
  double d[6] = {};
  for (std::size_t i = 0; i < count; ++i) {
    d[i] = f.real(8 + i, "a dimension of the section");
    if (d[i] < 0.0)
      return f.error(ErrorCode::out_of_range, "a dimension of the section is negative");
  }
  NastranStation first;
  first.section.nonstructural = p.nonstructural = f.real(8 + count, "the nonstructural mass", 0.0);
  named_shape(f, p, type, d, first.section);
  first.shape = p.section;
  named_stations(f, p, type, count, d, first);
}

}  // namespace floatframe
