// Contracts of the formulations in builds with asserts: the order of calls, sizes, and NaN in what
// was not asked for.
#include <gtest/gtest.h>

#include "support/descriptions.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

class Contracts : public testing::TestWithParam<Coordinates> {
 protected:
  void SetUp() override {
#ifdef NDEBUG
    GTEST_SKIP() << "built without asserts";
#endif
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    RandomSystem s(5);
    s.add_body("arm", 2);
    s.add_joint("hinge", JointType::revolute, ground_name, 0, "arm", 0);
    s.add_body("weight", 0);
    s.add_joint("ball", JointType::spherical, "arm", 1, "weight", 0);
    s.d.rods = {make_rod("rod", s.at(ground_name, 0), s.at("weight", 0))};
    model_ = std::make_unique<Model>(build_model(s.d));
    RelativeFormulation tree(*model_, InertiaMethod::preprocessing);
    f_ = make_formulation(GetParam(), *model_, InertiaMethod::preprocessing);
    tree.start(q_, v_);
    if (GetParam() == Coordinates::relative) return;
    const VecX q = q_, v = v_;
    static_cast<AbsoluteFormulation&>(*f_).start_from(tree, q, v, q_, v_);
  }

  std::unique_ptr<Model> model_;
  std::unique_ptr<Formulation> f_;
  VecX q_, v_;
};

TEST_P(Contracts, CallsOutOfOrderEndTheProgram) {
  Formulation& f = *f_;
  VecX b = VecX::Zero(f.velocities());
  const VecX lambda = VecX::Zero(f.constraints());
  EXPECT_DEATH(f.velocities(v_), "CallOrder::positions");
  f.positions(0.0, q_);
  EXPECT_DEATH(f.dynamics(), "CallOrder::velocities");
  EXPECT_DEATH(f.motion(), "CallOrder::velocities");
  EXPECT_DEATH(f.constraint_values(), "CallOrder::velocities");
  f.velocities(v_);
  EXPECT_DEATH(f.residual(b, lambda, 0.0, b), "CallOrder::dynamics");
  EXPECT_DEATH(f.factorize_metric(1.0, 1.0, 1), "has_masses");
  EXPECT_DEATH(f.motion({.accelerations = true}), "has_accelerations");
  EXPECT_DEATH(f.motion({.energies = true}), "CallOrder::dynamics");
  f.dynamics();
  EXPECT_DEATH(f.factorize(1.0, 0.0, 1.0, 1.0, 0), "CallOrder::residual");
  EXPECT_DEATH(f.solve(b, 1), "has_factors");
  ASSERT_LT(f.factorize_metric(1e-6, 1.0, 1), 0);
  f.solve(b, 1);
  EXPECT_DEATH(f.solve(b, 0), "has_factors");
}

TEST_P(Contracts, WrongSizesEndTheProgram) {
  const VecX longer = VecX::Zero(q_.size() + 1);
  EXPECT_DEATH(f_->positions(0.0, longer), "q.size\\(\\)");
  kinematics_at(*f_, 0.0, q_, v_);
  EXPECT_DEATH(f_->velocities(longer), "v.size\\(\\)");
  VecX rates(f_->constraints() + 1);
  EXPECT_DEATH(f_->constraint_rates(rates), "out.size\\(\\)");
}

TEST_P(Contracts, LevelsThatNobodyAskedForAreNan) {
  kinematics_at(*f_, 0.0, q_, v_);
  f_->dynamics();
  f_->set_accelerations(VecX::Zero(f_->velocities()));
  const BodyKinematics& arm = f_->motion().body(0);
  EXPECT_TRUE(arm.p_WB.allFinite() && arm.v_WB.allFinite());
  EXPECT_TRUE(arm.a_WB.hasNaN() && arm.alpha_WB.hasNaN() && arm.ydd.hasNaN());
  EXPECT_TRUE(std::isnan(arm.kinetic_energy) && std::isnan(arm.gravity_energy));
  f_->motion({.accelerations = true, .energies = true});
  EXPECT_TRUE(arm.a_WB.allFinite() && arm.alpha_WB.allFinite() && arm.ydd.allFinite());
  EXPECT_TRUE(std::isfinite(arm.kinetic_energy) && std::isfinite(arm.elastic_energy));
}

TEST_P(Contracts, VelocitiesAreNanAfterPositions) {
  kinematics_at(*f_, 0.0, q_, v_);
  const int tip = model_->elements.back().markers[1];
  EXPECT_TRUE(f_->marker(tip).v.allFinite());
  f_->positions(0.0, q_);
  EXPECT_TRUE(f_->marker(tip).r.allFinite());
  EXPECT_TRUE(f_->marker(tip).v.hasNaN());
}

INSTANTIATE_TEST_SUITE_P(Coordinates, Contracts,
                         testing::Values(Coordinates::relative, Coordinates::absolute));

}  // namespace
}  // namespace floatframe::test
