// A puck on an inclined plane, thrown and spinning: its motion is known in closed form.
#include <gtest/gtest.h>

#include "floatframe/model/model.hpp"
#include "support/completed_run.hpp"
#include "support/descriptions.hpp"

namespace floatframe::test {
namespace {

ModelDescription puck(bool reversed) {
  ModelDescription d;
  d.name = "puck";
  d.gravity = Vec3(0.0, 0.0, -9.81);
  const Mat3 J = Vec3(0.03, 0.03, 0.05).asDiagonal();
  // The plane is a body that is welded to the ground, so that the joint can be met from either
  // side.
  for (const char* name : {"table", "puck"})
    d.bodies.push_back(make_body(name, RigidDescription{1.7, Vec3::Zero(), J}));
  JointDescription plane =
      make_joint("plane", JointType::planar, "table", "puck", Vec3::Zero(), Vec3(0.2, -0.1, 1.0));
  plane.axis_2 = Vec3(1.0, 0.3, 0.4);
  plane.position = {0.1, -0.2, 0.4};
  plane.velocity = {0.5, 0.3, 2.0};
  d.joints = {make_joint("weld", JointType::weld, "ground", reversed ? "puck" : "table"), plane};
  for (int k = 0; k < 3; ++k) {
    const std::string number = std::to_string(k);
    d.outputs.push_back(make_output("q" + number, OutputType::joint_position, "plane", k));
    d.outputs.push_back(make_output("v" + number, OutputType::joint_velocity, "plane", k));
  }
  d.simulation.step = 1e-3;
  d.simulation.duration = 0.5;
  return d;
}

TEST(PlanarJoint, PuckOnAnInclinedPlane) {
  for (const Coordinates coordinates : both_coordinates) {
    ModelDescription d = puck(false);
    d.simulation.coordinates = coordinates;
    const Model m = build_model(d);
    EXPECT_EQ(m.outputs[0].unit + " " + m.outputs[1].unit + " " + m.outputs[4].unit, "m m/s rad");
    const RunResult r = completed_run(m, m.simulation);
    const Vec3 z = d.joints[1].axis.normalized();
    const Vec3 e1 = (d.joints[1].axis_2 - z.dot(d.joints[1].axis_2) * z).normalized();
    const Vec3 e2 = z.cross(e1);
    const double t = 0.5, g[] = {e1.dot(d.gravity), e2.dot(d.gravity), 0.0};
    const std::size_t last = r.table.rows() - 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double q0 = d.joints[1].position[k], v0 = d.joints[1].velocity[k];
      // Axes of a body that turns at v turn by 2 atan(v h/2) in a step: v^3 h^2 t/12 less in all.
      const double h = d.simulation.step, turn = k == 2 ? 1.1 * v0 * v0 * v0 * h * h * t / 12.0 : 0;
      EXPECT_NEAR(r.table.at(last, 1 + 2 * k), q0 + v0 * t + 0.5 * g[k] * t * t, 1e-8 + turn) << k;
      EXPECT_NEAR(r.table.at(last, 2 + 2 * k), v0 + g[k] * t, 1e-8) << k;
    }
  }
}

// The puck held, the table hangs from it: the joint is met from its child, and both agree.
TEST(PlanarJoint, MetFromTheChild) {
  RunResult results[2];
  for (int k = 0; k < 2; ++k) {
    ModelDescription d = puck(true);
    d.simulation.coordinates = both_coordinates[k];
    results[k] = completed_run(d);
  }
  const std::size_t last = results[0].table.rows() - 1;
  for (std::size_t c = 1; c <= 6; ++c) {
    EXPECT_NEAR(results[0].table.at(0, c), results[1].table.at(0, c), 1e-12);
    EXPECT_NEAR(results[0].table.at(last, c), results[1].table.at(last, c), 1e-4);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(results[0].table.at(0, 1 + 2 * k), (std::vector{0.1, -0.2, 0.4})[k], 1e-12);
    EXPECT_NEAR(results[0].table.at(0, 2 + 2 * k), (std::vector{0.5, 0.3, 2.0})[k], 1e-12);
  }
}

}  // namespace
}  // namespace floatframe::test
