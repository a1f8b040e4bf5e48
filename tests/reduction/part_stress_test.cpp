// Stress of reduced parts against direct solutions of the same finite elements.
#include "floatframe/reduction/part_stress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "floatframe/body/with_modes.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model/gauge.hpp"
#include "reduction/part_beam.hpp"
#include "support/arm_statics.hpp"
#include "support/quadratic_mesh.hpp"
#include "support/stressed_part.hpp"

namespace floatframe::test {
namespace {

VecX von_mises_of(const VecX& stress) {
  VecX out(stress.size() / 6);
  for (Eigen::Index k = 0; k < out.size(); ++k) out(k) = von_mises(stress.segment<6>(6 * k));
  return out;
}

/// Places by von Mises, the largest first; those that are not doubtful.
std::vector<int> hottest(const BodyStress& stress, const VecX& values) {
  std::vector<int> order;
  for (std::size_t k = 0; k < stress.places.size(); ++k)
    if (!stress.places[k].doubtful) order.push_back(static_cast<int>(k));
  std::sort(order.begin(), order.end(), [&](int a, int b) { return values(a) > values(b); });
  return order;
}

// Constraint modes answer forces at interfaces exactly, whatever else is among the modes.
TEST(PartStress, FiveStaticCasesOfTheArm) {
  PartOptions options;
  options.interfaces = arm_bores();
  options.modes = 6;
  const StressedPart arm(steel_part("aarm_coarse_mesh.inp.gz", "mm-t-s"), options);
  const std::vector<int> bushings = arm.rows_of({0, 1});
  for (const StaticCase& load : static_cases) {
    VecX f = VecX::Zero(arm.system.size());
    for (const int k : {2, 3, 4})
      if (load.interface == k || (load.interface < 0 && k > 2))
        f(arm.interfaces[k].rows[load.axis]) = load.load;
    const VecX u = arm.solve(f, bushings);
    for (int k = 2; k < 5; ++k)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(1e3 * u(arm.interfaces[k].rows[axis]), load.expected[6 * (k - 2) + axis],
                    1e-6 * std::abs(load.expected[6 * (k - 2) + axis]) + 2e-9);
    const VecX y = ldlt_solve(arm.reduced.body.K, MatX(arm.X.transpose() * f)).col(0);
    const VecX direct = von_mises_of(arm.stress_of(u));
    const VecX modal = von_mises_of(arm.stress().modes * y);
    const std::vector<int> order = hottest(arm.stress(), direct);
    double worst = 0.0;
    for (int i = 0; i < 20; ++i)
      worst = std::max(worst, std::abs(modal(order[i]) / direct(order[i]) - 1.0));
    std::printf("[ figure ] case %d %d: hottest %.4g MPa, modes at 20 places within %.1e\n",
                load.interface, load.axis, 1e-6 * direct(order[0]), worst);
    EXPECT_LT(worst, 1e-6);
  }
}

/// Loads at all interfaces, of the body and of its modes, that balance at the first interface.
void check_any_load(const StressedPart& part, const MatX& R, double limit) {
  std::srand(7);
  const Eigen::Index nm = part.X.cols();
  VecX c = VecX::Random(body_load_cases + nm);
  c.tail(nm) *= 0.1;
  VecX f = part.F * c;
  const double size = f.norm();
  for (std::size_t k = 1; k < part.interfaces.size(); ++k)
    for (const int row : part.interfaces[k].rows) f(row) += 0.1 * size * VecX::Random(1)(0);
  const VecX u = part.solve(f, part.rows_of({0}));
  EXPECT_LT((R.transpose() * f).norm(), 1e-8 * size);  // with the reactions nothing is left
  const VecX y = ldlt_solve(part.reduced.body.K, MatX(part.X.transpose() * f)).col(0);
  const VecX direct = part.stress_of(u), modes = part.stress().modes * y;
  const VecX all = modes + part.stress().loads * c;
  std::printf("[ figure ] of %.3g: by modes alone %.1e, with loads %.1e\n",
              direct.cwiseAbs().maxCoeff(),
              (modes - direct).cwiseAbs().maxCoeff() / direct.cwiseAbs().maxCoeff(),
              (all - direct).cwiseAbs().maxCoeff() / direct.cwiseAbs().maxCoeff());
  EXPECT_LT((all - direct).cwiseAbs().maxCoeff(), limit * direct.cwiseAbs().maxCoeff());
  EXPECT_GT((modes - direct).cwiseAbs().maxCoeff(), 1e-3 * direct.cwiseAbs().maxCoeff());

  // Modes that are left out move to the loads.
  std::vector<int> keep(static_cast<std::size_t>(nm));
  std::iota(keep.begin(), keep.end(), 0);
  keep.erase(keep.begin() + 1, keep.begin() + 3);
  const FlexibleBody fewer = with_modes(part.reduced.body, keep);
  const VecX y_k = ldlt_solve(fewer.K, MatX(part.X(Eigen::all, keep).transpose() * part.F * c));
  const VecX y_0 = ldlt_solve(part.reduced.body.K, MatX(part.X.transpose() * part.F * c));
  VecX c_k(body_load_cases + static_cast<Eigen::Index>(keep.size()));
  c_k.head<body_load_cases>() = c.head<body_load_cases>();
  VecX left = c;  // of the modes that stay
  left.tail(nm).setZero();
  for (std::size_t k = 0; k < keep.size(); ++k) {
    c_k(body_load_cases + static_cast<Eigen::Index>(k)) = c(body_load_cases + keep[k]);
    left(body_load_cases + keep[k]) = c(body_load_cases + keep[k]);
  }
  const VecX y_left = ldlt_solve(part.reduced.body.K, MatX(part.X.transpose() * part.F * left));
  const VecX y_kept =
      ldlt_solve(fewer.K, MatX(part.X(Eigen::all, keep).transpose() * part.F * left));
  const VecX whole = part.stress().modes * y_left + part.stress().loads * left;
  const VecX reduced = fewer.stress->modes * y_kept + fewer.stress->loads * c_k;
  EXPECT_LT((whole - reduced).norm(), 1e-6 * whole.norm());
}

MatX rigid_rows(const StressedPart& part) {
  return rigid_motions(part.model, part.system, Vec3::Zero());
}

TEST(PartStress, LoadsOfTheBodyWithConstraintModes) {
  const StressedPart part(beam(), both_ends(5));
  check_any_load(part, rigid_rows(part), 1e-7);
}

TEST(PartStress, LoadsOfTheBodyWithFreeModes) {
  PartOptions options = both_ends(3);
  options.method = ModeMethod::craig_chang;
  const StressedPart part(beam(), options);
  check_any_load(part, rigid_rows(part), 1e-6);
}

TEST(PartStress, LoadsOfTheArm) {
  PartOptions options;
  options.interfaces = arm_bores();
  options.modes = 4;
  const StressedPart arm(steel_part("aarm_coarse_mesh.inp.gz", "mm-t-s"), options);
  check_any_load(arm, rigid_rows(arm), 1e-6);
  std::size_t doubtful = 0;
  for (const StressPlace& place : arm.stress().places) doubtful += place.doubtful;
  EXPECT_GT(doubtful, 100u);
  EXPECT_LT(doubtful, arm.stress().places.size() / 2);
}

/// A brick beam 0.6 m x 30 x 30 mm of quadratic elements that follows its end A.
ReducedPart held_beam(bool tets) {
  const FeModel bricks = brick_beam(20, 2, 2, 0.6, 0.03);
  PartOptions options = both_ends(5);
  options.check_free_modes = false;
  options.reference = {BodyReference::Kind::node, "A"};
  return reduce_part(tets ? tets_of(bricks, true) : hex20_of(bricks), options);
}

// Away from the ends: M z / I under a force at the tip, rho W^2 (L^2 - x^2) / 2 of a beam that
// turns about its root.
TEST(PartStress, BeamsOfSolids) {
  for (const bool tets : {true, false}) {
    const ReducedPart part = held_beam(tets);
    const FlexibleBody& body = part.body;
    const BodyStress& stress = *body.stress;
    const double L = 0.6, a = 0.03, I = a * a * a * a / 12.0, W = 150.0;
    const Vec3 force(0.0, 0.0, 200.0);
    const VecX y = ldlt_solve(body.K, MatX(body.nodes[1].X.transpose() * force)).col(0);
    VecX c = VecX::Zero(body_load_cases + body.modes());
    c(3) = W * W;  // of -skew(w)^2 what pulls along the axis
    const VecX f = body.invariants.Si[0].row(0).transpose() * c(3);
    const VecX turning = ldlt_solve(body.K, MatX(f)).col(0);
    const VecX bent = stress.modes * y, spun = stress.modes * turning + stress.loads * c;
    const double root = 200.0 * L * 0.5 * a / I, pull = 0.5 * 7850.0 * W * W * L * L;
    double bending = 0.0, tension = 0.0;
    for (const StressPlace& place : stress.places) {
      const double x = place.p(0), z = place.p(2) - 0.5 * a;
      if (x < 0.25 * L || x > 0.75 * L) continue;
      const Eigen::Index row = 6 * (&place - stress.places.data());
      bending = std::max(bending, std::abs(bent(row) - 200.0 * (x - L) * z / I) / root);
      tension =
          std::max(tension, std::abs(spun(row) - 0.5 * 7850.0 * W * W * (L * L - x * x)) / pull);
    }
    std::printf(
        "[ figure ] %s beam: bending within %.1e of that at the root, tension within %.1e\n",
        tets ? "tet10" : "hex20", bending, tension);
    EXPECT_LT(bending, 0.02);
    EXPECT_LT(tension, 0.01);
  }
}

TEST(PartStress, NotRequested) {
  PartOptions options = both_ends(3);
  options.stresses = false;
  options.check_free_modes = false;
  EXPECT_EQ(reduce_part(beam(), options).body.stress, nullptr);
}

}  // namespace
}  // namespace floatframe::test
