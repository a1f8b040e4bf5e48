// The step itself: order of accuracy, free rotations without singularity, constraint levels after a
// step, and what a step that fails leaves behind.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/start/initial_state.hpp"
#include "support/descriptions.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

/// A formulation with its start state, in either set of coordinates.
template <class F>
struct System {
  System(const Model& model, StepOptions o)
      : tree(model, InertiaMethod::preprocessing),
        f(model, InertiaMethod::preprocessing),
        options(o) {
    options.penalty_mass =
        default_penalty_mass(model, std::is_same_v<F, AbsoluteFormulation> ? Coordinates::absolute
                                                                           : Coordinates::relative);
    const State start = relative_start(tree, Start::given);
    if constexpr (std::is_same_v<F, RelativeFormulation>) {
      state = start;
    } else {
      f.start_from(tree, start.q, start.v, state.q, state.v);
    }
    start_accelerations(f, state, options.penalty_mass);
  }
  void run(double h, long steps) {
    AugmentedLagrangian<F> integrator(f, options);
    for (long k = 0; k < steps; ++k) {
      const StepAttempt r = integrator.attempt(state, h);
      ASSERT_EQ(r.status, AttemptStatus::converged) << "step " << k;
      worst.position_violation = std::max(worst.position_violation, r.position_violation);
      worst.velocity_violation = std::max(worst.velocity_violation, r.velocity_violation);
    }
    evaluate_at(f, state.t, state.q, state.v);
  }
  RelativeFormulation tree;
  F f;
  StepOptions options;
  State state;
  StepAttempt worst;
};

RigidDescription rod_body(double length) {
  RigidDescription r;
  r.mass = 1.0;
  r.p_BC = Vec3(0.5 * length, 0.0, 0.0);
  r.J_C = Vec3(1e-4, length * length / 12.0, length * length / 12.0 + 1e-5).asDiagonal();
  return r;
}

/// Two rods in the x-z plane; the second hinge is out of line, so that the motion is spatial.
ModelDescription double_pendulum() {
  ModelDescription d;
  for (int k = 0; k < 2; ++k) {
    const std::string name = k == 0 ? "upper" : "lower";
    const Vec3 at(k, 0.0, 0.0);
    d.bodies.push_back(make_body(name, rod_body(1.0), at));
    d.joints.push_back(make_joint(name + "_hinge", JointType::revolute,
                                  k == 0 ? ground_name : "upper", name, at,
                                  k == 0 ? Vec3(0.0, 1.0, 0.0) : Vec3(0.3, 1.0, 0.2)));
    d.joints.back().velocity = {k == 0 ? 0.5 : -1.0};
  }
  d.outputs = {make_output("tip", place_on("lower", {2.0, 0.0, 0.0}), 0)};
  return d;
}

/// Tip position at t = 0.5, by steps of h.
template <class F>
std::vector<Vec3> tip_path(const Model& m, double h, double rho) {
  const StepOptions o{.spectral_radius = rho, .tolerance = 1e-12};
  System<F> s(m, o);
  std::vector<Vec3> path;
  const long every = std::lround(0.05 / h);
  for (int k = 0; k < 10; ++k) {
    s.run(h, every);
    path.push_back(s.f.motion().place(m.outputs[0].marker));
  }
  return path;
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, (a[k] - b[k]).norm());
  return worst;
}

template <class F>
void expect_second_order(double rho) {
  const Model m = build_model(double_pendulum());
  const std::vector<Vec3> exact = tip_path<F>(m, 1.5625e-4, 1.0);
  const double coarse = largest_distance(tip_path<F>(m, 5e-3, rho), exact);
  const double fine = largest_distance(tip_path<F>(m, 2.5e-3, rho), exact);
  const double order = std::log2(coarse / fine);
  EXPECT_GT(order, 1.9) << "rho " << rho;
  EXPECT_LT(order, 2.1) << "rho " << rho;
  EXPECT_LT(coarse, 1e-3);
}

TEST(Order, TrapezoidalRuleRelative) { expect_second_order<RelativeFormulation>(1.0); }
TEST(Order, TrapezoidalRuleAbsolute) { expect_second_order<AbsoluteFormulation>(1.0); }
TEST(Order, GeneralisedAlphaRelative) { expect_second_order<RelativeFormulation>(0.8); }
TEST(Order, GeneralisedAlphaAbsolute) { expect_second_order<AbsoluteFormulation>(0.8); }

TEST(Order, BothCoordinateSetsTakeTheSamePath) {
  const Model m = build_model(double_pendulum());
  const double coarse = largest_distance(tip_path<RelativeFormulation>(m, 5e-3, 1.0),
                                         tip_path<AbsoluteFormulation>(m, 5e-3, 1.0));
  const double fine = largest_distance(tip_path<RelativeFormulation>(m, 2.5e-3, 1.0),
                                       tip_path<AbsoluteFormulation>(m, 2.5e-3, 1.0));
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

/// An asymmetric top about its centre of mass, spun about its unstable axis.
Model top(JointType type) {
  ModelDescription d;
  d.gravity.setZero();
  const Mat3 J = Vec3(0.1, 0.2, 0.27).asDiagonal();
  BodyDescription b = make_body("top", RigidDescription{2.0, Vec3::Zero(), J});
  b.X_WB.R = rotation_exp(Vec3(0.3, -0.4, 0.2));
  d.bodies = {b};
  JointDescription j = make_joint("joint", type, ground_name, "top");
  const Vec3 spin = b.X_WB.R * Vec3(0.3, 7.0, 0.2);
  j.velocity.assign(type == JointType::free ? 3 : 0, 0.4);
  for (int k = 0; k < 3; ++k) j.velocity.push_back(spin[k]);
  d.joints.push_back(j);
  return build_model(d);
}

struct Drift {
  double momentum = 0.0, energy = 0.0, turned = 0.0, tilt = 0.0;
};

template <class F>
Drift spin(JointType type, double h) {
  const Model m = top(type);
  const StepOptions o{.tolerance = 1e-12};
  System<F> s(m, o);
  const Mat3 J = Vec3(0.1, 0.2, 0.27).asDiagonal();
  const auto momentum = [&]() -> Vec3 {
    const Mat3& R = s.f.motion().body(0).R_WB;
    return R * J * R.transpose() * s.f.motion().body(0).w_WB;
  };
  evaluate_at(s.f, 0.0, s.state.q, s.state.v);
  const Vec3 L0 = momentum();
  const Vec3 axis0 = s.f.motion().body(0).R_WB.col(1);
  const double E0 = s.f.kinetic_energy(s.state.v);
  Drift d;
  for (int k = 0; k < 40; ++k) {
    s.run(h, std::lround(0.1 / h));
    d.momentum = std::max(d.momentum, (momentum() - L0).norm() / L0.norm());
    d.turned += 0.1 * s.f.motion().body(0).w_WB.norm();
    d.tilt = std::max(d.tilt, 1.0 - s.f.motion().body(0).R_WB.col(1).dot(axis0));
    d.energy = std::max(d.energy, std::abs(s.f.kinetic_energy(s.state.v) / E0 - 1.0));
    evaluate_at(s.f, s.state.t, s.state.q, s.state.v);
  }
  return d;
}

template <class F>
void expect_momentum(JointType type) {
  const Drift coarse = spin<F>(type, 4e-3), fine = spin<F>(type, 2e-3);
  EXPECT_GT(coarse.turned, 4 * 2 * M_PI) << "several full turns";
  EXPECT_GT(coarse.tilt, 1.5) << "tumbles over";
  EXPECT_LT(coarse.momentum, 1e-2);
  EXPECT_LT(fine.momentum, 0.3 * coarse.momentum + 1e-10);
  EXPECT_LT(fine.energy, 0.3 * coarse.energy + 1e-10);
}

TEST(Spin, FreeBodyRelative) { expect_momentum<RelativeFormulation>(JointType::free); }
TEST(Spin, FreeBodyAbsolute) { expect_momentum<AbsoluteFormulation>(JointType::free); }
TEST(Spin, SphericalJointRelative) { expect_momentum<RelativeFormulation>(JointType::spherical); }
TEST(Spin, SphericalJointAbsolute) { expect_momentum<AbsoluteFormulation>(JointType::spherical); }

/// Crank, coupler and rocker with skew axes where the loop allows, and a rod that carries a mass.
Model four_bar() {
  ModelDescription d;
  const Vec3 points[] = {{0, 0, 0}, {0.3, 0, 0.4}, {1.2, 0, 0.6}, {1.0, 0, 0}};
  const char* names[] = {"crank", "coupler", "rocker"};
  for (int k = 0; k < 3; ++k) {
    const Vec3 x = points[k + 1] - points[k];
    BodyDescription b = make_body(names[k], rod_body(x.norm()), points[k]);
    b.X_WB.R.col(0) = x.normalized();
    b.X_WB.R.col(1) = Vec3::UnitY();
    b.X_WB.R.col(2) = b.X_WB.R.col(0).cross(Vec3::UnitY());
    d.bodies.push_back(b);
  }
  for (int k = 0; k < 4; ++k) {
    // One hinge, one universal and two balls: a spatial loop without redundant rows.
    const JointType type = k == 0   ? JointType::revolute
                           : k == 1 ? JointType::universal
                                    : JointType::spherical;
    JointDescription j =
        make_joint("joint_" + std::to_string(k), type, k % 3 == 0 ? ground_name : names[k - 1],
                   names[std::min(k, 2)], points[k], Vec3::UnitY());
    if (k == 0) j.velocity = {3.0};
    d.joints.push_back(j);
  }
  const Vec3 hung(0.3, 0.2, -0.3);
  d.bodies.push_back(
      make_body("load", RigidDescription{0.5, Vec3::Zero(), 0.001 * Mat3::Identity()}, hung));
  d.rods = {
      make_rod("rod", place_on("crank", points[1]), place_on("load", hung + Vec3(0, 0, 0.05)))};
  return build_model(d);
}

template <class F>
void expect_constraints_held(double rho) {
  const Model m = four_bar();
  const StepOptions o{.spectral_radius = rho};
  System<F> s(m, o);
  VecX rates(s.f.constraints()), accelerations(s.f.constraints());
  for (int k = 0; k < 20; ++k) {
    s.run(2e-3, 10);
    EXPECT_LT(largest(s.f.constraint_values()), 1e-9);
    s.f.constraint_rates(rates);
    EXPECT_LT(largest(rates), 1e-8);
    s.f.constraint_accelerations(s.state.a, accelerations);
    EXPECT_LT(largest(accelerations), 1e-4);
  }
  EXPECT_LT(s.worst.position_violation, 1e-9);
  EXPECT_LT(s.worst.velocity_violation, 1e-8);
}

TEST(Constraints, HeldAfterEveryStepRelative) {
  expect_constraints_held<RelativeFormulation>(1.0);
  expect_constraints_held<RelativeFormulation>(0.8);
}
TEST(Constraints, HeldAfterEveryStepAbsolute) {
  expect_constraints_held<AbsoluteFormulation>(1.0);
  expect_constraints_held<AbsoluteFormulation>(0.8);
}

bool same_bits(const VecX& a, const VecX& b) {
  if (a.size() != b.size()) return false;
  for (Eigen::Index k = 0; k < a.size(); ++k)  // NaN equals NaN here, -0 is not 0
    if (std::memcmp(&a[k], &b[k], sizeof(double)) != 0) return false;
  return true;
}

bool same_bits(const State& a, const State& b) {
  return a.t == b.t && same_bits(a.q, b.q) && same_bits(a.v, b.v) && same_bits(a.a, b.a) &&
         same_bits(a.a_alg, b.a_alg) && same_bits(a.lambda, b.lambda);
}

template <class F>
void expect_untouched() {
  const Model m = four_bar();
  for (const int limit : {1, 2, 3}) {
    StepOptions o;
    o.max_iterations = limit;
    o.tolerance = 1e-30;  // out of reach
    System<F> s(m, o);
    const State before = s.state;
    AugmentedLagrangian<F> integrator(s.f, s.options);
    const StepAttempt r = integrator.attempt(s.state, 1e-2);
    EXPECT_EQ(r.status, AttemptStatus::not_converged);
    EXPECT_EQ(r.iterations, 2 * limit);  // once more with a stiffer penalty
    EXPECT_EQ(r.factorizations, 2 * limit);
    EXPECT_TRUE(same_bits(s.state, before));
    ASSERT_GE(r.coordinate, 0);
    ASSERT_LT(r.coordinate, s.f.velocities());
    const std::string who = s.f.coordinate_owner(r.coordinate);
    EXPECT_TRUE(who.find("joint '") != std::string::npos || who.find("body '") != std::string::npos)
        << who;
    // With the tolerance back the same state goes on as if nothing had been tried.
    System<F> fresh(m, StepOptions{});
    s.options = fresh.options;
    AugmentedLagrangian<F> again(s.f, s.options), first(fresh.f, fresh.options);
    EXPECT_EQ(again.attempt(s.state, 1e-3).status, AttemptStatus::converged);
    EXPECT_EQ(first.attempt(fresh.state, 1e-3).status, AttemptStatus::converged);
    EXPECT_TRUE(same_bits(s.state, fresh.state));
  }
}

TEST(Failure, StepWithoutConvergenceLeavesTheStateRelative) {
  expect_untouched<RelativeFormulation>();
}
TEST(Failure, StepWithoutConvergenceLeavesTheStateAbsolute) {
  expect_untouched<AbsoluteFormulation>();
}

TEST(Failure, OpenConstraintIsNamed) {
  // Increments are accepted at once, constraints never.
  const Model m = four_bar();
  const StepOptions o{.tolerance = 1e30, .max_iterations = 4, .position_tolerance = 0.0};
  System<RelativeFormulation> s(m, o);
  const State before = s.state;
  AugmentedLagrangian<RelativeFormulation> integrator(s.f, s.options);
  const StepAttempt r = integrator.attempt(s.state, 1e-2);
  EXPECT_EQ(r.status, AttemptStatus::not_converged);
  EXPECT_EQ(r.coordinate, -1);
  EXPECT_GE(r.constraint, 0);
  EXPECT_LT(r.constraint, s.f.constraints());
  EXPECT_TRUE(same_bits(s.state, before));
}

TEST(Failure, MasslessFreedomIsASingularTangent) {
  ModelDescription d = double_pendulum();
  std::get<RigidDescription>(d.bodies[1].kind) = RigidDescription{};
  const Model m = build_model(d);
  RelativeFormulation f(m, InertiaMethod::preprocessing);
  State state;
  f.start(state.q, state.v);
  state.a = state.a_alg = VecX::Zero(f.velocities());
  state.lambda = VecX::Zero(0);
  const State before = state;
  AugmentedLagrangian<RelativeFormulation> integrator(f, StepOptions{});
  const StepAttempt r = integrator.attempt(state, 1e-2);
  EXPECT_EQ(r.status, AttemptStatus::singular_tangent);
  EXPECT_EQ(f.coordinate_owner(r.coordinate), "joint 'lower_hinge'");
  EXPECT_TRUE(same_bits(state, before));
}

/// A massless arm on a hinge with a torsion spring; a stone hangs from its tip by a spring. The arm
/// is in balance at the start: what has no mass would jump to it.
Model massless_arm() {
  ModelDescription d;
  const Vec3 at(1.0, 0.1, -0.8);
  d.bodies = {make_body("arm", RigidDescription{}),
              make_body("stone", RigidDescription{1.0, Vec3::Zero(), 0.01 * Mat3::Identity()}, at)};
  d.joints = {
      make_joint("hinge", JointType::revolute, ground_name, "arm", Vec3::Zero(), Vec3::UnitY())};
  JointSpring torsion;
  torsion.joint = "hinge";
  const double length = Vec3(0.0, 0.1, -0.8).norm(), pull = 50.0 * (length - 0.7);
  torsion.spring = PiecewisePolynomial::polynomial({pull * 0.8 / length, 20.0});
  SpringDamper string;
  string.a = place_on("arm", {1.0, 0.0, 0.0});
  string.b = place_on("stone", at);
  string.spring = PiecewisePolynomial::linear(50.0, 0.7);
  d.forces = {{"torsion", torsion, {}}, {"string", string, {}}};
  d.outputs = {make_output("tip", string.a, 0)};
  return build_model(d);
}

/// What holds the arm in the projections, 0.01 s K, is 1e-16 of the penalty of its constraints. The
/// arm follows the stone at once, so that nothing but rounding tells the formulations apart.
TEST(MasslessFreedom, HeldByASpringIsNoSingularTangent) {
  const Model m = massless_arm();
  const StepOptions o{.tolerance = 1e-12};
  for (const double h : {1e-3, 2e-4, 1e-4}) {
    System<RelativeFormulation> r(m, o);
    System<AbsoluteFormulation> a(m, o);
    const auto tip = [&](const auto& s) -> Vec3 { return s.f.motion().place(m.outputs[0].marker); };
    double d = 0.0, moved = 0.0;
    const Vec3 from = tip(r);
    for (int k = 0; k < 10; ++k) {
      ASSERT_NO_FATAL_FAILURE(r.run(h, std::lround(0.02 / h)));
      ASSERT_NO_FATAL_FAILURE(a.run(h, std::lround(0.02 / h)));
      d = std::max(d, (tip(r) - tip(a)).norm());
      moved = std::max(moved, (tip(r) - from).norm());
    }
    EXPECT_GT(moved, 0.05);
    EXPECT_LT(a.worst.position_violation, 1e-9);
    EXPECT_LT(a.worst.velocity_violation, 1e-8);
    EXPECT_LT(d, 1e-11) << h;
  }
}

TEST(Failure, StateThatIsNotFiniteIsRefused) {
  const Model m = build_model(double_pendulum());
  System<RelativeFormulation> s(m, StepOptions{});
  s.state.v[0] = std::numeric_limits<double>::quiet_NaN();
  const State before = s.state;
  AugmentedLagrangian<RelativeFormulation> integrator(s.f, s.options);
  EXPECT_NE(integrator.attempt(s.state, 1e-3).status, AttemptStatus::converged);
  EXPECT_TRUE(same_bits(s.state, before));
}

}  // namespace
}  // namespace floatframe::test
