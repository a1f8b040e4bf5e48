#include "floatframe/fe/shell_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/fe/elasticity.hpp"

namespace floatframe {
namespace {

double weight_of_higher_strains(const Mat3& A) {
  const double product = A(0, 1) * A(0, 1) / (A(0, 0) * A(1, 1));
  return std::max(0.5 * (1.0 - 4.0 * product), 0.01);
}

/// (xz, yz) of a material.
Eigen::Matrix2d across_plane(const Material& m) {
  if (!m.elasticity) return m.shear() * Eigen::Matrix2d::Identity();
  const Mat6& D = *m.elasticity;
  Eigen::Matrix2d out;
  out << D(5, 5), D(5, 4), D(4, 5), D(4, 4);
  return out;
}

/// In axes relative to which those of `H` are rotated by an angle.
Eigen::Matrix2d turned_shear(const Eigen::Matrix2d& H, double angle) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return R * H * R.transpose();
}

bool is_stiff(const Eigen::Matrix2d& H) { return H(0, 0) > 0.0 && H.determinant() > 0.0; }

/// The mean over the thickness.
Eigen::Matrix2d mean_shear(const ShellSection& section, const Material& material,
                           const std::vector<Material>& materials) {
  if (section.plies.empty()) return across_plane(material);
  Eigen::Matrix2d out = Eigen::Matrix2d::Zero();
  for (const ShellPly& ply : section.plies) {
    const Eigen::Matrix2d H = across_plane(materials[ply.material]);
    if (!is_stiff(H)) return Eigen::Matrix2d::Zero();
    out += ply.thickness / section.thickness * turned_shear(H, ply.angle);
  }
  return out;
}

/// One material through the thickness, with separate ones for bending and coupling.
void homogeneous(const ShellSection& section, const Material& material,
                 const std::vector<Material>& materials, ShellLayers& out) {
  const double t = section.thickness;
  const Mat3 Q = plane_stress(material);
  const Mat3 bending = section.bending < 0 ? Q : plane_stress(materials[section.bending]);
  out.A = t * Q;
  out.D = section.bending_factor * t * t * t / 12.0 * bending;
  out.B = -t * t * section.coupling;
  out.mass = material.density * t;
  out.inertia = out.mass * t * t / 12.0;
  out.top = {Q, 0.5 * t * bending};
  out.bottom = {Q, -0.5 * t * bending};
}

void plies(const ShellSection& section, const std::vector<Material>& materials, ShellLayers& out) {
  double z = -0.5 * section.thickness;
  for (std::size_t k = 0; k < section.plies.size(); ++k) {
    const ShellPly& ply = section.plies[k];
    const Material& material = materials[ply.material];
    const Mat3 Q = turned_plane(plane_stress(material), ply.angle);
    const double t = ply.thickness, middle = z + 0.5 * t;
    const double second = t * (middle * middle + t * t / 12.0);
    out.A += t * Q;
    out.B += t * middle * Q;
    out.D += second * Q;
    out.mass += material.density * t;
    out.moment += material.density * t * middle;
    out.inertia += material.density * second;
    if (k == 0) out.bottom = {Q, z * Q};
    z += t;
    if (k + 1 == section.plies.size()) out.top = {Q, z * Q};
  }
  if (!section.smeared) return;
  const double t = section.thickness;
  out.B.setZero();
  out.D = t * t / 12.0 * out.A;
  out.moment = 0.0;
  out.inertia = out.mass * t * t / 12.0;
}

}  // namespace

bool is_plain(const ShellSection& section, const Material& material) {
  return section.plies.empty() && !material.elasticity && section.bending < 0 &&
         section.coupling.isZero(0.0) && section.bending_factor == 1.0;
}

ShellLayers plain_layers(const ShellSection& section, const Material& material) {
  ShellLayers out;
  homogeneous(section, material, {}, out);
  out.mass += section.mass;
  out.offset = section.offset;
  out.shear = section.shear * across_plane(material);
  out.beta_0 = std::max(0.5 * (1.0 - 4.0 * material.poisson * material.poisson), 0.01);
  out.directional = false;
  return out;
}

ShellLayers shell_layers(const ShellSection& section, const Material& material,
                         const std::vector<Material>& materials) {
  ShellLayers out;
  if (section.plies.empty()) {
    homogeneous(section, material, materials, out);
  } else {
    plies(section, materials, out);
  }
  out.mass += section.mass;
  out.offset = section.offset;
  out.beta_0 = weight_of_higher_strains(out.A);
  const Eigen::Matrix2d H = mean_shear(section, material, materials);
  if (is_stiff(H)) out.shear = section.shear * H;
  return out;
}

std::string section_error(const ShellSection& section, const std::vector<Material>& materials) {
  const auto missing = [&](int material) {
    return material < 0 || static_cast<std::size_t>(material) >= materials.size();
  };
  if (!std::isfinite(section.offset)) return "has an offset that is not finite";
  if (!(section.mass >= 0.0) || !std::isfinite(section.mass))
    return fmt::format("has a mass of {:g} over area, expected no negative number", section.mass);
  if (!(section.bending_factor > 0.0) || !std::isfinite(section.bending_factor))
    return fmt::format("has a bending factor of {:g}, expected more than 0",
                       section.bending_factor);
  if (section.bending >= 0 && missing(section.bending))
    return "names a material that does not exist";
  if (!section.coupling.allFinite()) return "has a coupling that is not finite";
  double sum = 0.0;
  for (std::size_t k = 0; k < section.plies.size(); ++k) {
    const ShellPly& ply = section.plies[k];
    if (missing(ply.material))
      return fmt::format("has no material {} for ply {}", ply.material, k + 1);
    if (!(ply.thickness > 0.0) || !std::isfinite(ply.thickness))
      return fmt::format("has ply {} of thickness {:g}, expected more than 0", k + 1,
                         ply.thickness);
    if (!std::isfinite(ply.angle)) return fmt::format("has ply {} at no finite angle", k + 1);
    sum += ply.thickness;
  }
  if (!section.plies.empty() && std::abs(sum - section.thickness) > 1e-9 * sum)
    return fmt::format("is {:g} thick, but its plies together {:g}", section.thickness, sum);
  return {};
}

ShellLayers turned_layers(const ShellLayers& layers, double angle) {
  ShellLayers out = layers;
  for (Mat3* m : {&out.A, &out.B, &out.D, &out.top.membrane, &out.top.bending, &out.bottom.membrane,
                  &out.bottom.bending})
    *m = turned_plane(*m, angle);
  out.shear = turned_shear(out.shear, angle);
  return out;
}

Vec3 shell_normal(std::span<const Vec3> corners) {
  const bool triangle = corners.size() == 3 || corners.size() == 6;
  const Vec3 first = corners[triangle ? 1 : 2] - corners[0];
  return first.cross(corners[triangle ? 2 : 3] - corners[triangle ? 0 : 1]).normalized();
}

Vec3 first_axis(std::span<const Vec3> corners, const Orientation* orientation, double angle) {
  const Vec3 n = shell_normal(corners);
  Vec3 axis = corners[1] - corners[0];
  if (orientation != nullptr) {
    const std::size_t count = corners.size() == 3 || corners.size() == 6 ? 3 : 4;
    Vec3 middle = Vec3::Zero();
    for (std::size_t k = 0; k < count; ++k) middle += corners[k] / static_cast<double>(count);
    axis = orientation->at(middle).col(0);
  }
  const Vec3 along = axis - n * n.dot(axis);
  if (!(along.norm() > 1e-6 * axis.norm())) return Vec3::Zero();
  const Vec3 x = along.normalized();
  return std::cos(angle) * x + std::sin(angle) * n.cross(x);
}

}  // namespace floatframe
