// Angles of hinges beyond half a turn: springs, outputs and kept states count the turns alike in
// both formulations, for joints of the tree and for joints where a loop is cut.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/description/system_state.hpp"
#include "floatframe/formulation/absolute.hpp"
#include "floatframe/start/initial_state.hpp"
#include "support/completed_run.hpp"
#include "support/descriptions.hpp"

namespace floatframe::test {
namespace {

constexpr double disc_inertia = 0.02, stiffness = 3.0, start_angle = 4.0 * std::numbers::pi + 1.0;
const double disc_omega = std::sqrt(stiffness / disc_inertia);

/// A disc on a hinge with a torsion spring and no gravity: theta = theta_0 cos(omega t).
ModelDescription disc(bool cut, bool reversed) {
  ModelDescription d;
  d.gravity.setZero();
  const RigidDescription rigid{1.0, Vec3::Zero(), disc_inertia * Mat3::Identity()};
  d.bodies = {make_body("disc", rigid)};
  if (reversed) {  // the tree reaches the hinge from its child
    d.bodies.push_back(make_body("base", rigid));
    d.joints.push_back(make_joint("weld", JointType::weld, "ground", "base"));
  }
  JointDescription j =
      make_joint("hinge", JointType::revolute, reversed ? "disc" : "ground",
                 reversed ? "base" : "disc", Vec3::Zero(), Vec3(0.2, 0.3, 1.0).normalized());
  j.position = {start_angle};
  j.cut = cut;
  d.joints.push_back(j);
  JointSpring s;
  s.joint = "hinge";
  s.spring = PiecewisePolynomial::linear(stiffness, 0.0);
  d.forces = {{"spring", s, {}}};
  d.outputs = {make_output("hinge", OutputType::joint_position, "hinge"),
               make_output("spring", OutputType::force, "spring"),
               make_output("angle", OutputType::length, "spring")};
  d.simulation.step = 1e-4;  // turns by up to 0.017 rad in each
  d.simulation.output_interval = 0.01;
  d.simulation.duration = 0.3;  // rather more than half a period
  return d;
}

class Turns : public ::testing::TestWithParam<std::tuple<Coordinates, bool, bool>> {
 protected:
  static Coordinates coordinates() { return std::get<0>(GetParam()); }
  static ModelDescription description() {
    ModelDescription d = disc(std::get<1>(GetParam()), std::get<2>(GetParam()));
    d.simulation.coordinates = coordinates();
    return d;
  }
};

void expect_swing(const ResultTable& table, double from) {
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const double exact = start_angle * std::cos(disc_omega * table.at(k, 0));
    EXPECT_NEAR(table.at(k, 1), exact, 2e-3) << table.at(k, 0);
    EXPECT_NEAR(table.at(k, 2), stiffness * exact, 6e-3) << table.at(k, 0);
    EXPECT_NEAR(table.at(k, 3), exact, 2e-3) << table.at(k, 0);
  }
  EXPECT_NEAR(table.at(0, 0), from, 1e-12);
}

TEST_P(Turns, SpringActsAtTheAngleThatIsGiven) {
  const RunResult r = completed_run(description());
  expect_swing(r.table, 0.0);
  EXPECT_NEAR(r.summary.energy.total_start, 0.5 * stiffness * start_angle * start_angle, 1e-9);
  EXPECT_NEAR(r.summary.energy.total_end / r.summary.energy.total_start, 1.0, 1e-5);
}

TEST_P(Turns, StatesThatAreKeptGoOn) {
  const Model m = build_model(description());
  RunOptions keep;
  keep.keep_state = true;
  SimulationDescription o = m.simulation;
  o.duration = 0.04;
  const RunResult before = run(m, o, keep);
  ASSERT_NE(before.state, nullptr);
  for (const SystemState::Joint& j : before.state->joints)
    if (j.name == "hinge") {
      ASSERT_GT(j.position[0], 10.0) << "still more than a turn";
    }
  o = m.simulation;
  o.duration = 0.26;
  o.start = Start::state;
  o.state = before.state;
  const RunResult after = completed_run(m, o);
  expect_swing(after.table, 0.04);
}

INSTANTIATE_TEST_SUITE_P(Joints, Turns,
                         ::testing::Combine(::testing::ValuesIn(both_coordinates),
                                            ::testing::Bool(), ::testing::Bool()),
                         [](const auto& x) {
                           return name_of(std::get<0>(x.param)) +
                                  (std::get<1>(x.param) ? "_cut" : "") +
                                  (std::get<2>(x.param) ? "_reversed" : "");
                         });

TEST(TurnsOfMotors, OutputsBeginAtTheTurnOfTheMotion) {
  ModelDescription d = disc(false, false);
  d.joints[0].position.clear();
  TimeFunction motion;
  motion.pieces = PiecewisePolynomial::polynomial({10.0, 2.0});
  d.joints[0].motion = motion;
  for (const Coordinates coordinates : both_coordinates) {
    d.simulation.coordinates = coordinates;
    const Model m = build_model(d);
    RunOptions keep;
    keep.keep_state = true;
    const RunResult r = completed_run(m, m.simulation, keep);
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      const double exact = 10.0 + 2.0 * r.table.at(k, 0);
      EXPECT_NEAR(r.table.at(k, 1), exact, 1e-8);
      EXPECT_NEAR(r.table.at(k, 2), stiffness * exact, 1e-7);
    }
    EXPECT_NEAR(r.state->joints[0].position[0], 10.6, 1e-8);
  }
}

/// A Newton iteration that goes astray may turn a joint by anything: the next attempt at the step
/// must begin at the turn of the last one that was accepted.
template <class F>
void expect_forgotten(F& f, const VecX& q, const std::vector<VecX>& astray, const VecX& v) {
  const auto angle = [&](const VecX& at) {
    f.positions(0.0, at);
    f.velocities(v);
    f.forces();
    return f.effort(0).length;
  };
  ASSERT_NEAR(angle(q), start_angle, 1e-12);
  f.stepping(true);
  for (const VecX& x : astray) angle(x);
  EXPECT_GT(std::abs(angle(q) - start_angle), 6.0) << "a turn more";
  f.stepping(false, false);
  EXPECT_NEAR(angle(q), start_angle, 1e-12);
  f.stepping(true);
  angle(VecX::Constant(q.size(), std::numeric_limits<double>::quiet_NaN()));
  f.stepping(false, false);
  EXPECT_NEAR(angle(q), start_angle, 1e-12);
  f.stepping(true);
  for (const VecX& x : astray) angle(x);
  f.stepping(false, true);
  EXPECT_GT(std::abs(angle(q) - start_angle), 6.0) << "an accepted step may turn";
}

TEST(TurnsOfSteps, StepsThatAreNotAcceptedLeaveNone) {
  const Model m = build_model(disc(true, false));  // counted in both formulations
  RelativeFormulation relative(m, InertiaMethod::preprocessing);
  State s = relative_start(relative, Start::given);
  AbsoluteFormulation absolute(m, InertiaMethod::preprocessing);
  const Vec3 axis = m.joints[0].cut ? Vec3(0.2, 0.3, 1.0).normalized() : Vec3::UnitZ();
  std::vector<VecX> turned, turned_absolute;
  for (const double by : {2.0, 4.0, 6.0}) {
    VecX x = VecX::Zero(6), q = s.q, qa, va;
    x.tail<3>() = by * axis;
    relative.retract(s.q, x, q);
    turned.push_back(q);
    absolute.start_from(relative, q, s.v, qa, va);
    turned_absolute.push_back(qa);
  }
  State a;
  relative.start(a.q, a.v);  // counts from the start again
  absolute.start_from(relative, s.q, s.v, a.q, a.v);
  expect_forgotten(absolute, a.q, turned_absolute, a.v);
  expect_forgotten(relative, s.q, turned, s.v);
}

}  // namespace
}  // namespace floatframe::test
