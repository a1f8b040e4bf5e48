// Model files that are right: every key arrives, subsystems are placed and mirrored, the examples
// are what they say.
#include "floatframe/model_file/model_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numbers>

#include "floatframe/math/so3.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

const std::string good = FLOATFRAME_TEST_DATA "/good_models/";
const std::string examples = FLOATFRAME_EXAMPLES "/";

template <class T>
const T& named(const std::vector<T>& list, const std::string& name) {
  for (const T& x : list)
    if (x.name == name) return x;
  throw std::runtime_error("no entity " + name);
}
template <class T>
const T& kind(const ModelDescription& d, const std::string& force) {
  return std::get<T>(named(d.forces, force).kind);
}
const FlexibleDescription& flexible(const ModelDescription& d, const std::string& body) {
  return std::get<FlexibleDescription>(named(d.bodies, body).kind);
}
const RigidDescription& rigid(const ModelDescription& d, const std::string& body) {
  return std::get<RigidDescription>(named(d.bodies, body).kind);
}

class Everything : public ::testing::Test {
 protected:
  ModelDescription d = read_model(good + "everything.yaml");
};

TEST_F(Everything, TopAndRigidBodies) {
  EXPECT_EQ(d.name, "everything");
  EXPECT_EQ(d.gravity, Vec3(0, 0.5, -9.81));
  const BodyDescription& block = named(d.bodies, "block");
  EXPECT_LT((block.X_WB.R - rotation_exp(Vec3(0, 0, std::numbers::pi / 2))).norm(), 1e-15);
  EXPECT_EQ(block.X_WB.p, Vec3(1, 1, 1));
  EXPECT_LT((rigid(d, "block").p_BC - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(rigid(d, "block").J_C(0, 1), 0.1);
  EXPECT_EQ(rigid(d, "block").J_C(2, 0), -0.2);
  EXPECT_EQ(rigid(d, "block").J_C(1, 2), 0.3);
  const Mat3 R =
      rotation_exp(Vec3(0, 0, 0.3)) * rotation_exp(Vec3(0, 0.2, 0)) * rotation_exp(Vec3(0.1, 0, 0));
  EXPECT_LT((named(d.bodies, "turned").X_WB.R - R).norm(), 1e-15);
  EXPECT_EQ(named(d.bodies, "turned").X_WB.p, Vec3(1, 0, 0));  // the centre of mass
  EXPECT_LT((named(d.bodies, "quaternion").X_WB.R * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_EQ(d.bodies.size(), 8u);  // `ghost` is switched off
}

TEST_F(Everything, FlexibleBodies) {
  const FlexibleDescription& f = flexible(d, "frame");
  EXPECT_EQ(f.density, 7800.0);
  ASSERT_EQ(f.bars.size(), 3u);
  EXPECT_EQ(f.bars[0].elements, 4);
  EXPECT_EQ(std::get<SolidRound>(f.bars[0].section).diameter, 0.02);
  EXPECT_EQ(std::get<HollowRound>(f.bars[1].section).inner, 0.02);
  EXPECT_EQ(f.bars[1].reference, Vec3(0, 1, 0));
  EXPECT_EQ(*f.bars[2].from_bar, "one");
  EXPECT_EQ(f.bars[2].from_fraction, 0.5);
  EXPECT_EQ(f.points.at("c"), Vec3(1, 0, 0.5));
  EXPECT_EQ(f.masses.at(0).mass, 0.5);
  EXPECT_EQ(f.clamped.size(), 6u);
  ASSERT_EQ(f.interfaces.size(), 8u);
  EXPECT_EQ(f.interfaces[0].mask, 1u << 5);  // in the order of the file: rz, then x
  EXPECT_EQ(f.interfaces[1].mask, 1u << 0);
  EXPECT_EQ(f.max_frequency, 500.0);
  EXPECT_TRUE(f.orthonormalise);
  EXPECT_EQ(f.mass_model, MassModel::hermite);
  EXPECT_TRUE(f.section_inertia);
  EXPECT_EQ(f.damping.fractions, std::vector<double>{0.02});
  EXPECT_EQ(flexible(d, "bar").analytic->dynamic_per_plane, 1);
  EXPECT_EQ(named(d.bodies, "bar").X_WB.p, Vec3(0, 0, 0));
  const MatX& basis = *flexible(d, "given").basis;
  EXPECT_EQ(basis.rows(), 12);
  EXPECT_EQ(basis.cols(), 2);
  EXPECT_EQ(basis(8, 1), 1.5);
}

TEST_F(Everything, Joints) {
  EXPECT_EQ(d.joints.size(), 8u);
  EXPECT_EQ(named(d.joints, "free").position, (std::vector<double>{0.1, 0.2, 0.3, 0, 0, 0.4}));
  EXPECT_EQ(named(d.joints, "free").parent.point, Vec3(1, 1, 1));
  EXPECT_EQ(named(d.joints, "pin").axis, Vec3(0, -1, 0));
  EXPECT_EQ(named(d.joints, "pin").parent.body, "ground");
  EXPECT_EQ(named(d.joints, "pin").velocity, std::vector<double>{0.2});
  EXPECT_TRUE(named(d.joints, "pin").keep);
  EXPECT_FALSE(named(d.joints, "tube").keep);
  EXPECT_EQ(named(d.joints, "slide").axis, Vec3(0, 0, 1));
  const TimeFunction& motion = *named(d.joints, "slide").motion;
  EXPECT_DOUBLE_EQ(motion.pieces(1.0).f, 0.1);
  EXPECT_DOUBLE_EQ(motion.pieces(9.0).f, 0.1);
  EXPECT_DOUBLE_EQ(motion.pieces(0.0).df, 0.0);
  EXPECT_EQ(*named(d.joints, "cross").parent.node, "b");
  EXPECT_EQ(*named(d.joints, "cross").child.node, "a");
  EXPECT_TRUE(named(d.joints, "cross").cut);
  EXPECT_EQ(*std::get<Rod>(d.rods.at(0).kind).length, 1.5);
}

TEST_F(Everything, Forces) {
  const auto& linear = kind<SpringDamper>(d, "linear");
  EXPECT_EQ(linear.a.point, Vec3(1, 1, 1));
  const double length = (Vec3(1, 1, 1) - Vec3(1, 0, 0.5)).norm();
  EXPECT_NEAR(linear.spring(length).f, 0.0, 1e-12);  // a plain number is free at the design length
  EXPECT_NEAR(linear.spring(length + 0.1).f, 100.0, 1e-9);
  EXPECT_NEAR(linear.spring(0.05).f, 1000 * (0.05 - length) + 1e5 * (0.05 - 0.1), 1e-9);
  EXPECT_NEAR(linear.spring(3.5).f, 1000 * (3.5 - length) + 1e4 * 0.5, 1e-9);
  EXPECT_EQ(linear.damper(2).f, 12.0);
  const auto& pieces = kind<SpringDamper>(d, "pieces");
  EXPECT_EQ(pieces.spring(0.5).f, 10.0);
  EXPECT_EQ(pieces.spring(3).f, 17.0);
  EXPECT_EQ(pieces.damper(1).f, 30.0);
  EXPECT_EQ(kind<GuidedSpring>(d, "guided").spring(1.5).f, 6.0);
  EXPECT_EQ(kind<JointSpring>(d, "torsion").spring(0.1).f, 2.0);
  const auto& tyre = kind<Tyre>(d, "tyre");
  EXPECT_EQ(tyre.law, TyreLaw::radial);
  EXPECT_EQ(tyre.road, "hill");
  EXPECT_EQ(tyre.damping, 100.0);
  const auto& push = kind<AppliedForce>(d, "push");
  EXPECT_EQ(push.direction, Vec3(0, 2, 0));
  EXPECT_EQ(push.magnitude.pieces(2).f, 5.0);
  EXPECT_EQ(push.magnitude.sines.at(0).phase, 0.5);
  EXPECT_TRUE(push.follows);
  EXPECT_EQ(named(d.forces, "twist").type(), ElementType::torque);
  EXPECT_EQ(named(d.roads, "hill").pieces(1.0).f, 0.2);
  EXPECT_EQ(named(d.roads, "hill").bumps.at(0).height, 0.1);
}

TEST_F(Everything, SubsystemsOfSubsystems) {
  EXPECT_EQ(named(d.bodies, "left.inner.wheel").X_WB.p, Vec3(1, 1, 0.6));  // width 2
  EXPECT_EQ(named(d.bodies, "right.inner.wheel").X_WB.p,
            Vec3(1, 0, 0.6));  // width 1, mirrored at y = 0.25
  EXPECT_EQ(named(d.joints, "left.inner.axle").parent.body, "block");
  EXPECT_EQ(named(d.joints, "left.inner.axle").axis, Vec3(0, 1, 0));
  EXPECT_EQ(named(d.joints, "right.inner.axle").axis, Vec3(0, 1, 0));  // det P P e_y = e_y
  EXPECT_EQ(kind<Tyre>(d, "right.inner.tyre").road, "hill");
}

TEST_F(Everything, Blocks) {
  const auto block = [&]<class B>(const char* name, B) {
    return std::get<B>(named(d.controllers, name).kind);
  };
  const auto lead = block("lead", TransferFunction());
  EXPECT_EQ(lead.input.element, "smooth");
  EXPECT_EQ(lead.denominator, (MatX{{1.0, 3.0, 4.0}}));
  EXPECT_EQ(lead.initial, BlockStart::zero);
  const auto mix = block("mix", StateSpaceBlock());
  ASSERT_EQ(mix.inputs.size(), 2u);
  EXPECT_EQ(mix.inputs[0].element, "lead");
  EXPECT_EQ(mix.inputs[1].pieces(0.0).f, 2.0);
  EXPECT_EQ(mix.A, (MatX{{-1.0, 2.0}, {0.0, -3.0}}));
  EXPECT_EQ(mix.D, (MatX{{0.0, 6.0}}));
  const auto lone = block("lone", StateSpaceBlock());
  EXPECT_EQ(lone.inputs.at(0).element, "mix");
  EXPECT_EQ(lone.A, MatX{{-2.0}});
  EXPECT_EQ(*block("smooth", LowPass()).frequency, 3.0);
  EXPECT_EQ(*block("count", LimitedIntegral()).upper, 3.0);
  EXPECT_FALSE(block("cut", Limiter()).upper);
  EXPECT_EQ(block("slow", RateLimiter()).time, 0.01);
  EXPECT_EQ(block("relay", Hysteresis()).initial, RelaySide::above);
}

TEST_F(Everything, ControllersAndTheirSignals) {
  const auto& pid = std::get<Pid>(named(d.controllers, "hold").kind);
  EXPECT_EQ(pid.measured.source, SignalSource::length);
  EXPECT_EQ(pid.measured.element, "linear");
  EXPECT_EQ(pid.measured.factor, 2.0);
  EXPECT_EQ(pid.target->pieces(0.5).f, 1.5);
  EXPECT_FALSE(pid.rate);
  EXPECT_EQ(pid.integral, 4.0);
  EXPECT_EQ(*pid.filter, 0.01);
  EXPECT_EQ(*pid.upper, 5.0);
  EXPECT_EQ(*pid.unwind, 0.5);
  const SignalDescription& twist = kind<AppliedTorque>(d, "twist").magnitude;
  EXPECT_EQ(twist.source, SignalSource::controller);
  EXPECT_EQ(twist.element, "hold");
  EXPECT_EQ(twist.factor, 0.1);
  EXPECT_EQ(twist.pieces(0.0).f, 7.0);
}

TEST_F(Everything, OutputsAndStart) {
  std::vector<std::string> names;
  for (const OutputDescription& o : d.outputs) names.push_back(o.name);
  EXPECT_EQ(names, (std::vector<std::string>{
                       "block.x", "block.y", "block.z", "block.yaw", "block.spin", "tip.vz",
                       "hub.ax", "pin", "tube rate", "bar.2", "linear.force", "linear.length",
                       "linear.rate", "screw", "hold", "left.inner.z", "right.inner.z"}));
  EXPECT_EQ(named(d.outputs, "block.yaw").component, 2);
  EXPECT_EQ(named(d.outputs, "hub.ax").at.body, "left.inner.wheel");
  EXPECT_EQ(named(d.outputs, "hub.ax").at.point, Vec3(1, 1, 0.6));
  EXPECT_EQ(named(d.outputs, "tube rate").component, 1);
  EXPECT_EQ(named(d.outputs, "bar.2").component, 1);
  EXPECT_EQ(d.amplitudes.at("bar")[3], 2e-3);
  EXPECT_EQ(d.amplitude_rates.at("bar")[1], 0.1);
}

TEST_F(Everything, Simulation) {
  const SimulationDescription& s = d.simulation;
  EXPECT_EQ(s.coordinates, Coordinates::absolute);
  EXPECT_EQ(s.inertia, InertiaMethod::projection);
  EXPECT_EQ(s.step, 0.002);
  EXPECT_EQ(s.duration, 3.0);
  EXPECT_EQ(s.output_interval, 0.01);
  EXPECT_EQ(s.start, Start::equilibrium);
  EXPECT_EQ(s.velocity, Vec3(5, 0, 0));
  EXPECT_EQ(s.spectral_radius, 0.8);
  EXPECT_EQ(s.tolerance, 1e-10);
  EXPECT_EQ(s.max_iterations, 12);
  EXPECT_EQ(s.min_step, 1e-6);
  EXPECT_EQ(s.penalty, 1e9);
  EXPECT_EQ(s.position_tolerance, 1e-8);
  EXPECT_EQ(s.velocity_tolerance, 1e-7);
  EXPECT_TRUE(s.locate_edges);
  EXPECT_EQ(s.input, InputUse::ramp);
}

TEST_F(Everything, MarksPointAtTheFile) {
  const Origin& o = named(d.bodies, "block").origin;
  EXPECT_EQ(o.mark.file, good + "everything.yaml");
  EXPECT_EQ(o.mark.column, 3);
  EXPECT_EQ(o.of("position").line, o.mark.line + 1);
  EXPECT_EQ(o.of("mass").line, o.mark.line + 3);
}

TEST(Overrides, ChangeParametersAndWhatFollows) {
  const ModelDescription d =
      read_model(good + "everything.yaml", {{"ne", "${2 * 4}"}, {"stiff", "true"}});
  EXPECT_EQ(flexible(d, "frame").bars[0].elements, 8);
  EXPECT_EQ(flexible(d, "frame").points.at("b"), Vec3(2, 0, 0));
}

TEST(Names, HoldNoExpressions) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("model.yaml",
                                        "floatframe: 1\nparameters: {t: tip}\n"
                                        "bodies: {a: {rigid: {mass: 1}, position: [0, 0, 0]}}\n"
                                        "outputs:\n  '${t}_x': {position: a, axis: x}\n");
  EXPECT_EQ(test::error_of([&] { read_model(file); }), file + ":5:3: wrong_value");
}

TEST(Overrides, OfTextsAreTakenAsTheyAreWritten) {
  const test::TemporaryFolder folder;
  const std::string file =
      folder.write("model.yaml",
                   "floatframe: 1\nname: ${name}\nparameters: {name: 'no one', n: 3, on: true}\n"
                   "bodies: {a: {rigid: {mass: '${n}'}, position: [0, 0, 0]}}\n");
  const auto name = [&](const std::string& value) {
    return read_model(file, {{"name", value}}).name;
  };
  for (const char* value : {"true", "false", "yes", "10", "010", "1e3", "0x1F", ".nan", "a'b"})
    EXPECT_EQ(name(value), value);
  EXPECT_EQ(name("'true'"), "true");
  EXPECT_EQ(name("\"10\""), "10");
  EXPECT_EQ(name("${'a'}"), "a");
  for (const char* value : {"null", "~", "Null"}) EXPECT_EQ(name(value), value);
  const auto error = [&](const ParameterOverride& o) {
    return test::error_of([&] { read_model(file, {o}); }).substr(file.size() + 2);
  };
  EXPECT_EQ(error({"n", "true"}), "wrong_value");
  EXPECT_EQ(error({"n", "'4'"}), "wrong_value");
  EXPECT_EQ(error({"n", "010"}), "out_of_range");
  EXPECT_EQ(error({"on", "yes"}), "out_of_range");
  EXPECT_EQ(error({"on", "1"}), "wrong_value");
  EXPECT_EQ(error({"name", ""}), "missing");
  EXPECT_EQ(error({"n", "null"}), "out_of_range");
  EXPECT_EQ(error({"nam", "x"}), "unknown_key");
  EXPECT_EQ(error({"speed", "1"}), "unknown_key");
}

TEST(Parameters, MayTakeThePlaceOfAConstant) {
  const auto mass = [](const std::string& parameters) {
    const ModelDescription d = test::description_of(
        "parameters: {" + parameters +
        "}\nbodies: {a: {rigid: {mass: '${2 * a + mm}'}, position: [0, 0, 0]}}\n");
    return std::get<RigidDescription>(d.bodies[0].kind).mass;
  };
  EXPECT_DOUBLE_EQ(mass("a: '${1000 * mm}'"), 2.001);
  EXPECT_DOUBLE_EQ(mass("mm: 5, a: '${1000 * mm}'"), 10005.0);
  // Before: an unknown parameter; the constant is not meant.
  const std::string text = test::error_of([&] { mass("a: '${1000 * mm}', mm: 5"); });
  EXPECT_EQ(text.substr(text.find(":2:")), ":2:17: parameters.a: contradiction");
}

TEST(Examples, IltisIsTheVehicleOfTheDataSheet) {
  const ModelDescription d = read_model(examples + "iltis/iltis.yaml");
  EXPECT_EQ(d.bodies.size(), 17u);
  EXPECT_EQ(d.joints.size(), 25u);
  EXPECT_TRUE(d.rods.empty());
  int flexible_bodies = 0;
  for (const BodyDescription& b : d.bodies)
    flexible_bodies += std::holds_alternative<FlexibleDescription>(b.kind);
  EXPECT_EQ(flexible_bodies, 12);
  EXPECT_EQ(rigid(d, "chassis").mass, 1254.619858);
  EXPECT_EQ(rigid(d, "rear_left.wheel").mass, 56.0049645);
  // Rear: x -> -0.077 - x; right: y -> -y; both 0.57 m up.
  const auto place_of = [&](const std::string& corner) {
    return named(d.bodies, corner + ".wheel").X_WB.p;
  };
  EXPECT_LT((place_of("front_left") - Vec3(0.970, 0.615, 0.356)).norm(), 1e-15);
  EXPECT_LT((place_of("front_right") - Vec3(0.970, -0.615, 0.356)).norm(), 1e-15);
  EXPECT_LT((place_of("rear_left") - Vec3(-1.047, 0.615, 0.356)).norm(), 1e-15);
  EXPECT_LT((place_of("rear_right") - Vec3(-1.047, -0.615, 0.356)).norm(), 1e-15);
  EXPECT_EQ(named(d.bodies, "rear_right.arm").mirror.diagonal(), Vec3(-1, -1, 1));
  EXPECT_LT((named(d.bodies, "rear_right.arm").X_WB.R - Mat3::Identity()).norm(), 1e-15);
  // Hinge axes are axial: one mirror at y turns them over, one at x keeps them, both turn them
  // over.
  EXPECT_EQ(named(d.joints, "front_left.arm_hinge").axis.x(), 1.0);
  EXPECT_EQ(named(d.joints, "front_right.arm_hinge").axis.x(), -1.0);
  EXPECT_EQ(named(d.joints, "rear_left.arm_hinge").axis.x(), 1.0);
  EXPECT_EQ(named(d.joints, "rear_right.arm_hinge").axis.x(), -1.0);
  // Nominal forces.
  EXPECT_NEAR(kind<GuidedSpring>(d, "front_left.leaf").spring(0.076).f, -2728.86, 0.005);
  EXPECT_NEAR(kind<SpringDamper>(d, "front_left.shock").spring(0.4405564663).f, -128.03, 0.01);
  EXPECT_NEAR(kind<GuidedSpring>(d, "front_left.leaf").spring(0.005).f,
              35906 * (0.006 - 0.152) - 1e4, 1e-6);
  EXPECT_EQ(kind<Tyre>(d, "rear_right.tyre").radius, 0.363812);
  EXPECT_EQ(kind<Tyre>(d, "rear_right.tyre").road, "stairs");
  // The road of the paper.
  const PiecewisePolynomial& road = named(d.roads, "stairs").pieces;
  const double x[] = {0, 10, 17, 20.5, 21.5, 22.5, 23.5, 24.5, 25, 40},
               z[] = {0, 1, 2, 1.7, 1.4, 1.1, 0.8, 0.5, 0, 0};
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(road(x[k]).f, z[k], 1e-15) << x[k];
}

TEST(Examples, IltisRigidVariant) {
  const ModelDescription d = read_model(examples + "iltis/iltis.yaml",
                                        {{"flexible", "false"}, {"road", "bump"}, {"speed", "10"}});
  EXPECT_EQ(d.bodies.size(), 13u);
  EXPECT_EQ(d.rods.size(), 4u);
  double mass = 0.0;
  for (const BodyDescription& b : d.bodies) mass += std::get<RigidDescription>(b.kind).mass;
  EXPECT_NEAR(mass, 1513.4, 1e-9);
  EXPECT_EQ(kind<Tyre>(d, "front_left.tyre").road, "bump");
  EXPECT_EQ(d.simulation.velocity, Vec3(10, 0, 0));
  EXPECT_LT((rigid(d, "front_left.arm").p_BC - Vec3(0, 0.1565, -0.0365)).norm(), 1e-15);
  EXPECT_LT((rigid(d, "rear_right.arm").p_BC - Vec3(0, -0.1565, -0.0365)).norm(), 1e-15);
}

TEST(Examples, SliderCrankStartsClosed) {
  const ModelDescription d = read_model(examples + "slider_crank/slider_crank.yaml");
  EXPECT_NEAR(named(d.joints, "crank_pin").position[0], -1.146765287304156, 1e-14);
  EXPECT_NEAR(named(d.joints, "crank_pin").velocity[0], -82.67786838055363, 1e-12);
  EXPECT_NEAR(named(d.joints, "slide").position[0], 0.38669032118602775 - 0.45, 1e-15);
  EXPECT_NEAR(named(d.joints, "slide").velocity[0], -8.7693122078907457, 1e-13);
}

TEST(Examples, PendulumHasTheRequestedModes) {
  const ModelDescription d = read_model(examples + "flexible_pendulum/flexible_pendulum.yaml");
  EXPECT_EQ(flexible(d, "beam").interfaces.size(), 4u);
  EXPECT_EQ(flexible(d, "beam").normal_modes, 2);
  EXPECT_EQ(d.amplitudes.at("beam").size(), 6);
}

TEST(Defaults, OutputsAndSimulation) {
  const ModelDescription d = read_model(good + "smallest.yaml");
  EXPECT_EQ(d.name, "smallest");
  EXPECT_EQ(d.gravity, Vec3(0, 0, -9.81));
  ASSERT_EQ(d.outputs.size(), 3u);
  EXPECT_EQ(d.outputs[2].name, "block.z");
  EXPECT_EQ(d.simulation.step, 1e-3);
  EXPECT_EQ(d.simulation.duration, 1.0);
}

TEST(Speed, IltisIsReadInAFewMilliseconds) {
  double best = 1.0;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    read_model(examples + "iltis/iltis.yaml");
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  RecordProperty("milliseconds", std::to_string(1e3 * best));
#ifdef NDEBUG
  EXPECT_LT(best, 0.05);  // 2 ms on a quiet machine
#endif
}

}  // namespace
}  // namespace floatframe
