// Beads on curves against closed forms, in both formulations: a hoop (a pendulum), a helix, a
// closed spline, and a curve that a body carries.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

RunResult bead_in(const std::string& text, Coordinates c) {
  ModelDescription d = description_of(text);
  d.simulation.coordinates = c;
  return completed_run(d);
}

// On a vertical hoop of 0.5 m, from the height of its centre: the normal force is
// m g cos + m v^2 / R, with v^2 = 2 g h.
TEST(PointOnCurve, OfAHoopIsAPendulum) {
  for (const Coordinates c : both_coordinates) {
    const RunResult r = bead_in(R"(
bodies: {bead: {position: [0.5, 0, 0], rigid: {mass: 2, inertia: [0.01, 0.01, 0.01]}}}
constraints:
  hoop:
    type: point_on_curve
    from: {body: ground, at: [0, 0, 0]}
    to: {body: bead}
    x: 0.5 * cos(u)
    z: 0.5 * sin(u)
    range: [0, 6.283185307179586]
    closed: true
outputs:
  p: {position: bead}
  v: {velocity: bead}
  F: {joint_force: {constraint: hoop}}
simulation: {step: 5.0e-4, duration: 1}
)",
                                c);
    double lowest = 0.0;
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      const Vec3 p(r.table.at(k, 1), r.table.at(k, 2), r.table.at(k, 3));
      const Vec3 v(r.table.at(k, 4), r.table.at(k, 5), r.table.at(k, 6));
      const Vec3 F(r.table.at(k, 7), r.table.at(k, 8), r.table.at(k, 9));
      EXPECT_NEAR(p.norm(), 0.5, 1e-9);
      EXPECT_NEAR(0.5 * v.squaredNorm() + 9.81 * p.z(), 0.0, 1e-4);
      const double normal = 2.0 * (v.squaredNorm() / 0.5 - 9.81 * p.z() / 0.5);
      EXPECT_LT((F + normal * p / 0.5).norm(), 1e-6 * (1.0 + normal));
      lowest = std::min(lowest, p.z());
    }
    EXPECT_NEAR(lowest, -0.5, 1e-4);
  }
}

// Down a helix of the radius R and the slope p per radian: u'' = g p / (R^2 + p^2); the force is
// m (a - g) with the acceleration of u(t).
TEST(PointOnCurve, OfAHelixSlidesAsOnAnIncline) {
  const double R = 0.3, p = 0.1, g = 9.81, turn = g * p / (R * R + p * p);
  for (const Coordinates c : both_coordinates) {
    const RunResult r = bead_in(R"(
bodies: {bead: {position: [0.3, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}}
constraints:
  helix:
    type: point_on_curve
    from: {body: ground, at: [0, 0, 0]}
    to: {body: bead}
    x: 0.3 * cos(u)
    y: 0.3 * sin(u)
    z: -0.1 * u
    range: [-1, 15]
outputs:
  p: {position: bead}
  F: {joint_force: {constraint: helix}}
simulation: {step: 2.0e-4, duration: 1}
)",
                                c);
    for (std::size_t k = 0; k < r.table.rows(); k += 250) {
      const double t = r.table.at(k, 0), u = 0.5 * turn * t * t, w = turn * t;
      const Vec3 radial(std::cos(u), std::sin(u), 0.0), along(-std::sin(u), std::cos(u), 0.0);
      const Vec3 at = R * radial - p * u * Vec3::UnitZ();
      const Vec3 a = -R * w * w * radial + R * turn * along - p * turn * Vec3::UnitZ();
      const Vec3 found(r.table.at(k, 1), r.table.at(k, 2), r.table.at(k, 3));
      const Vec3 F(r.table.at(k, 4), r.table.at(k, 5), r.table.at(k, 6));
      EXPECT_LT((found - at).norm(), 3e-5) << k;
      EXPECT_LT((F - a - g * Vec3::UnitZ()).norm(), 3e-3 * (1.0 + a.norm())) << k;
      EXPECT_NEAR(std::hypot(found.x(), found.y()), R, 1e-8);
    }
  }
}

// A closed spline through 60 points of a circle, on a plate that turns at a constant speed without
// gravity: the bead keeps its energy on the plate, w r^2 with it.
TEST(PointOnCurve, OfAClosedSplineOnABodyThatMoves) {
  std::string points;
  for (int k = 0; k < 60; ++k) {
    const double u = 2.0 * std::numbers::pi * k / 60;
    points += fmt::format("{}[{:.15g}, {:.15g}, 0]", k > 0 ? ", " : "", 0.4 * std::cos(u),
                          0.4 * std::sin(u));
  }
  for (const Coordinates c : both_coordinates) {
    const RunResult r = bead_in(R"(
gravity: [0, 0, 0]
bodies:
  plate: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
  bead: {position: [0.4, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.01]}}
joints:
  plate: {type: revolute, child: plate, at: [0, 0, 0], axis: z, motion: {velocity: 3}}
  bead: {type: free, child: bead, velocity: [0, -0.8, 0, 0, 0, 0]}
constraints:
  groove:
    type: point_on_curve
    from: {body: plate, at: [0, 0, 0]}
    to: {body: bead}
    closed: true
    points: [)" + points + R"(]
outputs:
  p: {position: bead}
  v: {velocity: bead}
simulation: {step: 1.0e-3, duration: 4}
)",
                                c);
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      EXPECT_NEAR(std::hypot(r.table.at(k, 1), r.table.at(k, 2)), 0.4, 1e-6);
      EXPECT_NEAR(std::hypot(r.table.at(k, 4), r.table.at(k, 5)), 0.8, 1e-3);
      EXPECT_NEAR(r.table.at(k, 3), 0.0, 1e-10);
    }
    // More than a turn the other way round than the plate.
    EXPECT_GT(0.8 * 4.0 / 0.4, 2.0 * std::numbers::pi);
  }
}

}  // namespace
}  // namespace floatframe::test
