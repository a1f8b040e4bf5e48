// Sections of shells, from SECTYPE and SECDATA or from real constants.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/decks/number_sizes.hpp"
#include "floatframe/fe/shell_layers.hpp"

namespace floatframe {
namespace {

/// Transverse shear of a homogeneous section.
constexpr double shell_shear = 5.0 / 6.0;

class AnsysShell {
 public:
  AnsysShell(AnsysBuild& build, const AnsysElement& e, const AnsysType& type, Element& element)
      : b_(build), e_(e), type_(type), element_(element) {}

  void build() {
    ShellSection s;
    const bool thin = type_.number == 63;
    const AnsysSection* section = b_.section(e_, "SHEL");
    if (type_.keyopt[1] != 0)
      b_.shared_error(
          ErrorCode::unsupported, e_,
          fmt::format("KEYOPT(1) = {}: only shells with bending and membrane stiffness are read",
                      type_.keyopt[1]));
    if (section != nullptr && !thin && type_.number != 93) {
      layers(*section, s);
    } else {
      constants(s);
    }
    check_numbers(section == nullptr ? e_.at : section->at, s);
    s.shear = thin ? 0.0 : shell_shear * s.thickness;
    element_.section = index_of(s);
    orient();
  }

 private:
  /// Thicknesses and densities may be finite, and their sums and products not.
  void check_numbers(const FeSource& at, const ShellSection& s) {
    const std::vector<Material>& all = b_.model.materials;
    const std::string huge = huge_sheet(s, all[element_.material].density, all);
    if (huge.empty()) return;
    const bool fresh =
        b_.said_once.insert(fmt::format("{}, {}: {}", e_.section, e_.real, huge)).second;
    if (fresh) b_.source.error(ErrorCode::not_finite, at, "{}: {}", b_.label(e_), huge);
  }

  void layers(const AnsysSection& section, ShellSection& s) {
    std::vector<std::vector<double>> rows = section.rows;
    std::erase_if(rows, [](const std::vector<double>& row) {  // a layer that is dropped
      return row.size() > 0 && row[0] == 0.0;
    });
    const bool one = rows.size() == 1;
    for (const std::vector<double>& row : rows) {
      const double t = ansys_value(row, 0);
      if (!(t > 0.0))
        b_.error_once(
            ErrorCode::out_of_range, section.at,
            fmt::format("section {}: a layer is {:g} thick, expected more than 0", e_.section, t));
      const int material =
          ansys_value(row, 1) == 0.0
              ? element_.material
              : b_.layer_material(ansys_value(row, 1), e_, section.at).value_or(element_.material);
      const double angle = ansys_value(row, 2) * std::numbers::pi / 180.0;
      s.thickness += t;
      if (one) {
        element_.material = material;
        element_.angle = angle;
      } else {
        s.plies.push_back({material, t, angle});
      }
    }
    if (rows.empty())
      b_.error_once(ErrorCode::missing, section.at,
                    fmt::format("section {} has no layer with a thickness (SECDATA)", e_.section));
    const std::string& where = section.offset;
    if (where == "TOP" || where == "BOT") {
      s.offset = (where == "BOT" ? 0.5 : -0.5) * s.thickness;
    } else if (where == "USER") {  // the place of the nodes from the middle
      s.offset = -ansys_value(section.offsets, 0);
    } else if (!where.empty() && where != "MID") {
      b_.error_once(
          ErrorCode::unsupported, section.at,
          fmt::format("section {}: SECOFFSET,{} is not read, expected MID, TOP, BOT or USER",
                      e_.section, where));
    }
    if (ansys_value(section.control, 0) != 0.0 || ansys_value(section.control, 1) != 0.0 ||
        ansys_value(section.control, 2) != 0.0)
      b_.error_once(
          ErrorCode::unsupported, section.at,
          fmt::format(
              "section {}: a transverse shear stiffness of its own (SECCONTROL) is not read",
              e_.section));
    s.mass = ansys_value(section.control, 3);
  }

  /// SHELL63: thicknesses of the corners, EFS, THETA, RMI, ..., ADMSUA; others: thicknesses, THETA,
  /// ADMSUA.
  void constants(ShellSection& s) {
    const AnsysReal* real = b_.real(e_);
    if (real == nullptr || !(real->value(0) > 0.0)) {
      b_.shared_error(ErrorCode::missing, e_,
                      type_.number == 63 || type_.number == 93
                          ? fmt::format("its real constants {} give no thickness", e_.real)
                          : fmt::format("its section {} is no SECTYPE,{},SHELL, and its real "
                                        "constants give no thickness",
                                        e_.section, e_.section));
      s.thickness = 1.0;  // the error is known
      return;
    }
    s.thickness = real->value(0);
    for (std::size_t k = 1; k < 4; ++k)
      if (real->value(k) != 0.0 && std::abs(real->value(k) - s.thickness) > 1e-9 * s.thickness)
        b_.error_once(ErrorCode::contradiction, real->at,
                      fmt::format("real constants {}: the thickness is {:g} at one corner and {:g} "
                                  "at another, expected one",
                                  e_.real, s.thickness, real->value(k)));
    const bool thin = type_.number == 63;
    element_.angle = real->value(thin ? 5 : 4) * std::numbers::pi / 180.0;
    s.mass = real->value(thin ? 18 : 5);
    if (!thin) return others(*real, 6, real->values.size());
    if (real->value(6) != 0.0) s.bending_factor = real->value(6);
    if (real->value(4) != 0.0)
      b_.error_once(
          ErrorCode::unsupported, real->at,
          fmt::format("real constants {}: an elastic foundation (EFS) is not read", e_.real));
    others(*real, 9, 18);  // CTOP and CBOT before are of stress
  }

  void others(const AnsysReal& real, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < std::min(end, real.values.size()); ++k)
      if (real.values[k] != 0.0)
        b_.error_once(ErrorCode::out_of_range, real.at,
                      fmt::format("real constants {}: constant {} is {:g}, expected 0", e_.real,
                                  k + 1, real.values[k]));
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
        b_.error(
            ErrorCode::geometry, e_,
            fmt::format(
                "the x axis of its coordinate system {} is nearer to its normal than 45 degrees",
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

}  // namespace

void build_ansys_shell(AnsysBuild& build, const AnsysElement& e, const AnsysType& type,
                       Element& element) {
  AnsysShell(build, e, type, element).build();
}

}  // namespace floatframe
