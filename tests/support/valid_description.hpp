#pragma once
// A description that uses every field, and what is said when one of them is changed.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "support/descriptions.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double inf = std::numeric_limits<double>::infinity();

inline PiecewisePolynomial two_pieces(double at, double first, double second) {
  return {{at}, {{0.0, {0.0, first}}, {at, {second}}}};
}

inline FlexibleDescription bar_description() {
  FlexibleDescription f;
  f.young = 2e11;
  f.poisson = 0.3;
  f.density = 7800.0;
  f.points = {{"a", {0, 0, 0}}, {"b", {1, 0, 0}}, {"c", {1, 0, 1}}};
  BarDescription bar;
  bar.name = "one";
  bar.from = "a";
  bar.to = "b";
  bar.elements = 4;
  bar.section = HollowRound{0.02, 0.01};
  BarDescription branch;
  branch.name = "two";
  branch.from_bar = "one";
  branch.from_fraction = 0.5;
  branch.to = "c";
  branch.elements = 2;
  branch.section = Rectangle{0.01, 0.02};
  branch.reference = Vec3::UnitY();
  f.bars = {bar, branch};
  f.masses = {{"c", 0.1, {}}};
  f.clamped = {{"a", 63u}};
  f.interfaces = {{"b", 6u}};
  f.normal_modes = 2;
  return f;
}

/// One mode, two nodes.
inline FlexibleBody reduced_body() {
  FlexibleBody f;
  f.invariants = InertiaInvariants::zero(1);
  f.invariants.m = 2.0;
  f.invariants.P_u.diagonal() << 0.1, 0.1, 0.1;
  f.invariants.S(0, 0) = 1.0;
  for (std::size_t i = 0; i < 3; ++i) f.invariants.Sij[i][i](0, 0) = 1.0;
  f.K = MatX::Constant(1, 1, 100.0);
  f.D = MatX::Zero(1, 1);
  auto p = std::make_shared<ProjectionData>();
  p->p = Mat3X::Zero(3, 2);
  p->X = MatX::Zero(6, 1);
  p->M_s.resize(2, 2);
  p->M_s.insert(0, 0) = 1.0;
  p->M_s.insert(1, 1) = 1.0;
  f.projection = p;
  for (const char* name : {"n0", "n1"}) {
    ModalNode n;
    n.name = name;
    n.X = n.X_theta = Mat3X::Zero(3, 1);
    f.nodes.push_back(n);
  }
  f.nodes[1].p = Vec3(0.5, 0, 0);
  f.nodes[1].X(0, 0) = 1.0;
  return f;
}

/// A description that uses every field.
inline ModelDescription valid_description() {
  ModelDescription d;
  const Mat3 J = Vec3(0.1, 0.2, 0.25).asDiagonal();
  d.bodies = {make_body("block", RigidDescription{2.0, Vec3::Zero(), J}, {0, 0, 1}),
              make_body("arm", bar_description()), make_body("part", reduced_body())};
  d.joints = {make_joint("slide", JointType::prismatic, "ground", "block", {0, 0, 1}),
              make_joint("pin", JointType::universal, "ground", "arm", {0, 0, 0}),
              make_joint("ball", JointType::spherical, "ground", "part", {0, 0, 0})};
  d.joints[0].motion.emplace();
  d.joints[0].motion->pieces = PiecewisePolynomial::polynomial({0.0, 1.0});
  d.joints[1].position = {0.1, 0.2};
  d.joints[2].child.node = "n0";
  d.rods = {make_rod("rod", place_on("ground", {3, 0, 0}), place_on("block", {0, 0, 1.5}), 4.0)};

  SpringDamper spring;
  spring.a = place_on("ground", {0, 0, 3});
  spring.b = place_on("block", {0, 0, 1});
  spring.spring = two_pieces(1.0, 1000.0, 1000.0);
  spring.actuator.emplace();
  spring.actuator->input = "push";
  GuidedSpring guide;
  guide.reference = place_on("block", {0, 0, 1});
  guide.tip = place_on("part", {0.5, 0, 0});
  guide.damper = PiecewisePolynomial::linear(5.0, 0.0);
  JointSpring motor;
  motor.joint = "slide";
  motor.spring = PiecewisePolynomial::linear(5.0, 0.0);
  motor.target.emplace();
  Tyre tyre;
  tyre.centre = place_on("block", {0, 0, 1});
  tyre.radius = 0.3;
  tyre.stiffness = 1e5;
  tyre.road = "track";
  AppliedForce load;
  load.at = place_on("block", {0, 0, 1});
  d.forces = {{"spring", spring, {}},
              {"guide", guide, {}},
              {"motor", motor, {}},
              {"tyre", tyre, {}},
              {"load", load, {}}};
  RoadDescription road;
  road.name = "track";
  road.pieces = PiecewisePolynomial({1.0, 1.0}, {{0.0, {0.0}}, {0.0, {0.1}}, {0.0, {0.2}}});
  road.bumps = {{5.0, 1.0, 0.1}};
  d.roads = {road};
  d.inputs = {{"push", "N", 0.0, -1.0, 1.0, false, {}}};

  const auto output = [&](const char* name, OutputType type, const char* body, const char* entity,
                          int component) {
    OutputDescription o = make_output(name, type, entity, component);
    o.at = place_on(body, {0, 0, 1});
    return o;
  };
  d.outputs = {output("z", OutputType::position, "block", "", 2),
               output("yaw", OutputType::rotation, "block", "", 2),
               output("q", OutputType::joint_position, "ground", "pin", 1),
               output("y1", OutputType::modal_amplitude, "part", "", 0),
               output("F", OutputType::force, "ground", "load", 0),
               output("L", OutputType::length, "ground", "spring", 0)};
  d.amplitudes = {{"part", VecX::Constant(1, 0.01)}};
  d.amplitude_rates = {{"part", VecX::Constant(1, 0.0)}};
  return d;
}

inline std::string errors(const ModelDescription& d) {
  return error_of([&] { build_model(d); });
}

template <class T>
T& kind(ModelDescription& d, std::size_t k) {
  return std::get<T>(d.forces[k].kind);
}
inline RigidDescription& rigid(ModelDescription& d) {
  return std::get<RigidDescription>(d.bodies[0].kind);
}
inline FlexibleDescription& bars(ModelDescription& d) {
  return std::get<FlexibleDescription>(d.bodies[1].kind);
}
inline FlexibleBody& part(ModelDescription& d) { return std::get<FlexibleBody>(d.bodies[2].kind); }

struct DescriptionCase {
  std::function<void(ModelDescription&)> change;
  std::string expected;
};
using D = ModelDescription;

inline void check(const std::vector<DescriptionCase>& cases) {
  for (const DescriptionCase& c : cases) {
    ModelDescription d = valid_description();
    c.change(d);
    EXPECT_EQ(errors(d), c.expected);
  }
}

}  // namespace floatframe::test
