// Sections of beams and pipes from SECTYPE, SECDATA and SECOFFSET. In the figures of ANSYS y points
// to the right and z up.
#include <algorithm>
#include <cmath>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/fe/plate_section.hpp"

namespace floatframe {
namespace {

constexpr int most_solved_sections = 200;

using BeamPlates = std::vector<SectionPlate>;
using ShapeRow = std::vector<double>;

/// Between two corners.
SectionPlate plate(double y0, double y1, double z0, double z1) {
  return {0.5 * (y0 + y1), 0.5 * (z0 + z1), y1 - y0, z1 - z0};
}

struct PlateShape {
  const char* name;
  std::size_t dimensions;
  BeamPlates (*plates)(const ShapeRow&);
  bool origin = false;           ///< the origin is known: at 0, 0 of the plates
  bool sides = true;             ///< and to which side the shape points
  const char* remark = nullptr;  ///< assumptions
};

const PlateShape plate_shapes[] = {
    // W1, W2 of the flanges below and above, W3 overall depth, t1, t2 of these, t3 of the web.
    {"I", 6,
     [](const ShapeRow& d) -> BeamPlates {
       return {plate(-d[0] / 2, d[0] / 2, 0, d[3]), plate(-d[5] / 2, d[5] / 2, d[3], d[2] - d[4]),
               plate(-d[1] / 2, d[1] / 2, d[2] - d[4], d[2])};
     },
     true},
    // W1, W2 outside, t1 to t4 of the walls at the left, at the right, below and above.
    {"HREC", 6,
     [](const ShapeRow& d) -> BeamPlates {
       return {plate(0, d[2], 0, d[1]), plate(d[0] - d[3], d[0], 0, d[1]),
               plate(d[2], d[0] - d[3], 0, d[4]), plate(d[2], d[0] - d[3], d[1] - d[5], d[1])};
     },
     true},
    // Like I, with the web at the left.
    {"CHAN", 6,
     [](const ShapeRow& d) -> BeamPlates {
       return {plate(0, d[5], 0, d[2]), plate(d[5], d[0], 0, d[3]),
               plate(d[5], d[1], d[2] - d[4], d[2])};
     }},
    // W1, W2 of the legs, t1, t2: the first to the right, the second up.
    {"L", 4,
     [](const ShapeRow& d) -> BeamPlates {
       return {plate(0, d[0], 0, d[2]), plate(0, d[3], d[2], d[1])};
     }},
    // W1 of the flange, W2 overall depth, t1 of the flange, t2 of the stem.
    {"T", 4,
     [](const ShapeRow& d) -> BeamPlates {
       return {plate(-d[0] / 2, d[0] / 2, 0, d[2]), plate(-d[3] / 2, d[3] / 2, d[2], d[1])};
     },
     false, false},
    // Like I, with the lower flange to the right, the upper one to the left of the web.
    {"Z", 6,
     [](const ShapeRow& d) -> BeamPlates {
       return {plate(0, d[5], 0, d[2]), plate(d[5], d[0], 0, d[3]),
               plate(d[5] - d[1], 0, d[2] - d[4], d[2])};
     },
     false, true, "its lower flange is taken to point to +y and the upper one to -y"},
    // W1, W2 of the brims, W3 of the top, W4 overall depth, t1, t2 of the brims, t3 of the top, t4,
    // t5 of the webs.
    {"HATS", 9,
     [](const ShapeRow& d) -> BeamPlates {
       return {plate(-d[0], 0, 0, d[4]), plate(d[2], d[2] + d[1], 0, d[5]),
               plate(0, d[2], d[3] - d[6], d[3]), plate(0, d[7], 0, d[3] - d[6]),
               plate(d[2] - d[8], d[2], 0, d[3] - d[6])};
     },
     false, true, "its brims are taken to begin at the outer sides of the webs"},
};

class BeamShape {
 public:
  BeamShape(AnsysBuild& build, const AnsysSection& section, int id)
      : b_(build), s_(section), id_(id) {
    if (!s_.rows.empty()) d_ = s_.rows.front();
    d_.resize(std::max<std::size_t>(d_.size(), 14), 0.0);
  }

  std::optional<AnsysBeam> made() {
    return shape() && place() && finite() ? std::optional(beam_) : std::nullopt;
  }

 private:
  template <class... Args>
  bool fail(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
    b_.source.error(code, s_.at, "section {} ({}): {}", id_, s_.kind == "PIPE" ? s_.kind : s_.shape,
                    fmt::format(text, std::forward<Args>(args)...));
    return false;
  }

  bool shape() {
    // TXZ, --, TXY, ADDMAS
    if (ansys_value(s_.control, 0) != 0.0 || ansys_value(s_.control, 2) != 0.0)
      return fail(ErrorCode::unsupported,
                  "a transverse shear stiffness of its own (SECCONTROL) is not read");
    beam_.mass = ansys_value(s_.control, 3);
    if (s_.shape == "ASEC") return constants();
    for (const PlateShape& known : plate_shapes)
      if (known.name == s_.shape) return plates(known);
    return solid();
  }

  bool finite() {
    const std::string misfit = ansys_beam_misfit(beam_);
    return misfit.empty() || fail(ErrorCode::geometry, "{}", misfit);
  }

  bool positive(std::size_t count) const {
    return std::all_of(d_.begin(), d_.begin() + static_cast<std::ptrdiff_t>(count),
                       [](double x) { return x > 0.0; });
  }

  void round(double outer, double inner) {
    beam_.section = inner > 0.0 ? BeamSection::hollow_round(2.0 * outer, 2.0 * inner)
                                : BeamSection::solid_round(2.0 * outer);
    // Cowper's coefficient without Poisson's ratio.
    const double m = inner / outer, q = (1.0 + m * m) * (1.0 + m * m);
    const double shear = 6.0 * q / (7.0 * q + 20.0 * m * m);
    beam_.section.shear_y = beam_.section.shear_z = shear * beam_.section.A;
  }

  /// RECT, CSOLID, CTUBE, PIPE: the centroid is the origin and the shear centre.
  bool solid() {
    if (s_.kind == "PIPE") return pipe();
    if (s_.shape == "MESH")
      return fail(ErrorCode::unsupported,
                  "sections of cells are not read; give their constants, SECTYPE,n,BEAM,ASEC");
    if (s_.shape == "RECT") {
      if (!positive(2))
        return fail(ErrorCode::out_of_range, "its sides are expected to be more than 0");
      beam_.section = BeamSection::rectangle(d_[0], d_[1]);
      beam_.section.shear_y = beam_.section.shear_z = 5.0 / 6.0 * beam_.section.A;
    } else if (s_.shape == "CSOLID") {
      if (!positive(1))
        return fail(ErrorCode::out_of_range, "its radius is expected to be more than 0");
      round(d_[0], 0.0);
    } else if (s_.shape == "CTUBE") {
      if (!positive(2) || !(d_[1] > d_[0]))
        return fail(ErrorCode::out_of_range,
                    "expected an inner radius above 0 and a larger outer one");
      round(d_[1], d_[0]);
    } else {
      return fail(ErrorCode::unsupported,
                  "this shape is not read; RECT, CSOLID, CTUBE, I, CHAN, L, T, Z, HREC, HATS and "
                  "ASEC (constants) are");
    }
    return true;
  }

  /// Do, Tw, Nc, Ss, Nt, Mint, Mins, Tins
  bool pipe() {
    const double outer = 0.5 * d_[0], wall = d_[1] == 0.0 ? outer : d_[1];
    if (!(outer > 0.0 && wall > 0.0 && wall <= outer))
      return fail(ErrorCode::out_of_range,
                  "its outer diameter is {:g} and its wall {:g}, expected more than 0 and a wall "
                  "of at most the radius",
                  d_[0], d_[1]);
    if (d_[5] != 0.0) return fail(ErrorCode::unsupported, "a fluid inside (Mint) is not read");
    round(outer, outer - wall);
    if (d_[6] == 0.0 || d_[7] == 0.0) return true;
    if (d_[7] < 0.0) return fail(ErrorCode::out_of_range, "its insulation is {:g} thick", d_[7]);
    const auto cover = b_.content.materials.find(static_cast<int>(d_[6]));
    if (cover == b_.content.materials.end() || cover->second.find("DENS") == nullptr)
      return fail(ErrorCode::missing, "material {:g} of its insulation has no density (MP,DENS)",
                  d_[6]);
    beam_.mass += cover->second.find("DENS")->front().second * std::numbers::pi * d_[7] *
                  (2.0 * outer + d_[7]);
    return true;
  }

  /// A, Iyy, Iyz, Izz, Iw, J, CGy, CGz, SHy, SHz, TKz, TKy, TSxz, TSxy
  bool constants() {
    if (!positive(2) || !(d_[3] > 0.0) || !(d_[5] > 0.0))
      return fail(ErrorCode::out_of_range, "A, Iyy, Izz and J are expected to be more than 0");
    BeamSection& s = beam_.section;
    s.A = d_[0];
    set_principal(d_[1], d_[3], d_[2]);
    s.J = d_[5];
    if (!(s.Iy > 0.0))
      return fail(ErrorCode::contradiction, "Iyz is larger than Iyy and Izz allow");
    if (d_[12] > 0.0) s.shear_z = d_[12] * d_[0];
    if (d_[13] > 0.0) s.shear_y = d_[13] * d_[0];
    center_ = {d_[6], d_[7]};
    shear_ = {d_[8], d_[9]};
    note_shear_center();
    return true;
  }

  bool plates(const PlateShape& shape) {
    if ((s_.shape == "L" || s_.shape == "T") && d_[1] < 0.0)
      return fail(ErrorCode::unsupported, "W2 is {:g}: a flipped section is not read", d_[1]);
    if (!positive(shape.dimensions))
      return fail(ErrorCode::out_of_range, "it has {} dimensions, expected all to be more than 0",
                  shape.dimensions);
    const BeamPlates plates = shape.plates(d_);
    for (const SectionPlate& p : plates)
      if (!(p.height > 0.0 && p.width > 0.0))
        return fail(ErrorCode::geometry,
                    "its dimensions do not fit: a wall of it would be {:g} by {:g}", p.height,
                    p.width);
    if (s_.shape == "HATS" && !(d_[7] + d_[8] < d_[2]))
      return fail(ErrorCode::geometry, "its webs are thicker than its top is wide");
    if ((s_.shape == "HREC" && !(d_[4] + d_[5] < d_[1])) ||
        (s_.shape == "CHAN" && !(d_[3] + d_[4] < d_[2])))
      return fail(ErrorCode::geometry, "its walls are thicker than it is high");
    // A few bytes of deck would take 0.01 to 0.1 s each.
    if (++b_.solved_sections > most_solved_sections)
      return fail(ErrorCode::too_large,
                  "the torsion of more than {} sections is not computed: give their constants "
                  "(SECTYPE,n,BEAM,ASEC)",
                  most_solved_sections);
    const PlateSums sums = plate_sums(plates);
    const SectionFlow flow = section_flow(plates);
    if (!flow.found)
      return fail(ErrorCode::unsupported,
                  "its torsion constant cannot be computed: its walls are too unlike in size");
    BeamSection& s = beam_.section;
    s.A = sums.A;
    set_principal(sums.Iy, sums.Iz, sums.Iyz);
    s.J = flow.J;
    const Vec2 y(std::cos(beam_.turn), std::sin(beam_.turn)), z(-y(1), y(0));
    s.shear_y = 1.0 / y.dot(flow.shear_flexibility * y);
    s.shear_z = 1.0 / z.dot(flow.shear_flexibility * z);
    center_ = {sums.y, sums.z};
    shear_ = {flow.center_y, flow.center_z};
    origin_ = shape.origin;
    sides_ = shape.sides;
    note_shear_center();
    if (shape.remark != nullptr) note(shape.remark);
    return true;
  }

  void note(const char* text) { b_.note(s_.at, "section {} ({}): {}", id_, s_.shape, text); }

  void note_shear_center() {
    if ((center_ - shear_).norm() > 1e-6 * std::sqrt(beam_.section.A))
      note("its shear centre is taken at its centroid");
  }

  /// Iy, Iz of the principal axes and their angle, from moments about y and z.
  void set_principal(double Iyy, double Izz, double Iyz) {
    beam_.section.Iy = Iyy;
    beam_.section.Iz = Izz;
    if (std::abs(Iyz) <= 1e-12 * (Iyy + Izz)) return;
    const double mean = 0.5 * (Iyy + Izz), half = std::hypot(0.5 * (Izz - Iyy), Iyz);
    beam_.turn = 0.5 * std::atan2(2.0 * Iyz, Izz - Iyy);
    beam_.section.Iz = mean + half;
    beam_.section.Iy = mean - half;
  }

  /// The arm from the node to the centroid.
  bool place() {
    const std::string& where = s_.offset;
    for (std::size_t k = 2; k < 6; ++k)
      if (ansys_value(s_.offsets, k) != 0.0)
        return fail(ErrorCode::unsupported,
                    "a centroid or shear centre of its own (SECOFFSET) is not read");
    Vec2 node = center_;
    if (where == "SHRC") {
      if (!sides_) return unknown("to which side its flange points");
      node = shear_;
    } else if (where == "ORIG" || where == "USER") {
      if (!origin_) return unknown("where its origin is");
      node.setZero();
      if (where == "USER") node << ansys_value(s_.offsets, 0), ansys_value(s_.offsets, 1);
    } else if (!where.empty() && where != "CENT") {
      return fail(ErrorCode::unsupported,
                  "SECOFFSET,{} is not read, expected CENT, SHRC, ORIGIN or USER", where);
    }
    // Not the rounding error of a centroid off the node.
    const double least = 1e-9 * std::sqrt(beam_.section.A);
    const auto arm = [&](double x) { return std::abs(x) < least ? 0.0 : x; };
    beam_.arm_y = arm(center_(0) - node(0));
    beam_.arm_z = arm(center_(1) - node(1));
    return true;
  }

  bool unknown(const char* what) {
    return fail(ErrorCode::unsupported,
                "SECOFFSET,{}: {} is not known; expected CENT, or give its constants and centroid "
                "(SECTYPE,n,BEAM,ASEC)",
                s_.offset, what);
  }

  AnsysBuild& b_;
  const AnsysSection& s_;
  int id_;
  ShapeRow d_;
  AnsysBeam beam_;
  Vec2 center_ = Vec2::Zero(), shear_ = Vec2::Zero();  ///< from the origin
  bool origin_ = true, sides_ = true;
};

}  // namespace

std::string ansys_beam_misfit(const AnsysBeam& beam) {
  const BeamSection& s = beam.section;
  if (std::isfinite(s.A + beam.mass) && std::isfinite(s.Iy + s.Iz) && std::isfinite(s.J) &&
      std::isfinite(s.shear_y + s.shear_z) && std::isfinite(beam.arm_y + beam.arm_z))
    return {};
  return fmt::format(
      "its area is {:g}, its moments are {:g} and {:g}, its torsion constant is {:g}, its areas in "
      "shear {:g} and {:g} and its centroid ({:g}, {:g}) from the node, expected finite numbers",
      s.A, s.Iy, s.Iz, s.J, s.shear_y, s.shear_z, beam.arm_y, beam.arm_z);
}

std::optional<AnsysBeam> ansys_beam_section(AnsysBuild& build, const AnsysSection& section,
                                            const AnsysElement& e) {
  const auto it = build.beams.find(e.section);
  if (it != build.beams.end()) return it->second;
  return build.beams.emplace(e.section, BeamShape(build, section, e.section).made()).first->second;
}

}  // namespace floatframe
