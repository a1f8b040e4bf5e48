// What cannot run says why and names the cause; what merely looks degenerate (massless rods,
// links, points, torsion) runs.
#include <gtest/gtest.h>

#include <numbers>

#include "floatframe/start/statics.hpp"
#include "support/descriptions.hpp"
#include "support/figures.hpp"

namespace floatframe::test {
namespace {

BodyDescription rigid(const std::string& name, double mass, const Vec3& p,
                      const Mat3& J = Mat3::Zero()) {
  return make_body(name, RigidDescription{mass, Vec3::Zero(), J}, p);
}

template <class Check>
void both_formulations(Check&& check) {
  for (const Coordinates c : both_coordinates) check(Combination{c, InertiaMethod::preprocessing});
}

std::string refusal(const Model& model, const Combination& c) {
  return message_of<RunError>([&] { run(model, with(model.simulation, c, 0.01, 1.0)); });
}

TEST(Failures, LoopThatCannotClose) {
  ModelDescription d;
  d.bodies = {rigid("crank", 1.0, Vec3::Zero(), 0.1 * Mat3::Identity())};
  d.joints = {
      make_joint("hinge", JointType::revolute, "ground", "crank", Vec3::Zero(), Vec3::UnitY())};
  // 4 m at least, wherever the crank stands
  d.rods = {make_rod("tie", place_on("crank", {1, 0, 0}), place_on("ground", {5, 0, 0}), 2.0)};
  const Model model = build_model(d);
  both_formulations([&](const Combination& c) {
    const std::string m = refusal(model, c);
    expect_in(m, "the model cannot be assembled: ");
    expect_in(m, "rod 'tie' has a gap of ");
    expect_in(m, " m at the start");
  });
  expect_in(message_of<RunError>([&] { statics(model); }), "rod 'tie' has a gap of ");
}

TEST(Failures, JointThatCannotClose) {
  ModelDescription d;
  d.bodies = {rigid("a", 1.0, Vec3::Zero(), 0.1 * Mat3::Identity()),
              rigid("b", 1.0, Vec3(3, 0, 0), 0.1 * Mat3::Identity())};
  d.joints = {make_joint("left", JointType::revolute, "ground", "a", Vec3::Zero(), Vec3::UnitY()),
              make_joint("right", JointType::revolute, "ground", "b", Vec3(3, 0, 0), Vec3::UnitY()),
              make_joint("bridge", JointType::spherical, "a", "b", Vec3(1, 0, 0), Vec3::UnitY())};
  d.joints[2].child.point = Vec3(2, 2, 0);  // 2 m aside of the plane of the other
  d.joints[2].cut = true;
  const auto attempt = [&] { run(build_model(d), with(d.simulation, combinations[0], 0.01, 1.0)); };
  expect_in(message_of<RunError>(attempt), "joint 'bridge' has a gap of ");
}

TEST(Failures, MassMatrixSingularWhereNothingHolds) {
  ModelDescription d;
  d.bodies = {rigid("heavy", 1.0, Vec3::Zero(), 0.1 * Mat3::Identity()),
              rigid("ghost", 0.0, Vec3(1, 0, 0))};
  const Model model = build_model(d);
  both_formulations([&](const Combination& c) {
    const std::string m = refusal(model, c);
    expect_in(m, "the mass matrix is singular where nothing holds it: ");
    expect_in(m, "ghost");
  });
}

TEST(Failures, RodWithoutInertiaAboutItsHinge) {
  // A massless arm on a hinge, with nothing at its end.
  ModelDescription d;
  d.bodies = {rigid("arm", 0.0, Vec3::Zero())};
  d.joints = {
      make_joint("pivot", JointType::revolute, "ground", "arm", Vec3::Zero(), Vec3::UnitY())};
  const Model model = build_model(d);
  both_formulations([&](const Combination& c) {
    const std::string m = refusal(model, c);
    expect_in(m, "the mass matrix is singular where nothing holds it: ");
  });
}

/// A carriage that meets a wall whose force jumps from 0 to 1 MN.
ModelDescription jump() {
  ModelDescription d;
  d.bodies = {rigid("carriage", 1.0, Vec3::Zero(), Mat3::Identity())};
  d.joints = {
      make_joint("rail", JointType::prismatic, "ground", "carriage", Vec3::Zero(), Vec3::UnitX())};
  d.joints[0].velocity = {1.0};
  JointSpring spring;
  spring.joint = "rail";
  spring.spring = PiecewisePolynomial::linear(1.0, 0.0);
  d.forces = {{"wall", spring, {}}};
  d.outputs = {make_output("x", place_on("carriage", Vec3::Zero()), 0)};
  return d;
}

TEST(Failures, StepThatCannotConverge) {
  ModelDescription d = jump();
  Model model = build_model(d);
  // A description with a jump is refused: the wall comes into the built model.
  model.elements[0].laws[0] = PiecewisePolynomial({0.105}, {{0.0, {0.0}}, {0.0, {1e6}}});
  for (const double min_step : {0.01, 0.0}) {
    both_formulations([&](const Combination& c) {
      SimulationDescription s = with(d.simulation, c, 0.01, 1.0);
      s.min_step = min_step;
      // Newton alternates between the two sides of the wall: stop where the wall pushes.
      s.max_iterations = 19;
      const RunResult r = run(model, s);
      std::printf("[ message ] %s\n", r.summary.message.c_str());
      EXPECT_EQ(r.summary.status, "failed") << c.name();
      expect_in(r.summary.message,
                min_step > 0.0 ? "step failed at t = 0.1 s" : "step failed at t = 0.10");
      expect_in(r.summary.message, min_step > 0.0 ? "0.01 s: no convergence; look at "
                                                  : "9.77e-06 s: no convergence; look at ");
      expect_in(r.summary.message,
                c.coordinates == Coordinates::relative ? "joint 'rail'" : "body 'carriage'");
      expect_in(r.summary.message, "(largest force: 'wall', ");
      EXPECT_EQ(r.summary.message.find("almost without mass"), std::string::npos);
      // What was reached is kept: times 0 to 0.10 s at 1 m/s.
      ASSERT_EQ(r.table.rows(), 11u) << c.name();
      EXPECT_NEAR(r.table.at(10, 0), 0.10, 1e-12);
      EXPECT_NEAR(r.table.at(10, 1), 0.10, 1e-9);
      EXPECT_EQ(r.summary.steps, 10);
      EXPECT_NEAR(r.summary.duration, 0.1025, 0.002501);
      EXPECT_TRUE(std::isfinite(r.summary.energy.total_end));
    });
  }
}

TEST(Failures, NoEquilibrium) {
  ModelDescription d;
  d.bodies = {rigid("stone", 2.0, Vec3::Zero(), Mat3::Identity())};
  const Model model = build_model(d);
  const std::string m = message_of<RunError>([&] { statics(model); });
  expect_in(m, "equilibrium found: after ");
  expect_in(m, "stone");
  d.simulation.start = Start::equilibrium;
  const Model start = build_model(d);
  both_formulations(
      [&](const Combination& c) { expect_in(refusal(start, c), "equilibrium found: after "); });
}

/// An arm without mass goes with its load until the torsion spring can hold no more, at 2.5 N m:
/// beyond, it has no place to be.
TEST(Failures, ArmWithoutMassThatNothingHoldsAnyMoreIsNamed) {
  ModelDescription d;
  d.bodies = {rigid("arm", 0.0, Vec3::Zero()),
              rigid("stone", 1.0, Vec3(0, 0, 2), 0.1 * Mat3::Identity())};
  d.joints = {
      make_joint("hinge", JointType::revolute, "ground", "arm", Vec3::Zero(), Vec3::UnitY())};
  JointSpring spring;
  spring.joint = "hinge";
  spring.spring = PiecewisePolynomial::polynomial({0.0, 10.0, -10.0});
  AppliedTorque load;
  load.at.body = "arm";
  load.direction = Vec3::UnitY();
  load.magnitude.pieces = PiecewisePolynomial::polynomial({0.0, 5.0});
  d.forces = {{"spring", spring, {}}, {"load", load, {}}};
  d.outputs = {make_output("x", place_on("arm", Vec3(1, 0, 0)), 0)};
  const Model model = build_model(d);
  both_formulations([&](const Combination& c) {
    const RunResult r = run(model, with(d.simulation, c, 0.01, 1.0));
    EXPECT_EQ(r.summary.status, "failed") << c.name();
    EXPECT_NEAR(r.summary.duration, 0.5, 0.01) << c.name();
    expect_in(r.summary.message,
              "; body 'arm' can move there almost without mass, so that nothing "
              "but forces limits where to and how fast");
  });
}

TEST(Degenerate, MasslessRodsAndLinksRun) {
  // A stone hangs on a massless link, pinned at both ends, and swings; beside it a second one on a
  // massless rod: neither turns, both are pendulums of 1 m.
  ModelDescription d;
  const Mat3 J = 1e-3 * Mat3::Identity();
  d.bodies = {rigid("upper", 0.0, Vec3::Zero()), rigid("stone", 1.0, Vec3(1, 0, 0), J),
              rigid("other", 1.0, Vec3(1, 2, 0), J)};
  d.joints = {
      make_joint("hinge", JointType::revolute, "ground", "upper", Vec3::Zero(), Vec3::UnitY()),
      make_joint("pin", JointType::revolute, "upper", "stone", Vec3(1, 0, 0), Vec3::UnitY())};
  d.rods = {make_rod("rod", place_on("ground", {0, 2, 0}), place_on("other", {1, 2, 0}))};
  d.outputs = {make_output("stone", place_on("stone", Vec3(1, 0, 0)), 2),
               make_output("other", place_on("other", Vec3(1, 2, 0)), 2)};
  d.simulation.tolerance = 1e-11;
  const Model model = build_model(d);
  both_formulations([&](const Combination& c) {
    const RunResult r = completed_run(model, with(d.simulation, c, 1e-3, 2.0));
    double worst = 0.0;
    for (std::size_t i = 0; i < r.table.rows(); ++i)
      worst = std::max(worst, std::abs(r.table.at(i, 1) - r.table.at(i, 2)));
    figure(c.name() + " massless link - massless rod [m]", worst);
    figure(c.name() + " lowest [m]", minimum(r.table, "stone").value);
    EXPECT_LT(worst, 1e-4);
    EXPECT_NEAR(minimum(r.table, "stone").value, -1.0, 1e-4);
    EXPECT_LT(r.summary.max_position_violation, 1e-9);
  });
}

/// A bar clamped at the ground, whose only mode is torsion; its isoparametric mass has no inertia
/// about the axis.
ModelDescription torsion_bar(bool disc) {
  ModelDescription d;
  d.gravity = Vec3::Zero();
  BodyDescription b;
  b.name = "bar";
  FlexibleDescription f;
  f.young = 2e11;
  f.poisson = 0.25;  // G = 8e10
  f.density = 7800;
  f.points = {{"root", Vec3::Zero()}, {"tip", Vec3(0.5, 0, 0)}};
  BarDescription bar;
  bar.name = "bar";
  bar.from = "root";
  bar.to = "tip";
  bar.elements = 4;
  bar.section = SectionConstants{1e-4, 1e-9, 1e-9, 2e-9};
  f.bars = {bar};
  NodeDofs root, tip;
  root.node = "root";
  root.mask = 63u;
  tip.node = "tip";
  tip.mask = 8u;  // rx
  f.clamped = {root};
  f.interfaces = {tip};
  b.kind = f;
  d.bodies = {b};
  d.joints = {make_joint("clamp", JointType::weld, "ground", "bar", Vec3::Zero(), Vec3::UnitY())};
  d.amplitudes["bar"] = VecX::Constant(1, 0.1);
  OutputDescription o;
  o.name = "twist";
  o.type = OutputType::modal_amplitude;
  o.at.body = "bar";
  d.outputs = {o};
  if (disc) {
    d.bodies.push_back(rigid("disc", 1.0, Vec3(0.5, 0, 0), Vec3(0.02, 0.01, 0.01).asDiagonal()));
    JointDescription weld =
        make_joint("weld", JointType::weld, "bar", "disc", Vec3(0.5, 0, 0), Vec3::UnitY());
    weld.parent.node = "tip";
    d.joints.push_back(weld);
  }
  d.simulation.tolerance = 1e-12;
  return d;
}

TEST(Degenerate, MasslessTorsionCarriesADisc) {
  const ModelDescription d = torsion_bar(true);
  const Model model = build_model(d);
  // k = G J / L = 320 N m/rad on 0.02 kg m2: omega = 126.49 rad/s.
  const double omega = std::sqrt(8e10 * 2e-9 / 0.5 / 0.02);
  for (const Combination& c : combinations) {
    const double period = 2.0 * std::numbers::pi / omega, h = period / 400.0;
    const RunResult r = completed_run(model, with(d.simulation, c, h, 2.0 * period));
    double worst = 0.0;
    for (std::size_t i = 0; i < r.table.rows(); ++i)
      worst =
          std::max(worst, std::abs(r.table.at(i, 1) - 0.1 * std::cos(omega * r.table.at(i, 0))));
    figure(c.name() + " twist - 0.1 cos(omega t) [rad]", worst);
    EXPECT_LT(worst, 1e-4);
  }
}

TEST(Degenerate, MasslessTorsionAloneRests) {
  ModelDescription d = torsion_bar(false);
  d.amplitudes["bar"].setZero();
  const Model model = build_model(d);
  for (const Combination& c : combinations) {
    const RunResult r = completed_run(model, with(d.simulation, c, 1e-3, 0.1));
    EXPECT_NEAR(maximum(r.table, "twist").value, 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace floatframe::test
