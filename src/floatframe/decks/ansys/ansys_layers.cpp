// Sections of shells, from SECTYPE and SECDATA or from real constants, and layers of solids:
// SOLID185 and 186 with KEYOPT(3) = 1, and SOLSH190 with a SHELL section. In a solid the
// thicknesses of a section are shares of that of the element, from the face I-J-K-L to M-N-O-P;
// angles count from the x axis of ESYS projected on the layer, else from the first natural
// direction.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/decks/number_sizes.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/shell_layers.hpp"

namespace floatframe {
namespace {

/// Transverse shear of a homogeneous section.
constexpr double shell_shear = 5.0 / 6.0;
/// Of a solid, as many as ANSYS has.
constexpr std::size_t most_layers = 250;

/// Thickness, material, angle: without the layers that are dropped.
std::vector<std::vector<double>> layers_of(const AnsysSection& section) {
  std::vector<std::vector<double>> rows = section.rows;
  std::erase_if(rows, [](const auto& row) { return !row.empty() && row[0] == 0.0; });
  return rows;
}

/// Is axis 1 far enough from the normal of a face with these corners? `normal`: its name.
bool axis_in_face(AnsysBuild& b, const AnsysElement& e, const FeElement& element,
                  const std::vector<Vec3>& corners, const char* normal) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& x : corners) middle += x / static_cast<double>(corners.size());
  const Vec3 x = b.model.orientations[element.orientation].at(middle).col(0);
  return std::abs(x.dot(shell_normal(corners))) <= std::numbers::sqrt2 / 2.0 ||
         b.error(ErrorCode::geometry, e,
                 "the x axis of its coordinate system {} is nearer to {} than 45 degrees", e.system,
                 normal);
}

class AnsysShell {
 public:
  AnsysShell(AnsysBuild& build, const AnsysElement& e, const AnsysType& type, FeElement& element)
      : b_(build), e_(e), type_(type), element_(element) {}

  void build() {
    ShellSection s;
    const AnsysSection* section = b_.section(e_, "SHEL");
    if (type_.keyopt[1] != 0)
      b_.shared_error(ErrorCode::unsupported, e_,
                      "KEYOPT(1) = {}: only shells with bending and membrane stiffness are read",
                      type_.keyopt[1]);
    if (section != nullptr && !thin_ && type_.number != 93)
      layers(*section, s);
    else
      constants(s);
    check_numbers(section == nullptr ? e_.at : section->at, s);
    s.shear = thin_ ? 0.0 : shell_shear * s.thickness;
    element_.section = index_of(s);
    orient();
  }

 private:
  /// Thicknesses and densities may be finite, and their sums and products not.
  void check_numbers(const FeSource& at, const ShellSection& s) {
    const std::vector<Material>& all = b_.model.materials;
    const std::string huge = huge_sheet(s, all[element_.material].density, all);
    if (huge.empty()) return;
    if (b_.said_once.insert(fmt::format("{}, {}: {}", e_.section, e_.real, huge)).second)
      b_.source.error(ErrorCode::not_finite, at, "{}: {}", b_.label(e_), huge);
  }

  void layers(const AnsysSection& section, ShellSection& s) {
    const std::vector<std::vector<double>> rows = layers_of(section);
    for (const std::vector<double>& row : rows) {
      const double t = ansys_value(row, 0), angle = ansys_value(row, 2) * ansys_degree;
      if (!(t > 0.0))
        b_.error_once(ErrorCode::out_of_range, section.at,
                      "section {}: a layer is {:g} thick, expected more than 0", e_.section, t);
      const int material =
          b_.layer_material(ansys_value(row, 1), e_, section.at).value_or(element_.material);
      s.thickness += t;
      if (rows.size() > 1) {
        s.plies.push_back({material, t, angle});
      } else {
        element_.material = material;
        element_.angle = angle;
      }
    }
    if (rows.empty())
      b_.error_once(ErrorCode::missing, section.at,
                    "section {} has no layer with a thickness (SECDATA)", e_.section);
    const std::string& where = section.offset;
    if (where == "TOP" || where == "BOT") {
      s.offset = (where == "BOT" ? 0.5 : -0.5) * s.thickness;
    } else if (where == "USER") {  // the place of the nodes from the middle
      s.offset = -ansys_value(section.offsets, 0);
    } else if (!where.empty() && where != "MID") {
      b_.error_once(ErrorCode::unsupported, section.at,
                    "section {}: SECOFFSET,{} is not read, expected MID, TOP, BOT or USER",
                    e_.section, where);
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (ansys_value(section.control, k) != 0.0)
        b_.error_once(
            ErrorCode::unsupported, section.at,
            "section {}: a transverse shear stiffness of its own (SECCONTROL) is not read",
            e_.section);
    s.mass = ansys_value(section.control, 3);
  }

  /// SHELL63: thicknesses of the corners, EFS, THETA, RMI, ..., ADMSUA; others: thicknesses, THETA,
  /// ADMSUA.
  void constants(ShellSection& s) {
    const AnsysReal* real = b_.real(e_);
    s.thickness = real == nullptr ? 0.0 : real->value(0);
    if (!(s.thickness > 0.0)) {
      s.thickness = 1.0;  // the error is reported already
      if (thin_ || type_.number == 93)
        b_.shared_error(ErrorCode::missing, e_, "its real constants {} give no thickness", e_.real);
      else
        b_.shared_error(
            ErrorCode::missing, e_,
            "its section {} is no SECTYPE,{},SHELL, and its real constants give no thickness",
            e_.section, e_.section);
      return;
    }
    for (std::size_t k = 1; k < 4; ++k)
      if (real->value(k) != 0.0 && std::abs(real->value(k) - s.thickness) > 1e-9 * s.thickness)
        b_.error_once(ErrorCode::contradiction, real->at,
                      "real constants {}: the thickness is {:g} at one corner and {:g} at another, "
                      "expected one",
                      e_.real, s.thickness, real->value(k));
    element_.angle = real->value(thin_ ? 5 : 4) * ansys_degree;
    s.mass = real->value(thin_ ? 18 : 5);
    if (!thin_) return others(*real, 6, real->values.size());
    if (real->value(6) != 0.0) s.bending_factor = real->value(6);
    if (real->value(4) != 0.0)
      b_.error_once(ErrorCode::unsupported, real->at,
                    "real constants {}: an elastic foundation (EFS) is not read", e_.real);
    others(*real, 9, 18);  // CTOP and CBOT before are of stress
  }

  void others(const AnsysReal& real, std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k)
      if (real.value(k) != 0.0)
        b_.error_once(ErrorCode::out_of_range, real.at,
                      "real constants {}: constant {} is {:g}, expected 0", e_.real, k + 1,
                      real.value(k));
  }

  int index_of(const ShellSection& s) {
    const auto numbers = [](const ShellSection& x) {
      return std::tie(x.thickness, x.shear, x.offset, x.mass, x.bending_factor);
    };
    const auto same_ply = [](const ShellPly& x, const ShellPly& y) {
      return x.material == y.material && x.thickness == y.thickness && x.angle == y.angle;
    };
    auto& all = b_.model.shells;
    for (std::size_t k = all.size(); k-- > 0;)
      if (numbers(all[k]) == numbers(s) && std::equal(all[k].plies.begin(), all[k].plies.end(),
                                                      s.plies.begin(), s.plies.end(), same_ply))
        return static_cast<int>(k);
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
    const bool triangle =
        element_.type == FeElementType::tri3 || element_.type == FeElementType::tri6;
    std::vector<Vec3> p;
    for (int k = 0; k < (triangle ? 3 : 4); ++k) p.push_back(b_.model.positions[element_.nodes[k]]);
    if (e_.system != 0) {
      element_.orientation = b_.orientation(e_.system, e_.at, b_.label(e_));
      if (element_.orientation >= 0) axis_in_face(b_, e_, element_, p, "its normal");
      return;
    }
    if (triangle) return;
    const Vec3 side = (p[1] - p[0]).normalized(), first = p[1] - p[0] + p[2] - p[3];
    element_.angle += std::atan2(shell_normal(p).dot(side.cross(first)), side.dot(first));
  }

  AnsysBuild& b_;
  const AnsysElement& e_;
  const AnsysType& type_;
  FeElement& element_;
  const bool thin_ = type_.number == 63;
};

/// Layers with a thickness; empty with an error.
std::vector<ShellPly> solid_plies(AnsysBuild& b, const AnsysSection& section,
                                  const AnsysElement& e) {
  const auto refuse = [&]<class... Args>(ErrorCode code, fmt::format_string<Args...> text,
                                         Args&&... args) {
    b.source.error(code, section.at, "section {}{}", e.section,
                   fmt::format(text, std::forward<Args>(args)...));
    return std::vector<ShellPly>();
  };
  std::vector<ShellPly> plies;
  double thick = 0.0, mass = 0.0;
  for (const std::vector<double>& row : layers_of(section)) {
    const double t = ansys_value(row, 0);
    if (!(t > 0.0) || !std::isfinite(t))
      return refuse(ErrorCode::out_of_range, ": a layer is {:g} thick, expected more than 0", t);
    const std::optional<int> material = b.layer_material(ansys_value(row, 1), e, section.at);
    if (!material) return {};
    plies.push_back({*material, t, ansys_value(row, 2) * ansys_degree});
    thick += t;
    mass += t * b.model.materials[*material].density;
  }
  if (!std::isfinite(thick + mass))
    return refuse(ErrorCode::not_finite,
                  ": the thickness of its layers is {:g} and their mass over area {:g}, expected "
                  "finite numbers",
                  thick, mass);
  if (plies.empty()) return refuse(ErrorCode::missing, " has no layer with a thickness (SECDATA)");
  if (plies.size() > most_layers)
    return refuse(ErrorCode::too_large, " has {} layers, expected at most {} in a solid",
                  plies.size(), most_layers);
  if (!section.offset.empty() && section.offset != "MID")
    return refuse(ErrorCode::unsupported,
                  ": SECOFFSET,{} of layers of solids is not read: they fill their element",
                  section.offset);
  if (std::any_of(section.control.begin(), section.control.end(),
                  [](double x) { return x != 0.0; }))
    return refuse(ErrorCode::unsupported, ": SECCONTROL of layers of solids is not read");
  return plies;
}

/// Index in FeModel::layups, one per section and material of elements; -1 with an error.
int layup_of(AnsysBuild& b, const AnsysElement& e) {
  const auto [it, fresh] = b.layups.try_emplace({e.section, e.material}, -1);
  if (!fresh) return it->second;
  const AnsysSection* section = b.section(e, "SHEL");
  if (section == nullptr)
    b.error(ErrorCode::contradiction, e,
            "it has layers (KEYOPT(3) = 1), but its section {} is no SECTYPE,{},SHELL", e.section,
            e.section);
  std::vector<ShellPly> plies;
  if (section != nullptr) plies = solid_plies(b, *section, e);
  if (plies.empty()) return -1;
  b.model.layups.push_back({std::move(plies)});
  return it->second = static_cast<int>(b.model.layups.size()) - 1;
}

/// The corners of the face halfway between the lowest and the highest layer.
std::vector<Vec3> middle_face(const FeModel& model, const FeElement& element) {
  const std::size_t side = element_kernel(element.type).shape.neighbours.size() / 2;
  std::vector<Vec3> corners;
  for (std::size_t k = 0; k < side; ++k)
    corners.emplace_back(
        0.5 * (model.positions[element.nodes[k]] + model.positions[element.nodes[k + side]]));
  return corners;
}

}  // namespace

void build_ansys_shell(AnsysBuild& build, const AnsysElement& e, const AnsysType& type,
                       FeElement& element) {
  AnsysShell(build, e, type, element).build();
}

bool ansys_has_layers(const AnsysBuild& b, const AnsysElement& e, const AnsysType& type) {
  if (type.number == 190) return b.section(e, "SHEL") != nullptr;
  return (type.number == 185 || type.number == 186) && type.keyopt[3] != 0;
}

bool build_ansys_layers(AnsysBuild& b, const AnsysElement& e, const AnsysType& type,
                        FeElement& element) {
  const int layup = layup_of(b, e);
  if (layup < 0) return false;
  const std::vector<ShellPly>& plies = b.model.layups[layup].plies;
  element.material = plies.front().material;
  const bool uniform = std::all_of(plies.begin(), plies.end(), [&](const ShellPly& ply) {
    return ply.material == plies.front().material;
  });
  // Layers of SOLID185 have enhanced strains for any KEYOPT(2).
  const bool brick = element.type == FeElementType::hex8 || element.type == FeElementType::hex8r;
  if (brick && type.number == 185) element.type = FeElementType::hex8i;
  if (uniform && !b.model.materials[element.material].elasticity) return true;
  if (element_kernel(element.type).nodal_ply == nullptr)
    return b.error(ErrorCode::unsupported, e,
                   "its layers are those of a pyramid or tetrahedron, expected a brick or a wedge");
  element.layup = layup;
  element.orientation = b.orientation(e.system, e.at, b.label(e));
  return e.system == 0 ||
         (element.orientation >= 0 &&
          axis_in_face(b, e, element, middle_face(b.model, element), "the normal of its layers"));
}

}  // namespace floatframe
