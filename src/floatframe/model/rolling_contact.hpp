#pragma once
// Where a wheel touches a road, over any scalar. With the wheel centre C, the unit axis a of the
// wheel to the left, and the surface z(x, y) with its normal n = (-z_x, -z_y, 1)/|.|:
//   below C      n_0, and the tangent plane there, at the distance d_0 along n_0
//   trial        e_x0 = a x n_0/|.|, e_z0 = e_x0 x a, P_0 = C - d_0/(e_z0.n_0) e_z0
//   at P_0       n, exact, and its plane; with contact over a patch the plane through the mean of
//                four points of the surface, half a length and half a width from P_0 along e_x0 and
//                n_0 x e_x0, with the directions of their diagonals
//   frame        e_x = a x n/|a x n|, e_y = n x e_x, e_z = e_x x a in the plane of the wheel; ISO-W
//   radius       r_l = d/(e_z.n), d the distance of C from that plane; e_z.n = |a x n|
//   contact      P = C - r_l e_z; camber gamma = atan2(a.n, |a x n|), the top to the right
// On a plane this is exact; elsewhere the trial point is near P, with an error of the second order
// in the distance along which the normal turns. Motion, with w_c = w - (w.a) a:
//   V_m = v_C + w_c x (P - C) - v_plate,  ddot = -n.V_m/(e_z.n)  (rate of the deflection R - r_l)
//   V_c = V_m + ddot e_z, V_cx = V_c.e_x, V_cy = V_c.e_y         (along the road: V_c.n = 0)
//   spin Omega = w.a
// A road of pieces (model/road.hpp) is that of the held branch, or of the piece under C.
#include <cmath>
#include <utility>

#include "floatframe/description/tyre_elements.hpp"
#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/road.hpp"

namespace floatframe {

template <class S>
struct RollingContact {
  using V = Eigen::Matrix<S, 3, 1>;
  bool found = false;  ///< false: the wheel lies flat; then only what is above the frame is known
  double x = 0.0;      ///< of the centre [m]
  S height, height_rate;  ///< of the centre above the road below it [m], [m/s]
  V axis, e_x, e_y, e_z, n;
  V arm, point;             ///< from the centre to the contact point [m]; that point, world
  S loaded_radius, camber;  ///< [m], [rad]
  S sinking;                ///< rate of the deflection [m/s]
  S v_cx, v_cy, spin;       ///< [m/s], [rad/s]
  double friction = 1.0;    ///< factor of the surface
};

/// The branch of a rolling tyre: the piece of its road under the centre, and whether it touches.
struct RollingBranch {
  std::int64_t held;
  static std::int64_t of(std::size_t stretch, bool touches) noexcept {
    return std::int64_t{2} * static_cast<std::int64_t>(stretch) + (touches ? 1 : 0);
  }
  std::size_t stretch() const noexcept { return static_cast<std::size_t>(held / 2); }
  bool touches() const noexcept { return held % 2 != 0; }
};

/// What a road looks like from one wheel.
struct RoadUnderWheel {
  const Road& road;
  bool pieces;  ///< one of them alone counts
  std::size_t stretch;
  RoadUnderWheel(const Road& of, TyreContact contact, std::int64_t branch, double x) noexcept
      : road(of),
        pieces(contact == TyreContact::point && !of.pieces.edges().empty()),
        stretch(!pieces                 ? 0
                : branch == free_branch ? of.pieces.stretch_index(x)
                                        : RollingBranch{branch}.stretch()) {}
  SurfacePoint operator()(double x, double y) const noexcept {
    if (!pieces) return surface_at(road, x, y);
    const RoadPoint p = road_at(road, stretch, x);
    SurfacePoint s;
    s.z = p.z;
    s.zx = p.slope;
    s.zxx = p.curvature;
    return s;
  }
};

/// Height and unit normal of a surface at (x, y), with derivatives through its second ones.
template <class S>
struct SurfaceAt {
  S z;
  Eigen::Matrix<S, 3, 1> n;
  SurfaceAt(const SurfacePoint& p, const S& x, const S& y) noexcept
      : z(chained(p.z, p.zx, x, p.zy, y)),
        n(S(-chained(p.zx, p.zxx, x, p.zxy, y)), S(-chained(p.zy, p.zxy, x, p.zyy, y)), S(1.0)) {
    n /= S(n.norm());
  }
};

/// A plane by a point and its normal.
template <class S>
struct RoadPlane {
  Eigen::Matrix<S, 3, 1> at, n;
};

/// Through the mean of four points around `trial`, along unit directions in the road.
template <class S>
RoadPlane<S> plane_of_patch(const RoadUnderWheel& road, const Eigen::Matrix<S, 3, 1>& trial,
                            const Eigen::Matrix<S, 3, 1>& along,
                            const Eigen::Matrix<S, 3, 1>& across, double half_length,
                            double half_width) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  const auto on_road = [&](const V& shift) noexcept -> V {
    V q = trial + shift;
    const SurfacePoint p = road(value_of(q.x()), value_of(q.y()));
    q.z() = chained(p.z, p.zx, q.x(), p.zy, q.y());
    return q;
  };
  const V front = on_road(S(half_length) * along), rear = on_road(S(-half_length) * along),
          left = on_road(S(half_width) * across), right = on_road(S(-half_width) * across);
  V n = (front - rear).cross(V(left - right));
  n /= S(n.norm());
  return {S(0.25) * (front + rear + left + right), n};
}

/// How a wheel stands on its road. `radius`: unloaded, of the default patch [m]; `plate`: height and
/// rate of a plate; `of_centre`: the slip velocity is that of the wheel centre.
template <class S>
RollingContact<S> rolling_contact(const PortsOf<S>& in, const RollingTyre& keys, double radius,
                                  const SignalValue<S>& plate, bool of_centre = false) noexcept {
  using V = Eigen::Matrix<S, 3, 1>;
  using std::atan2;
  // The sine of the angle between axis and normal below which a wheel lies.
  constexpr double flat = 1e-3;
  const auto& marker = in.marker(0);
  RollingContact<S> c;
  V centre = marker.r + in.origin.template cast<S>();
  centre.z() -= plate.f;  // the plate in the place of the road
  V v = marker.v;
  v.z() -= plate.df;
  c.x = value_of(centre.x());
  c.axis = marker.R * keys.axis.template cast<S>();
  const RoadUnderWheel road(in.model.roads[in.element.road], keys.contact, in.branch, c.x);
  const SurfacePoint below = road(c.x, value_of(centre.y()));
  const SurfaceAt<S> under(below, centre.x(), centre.y());
  c.height = centre.z() - under.z;
  c.height_rate = v.z() + (under.n.x() * v.x() + under.n.y() * v.y()) / under.n.z();
  V along = c.axis.cross(under.n);
  S upright = along.norm();
  if (!(value_of(upright) > flat)) return c;
  along /= upright;
  const V trial = centre - S(c.height * under.n.z() / upright) * along.cross(c.axis);
  RoadPlane<S> plane;
  const SurfacePoint there = road(value_of(trial.x()), value_of(trial.y()));
  c.friction = there.friction;
  if (keys.contact == TyreContact::patch) {
    plane = plane_of_patch(road, trial, along, V(under.n.cross(along)),
                           0.5 * keys.patch_length.value_or(0.2 * radius),
                           0.5 * keys.patch_width.value_or(0.3 * radius));
  } else {
    const SurfaceAt<S> exact(there, trial.x(), trial.y());
    plane = {V(trial.x(), trial.y(), exact.z), exact.n};
  }
  c.n = plane.n;
  c.e_x = c.axis.cross(c.n);
  upright = c.e_x.norm();
  if (!(value_of(upright) > flat)) return c;
  c.found = true;
  c.e_x /= upright;
  c.e_y = c.n.cross(c.e_x);
  c.e_z = c.e_x.cross(c.axis);
  c.loaded_radius = c.n.dot(V(centre - plane.at)) / upright;
  c.camber = atan2(S(c.axis.dot(c.n)), upright);
  c.arm = -c.loaded_radius * c.e_z;
  c.point = centre + c.arm;
  c.point.z() += plate.f;
  c.spin = marker.w.dot(c.axis);
  const V carried = marker.w - c.spin * c.axis;
  V moving = v + carried.cross(c.arm);
  c.sinking = -c.n.dot(moving) / upright;
  if (of_centre)
    moving = v;
  else
    moving += c.sinking * c.e_z;
  c.v_cx = moving.dot(c.e_x);
  c.v_cy = moving.dot(c.e_y);
  return c;
}

}  // namespace floatframe
