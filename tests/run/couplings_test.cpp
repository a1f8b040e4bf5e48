// Sums of coordinates that couplings hold: gears, screws, racks and differentials against closed
// forms, over many turns, in both formulations.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// Relative error of an angle after an acceleration: absolute coordinates step along chords.
double error_of_turning(Coordinates c, double rate, double step) {
  return c == Coordinates::relative ? 1e-8 : 0.15 * rate * rate * step * step;
}

/// Two discs, the first one driven by a torque of 0.3 N m: theta_1 + 2.5 theta_2 = 0. `second`:
/// more keys of its hinge.
std::string gears(const std::string& second) {
  return R"(
gravity: [0, 0, 0]
bodies:
  one: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  two: {position: [0.5, 0, 0], rigid: {mass: 3, inertia: [0.03, 0.03, 0.05]}}
joints:
  a: {type: revolute, child: one, at: [0, 0, 0], axis: z}
  b: {type: revolute, child: two, at: [0.5, 0, 0], axis: z)" +
         second + R"(}
couplings: {mesh: {terms: [{joint: a}, {joint: b, factor: 2.5}]}}
forces: {motor: {type: torque, body: one, direction: z, magnitude: 0.3}}
outputs:
  a: {joint_position: a}
  b: {joint_position: b}
  mesh: {coupling_force: mesh}
  a.M: {joint_torque: a, axis: z}
simulation: {step: 1.0e-3, duration: 5}
)";
}

struct Case {
  Coordinates coordinates;
  const char* second;
};

class Gears : public ::testing::TestWithParam<Case> {};

TEST_P(Gears, TurnAsOneInertia) {
  ModelDescription d = description_of(gears(GetParam().second));
  d.simulation.coordinates = GetParam().coordinates;
  const RunResult r = completed_run(d);
  const std::size_t end = r.table.rows() - 1;
  const double ratio = 2.5, alpha = 0.3 / (0.02 + 0.05 / (ratio * ratio)), angle = 12.5 * alpha;
  const double error = error_of_turning(GetParam().coordinates, 5.0 * alpha, 1e-3);
  ASSERT_GT(angle, 20.0 * 2.0 * std::numbers::pi);
  EXPECT_NEAR(r.table.at(end, 1), angle, error * angle);
  EXPECT_NEAR(r.table.at(end, 2), -angle / ratio, error * angle);
  // What accelerates the second disc, at its own factor; the first one feels it at the factor 1.
  EXPECT_NEAR(r.table.at(end, 3), -0.05 * alpha / ratio / ratio, 1e-9);
  EXPECT_NEAR(r.table.at(end, 4), r.table.at(end, 3), 1e-9);
  EXPECT_EQ(r.table.columns[3].unit, "N m");
  for (std::size_t k = 0; k <= end; ++k)
    EXPECT_NEAR(r.table.at(k, 1) + ratio * r.table.at(k, 2), 0.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(EveryPlace, Gears,
                         ::testing::Values(Case{Coordinates::relative, ""},
                                           Case{Coordinates::absolute, ""},
                                           Case{Coordinates::relative, ", cut: true"},
                                           Case{Coordinates::absolute, ", cut: true"}),
                         [](const auto& c) {
                           return name_of(c.param.coordinates) +
                                  (*c.param.second ? "_cut" : "_tree");
                         });

// The second disc is many turns away where the run goes on, whether its hinge is cut or not.
TEST_P(Gears, StatesThatAreKeptGoOn) {
  ModelDescription d = description_of(gears(GetParam().second));
  d.simulation.coordinates = GetParam().coordinates;
  d.joints[0].position = {50.0};
  const Model m = build_model(d);
  RunOptions keep;
  keep.keep_state = true;
  SimulationDescription o = m.simulation;
  o.duration = 3.0;
  const RunResult before = completed_run(m, o, keep);
  EXPECT_NEAR(before.table.at(0, 2), -20.0, 1e-10);
  const std::size_t last = before.table.rows() - 1;
  o.duration = 2.0;
  o.start = Start::state;
  o.state = before.state;
  const RunResult after = completed_run(m, o);
  for (std::size_t k = 1; k <= 2; ++k)
    EXPECT_NEAR(after.table.at(0, k), before.table.at(last, k), 1e-9);
  const RunResult whole = completed_run(m);
  for (std::size_t k = 1; k <= 3; ++k)
    EXPECT_NEAR(after.table.at(after.table.rows() - 1, k),
                whole.table.at(whole.table.rows() - 1, k), 1e-6);
}

// A nut that a weight turns on its screw: s = p q, so (m + J / p^2) s'' = -m g, for a coarse screw
// and one of a tenth of a millimetre per radian.
TEST(Screw, SinksWithTheInertiaThatTurns) {
  const double m = 2.0, J = 1e-6, g = 9.81;
  for (const double pitch : {5e-3, 1e-4})
    for (const Coordinates c : both_coordinates) {
      ModelDescription d = description_of(R"(
bodies: {nut: {position: [0, 0, 0], rigid: {mass: 2, inertia: [1.0e-6, 1.0e-6, 1.0e-6]}}}
joints: {nut: {type: cylindrical, child: nut, at: [0, 0, 0], axis: z, position: [0, 0]}}
couplings:
  screw:
    terms: [{joint: nut, coordinate: displacement}, {joint: nut, coordinate: angle, factor: -1}]
outputs:
  s: {joint_position: nut, coordinate: 1}
  q: {joint_position: nut, coordinate: 2}
  screw: {coupling_force: screw}
  nut.M: {joint_torque: nut, axis: z}
simulation: {step: 1.0e-4, duration: 0.1}
)");
      d.simulation.coordinates = c;
      std::get<Coupling>(d.couplings[0].kind).terms[1].factor = -pitch;
      const RunResult r = completed_run(d);
      const std::size_t end = r.table.rows() - 1;
      const double a = -m * g / (m + J / (pitch * pitch)), s = 0.005 * a;
      const double error = error_of_turning(c, 0.1 * a / pitch, 1e-4);
      EXPECT_NEAR(r.table.at(end, 1), s, error * std::abs(s)) << pitch << name_of(c);
      EXPECT_NEAR(r.table.at(end, 2), r.table.at(end, 1) / pitch, 1e-9 * std::abs(s / pitch));
      EXPECT_NEAR(r.table.at(end, 3), m * (a + g), 1e-7 * m * g);
      EXPECT_NEAR(r.table.at(end, 4), -pitch * m * (a + g), 1e-7 * pitch * m * g);
      EXPECT_EQ(r.table.columns[3].unit, "N");
    }
}

// A rack of 4 kg on a pinion of 0.1 m with 0.03 kg m2: x = 0.1 q.
TEST(Rack, MovesWithThePinion) {
  for (const Coordinates c : both_coordinates) {
    ModelDescription d = description_of(R"(
gravity: [0, 0, 0]
bodies:
  rack: {position: [0, 0, 0], rigid: {mass: 4, inertia: [0.1, 0.1, 0.1]}}
  pinion: {position: [0, 0.1, 0], rigid: {mass: 1, inertia: [0.02, 0.02, 0.03]}}
joints:
  x: {type: prismatic, child: rack, at: [0, 0, 0], axis: x}
  q: {type: revolute, child: pinion, at: [0, 0.1, 0], axis: z}
couplings: {teeth: {terms: [{joint: x}, {joint: q, factor: -0.1}]}}
forces: {push: {type: force, body: rack, at: [0, 0, 0], direction: x, magnitude: 2.1}}
outputs:
  x: {joint_position: x}
  q: {joint_position: q}
  teeth: {coupling_force: teeth}
simulation: {step: 1.0e-3, duration: 2}
)");
    d.simulation.coordinates = c;
    const RunResult r = completed_run(d);
    const std::size_t end = r.table.rows() - 1;
    EXPECT_NEAR(r.table.at(end, 1), 0.6, 0.6 * error_of_turning(c, 6.0, 1e-3));
    EXPECT_NEAR(r.table.at(end, 2), 10.0 * r.table.at(end, 1), 1e-9);
    EXPECT_NEAR(r.table.at(end, 3), -0.9, 1e-8);
  }
}

// Three terms: the sum of two shafts is twice the cage. M a = T + lambda c, c.a = 0.
TEST(Differential, SharesTheTorque) {
  for (const Coordinates c : both_coordinates) {
    ModelDescription d = description_of(R"(
gravity: [0, 0, 0]
bodies:
  left: {position: [0, 1, 0], rigid: {mass: 1, inertia: [0.1, 0.2, 0.1]}}
  right: {position: [0, -1, 0], rigid: {mass: 1, inertia: [0.2, 0.3, 0.2]}}
  cage: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.4, 0.5, 0.4]}}
joints:
  left: {type: revolute, child: left, at: [0, 1, 0], axis: y}
  right: {type: revolute, child: right, at: [0, -1, 0], axis: y}
  cage: {type: revolute, child: cage, at: [0, 0, 0], axis: y}
couplings: {gear: {terms: [{joint: left}, {joint: right}, {joint: cage, factor: -2}]}}
forces:
  motor: {type: torque, body: cage, direction: y, magnitude: 7}
  brake: {type: torque, body: left, direction: y, magnitude: -1}
outputs:
  left: {joint_position: left}
  right: {joint_position: right}
  cage: {joint_position: cage}
  gear: {coupling_force: gear}
simulation: {step: 1.0e-3, duration: 1}
)");
    d.simulation.coordinates = c;
    const RunResult r = completed_run(d);
    const std::size_t end = r.table.rows() - 1;
    const Vec3 J(0.2, 0.3, 0.5), factors(1.0, 1.0, -2.0), torque(-1.0, 0.0, 7.0);
    const Vec3 free = torque.cwiseQuotient(J), per_force = factors.cwiseQuotient(J);
    const double force = -factors.dot(free) / factors.dot(per_force);
    const Vec3 a = free + force * per_force;
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(r.table.at(end, static_cast<std::size_t>(k) + 1), 0.5 * a[k],
                  a.norm() * error_of_turning(c, a.norm(), 1e-3));
    EXPECT_NEAR(r.table.at(end, 4), force, 1e-9);
  }
}

/// A crank whose slider drives a disc by a rack: the slide is where the loop is cut. A flexible
/// shaft carries the disc.
const std::string machine = R"(
points: {foot: [1, 0, 0], head: [1, 0, 0.4]}
bodies:
  crank: {rigid: {mass: 1, centre_of_mass: [0.05, 0, 0], inertia: [0.001, 0.002, 0.003]}}
  link: {rigid: {mass: 0.5, centre_of_mass: [0.3, 0, 0], inertia: [0.0001, 0.007, 0.007]}}
  slider: {rigid: {mass: 2, centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.01, 0.01]}}
  shaft:
    flexible:
      material: {young: 2.0e9, poisson: 0.3, density: 2700}
      bars: {one: {from: foot, to: head, elements: 4, section: {round: 0.02}}}
      clamped: [foot]
      static_modes: [{point: head, dofs: [x, y, rz]}]
  disc: {rigid: {mass: 1, centre_of_mass: [1, 0, 0.4], inertia: [0.01, 0.01, 0.02]}}
joints:
  crank: {type: revolute, child: crank, at: [0, 0, 0], axis: z, velocity: 12}
  pin: {type: revolute, parent: crank, child: link, at: [0.1, 0, 0], axis: z}
  eye: {type: revolute, parent: link, child: slider, at: [0.5, 0, 0], axis: z}
  slide: {type: prismatic, child: slider, at: [0.5, 0, 0], axis: x, cut: true}
  foot: {type: revolute, child: shaft, at: foot, axis: z}
  disc: {type: revolute, parent: shaft, child: disc, at: head, axis: z}
couplings:
  rack: {terms: [{joint: slide}, {joint: foot, factor: 0.05}]}
  tie: {terms: [{joint: foot}, {joint: disc, factor: -3}]}
forces:
  coil: {type: joint_spring, joint: foot, spring: 0.05}
outputs:
  crank: {joint_position: crank}
  slide: {joint_position: slide}
  foot: {joint_position: foot}
  disc: {joint_position: disc}
  twist: {modal_amplitude: shaft, mode: 3}
simulation: {step: 1.0e-3, duration: 0.5}
)";

TEST(CoupledLoop, IsTheSameInBothFormulationsToSecondOrder) {
  ModelDescription d = description_of(machine);
  d.simulation.output_interval = 0.1;
  d.simulation.tolerance = 1e-12;
  double before = 0.0;
  for (const double step : {2e-3, 1e-3, 5e-4}) {
    d.simulation.step = step;
    double difference = 0.0;
    d.simulation.coordinates = Coordinates::relative;
    const RunResult a = completed_run(d);
    d.simulation.coordinates = Coordinates::absolute;
    const RunResult b = completed_run(d);
    for (std::size_t k = 0; k < a.table.data.size(); ++k)
      difference = std::max(difference, std::abs(a.table.data[k] - b.table.data[k]));
    for (const RunResult* r : {&a, &b}) {
      const std::size_t end = r->table.rows() - 1;
      EXPECT_NEAR(r->table.at(end, 2) + 0.05 * r->table.at(end, 3), 0.0, 1e-9);
      EXPECT_NEAR(r->table.at(end, 3) - 3.0 * r->table.at(end, 4), 0.0, 1e-8);
      EXPECT_GT(std::abs(r->table.at(end, 1)), 0.5);
      EXPECT_LT(std::abs(r->summary.energy.remainder), 0.02 * std::pow(step / 2e-3, 2));
    }
    std::printf("[ figure ] coupled loop, step %g: difference of the formulations %.3g\n", step,
                difference);
    if (before > 0.0) {
      EXPECT_NEAR(before / difference, 4.0, 1.0);
    }
    before = difference;
  }
}

// A phase that a function of time sets between two discs: what it gives is what they gain.
TEST(Phase, IsTheFunctionOfTime) {
  for (const Coordinates c : both_coordinates) {
    ModelDescription d = description_of(R"(
gravity: [0, 0, 0]
bodies:
  one: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.01, 0.02]}}
  two: {position: [0.5, 0, 0], rigid: {mass: 1, inertia: [0.03, 0.03, 0.06]}}
joints:
  a: {type: revolute, child: one, at: [0, 0, 0], axis: z, velocity: 30}
  b: {type: revolute, child: two, at: [0.5, 0, 0], axis: z}
couplings:
  phase:
    terms: [{joint: a}, {joint: b, factor: -1}]
    value: {sine: {amplitude: 0.4, frequency: 2}}
outputs:
  a: {joint_position: a}
  b: {joint_position: b}
simulation: {step: 1.0e-3, duration: 0.8}
)");
    d.simulation.coordinates = c;
    const RunResult r = completed_run(d);
    const auto sum = [&](std::size_t k) {
      return 0.02 * r.table.at(k, 1) + 0.06 * r.table.at(k, 2);
    };
    for (std::size_t k = 0; k < r.table.rows(); k += 50) {
      const double t = r.table.at(k, 0);
      EXPECT_NEAR(r.table.at(k, 1) - r.table.at(k, 2), 0.4 * std::sin(4.0 * std::numbers::pi * t),
                  1e-9);
      // Nothing acts from outside: the angular momentum is constant.
      const std::size_t end = r.table.rows() - 1;
      EXPECT_NEAR(sum(k), sum(0) + t / r.table.at(end, 0) * (sum(end) - sum(0)),
                  c == Coordinates::relative ? 1e-6 : 1e-3);
    }
    EXPECT_LT(std::abs(r.summary.energy.remainder), 1e-3);
    EXPECT_GT(std::abs(r.summary.energy.work[EnergyFlow::motions]), 1e-3);
    EXPECT_TRUE(r.summary.warnings.empty());
  }
}

}  // namespace
}  // namespace floatframe::test
