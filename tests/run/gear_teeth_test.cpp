// Gears with a pressure angle: the force of the teeth at the pitch point and the reactions of
// bearings and housing by balance, and wheels in a housing that moves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/start/statics.hpp"
#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

struct Mesh {
  double ratio = 2.5;
  bool internal = false, cut = false;
  double pressure = 0.35, helix = 0.0;
  double torque = 10.0;    ///< on the driver
  const char* axis = "z";  ///< of the driven wheel
  const char* flank = "forward";
  Vec3 driven = Vec3(0.3, 0.0, 0.0);
};

/// A driver at the origin with a torque, a driven wheel that is held, both in a housing on a weld.
StaticsResult statics_of(const Mesh& m) {
  const std::string at = fmt::format("[{}, {}, {}]", m.driven.x(), m.driven.y(), m.driven.z());
  return statics(model_of(fmt::format(R"(
gravity: [0, 0, 0]
bodies:
  housing: {{position: [0, 0, 0], rigid: {{mass: 5, inertia: [0.1, 0.1, 0.1]}}}}
  pinion: {{position: [0, 0, 0], rigid: {{mass: 1, inertia: [0.01, 0.01, 0.02]}}}}
  wheel: {{position: {0}, rigid: {{mass: 3, inertia: [0.03, 0.03, 0.05]}}}}
joints:
  foot: {{type: weld, child: housing, at: [0, 0, 0]}}
  a: {{type: revolute, parent: housing, child: pinion, at: [0, 0, 0], axis: z}}
  b: {{type: revolute, parent: housing, child: wheel, at: {0}, axis: {1}, motion: 0{2}}}
forces: {{motor: {{type: torque, body: pinion, direction: z, magnitude: {3}}}}}
couplings:
  mesh: {{type: gear, driver: a, driven: b, ratio: {4}, internal: {5}, pressure_angle: {6},
         helix_angle: {7}, flank: {8}}}
outputs: {{a: {{joint_position: a}}}}
simulation: {{step: 1.0e-3, duration: 1}}
)",
                                      at, m.axis, m.cut ? ", cut: true" : "", m.torque, m.ratio,
                                      m.internal, m.pressure, m.helix, m.flank)));
}

/// By the forces along the tangent, the line of centres and the axis that gears are drawn with.
void expect_balance(const Mesh& m) {
  const StaticsResult s = statics_of(m);
  const Vec3 z = Vec3::UnitZ(), across(m.driven.x(), m.driven.y(), 0.0);
  const double a = across.norm();
  const double r_1 = m.internal ? a / std::abs(m.ratio - 1.0) : a / (1.0 + m.ratio);
  const bool pinion_inside = m.internal && m.ratio > 1.0;
  const Vec3 u = across / a * (pinion_inside ? -1.0 : 1.0);
  // The force on the driver: against its torque, towards its centre, of a ring away from it.
  const double tangential = m.torque / r_1;
  const double apart = std::abs(tangential) * std::tan(m.pressure) / std::cos(m.helix);
  const bool ring = m.internal && m.ratio < 1.0;
  const Vec3 force =
      -tangential * z.cross(u) + (ring ? apart : -apart) * u + tangential * std::tan(m.helix) * z;
  const Vec3 M_2 = m.driven, P = (m.internal ? 1.0 / (1.0 - m.ratio) : 1.0 / (1.0 + m.ratio)) * M_2;
  EXPECT_NEAR((Vec3(P.x(), P.y(), 0.0) - r_1 * u).norm(), 0.0, 1e-12);
  ASSERT_EQ(s.forces.size(), 3u);
  EXPECT_NEAR(s.forces[1].force, -m.torque, 1e-9);  // on the driver
  const double size = 1.0 + force.norm();
  EXPECT_LT((s.joints[1].force + force).norm(), 1e-9 * size);
  EXPECT_LT((s.joints[1].torque + P.cross(force) + m.torque * z).norm(), 1e-9 * size);
  EXPECT_LT((s.joints[2].force - force).norm(), 1e-9 * size);
  EXPECT_LT((s.joints[2].torque - (P - M_2).cross(force)).norm(), 1e-9 * size);
  // The housing carries both bearings, and the foot what acts from outside.
  EXPECT_LT(s.joints[0].force.norm(), 1e-9 * size);
  EXPECT_LT((s.joints[0].torque + m.torque * z).norm(), 1e-9 * size);
}

TEST(GearTeeth, BearingsAndHousingAreInBalance) {
  for (const bool cut : {false, true}) {
    expect_balance({.cut = cut});
    expect_balance({.cut = cut, .helix = 0.3});
    expect_balance({.ratio = 0.4, .cut = cut, .helix = -0.2, .axis = "-z"});
    expect_balance({.cut = cut, .helix = 0.3, .torque = -7.0, .flank = "backward"});
    expect_balance({.cut = cut, .helix = 0.3, .driven = Vec3(0.2, -0.15, 0.04)});
    expect_balance({.ratio = 4.0, .internal = true, .cut = cut, .helix = 0.1});
    expect_balance({.ratio = 0.25, .internal = true, .cut = cut, .helix = 0.1, .torque = 3.0});
  }
}

// Without a pressure angle the bearings carry nothing, and the torques are those of the housing.
TEST(GearTeeth, WithoutThemThereAreTorquesAlone) {
  const StaticsResult s = statics(model_of(R"(
gravity: [0, 0, 0]
bodies:
  pinion: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  wheel: {position: [0.3, 0, 0], rigid: {mass: 3, inertia: [0.03, 0.03, 0.05]}}
joints:
  a: {type: revolute, child: pinion, at: [0, 0, 0], axis: z}
  b: {type: revolute, child: wheel, at: [0.3, 0, 0], axis: z, motion: 0}
forces: {motor: {type: torque, body: pinion, direction: z, magnitude: 10}}
couplings: {mesh: {type: gear, driver: a, driven: b, ratio: 2.5}}
outputs: {a: {joint_position: a}}
simulation: {step: 1.0e-3, duration: 1}
)"));
  EXPECT_NEAR(s.forces[1].force, -10.0, 1e-9);
  EXPECT_LT(s.joints[0].force.norm() + s.joints[1].force.norm(), 1e-9);
  EXPECT_NEAR(s.joints[0].torque.z(), -10.0, 1e-9);
}

// Helical wheels on a carrier that turns and is accelerated: both formulations agree to the second
// order of the step, and the mesh neither takes nor gives energy.
TEST(GearTeeth, TurnWithTheirHousing) {
  ModelDescription d = description_of(R"(
bodies:
  carrier: {position: [0.1, 0, 0], rigid: {mass: 4, inertia: [0.2, 0.3, 0.4]}}
  pinion: {position: [0.2, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  wheel: {position: [0.5, 0, 0.05], rigid: {mass: 3, inertia: [0.03, 0.03, 0.05]}}
joints:
  carrier: {type: revolute, child: carrier, at: [0, 0, 0], axis: x, velocity: 3}
  a: {type: revolute, parent: carrier, child: pinion, at: [0.2, 0, 0], axis: z, velocity: 10}
  b: {type: revolute, parent: carrier, child: wheel, at: [0.5, 0, 0.05], axis: z}
forces: {motor: {type: torque, body: pinion, direction: z, magnitude: 0.5, follows: true}}
couplings:
  mesh: {type: gear, driver: a, driven: b, teeth: [20, 40], pressure_angle: 0.35, helix_angle: 0.3}
outputs:
  carrier: {joint_position: carrier}
  a: {joint_position: a}
  b: {joint_position: b}
  mesh: {coupling_force: mesh}
  a.x: {joint_force: a, axis: x}
  a.Mx: {joint_torque: a, axis: x}
  b.x: {joint_force: b, axis: x}
  b.z: {joint_force: b, axis: z}
simulation: {step: 1.0e-3, duration: 0.4, output_interval: 0.1, tolerance: 1.0e-12}
)");
  double before = 0.0;
  for (const double step : {2e-3, 1e-3}) {
    d.simulation.step = step;
    d.simulation.coordinates = Coordinates::relative;
    const RunResult a = completed_run(d);
    d.simulation.coordinates = Coordinates::absolute;
    const RunResult b = completed_run(d);
    double difference = 0.0;
    for (std::size_t k = 0; k < a.table.data.size(); ++k)
      difference = std::max(difference, std::abs(a.table.data[k] - b.table.data[k]));
    for (const RunResult* r : {&a, &b}) {
      const std::size_t end = r->table.rows() - 1;
      EXPECT_NEAR(r->table.at(end, 2) + 2.0 * r->table.at(end, 3), 0.0, 1e-8);
      EXPECT_LT(std::abs(r->summary.energy.remainder), 1e-2);
    }
    std::printf("[ figure ] gear teeth, step %g: difference of the formulations %.3g\n", step,
                difference);
    if (before > 0.0) {
      EXPECT_NEAR(before / difference, 4.0, 1.2);
    }
    before = difference;
  }
}

}  // namespace
}  // namespace floatframe::test
