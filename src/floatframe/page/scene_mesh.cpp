#include "floatframe/page/scene_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/body/surface_mesh.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

SceneMesh scene_mesh(const FlexibleBody& body) {
  const SurfaceMesh surface = surface_mesh(body);
  SceneMesh mesh;
  if (surface.triangles.empty()) return mesh;
  mesh.generated = !surface.bar_ends.empty();
  const auto append = [](std::vector<float>& out, const Vec3& p) {
    for (const double x : p) out.push_back(static_cast<float>(x));
  };
  for (Eigen::Index v = 0; v < surface.positions.cols(); ++v) {
    append(mesh.vertices, surface.positions.col(v));
    for (Eigen::Index m = 0; m < surface.modes.cols(); ++m)
      append(mesh.displacements, surface.modes.block<3, 1>(3 * v, m));
  }
  mesh.nodes.assign(surface.nodes.begin(), surface.nodes.end());
  for (const auto& t : surface.triangles)
    for (const int v : t) mesh.triangles.push_back(static_cast<std::uint32_t>(v));
  return mesh;
}

Vec3 scene_up(const Model& model) {
  Vec3 out = Vec3::UnitZ();
  Eigen::Index k = 2;
  if (model.gravity.cwiseAbs().maxCoeff(&k) > 0.0)
    out = Vec3::Unit(k) * (model.gravity[k] > 0.0 ? -1.0 : 1.0);
  return out;
}

SceneExtent scene_extent(const Model& model) {
  SceneExtent out;
  Eigen::AlignedBox3d box;
  for (const Body& b : model.bodies) {
    out.mass += b.data->invariants.m;
    box.extend(b.X_WB.p);
  }
  for (const Marker& m : model.markers)
    if (m.body >= 0) {
      const Body& body = model.bodies[m.body];
      const Vec3 p = m.node < 0 ? m.X_NM.p : Vec3(body.data->nodes[m.node].p + m.X_NM.p);
      box.extend(body.X_WB * p);
    }
  if (!box.isEmpty()) out.reach = box.diagonal().norm();
  return out;
}

namespace {

/// Second moments int x^2 dm / m of the body along its principal axes, the pair that is equal
/// first: true if there is one.
bool order_round(Mat3& axes, Vec3& moments) {
  constexpr double equal = 1e-3;  // relative to the largest
  const double largest = moments.maxCoeff();
  const auto same = [&](int i, int j) {
    return std::abs(moments[i] - moments[j]) <= equal * largest;
  };
  const bool low = same(0, 1), high = same(1, 2);  // ascending
  if (low == high) return false;                   // none, or all three: a cube
  if (high) {
    axes.col(0).swap(axes.col(2));
    std::swap(moments[0], moments[2]);
  }
  return true;
}

/// Within the points of the body, or of the model where those of the body are at its centre.
void bound_by_points(SceneBox& box, const std::vector<Vec3>& points, double reach) {
  double far = 0.0, along = 0.0, across = 0.0;
  for (const Vec3& p : points) {
    const Vec3 r = box.axes.transpose() * (p - box.position);
    far = std::max(far, 2.0 * r.norm());
    along = std::max(along, 2.0 * std::abs(r.z()));
    across = std::max(across, 2.0 * r.head<2>().norm());
  }
  const double nothing = 1e-6 * std::max(reach, box.size.maxCoeff());
  const auto bound = [&](double points_reach, double size) {
    const double most = points_reach > nothing ? points_reach : reach;
    return most > nothing ? std::min(size, most) : size;
  };
  if (box.round) {
    // Points on its axis say nothing of the diameter of a disc.
    box.size.head<2>().setConstant(bound(across, box.size[0]));
    box.size[2] = bound(along, box.size[2]);
  } else if (const double largest = box.size.maxCoeff(); largest > 0.0) {
    box.size *= bound(far, largest) / largest;
  }
}

}  // namespace

SceneBox scene_box(const FlexibleBody& body, const std::vector<Vec3>& points,
                   const SceneExtent& extent) {
  constexpr double light = 1e-2, nothing = 1e-6;  // of the mass of all bodies
  constexpr double thinnest = 10.0;               // [kg/m3]; foams have more
  const InertiaInvariants& v = body.invariants;
  SceneBox box;
  const auto thicken = [&] {  // one without extent is a thin plate, a thin rod or a small cube
    const double largest = box.size.maxCoeff();
    box.size = box.size.cwiseMax(largest > 0.0        ? 0.05 * largest
                                 : extent.reach > 0.0 ? 0.04 * extent.reach
                                                      : 0.05);
  };
  if (v.m > 0.0) {
    box.position = v.m_u / v.m;
    const SymmetricEigen axes = symmetric_eigen(v.P_u - v.m_u * v.m_u.transpose() / v.m);
    if (axes.found) {
      box.axes = axes.vectors;
      Vec3 moments = axes.values.cwiseMax(0.0) / v.m;
      box.round = order_round(box.axes, moments);
      if (box.axes.determinant() < 0.0) box.axes.col(2) *= -1.0;
      // Along an axis of a box int x^2 dm = m a^2 / 12, across that of a cylinder m d^2 / 16.
      box.size = (12.0 * moments).cwiseSqrt();
      if (box.round)
        box.size.head<2>().setConstant(2.0 * std::sqrt(2.0 * (moments[0] + moments[1])));
    }
    thicken();
    box.dummy = v.m <= nothing * extent.mass ||
                (v.m <= light * extent.mass && v.m < thinnest * box.size.prod());
    bound_by_points(box, points, extent.reach);
  } else {
    box.dummy = true;
    Eigen::AlignedBox3d about;
    for (const Vec3& p : points) about.extend(p);
    if (!about.isEmpty()) {
      box.position = about.center();
      box.size = about.sizes();
    }
  }
  thicken();
  return box;
}

}  // namespace floatframe
