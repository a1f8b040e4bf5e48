// Elements, laws and roads: numbers computed by hand. What holds for every kind is in
// element_kinds_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/road.hpp"
#include "support/element_motion.hpp"

namespace floatframe::test {
namespace {

MarkerState at(const Vec3& r, const Mat3& R = Mat3::Identity()) {
  const Vec3 zero = Vec3::Zero();
  return {r, R, zero, zero, zero, zero};
}

ElementExample tyre_at(TyreLaw law, const PiecewisePolynomial& road, const MarkerState& centre,
                       double damping) {
  ElementExample x;
  x.model.roads.push_back({"road", road, {}});
  Tyre f;
  f.law = law;
  f.radius = 0.5;
  f.stiffness = 1e4;
  f.damping = damping;
  x.keys(f);
  x.element.road = 0;
  x.markers = {centre};
  return x;
}
Efforts tyre(TyreLaw law, const PiecewisePolynomial& road, const MarkerState& centre,
             double damping = 0.0) {
  return efforts(tyre_at(law, road, centre, damping));
}

const PiecewisePolynomial slope = PiecewisePolynomial::polynomial({0.0, 0.75});

TEST(Tyres, RadialOnASlopeOfThreeToFour) {
  // Centre 0.4 m above the road below it: F = 1e4 0.1 0.8 = 800 N along (-0.6, 0, 0.8), through the
  // centre because the wheel stands in the x-z plane.
  const Efforts s = tyre(TyreLaw::radial, slope, at(Vec3(2.0, 7.0, 1.9)));
  EXPECT_NEAR(s.force, 800.0, 1e-9);
  EXPECT_NEAR(s.length, 0.4, 1e-15);
  EXPECT_LT((s.wrench[0].F - Vec3(-480.0, 0.0, 640.0)).norm(), 1e-9);
  EXPECT_LT(s.wrench[0].T.norm(), 1e-9);
}

TEST(Tyres, RadialWithCamberOnFlatGround) {
  // Axis tilted by atan(1/2): the contact lies 0.4/2 beside the centre; 1000 N make 200 N m.
  const Mat3 R = rotation_exp(std::atan(0.5) * Vec3::UnitX());
  const Efforts s = tyre(TyreLaw::radial, PiecewisePolynomial(), at(Vec3(0.0, 0.0, 0.4), R));
  EXPECT_LT((s.wrench[0].F - Vec3(0.0, 0.0, 1000.0)).norm(), 1e-9);
  EXPECT_LT((s.wrench[0].T - Vec3(200.0, 0.0, 0.0)).norm(), 1e-9);
}

TEST(Tyres, VerticalPushesUpWhateverTheSlope) {
  MarkerState centre = at(Vec3(2.0, 7.0, 1.9));
  Efforts s = tyre(TyreLaw::vertical, slope, centre, 100.0);
  EXPECT_LT((s.wrench[0].F - Vec3(0.0, 0.0, 1000.0)).norm(), 1e-9);
  // Driving up the slope at 2 m/s the road rises by 1.5 m/s: 150 N more.
  centre.v = Vec3(2.0, 0.0, 0.0);
  s = tyre(TyreLaw::vertical, slope, centre, 100.0);
  EXPECT_NEAR(s.force, 1150.0, 1e-9);
}

// Damping acts on the rate of the height above the road: a wheel that rolls up a slope at constant
// speed is damped by nothing, one that moves level towards it is pushed.
TEST(Tyres, DampsTheRateOfTheHeightAboveTheRoad) {
  MarkerState centre = at(Vec3(2.0, 0.0, 1.9));
  centre.v = Vec3(4.0, 0.0, 3.0);
  for (const TyreLaw law : {TyreLaw::vertical, TyreLaw::radial})
    EXPECT_DOUBLE_EQ(tyre(law, slope, centre, 100.0).force, tyre(law, slope, centre).force);
  centre.v = Vec3(4.0, 0.0, 0.0);
  const double spring = tyre(TyreLaw::vertical, slope, centre).force;
  EXPECT_NEAR(tyre(TyreLaw::vertical, slope, centre, 100.0).force, spring + 300.0, 1e-9);
  EXPECT_NEAR(tyre(TyreLaw::radial, slope, centre, 100.0).force, 0.8 * (spring + 300.0), 1e-9);
}

TEST(Tyres, NeverPulls) {
  for (const TyreLaw law : {TyreLaw::vertical, TyreLaw::radial}) {
    Efforts s = tyre(law, slope, at(Vec3(0.0, 0.0, 0.51)));
    EXPECT_EQ(s.force, 0.0);
    EXPECT_EQ(s.row_count, 0);
    EXPECT_EQ(s.wrench[0].F.norm(), 0.0);
    MarkerState leaving = at(Vec3(0.0, 0.0, 0.4));
    leaving.v = Vec3(0.0, 0.0, 11.0);  // the damper would pull with 1100 N
    s = tyre(law, slope, leaving, 100.0);
    EXPECT_EQ(s.force, 0.0);
  }
}

TEST(Tyres, RoadIsFoundFromTheEvaluationOrigin) {
  ElementExample x = tyre_at(TyreLaw::vertical, slope, at(Vec3(1.0, 0.0, 0.9)), 0.0);
  x.origin = Vec3(1.0, 0.0, 1.0);
  EXPECT_NEAR(efforts(x).length, 0.4, 1e-15);
}

template <class Load>
void turns_only_if_it_follows(const Vec3& fixed, const Vec3& turned, Vec3 Wrench::*part) {
  for (const bool follows : {false, true}) {
    Load f;
    f.direction = Vec3(2.0, 0.0, 0.0);
    f.follows = follows;
    f.magnitude.pieces = PiecewisePolynomial::polynomial({1.0});
    f.magnitude.sines = {{.amplitude = 3.0, .frequency = 0.25}};
    ElementExample x;
    x.keys(f);
    x.markers = {at(Vec3(1.0, 2.0, 3.0), rotation_exp(0.5 * M_PI * Vec3::UnitZ()))};
    x.t = 1.0;  // 1 + 3 sin(pi/2) = 4
    const Efforts s = efforts(x);
    const Vec3 load = follows ? turned : fixed;
    EXPECT_LT((s.wrench[0].*part - load).norm(), 1e-14);
    EXPECT_NEAR(stacked(s).norm(), load.norm(), 1e-14);
    EXPECT_NEAR(s.force, 4.0, 1e-14);
  }
}

TEST(AppliedLoads, DirectionTurnsOnlyIfItFollows) {
  const Vec3 fixed(8.0, 0.0, 0.0), turned(0.0, 8.0, 0.0);
  turns_only_if_it_follows<AppliedForce>(fixed, turned, &Wrench::F);
  turns_only_if_it_follows<AppliedTorque>(fixed, turned, &Wrench::T);
}

TEST(JointSprings, FollowSeveralTurns) {
  JointSpring f;
  f.spring = PiecewisePolynomial::linear(2.0, 0.0);
  ElementExample x;
  x.keys(f);
  x.element.rotational = true;
  x.markers = {at(Vec3::Zero()), at(Vec3::Zero())};
  for (double angle = 0.0; angle < 20.0; angle += 0.7) {
    x.markers[1].R = rotation_exp(std::remainder(angle, 2 * M_PI) * Vec3::UnitZ());
    const Efforts s = efforts(x);
    x.reference_angle = s.length;
    EXPECT_NEAR(s.length, angle, 1e-12);
    EXPECT_NEAR(s.force, 2.0 * angle, 1e-12);
  }
}

TEST(LawEnergy, IsTheIntegralOfTheLaw) {
  const PiecewisePolynomial law =
      table_function({{-1.0, -30.0}, {-0.2, -1.0}, {0.1, 0.0}, {0.7, 12.0}}, Interpolation::cubic,
                     Beyond::tangent) +
      ramp_below(-0.5, 200.0) + ramp_above(0.4, 70.0);
  EXPECT_NEAR(law_energy(law, 0.0), 0.0, 1e-15);
  for (const double s : {-1.7, -0.5, -0.1, 0.05, 0.4, 0.9, 2.0}) {
    const int n = 20000;
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += law((k + 0.5) * s / n).f * s / n;
    EXPECT_NEAR(law_energy(law, s), sum, 1e-6 * (1 + std::abs(sum)));
  }
}

TEST(Road, SlopeAgainstFiniteDifferences) {
  Road road{
      "road",
      table_function({{0.0, 0.0}, {2.0, 0.4}, {5.0, 0.3}}, Interpolation::cubic, Beyond::hold),
      {{1.0, 0.8, 0.1}, {3.0, 1.0, -0.05}}};
  for (double x = -1.0; x < 7.0; x += 0.0371) {
    const double h = 1e-6;
    const double numeric = (road_at(road, x + h).z - road_at(road, x - h).z) / (2 * h);
    EXPECT_NEAR(road_at(road, x).slope, numeric, 1e-6) << x;
  }
  Road bump{"bump", PiecewisePolynomial(), {{1.0, 0.8, 0.1}}};
  EXPECT_EQ(road_at(bump, 0.99).z, 0.0);
  EXPECT_NEAR(road_at(bump, 1.2).z, 0.05, 1e-15);
  EXPECT_NEAR(road_at(bump, 1.4).z, 0.1, 1e-15);
  EXPECT_NEAR(road_at(bump, 1.4).slope, 0.0, 1e-15);
  EXPECT_EQ(road_at(bump, 1.81).z, 0.0);
}

}  // namespace
}  // namespace floatframe::test
