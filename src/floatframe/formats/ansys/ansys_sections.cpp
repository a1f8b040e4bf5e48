// Sections of shells, beams and rods, from SECTYPE and SECDATA or from real constants.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/fe/shell_layers.hpp"
#include "floatframe/formats/ansys/ansys_build.hpp"

namespace floatframe {
namespace {

/// Transverse shear of a homogeneous section.
constexpr double shell_shear = 5.0 / 6.0;

const AnsysSection* section_of(const AnsysBuild& b, const AnsysElement& e, const char* kind) {
  const auto it = b.content.sections.find(e.section);
  return it != b.content.sections.end() && it->second.kind == kind ? &it->second : nullptr;
}

double at(const std::vector<double>& row, std::size_t k) { return k < row.size() ? row[k] : 0.0; }

class AnsysShell {
 public:
  AnsysShell(AnsysBuild& build, const AnsysElement& e, const AnsysType& type, Element& element)
      : b_(build), e_(e), type_(type), element_(element) {}

  void build() {
    ShellSection s;
    const bool thin = type_.number == 63;
    const AnsysSection* section = section_of(b_, e_, "SHEL");
    if (type_.keyopt[1] != 0)
      b_.error(e_,
               fmt::format("KEYOPT(1) = {}: only shells with bending and membrane stiffness are "
                           "read",
                           type_.keyopt[1]));
    if (section != nullptr && !thin && type_.number != 93) {
      layers(*section, s);
    } else {
      constants(s);
    }
    s.shear = thin ? 0.0 : shell_shear * s.thickness;
    element_.section = index_of(s);
    orient();
  }

 private:
  void layers(const AnsysSection& section, ShellSection& s) {
    const bool one = section.rows.size() == 1;
    for (const std::vector<double>& row : section.rows) {
      const double t = at(row, 0);
      if (!(t > 0.0))
        b_.source.error(section.at, fmt::format("section {}: a layer is {:g} thick, expected more "
                                                "than 0",
                                                e_.section, t));
      const int id = static_cast<int>(at(row, 1));
      const int material = id == 0 ? element_.material : b_.material(id, e_);
      const double angle = at(row, 2) * std::numbers::pi / 180.0;
      s.thickness += t;
      if (one) {
        element_.material = material;
        element_.angle = angle;
      } else {
        s.plies.push_back({material, t, angle});
      }
    }
    if (section.rows.empty())
      b_.source.error(section.at, fmt::format("section {} has no layer (SECDATA)", e_.section));
    const std::string& where = section.offset;
    if (where == "TOP" || where == "BOT") {
      s.offset = (where == "BOT" ? 0.5 : -0.5) * s.thickness;
    } else if (!where.empty() && where != "MID") {
      b_.source.error(section.at, fmt::format("section {}: SECOFFSET,{} is not read, expected MID, "
                                              "TOP or BOT",
                                              e_.section, where));
    }
    if (at(section.control, 0) != 0.0 || at(section.control, 1) != 0.0 ||
        at(section.control, 2) != 0.0)
      b_.source.error(section.at, fmt::format("section {}: a transverse shear stiffness of its own "
                                              "(SECCONTROL) is not read",
                                              e_.section));
    s.mass = at(section.control, 3);
  }

  /// SHELL63: thicknesses of the corners, EFS, THETA, RMI, ..., ADMSUA; others: thicknesses, THETA,
  /// ADMSUA.
  void constants(ShellSection& s) {
    const AnsysReal* real = b_.real(e_);
    if (real == nullptr || !(real->value(0) > 0.0)) {
      b_.error(e_,
               type_.number == 63 || type_.number == 93
                   ? fmt::format("its real constants {} give no thickness", e_.real)
                   : fmt::format("its section {} is no SECTYPE,{},SHELL, and its real constants "
                                 "give no thickness",
                                 e_.section, e_.section));
      s.thickness = 1.0;  // the error is known
      return;
    }
    s.thickness = real->value(0);
    for (std::size_t k = 1; k < 4; ++k)
      if (real->value(k) != 0.0 && std::abs(real->value(k) - s.thickness) > 1e-9 * s.thickness)
        b_.source.error(real->at, fmt::format("real constants {}: the thickness is {:g} at one "
                                              "corner and {:g} at another, expected one",
                                              e_.real, s.thickness, real->value(k)));
    const bool thin = type_.number == 63;
    element_.angle = real->value(thin ? 5 : 4) * std::numbers::pi / 180.0;
    s.mass = real->value(thin ? 18 : 5);
    if (!thin) return others(*real, 6, real->values.size());
    if (real->value(6) != 0.0) s.bending_factor = real->value(6);
    if (real->value(4) != 0.0)
      b_.source.error(real->at, fmt::format("real constants {}: an elastic foundation (EFS) is not "
                                            "read",
                                            e_.real));
    others(*real, 9, 18);  // CTOP and CBOT before are of stress
  }

  void others(const AnsysReal& real, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < std::min(end, real.values.size()); ++k)
      if (real.values[k] != 0.0)
        b_.source.error(real.at, fmt::format("real constants {}: constant {} is {:g}, expected 0",
                                             e_.real, k + 1, real.values[k]));
  }

  int index_of(const ShellSection& s) {
    auto& all = b_.model.shells;
    for (std::size_t k = all.size(); k-- > 0;) {
      const ShellSection& o = all[k];
      const bool same = o.thickness == s.thickness && o.shear == s.shear && o.offset == s.offset &&
                        o.mass == s.mass && o.bending_factor == s.bending_factor &&
                        std::equal(o.plies.begin(), o.plies.end(), s.plies.begin(), s.plies.end(),
                                   [](const ShellPly& a, const ShellPly& b) {
                                     return a.material == b.material &&
                                            a.thickness == b.thickness && a.angle == b.angle;
                                   });
      if (same) return static_cast<int>(k);
    }
    all.push_back(s);
    return static_cast<int>(all.size()) - 1;
  }

  /// Axis 1 is the x axis of the coordinate system, projected; without one the direction of the
  /// first natural coordinate in the middle, the mean of the sides 1-2 and 4-3.
  void orient() {
    const ShellSection& s = b_.model.shells[element_.section];
    if (is_plain(s, b_.model.materials[element_.material])) {
      element_.angle = 0.0;
      return;
    }
    const bool triangle = element_.type == ElementType::tri3 || element_.type == ElementType::tri6;
    std::vector<Vec3> p;
    for (int k = 0; k < (triangle ? 3 : 4); ++k) p.push_back(b_.model.positions[element_.nodes[k]]);
    const Vec3 n = shell_normal(p);
    if (e_.system != 0) {
      element_.orientation = b_.orientation(e_.system, e_.at, b_.label(e_));
      if (element_.orientation < 0) return;
      Vec3 middle = Vec3::Zero();
      for (const Vec3& x : p) middle += x / static_cast<double>(p.size());
      const Vec3 x = b_.model.orientations[element_.orientation].at(middle).col(0);
      if (std::abs(x.dot(n)) > std::numbers::sqrt2 / 2.0)
        b_.error(e_, fmt::format("the x axis of its coordinate system {} is nearer to its normal "
                                 "than 45 degrees",
                                 e_.system));
      return;
    }
    if (triangle) return;
    const Vec3 side = (p[1] - p[0]).normalized(), first = p[1] - p[0] + p[2] - p[3];
    element_.angle += std::atan2(n.dot(side.cross(first)), side.dot(first));
  }

  AnsysBuild& b_;
  const AnsysElement& e_;
  const AnsysType& type_;
  Element& element_;
};

/// Second moments of area about its own axes, and the turn to the principal ones.
struct Beam {
  BeamSection section;
  double turn = 0.0;  ///< of y towards z [rad]
};

void set_principal(double Iyy, double Izz, double Iyz, Beam& beam) {
  beam.section.Iy = Iyy;
  beam.section.Iz = Izz;
  if (Iyz == 0.0) return;
  const double mean = 0.5 * (Iyy + Izz), half = std::hypot(0.5 * (Izz - Iyy), Iyz);
  beam.turn = 0.5 * std::atan2(2.0 * Iyz, Izz - Iyy);
  beam.section.Iz = mean + half;
  beam.section.Iy = mean - half;
}

class AnsysBeam {
 public:
  AnsysBeam(AnsysBuild& build, const AnsysElement& e, const AnsysType& type)
      : b_(build), e_(e), type_(type) {}

  std::optional<Beam> made() {
    if (type_.number == 4) return of_constants();
    const AnsysSection* s = section_of(b_, e_, "BEAM");
    if (s == nullptr) {
      b_.error(e_, fmt::format("its section {} is no SECTYPE,{},BEAM", e_.section, e_.section));
      return std::nullopt;
    }
    return of_section(*s);
  }
  double mass() const noexcept { return mass_; }  ///< besides that of the material [mass/length]

 private:
  /// BEAM4: AREA, IZZ, IYY, TKZ, TKY, THETA, ISTRN, IXX, SHEARZ, SHEARY, SPIN, ADDMAS.
  std::optional<Beam> of_constants() {
    const AnsysReal* real = b_.real(e_);
    if (real == nullptr) {
      b_.error(e_, fmt::format("its real constants {} are not in the file", e_.real));
      return std::nullopt;
    }
    Beam beam;
    const auto r = [&](std::size_t k) { return real->value(k); };
    BeamSection& s = beam.section;
    s.A = r(0);
    s.Iz = r(1);
    s.Iy = r(2);
    s.J = r(7) != 0.0 ? r(7) : r(1) + r(2);
    if (r(8) > 0.0) s.shear_z = s.A / r(8);
    if (r(9) > 0.0) s.shear_y = s.A / r(9);
    beam.turn = r(5) * std::numbers::pi / 180.0;
    mass_ = r(11);
    if (!(s.A > 0.0 && s.Iz > 0.0 && s.Iy > 0.0)) {
      b_.source.error(real->at,
                      fmt::format("real constants {}: AREA, IZZ and IYY are {:g}, {:g} and "
                                  "{:g}, expected more than 0",
                                  e_.real, s.A, s.Iz, s.Iy));
      return std::nullopt;
    }
    return beam;
  }

  std::optional<Beam> of_section(const AnsysSection& s) {
    const std::vector<double> d = s.rows.empty() ? std::vector<double>{} : s.rows.front();
    const auto wrong = [&](const std::string& text) {
      b_.source.error(s.at, fmt::format("section {} ({}): {}", e_.section, s.shape, text));
      return std::nullopt;
    };
    const auto positive = [&](std::size_t count) {
      for (std::size_t k = 0; k < count; ++k)
        if (!(at(d, k) > 0.0)) return false;
      return true;
    };
    mass_ = at(s.control, 3);
    if (at(s.control, 0) != 0.0 || at(s.control, 2) != 0.0)
      return wrong("a transverse shear stiffness of its own (SECCONTROL) is not read");
    Beam beam;
    const bool round = s.shape == "CSOLID", tube = s.shape == "CTUBE";
    if (s.shape == "RECT") {
      if (!positive(2)) return wrong("its sides are expected to be more than 0");
      beam.section = BeamSection::rectangle(d[0], d[1]);
      beam.section.shear_y = beam.section.shear_z = 5.0 / 6.0 * beam.section.A;
    } else if (round || tube) {
      if (!positive(tube ? 2 : 1) || (tube && !(d[1] > d[0])))
        return wrong(tube ? "expected an inner radius above 0 and a larger outer one"
                          : "its radius is expected to be more than 0");
      const double outer = d[tube ? 1 : 0], inner = tube ? d[0] : 0.0, m = inner / outer,
                   q = (1.0 + m * m) * (1.0 + m * m);
      beam.section = tube ? BeamSection::hollow_round(2.0 * outer, 2.0 * inner)
                          : BeamSection::solid_round(2.0 * outer);
      // Cowper's coefficient without Poisson's ratio.
      const double shear = 6.0 * q / (7.0 * q + 20.0 * m * m);
      beam.section.shear_y = beam.section.shear_z = shear * beam.section.A;
    } else if (s.shape == "ASEC") {
      // A, Iyy, Iyz, Izz, Iw, J, CGy, CGz, SHy, SHz, TKz, TKy, TSxz, TSxy
      if (!positive(2) || !(at(d, 3) > 0.0) || !(at(d, 5) > 0.0))
        return wrong("A, Iyy, Izz and J are expected to be more than 0");
      if (at(d, 6) != 0.0 || at(d, 7) != 0.0)
        return wrong("its centroid is not at the node, which is not read");
      beam.section.A = d[0];
      set_principal(d[1], d[3], d[2], beam);
      beam.section.J = d[5];
      if (!(beam.section.Iy > 0.0)) return wrong("Iyz is larger than Iyy and Izz allow");
      if (at(d, 8) != 0.0 || at(d, 9) != 0.0)
        b_.note(s.at,
                fmt::format("section {}: its shear centre is taken at its centroid", e_.section));
      if (at(d, 12) > 0.0) beam.section.shear_z = d[12] * d[0];
      if (at(d, 13) > 0.0) beam.section.shear_y = d[13] * d[0];
    } else {
      return wrong("this shape is not read; RECT, CSOLID, CTUBE and ASEC (constants) are");
    }
    if (!s.offset.empty() && s.offset != "CENT" && !(s.shape != "ASEC" && s.offset != "USER"))
      return wrong(fmt::format("SECOFFSET,{} is not read, expected CENT", s.offset));
    return beam;
  }

  AnsysBuild& b_;
  const AnsysElement& e_;
  const AnsysType& type_;
  double mass_ = 0.0;
};

/// Local y: of the node for the orientation, which is towards z; without one parallel to the global
/// xy plane, of an element along z the global y.
Vec3 local_y(const Vec3& along, const Vec3* towards_z) {
  const Vec3 x = along.normalized();
  if (towards_z != nullptr) return towards_z->cross(x);
  const Vec3 y = Vec3::UnitZ().cross(x);
  return y.norm() > 1e-4 ? y : Vec3(Vec3::UnitY());
}

int add_section(FeModel& model, const BeamSection& s) {
  for (std::size_t k = model.sections.size(); k-- > 0;) {
    const BeamSection& o = model.sections[k];
    if (o.A == s.A && o.Iy == s.Iy && o.Iz == s.Iz && o.J == s.J && o.shear_y == s.shear_y &&
        o.shear_z == s.shear_z && o.outline == s.outline && o.width == s.width &&
        o.height == s.height && o.bore == s.bore)
      return static_cast<int>(k);
  }
  model.sections.push_back(s);
  return static_cast<int>(model.sections.size()) - 1;
}

}  // namespace

void build_ansys_shell(AnsysBuild& build, const AnsysElement& e, const AnsysType& type,
                       Element& element) {
  AnsysShell(build, e, type, element).build();
}

namespace {

bool rod(AnsysBuild& b, const AnsysElement& e, const AnsysType& type, Element& element) {
  BeamSection s;
  double mass = 0.0;
  bool one_way = false;
  const AnsysSection* section = type.number == 180 ? section_of(b, e, "LINK") : nullptr;
  if (section != nullptr && !section->rows.empty()) {
    s.A = at(section->rows.front(), 0);
    mass = at(section->control, 0);
    one_way = at(section->control, 1) != 0.0;
  } else if (const AnsysReal* real = b.real(e)) {
    s.A = real->value(0);
    if (type.number == 180) mass = real->value(1);
    one_way = type.number == 180 && real->value(2) != 0.0;
  }
  if (one_way) {
    b.error(e, "it is for tension or compression alone (TENSKEY), which is not linear");
    return false;
  }
  if (!(s.A > 0.0)) {
    b.error(e, "neither its section (SECTYPE,n,LINK) nor its real constants give an area above 0");
    return false;
  }
  element.type = ElementType::rod2;
  element.material = b.material(e.material, e, mass / s.A);
  element.section = add_section(b.model, s);
  return true;
}

}  // namespace

bool build_ansys_line(AnsysBuild& b, const AnsysElement& e, const AnsysType& type,
                      const std::vector<int>& nodes, Element& element) {
  const AnsysFamily family = ansys_library_element(type.number)->family;
  const std::size_t count = family == AnsysFamily::beam3 ? 3 : 2;
  if (nodes.size() < count || std::any_of(nodes.begin(), nodes.begin() + static_cast<int>(count),
                                          [](int n) { return n < 0; })) {
    b.error(e, fmt::format("it has fewer than {} nodes", count));
    return false;
  }
  const std::vector<Vec3>& p = b.model.positions;
  const Vec3 along = p[nodes[1]] - p[nodes[0]];
  element.nodes[0] = nodes[0];
  element.nodes[1] = nodes[1];
  if (!(along.norm() > 0.0)) {
    b.error(e, "its ends are at one place");
    return false;
  }
  if (family == AnsysFamily::rod) return rod(b, e, type, element);
  AnsysBeam reader(b, e, type);
  const auto beam = reader.made();
  if (!beam) return false;
  element.type = family == AnsysFamily::beam3 ? ElementType::beam3 : ElementType::beam2;
  if (family == AnsysFamily::beam3) {  // ends, middle there; end, middle, end here
    element.nodes[1] = nodes[2];
    element.nodes[2] = nodes[1];
  }
  const bool oriented = nodes.size() > count && nodes[count] >= 0;
  const Vec3 towards = oriented ? Vec3(p[nodes[count]] - p[nodes[0]]) : Vec3::Zero();
  const Vec3 x = along.normalized();
  if (oriented && !(x.cross(towards).norm() > 1e-8 * towards.norm())) {
    b.error(e, "its node for the orientation is on its axis");
    return false;
  }
  const Vec3 y = local_y(along, oriented ? &towards : nullptr);
  const Vec3 unit_y = (y - y.dot(x) * x).normalized(), z = x.cross(unit_y);
  element.reference = std::cos(beam->turn) * unit_y + std::sin(beam->turn) * z;
  element.material = b.material(e.material, e, reader.mass() / beam->section.A);
  element.section = add_section(b.model, beam->section);
  return true;
}

}  // namespace floatframe
