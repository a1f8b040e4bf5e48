// Force elements between two markers in any motion: work, reaction, dissipation and tangents, over
// every type; then numbers computed by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/model/force_evaluation.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

using Vec12 = Eigen::Matrix<double, 12, 1>;

struct Case {
  std::string name;
  Force force;
};

Model flat_road() {
  Model m;
  m.roads.push_back({"flat", PiecewisePolynomial(), {}});
  return m;
}

/// Elements of one type with all their options. A new type must be added here to compile.
std::vector<Case> cases_of(ForceType type) {
  Random random(21);
  Force f;
  f.type = type;
  f.a = 0;
  f.b = 1;
  f.spring = PiecewisePolynomial::polynomial({20.0, 300.0, 40.0, 90.0}) + ramp_above(0.6, 500.0);
  f.damper = table_function({{-1.0, -8.0}, {0.0, 0.0}, {2.0, 30.0}}, Interpolation::cubic,
                            Beyond::tangent);
  f.axis = random.vec3().normalized();
  switch (type) {
    case ForceType::spring_damper:
      return {{"spring_damper", f}};
    case ForceType::guided_spring:
      return {{"guided_spring", f}};
    case ForceType::joint_spring: {
      Case along{"joint_spring_along", f}, about{"joint_spring_about", f};
      about.force.rotational = true;
      return {along, about};
    }
    case ForceType::tyre: {
      f.a = -1;
      f.road = 0;
      f.radius = 3.0;  // every random centre below touches the road
      f.stiffness = 2e4;
      f.damping = 50.0;
      f.axis = Vec3::UnitY();
      Case vertical{"tyre_vertical", f}, radial{"tyre_radial", f};
      radial.force.law = TyreLaw::radial;
      return {vertical, radial};
    }
    case ForceType::force:
    case ForceType::torque: {
      f.a = -1;
      f.magnitude.pieces = PiecewisePolynomial::polynomial({2.0, 3.0});
      Case fixed{std::string(force_type_name(type)) + "_fixed", f};
      Case follows{std::string(force_type_name(type)) + "_following", f};
      follows.force.follows = true;
      return {fixed, follows};
    }
  }
  return {};
}

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const ForceType type :
       {ForceType::spring_damper, ForceType::guided_spring, ForceType::joint_spring,
        ForceType::tyre, ForceType::force, ForceType::torque})
    for (const Case& c : cases_of(type)) all.push_back(c);
  return all;
}

struct Pair {
  MarkerState a, b;
};

Vec12 stacked(const WrenchRow& g) {
  Vec12 x;
  x << g.Fa, g.Ta, g.Fb, g.Tb;
  return x;
}

class ForceElement : public ::testing::TestWithParam<Case> {
 protected:
  /// Random motion; a hinge spring gets markers that share the hinge axis, a radial tyre an upright
  /// wheel.
  static Pair random_pair(Random& random) {
    Pair p;
    for (MarkerState* s : {&p.a, &p.b}) {
      s->r = random.vec3(0.8);
      s->R = random.rotation();
      s->v = random.vec3(1.0);
      s->w = random.vec3(1.0);
      s->a_bias.setZero();
      s->alpha_bias.setZero();
    }
    const Force& f = GetParam().force;
    if (f.rotational) {
      p.b.R = p.a.R * rotation_exp(random(-2.5, 2.5) * Vec3::UnitZ());
      p.b.w = p.a.w + random() * p.a.R.col(2);
    }
    if (f.type == ForceType::tyre) p.b.R = rotation_exp(random(-3.0, 3.0) * Vec3::UnitZ());
    return p;
  }
  static Pair moved(const Pair& p, const Vec12& x) {
    Pair q = p;
    q.a.r += x.segment<3>(0);
    q.a.R = rotation_exp(x.segment<3>(3)) * p.a.R;
    q.b.r += x.segment<3>(6);
    q.b.R = rotation_exp(x.segment<3>(9)) * p.b.R;
    return q;
  }
  static Pair with_velocity(const Pair& p, const Vec12& x) {
    Pair q = p;
    q.a.v = x.segment<3>(0);
    q.a.w = x.segment<3>(3);
    q.b.v = x.segment<3>(6);
    q.b.w = x.segment<3>(9);
    return q;
  }
  static Vec12 velocity(const Pair& p) {
    Vec12 x;
    x << p.a.v, p.a.w, p.b.v, p.b.w;
    return x;
  }
  /// Small motions that the joint of the element allows.
  static std::vector<Vec12> directions(const Pair& p) {
    std::vector<Vec12> list;
    const Force& f = GetParam().force;
    if (!f.rotational) {
      for (int k = 0; k < 12; ++k) {
        if (f.type == ForceType::tyre && (k == 9 || k == 10)) continue;  // the wheel stays upright
        list.push_back(Vec12::Unit(k));
      }
      return list;
    }
    for (int k = 0; k < 3; ++k) {
      Vec12 x = Vec12::Zero();
      x[3 + k] = x[9 + k] = 1.0;  // both turn together
      list.push_back(x);
      list.push_back(Vec12::Unit(k));
      list.push_back(Vec12::Unit(6 + k));
    }
    Vec12 about = Vec12::Zero();
    about.tail<3>() = p.a.R.col(2);
    list.push_back(about);
    return list;
  }
  static ForceState evaluate(const Pair& p, double t = 0.3) {
    static const Model model = flat_road();
    ForceState s;
    evaluate_force(model, GetParam().force, p.a, p.b, Vec3::Zero(), t, 0.0, s);
    return s;
  }
  static bool applied() {
    return GetParam().force.type == ForceType::force || GetParam().force.type == ForceType::torque;
  }
};

TEST_P(ForceElement, ActionEqualsReaction) {
  if (GetParam().force.a < 0) return;
  Random random(1);
  for (int k = 0; k < 20; ++k) {
    const Pair p = random_pair(random);
    const ForceState s = evaluate(p);
    const WrenchRow& w = s.wrench;
    EXPECT_LT((w.Fa + w.Fb).norm(), 1e-12 * (1 + w.Fa.norm()));
    const Vec3 moment = w.Ta + w.Tb + p.a.r.cross(w.Fa) + p.b.r.cross(w.Fb);
    EXPECT_LT(moment.norm(), 1e-12 * (1 + w.Fa.norm() + w.Ta.norm()));
    EXPECT_GT(w.Fa.norm() + w.Ta.norm(), 1.0);
  }
}

TEST_P(ForceElement, WorkIsTheLossOfPotentialEnergy) {
  if (applied()) return;
  Random random(2);
  for (int k = 0; k < 20; ++k) {
    const Pair p = with_velocity(random_pair(random), Vec12::Zero());
    const Vec12 w = stacked(evaluate(p).wrench);
    const double h = 1e-5;
    for (const Vec12& x : directions(p)) {
      const double rate =
          (evaluate(moved(p, h * x)).energy - evaluate(moved(p, -h * x)).energy) / (2 * h);
      EXPECT_NEAR(w.dot(x), -rate, 1e-5 * (1.0 + w.norm()));
    }
  }
}

TEST_P(ForceElement, DampingTakesEnergyOut) {
  if (applied()) return;
  Random random(3);
  for (int k = 0; k < 20; ++k) {
    const Pair p = random_pair(random);
    const ForceState s = evaluate(p), rest = evaluate(with_velocity(p, Vec12::Zero()));
    const double power = (stacked(s.wrench) - stacked(rest.wrench)).dot(velocity(p));
    EXPECT_LE(power, 1e-12);
    EXPECT_NEAR(std::abs(power), std::abs((s.force - rest.force) * s.rate), 1e-9 * (1 - power));
    EXPECT_GT(std::abs(power), 1e-9);
  }
}

TEST_P(ForceElement, LengthAndRateBelongTogether) {
  if (applied()) return;
  Random random(4);
  for (int k = 0; k < 20; ++k) {
    const Pair p = random_pair(random);
    const double h = 1e-6;
    const Vec12 v = velocity(p);
    const double rate =
        (evaluate(moved(p, h * v)).length - evaluate(moved(p, -h * v)).length) / (2 * h);
    EXPECT_NEAR(evaluate(p).rate, rate, 1e-8);
  }
}

// The first row of the tangent is the slope of the scalar force; a tyre pushes, so its force falls
// with the height.
TEST_P(ForceElement, TangentRowIsTheSlopeOfTheForce) {
  if (applied()) {
    EXPECT_EQ(evaluate(Pair{}).row_count, 0);
    return;
  }
  Random random(5);
  const double sign = GetParam().force.type == ForceType::tyre ? -1.0 : 1.0;
  for (int k = 0; k < 20; ++k) {
    const Pair p = random_pair(random), rest = with_velocity(p, Vec12::Zero());
    const ForceState s = evaluate(p);
    ASSERT_GE(s.row_count, 1);
    const Vec12 g = stacked(s.rows[0].g);
    const double h = 1e-6;
    for (const Vec12& x : directions(p)) {
      const double by_length =
          (evaluate(moved(rest, h * x)).force - evaluate(moved(rest, -h * x)).force) / (2 * h);
      EXPECT_NEAR(by_length, sign * s.rows[0].k * g.dot(x), 1e-5 * (1 + s.rows[0].k));
      const Vec12 v = velocity(p);
      const double by_rate = (evaluate(with_velocity(p, v + h * x)).force -
                              evaluate(with_velocity(p, v - h * x)).force) /
                             (2 * h);
      EXPECT_NEAR(by_rate, sign * s.rows[0].c * g.dot(x), 1e-5 * (1 + s.rows[0].c));
    }
  }
}

TEST_P(ForceElement, RowsOfASpringHoldItsWholeStiffness) {
  if (GetParam().force.type != ForceType::spring_damper) return;
  Random random(6);
  for (int k = 0; k < 20; ++k) {
    const Pair p = with_velocity(random_pair(random), Vec12::Zero());
    const ForceState s = evaluate(p);
    const double h = 1e-6;
    for (int j = 0; j < 12; ++j) {
      Vec12 by_rows = Vec12::Zero();
      for (int r = 0; r < s.row_count; ++r) {
        const Vec12 g = stacked(s.rows[r].g);
        by_rows += s.rows[r].k * g[j] * g;
      }
      const Vec12 x = Vec12::Unit(j);
      const Vec12 numeric = -(stacked(evaluate(moved(p, h * x)).wrench) -
                              stacked(evaluate(moved(p, -h * x)).wrench)) /
                            (2 * h);
      EXPECT_LT((by_rows - numeric).norm(), 1e-4 * (1 + by_rows.norm()));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryType, ForceElement, ::testing::ValuesIn(all_cases()),
                         [](const auto& c) { return c.param.name; });

// -------------------------------------------------------------------------------------------
// numbers by hand

MarkerState at(const Vec3& r, const Mat3& R = Mat3::Identity()) {
  const Vec3 zero = Vec3::Zero();
  return {r, R, zero, zero, zero, zero};
}

ForceState tyre(TyreLaw law, const PiecewisePolynomial& road, const MarkerState& centre,
                double damping = 0.0) {
  Model m;
  m.roads.push_back({"road", road, {}});
  Force f;
  f.type = ForceType::tyre;
  f.law = law;
  f.b = 0;
  f.road = 0;
  f.radius = 0.5;
  f.stiffness = 1e4;
  f.damping = damping;
  f.axis = Vec3::UnitY();
  ForceState s;
  evaluate_force(m, f, centre, centre, Vec3::Zero(), 0.0, 0.0, s);
  return s;
}

const PiecewisePolynomial slope = PiecewisePolynomial::polynomial({0.0, 0.75});

TEST(Tyre, RadialOnASlopeOfThreeToFour) {
  // Centre 0.4 m above the road below it: F = 1e4 0.1 0.8 = 800 N along (-0.6, 0, 0.8), through the
  // centre because the wheel stands in the x-z plane.
  const ForceState s = tyre(TyreLaw::radial, slope, at(Vec3(2.0, 7.0, 1.9)));
  EXPECT_NEAR(s.force, 800.0, 1e-9);
  EXPECT_NEAR(s.length, 0.4, 1e-15);
  EXPECT_LT((s.wrench.Fb - Vec3(-480.0, 0.0, 640.0)).norm(), 1e-9);
  EXPECT_LT(s.wrench.Tb.norm(), 1e-9);
}

TEST(Tyre, RadialWithCamberOnFlatGround) {
  // Axis tilted by atan(1/2): the contact lies 0.4/2 beside the centre; 1000 N make 200 N m.
  const Mat3 R = rotation_exp(std::atan(0.5) * Vec3::UnitX());
  const ForceState s = tyre(TyreLaw::radial, PiecewisePolynomial(), at(Vec3(0.0, 0.0, 0.4), R));
  EXPECT_LT((s.wrench.Fb - Vec3(0.0, 0.0, 1000.0)).norm(), 1e-9);
  EXPECT_LT((s.wrench.Tb - Vec3(200.0, 0.0, 0.0)).norm(), 1e-9);
}

TEST(Tyre, VerticalPushesUpWhateverTheSlope) {
  MarkerState centre = at(Vec3(2.0, 7.0, 1.9));
  ForceState s = tyre(TyreLaw::vertical, slope, centre, 100.0);
  EXPECT_LT((s.wrench.Fb - Vec3(0.0, 0.0, 1000.0)).norm(), 1e-9);
  // Driving up the slope at 2 m/s the road rises by 1.5 m/s: 150 N more.
  centre.v = Vec3(2.0, 0.0, 0.0);
  s = tyre(TyreLaw::vertical, slope, centre, 100.0);
  EXPECT_NEAR(s.force, 1150.0, 1e-9);
}

TEST(Tyre, NeverPulls) {
  for (const TyreLaw law : {TyreLaw::vertical, TyreLaw::radial}) {
    ForceState s = tyre(law, slope, at(Vec3(0.0, 0.0, 0.51)));
    EXPECT_EQ(s.force, 0.0);
    EXPECT_EQ(s.row_count, 0);
    EXPECT_EQ(s.wrench.Fb.norm(), 0.0);
    MarkerState leaving = at(Vec3(0.0, 0.0, 0.4));
    leaving.v = Vec3(0.0, 0.0, 11.0);  // the damper would pull with 1100 N
    s = tyre(law, slope, leaving, 100.0);
    EXPECT_EQ(s.force, 0.0);
  }
}

TEST(Tyre, RoadIsFoundFromTheEvaluationOrigin) {
  Model m;
  m.roads.push_back({"road", slope, {}});
  Force f;
  f.type = ForceType::tyre;
  f.b = 0;
  f.road = 0;
  f.radius = 0.5;
  f.stiffness = 1e4;
  ForceState s;
  const MarkerState centre = at(Vec3(1.0, 0.0, 0.9));
  evaluate_force(m, f, centre, centre, Vec3(1.0, 0.0, 1.0), 0.0, 0.0, s);
  EXPECT_NEAR(s.length, 0.4, 1e-15);
}

TEST(AppliedLoad, DirectionTurnsOnlyIfItFollows) {
  const Mat3 R = rotation_exp(0.5 * M_PI * Vec3::UnitZ());
  for (const ForceType type : {ForceType::force, ForceType::torque})
    for (const bool follows : {false, true}) {
      Force f;
      f.type = type;
      f.b = 0;
      f.axis = Vec3(2.0, 0.0, 0.0);
      f.follows = follows;
      f.magnitude = {PiecewisePolynomial::polynomial({1.0}), 3.0, 0.25, 0.0};
      ForceState s;
      const MarkerState b = at(Vec3(1.0, 2.0, 3.0), R);
      evaluate_force(Model{}, f, b, b, Vec3::Zero(), 1.0, 0.0, s);  // 1 + 3 sin(pi/2) = 4
      const Vec3 load = follows ? Vec3(0.0, 8.0, 0.0) : Vec3(8.0, 0.0, 0.0);
      EXPECT_LT(((type == ForceType::force ? s.wrench.Fb : s.wrench.Tb) - load).norm(), 1e-14);
      EXPECT_EQ((type == ForceType::force ? s.wrench.Tb : s.wrench.Fb).norm(), 0.0);
      EXPECT_NEAR(s.force, 4.0, 1e-14);
    }
}

TEST(JointSpring, FollowsSeveralTurns) {
  Force f;
  f.type = ForceType::joint_spring;
  f.rotational = true;
  f.spring = PiecewisePolynomial::linear(2.0, 0.0);
  double reference = 0.0;
  for (double angle = 0.0; angle < 20.0; angle += 0.7) {
    ForceState s;
    evaluate_force(Model{}, f, at(Vec3::Zero()),
                   at(Vec3::Zero(), rotation_exp(std::remainder(angle, 2 * M_PI) * Vec3::UnitZ())),
                   Vec3::Zero(), 0.0, reference, s);
    reference = s.length;
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
