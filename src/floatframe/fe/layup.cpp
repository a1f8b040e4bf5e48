#include "floatframe/fe/layup.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "floatframe/fe/elasticity.hpp"

namespace floatframe {

std::vector<LayupPly> layup_plies(const Layup& layup, const std::vector<Material>& materials) {
  double thickness = 0.0;
  for (const ShellPly& ply : layup.plies) thickness += ply.thickness;
  std::vector<LayupPly> out;
  out.reserve(layup.plies.size());
  double below = 0.0;
  for (const ShellPly& ply : layup.plies) {
    const Material& m = materials[ply.material];
    const double bottom = -1.0 + 2.0 * below / thickness;
    below += ply.thickness;
    out.push_back({bottom, -1.0 + 2.0 * below / thickness, elasticity_matrix(m),
                   m.elasticity.has_value(), ply.angle, m.density});
  }
  return out;
}

Vec3 layer_axis(const Mat3& J, const Orientation* orientation, const Vec3& p) {
  const Vec3 n = J.col(0).cross(J.col(1)).normalized();
  const Vec3 axis = orientation != nullptr ? Vec3(orientation->at(p).col(0)) : Vec3(J.col(0));
  const Vec3 along = axis - n * n.dot(axis);
  if (!(along.norm() > 1e-6 * axis.norm())) return Vec3::Zero();
  return along.normalized();
}

Mat6 ply_elasticity(const LayupPly& ply, const Mat3& J, const Orientation* orientation,
                    const Vec3& p) {
  if (!ply.directional) return ply.D;
  const Vec3 n = J.col(0).cross(J.col(1)).normalized();
  const Vec3 x = layer_axis(J, orientation, p), y = n.cross(x);
  const double c = std::cos(ply.angle), s = std::sin(ply.angle);
  Mat3 R;
  R << c * x + s * y, c * y - s * x, n;
  return turned_elasticity(ply.D, R);
}

int ply_at(const std::vector<LayupPly>& plies, double t) {
  int k = 0;
  while (k + 1 < static_cast<int>(plies.size()) && plies[k].top < t - 1e-9) ++k;
  return k;
}

std::string layup_error(const Layup& layup, const std::vector<Material>& materials) {
  if (layup.plies.empty()) return "has no ply";
  for (std::size_t k = 0; k < layup.plies.size(); ++k) {
    const ShellPly& ply = layup.plies[k];
    if (ply.material < 0 || static_cast<std::size_t>(ply.material) >= materials.size())
      return fmt::format("has no material {} for ply {}", ply.material, k + 1);
    if (materials[ply.material].plane)
      return fmt::format("has ply {} of a material of plane stress, which is for shells only",
                         k + 1);
    if (!(ply.thickness > 0.0) || !std::isfinite(ply.thickness))
      return fmt::format("has ply {} of thickness {:g}, expected more than 0", k + 1,
                         ply.thickness);
    if (!std::isfinite(ply.angle)) return fmt::format("has ply {} at no finite angle", k + 1);
  }
  return {};
}

}  // namespace floatframe
