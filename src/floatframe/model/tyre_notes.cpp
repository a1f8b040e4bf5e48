// What is odd about a tyre that rolls at the start: a radius in mm, a wheel in the air or deep in
// the road, one that lies, one that does not turn as it travels.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/rolling_tyre_kind.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {
namespace {

/// The wheel at the start, in the plane of the road below it.
struct WheelAtStart {
  double height = 0.0;        ///< of the centre above the road below it [m]
  double speed = 0.0;         ///< of the centre, forwards for a positive spin [m/s]
  double spin = 0.0;          ///< about the axis of the tyre [rad/s]
  double radius = 0.0;        ///< effective [m]
  Vec3 axis = Vec3::UnitY();  ///< of the wheel, world axes
};

WheelAtStart wheel_at_start(const Element& element, const RollingTyre& keys, double radius,
                            const SystemMotion& start) {
  constexpr double upright = 0.5;  // the sine of the least angle of axis and normal
  const int marker = element.markers[0];
  const MarkerState& m = start.marker(marker);
  const Vec3 centre = start.place(marker);
  const SurfacePoint below = surface_at(start.model.roads[element.road], centre.x(), centre.y());
  const Vec3 normal = Vec3(-below.zx, -below.zy, 1.0).normalized();
  WheelAtStart w;
  w.axis = m.R * keys.axis;
  const Vec3 forwards = w.axis.cross(normal);
  if (forwards.norm() >= upright) w.speed = m.v.dot(forwards.normalized());
  w.spin = m.w.dot(w.axis);
  // In the air the results of the tyre are zero. Its length is the height above a plate, too.
  const Efforts& efforts = start.effort(&element - start.model.elements.data());
  const double effective = efforts.further[rolling::effective_radius];
  w.radius = effective > 0.0 ? effective : radius;
  w.height = efforts.length > 0.0 ? efforts.length : centre.z() - below.z;
  return w;
}

/// "radius of 295 m is unusual; it may be in mm"; empty: it may be that of a wheel.
std::string odd_radius(double radius) {
  constexpr double least = 5e-3, most = 5.0;  // of toys, and twice that of the largest tyres [m]
  if (radius >= least && radius <= most) return {};
  return fmt::format(
      "its radius of {:.4g} m is unusual; it may be {} (of a .tir file: LENGTH in [UNITS])", radius,
      radius > most ? "in mm" : "in m and was taken for mm");
}

/// An equilibrium lowers wheels that hang a little, and lifts those that are pressed in.
std::string odd_height(double height, double radius, bool equilibrium) {
  constexpr double deep = 0.2;   // relative to the radius
  constexpr double play = 5e-3;  // [m]
  constexpr double reach = 0.2;  // of a search for an equilibrium, relative to the radius
  const double gap = height - radius;
  if (std::isnan(gap)) return {};  // beyond the road
  if (gap >= -deep * radius && gap <= (equilibrium ? reach * radius : play)) return {};
  return fmt::format(
      "its wheel centre is {:.4g} m above the road and its radius is {:.4g} m, so that at the "
      "start {}",
      height, radius,
      gap > 0.0 ? fmt::format("the wheel hangs {:.4g} m in the air", gap)
                : fmt::format("the road presses {:.4g} m into it", -gap));
}

bool turns_alone(JointType type) {
  return joint_kind(type).coordinates.count() == 1 && joint_unit(type, 0) == JointUnit::rad;
}

/// The joint of one angle about the axis of the wheel, on which its body turns; its sense.
struct SpinJoint {
  const Joint* joint = nullptr;
  double rate = 0.0;   ///< at the start [rad/s]
  double sense = 1.0;  ///< of the spin of the tyre over it
};
SpinJoint spin_joint(const Element& element, const Vec3& axis, const SystemMotion& start) {
  constexpr double parallel = 0.9;
  const int body = start.model.markers[element.markers[0]].body;
  for (const Joint& j : start.model.joints) {
    if (!turns_alone(j.type) || (j.child != body && j.parent != body)) continue;
    const MarkerState &F = start.marker(j.frame_F), &M = start.marker(j.frame_M);
    const double along = F.R.col(2).dot(axis);
    if (std::abs(along) < parallel) continue;
    return {&j, (M.w - F.w).dot(F.R.col(2)), (along > 0.0) == (j.child == body) ? 1.0 : -1.0};
  }
  return {};
}

/// Of a wheel that moves: its contact slips by a large part of the speed. Empty: it rolls.
std::string odd_spin(const Element& element, const WheelAtStart& w, const SystemMotion& start) {
  constexpr double least_speed = 1.0;  // [m/s]
  constexpr double most_slip = 0.5;
  if (std::abs(w.speed) < least_speed) return {};
  const double slip = 1.0 - w.spin * w.radius / w.speed;
  if (std::abs(slip) <= most_slip) return {};
  const SpinJoint by = spin_joint(element, w.axis, start);
  const double missing = w.speed / w.radius - w.spin;
  return fmt::format(
      "at the start its wheel {}: the contact slips by {:.3g} % of the speed of {:.4g} m/s{}",
      w.spin * w.speed < 0.0 ? "turns backwards"
      : slip > 0.99          ? "does not turn"
                             : "does not roll",
      100.0 * std::abs(slip), std::abs(w.speed),
      by.joint == nullptr
          ? std::string()
          : fmt::format("; joint '{}' turns at {:.4g} rad/s, and it would roll with a velocity of "
                        "{:.4g} rad/s",
                        by.joint->name, by.rate, by.rate + by.sense * missing));
}

}  // namespace

void note_rolling_tyre(const Element& element, const RollingTyre& keys, double radius,
                       const SystemMotion& start, std::vector<std::string>& notes) {
  const auto note = [&](const std::string& text) {
    if (!text.empty()) notes.push_back(fmt::format("tyre '{}': {}", element.name, text));
  };
  if (const std::string text = odd_radius(radius); !text.empty()) return note(text);
  const WheelAtStart w = wheel_at_start(element, keys, radius, start);
  note(odd_height(w.height, radius, start.model.simulation.start == Start::equilibrium));
  if (keys.spinning) note(odd_spin(element, w, start));
  constexpr double lies = 0.5;  // the sine of the angle of axis and vertical
  if (const double sine = w.axis.head<2>().norm(); sine < lies)
    note(fmt::format("its wheel lies: the axis is {:.3g} deg from the vertical",
                     std::asin(std::min(1.0, sine)) * 180.0 / std::numbers::pi));
}

}  // namespace floatframe
