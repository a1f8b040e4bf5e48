// Damping of reduced bodies: which modes have the fraction that is given, whatever the body frame
// and the mode set; a damping matrix of another program.
#include <gtest/gtest.h>

#include "floatframe/body/modal_damping.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "reduction/part_beam.hpp"
#include "support/error_of.hpp"
#include "support/iltis_parts.hpp"

namespace floatframe::test {
namespace {

ModalDamping damping_of(double fraction, DampingReference reference) {
  ModalDamping d = fraction;
  d.reference = reference;
  return d;
}

FlexibleBody damped_beam(PartOptions options, const ModalDamping& damping) {
  options.damping = damping;
  return reduce_part(beam(), options).body;
}

/// Of D against K: what a damping is, in whatever amplitudes of the same deformations.
VecX loss(const FlexibleBody& body) { return generalised_eigenvalues(body.D, body.K).values; }

double least_eigenvalue(const MatX& D) { return symmetric_eigenvalues(D)(0); }

/// Fractions of critical damping of the free body, from M(0), diag(0, K) and diag(0, D).
std::vector<double> free_fractions(const FlexibleBody& body) {
  const Eigen::Index nm = body.modes();
  const MatX M = mass_matrix_at_rest(body.invariants);
  MatX K = MatX::Zero(6 + nm, 6 + nm), D = K;
  K.bottomRightCorner(nm, nm) = body.K;
  D.bottomRightCorner(nm, nm) = body.D;
  const SymmetricEigen modes = generalised_eigen(K, M);
  std::vector<double> out;
  for (Eigen::Index k = 6; k < 6 + nm; ++k)
    out.push_back(modes.vectors.col(k).dot(D * modes.vectors.col(k)) /
                  (2.0 * std::sqrt(modes.values(k))));
  return out;
}

TEST(Damping, OfTheFreePartIsTheSameInEveryBodyFrame) {
  PartOptions node = both_ends();
  node.reference = {BodyReference::Kind::node, "A"};
  const ModalDamping free = damping_of(0.02, DampingReference::free);
  const FlexibleBody mean = damped_beam(both_ends(), free), held = damped_beam(node, free);
  for (const FlexibleBody& body : {mean, held})
    for (const double fraction : free_fractions(body)) EXPECT_NEAR(fraction, 0.02, 1e-8);
  EXPECT_LT((loss(mean) - loss(held)).norm(), 1e-8 * loss(mean).norm());
  // With mean axes that is what a fraction without a reference is; at a node it is another one.
  EXPECT_LT((damped_beam(both_ends(), 0.02).D - mean.D).norm(), 1e-9 * mean.D.norm());
  const double first = free_fractions(damped_beam(node, 0.02)).front();
  EXPECT_GT(first, 0.05);
}

TEST(Damping, OfTheMountedPartBelongsToTheFixedInterfaceModes) {
  const ModalDamping mounted = damping_of(0.02, DampingReference::mounted);
  PartOptions node = both_ends();
  node.reference = {BodyReference::Kind::node, "B"};
  PartOptions one = both_ends(6);
  one.interfaces = {bore("A")};
  for (const PartOptions& options : {both_ends(), node, one}) {
    const FlexibleBody body = damped_beam(options, mounted);
    const auto modes = damped_modes(body, DampingReference::mounted);
    ASSERT_EQ(static_cast<Eigen::Index>(modes.size()), body.fixed_interface_frequencies.size());
    for (std::size_t k = 0; k < modes.size(); ++k) {
      EXPECT_NEAR(modes[k].frequency / body.fixed_interface_frequencies(k), 1.0, 1e-7);
      EXPECT_NEAR(modes[k].fraction, 0.02, 1e-8);
    }
    // Motions of the interfaces are damped too.
    EXPECT_GT(least_eigenvalue(body.D), 0.0);
  }
  const VecX mean = loss(damped_beam(both_ends(), mounted)),
             held = loss(damped_beam(node, mounted));
  EXPECT_LT((mean - held).norm(), 1e-8 * mean.norm());
}

// Two interfaces leave six deformations by their motions alone. In them the damping is 2 zeta/w
// times the stiffness at the frequency that is given.
TEST(Damping, OfInterfaceMotionsAtAFrequency) {
  ModalDamping at = damping_of(0.02, DampingReference::mounted);
  at.interface_frequency = 40.0;
  const FlexibleBody body = damped_beam(both_ends(), at);
  const ReferenceModes modes = reference_modes(body, DampingReference::mounted);
  ASSERT_EQ(modes.mu.size() - modes.held, 6);
  const MatX W = modes.Y.rightCols(6), H = modes.Y.leftCols(modes.held);
  EXPECT_LT((H.transpose() * body.K * W).norm(), 1e-8);
  EXPECT_LT((W.transpose() * body.D * W - 0.04 / omega_of(40.0) * MatX::Identity(6, 6)).norm(),
            1e-8 * 0.04 / omega_of(40.0));
  for (const DampedMode& m : damped_modes(body, DampingReference::mounted))
    EXPECT_NEAR(m.fraction, 0.02, 1e-8);
  // By themselves they vibrate as the free part does in these deformations.
  const FlexibleBody own = damped_beam(both_ends(), damping_of(0.02, DampingReference::mounted));
  for (Eigen::Index k = 0; k < 6; ++k)
    EXPECT_NEAR(W.col(k).dot(own.D * W.col(k)) / (0.04 * std::sqrt(modes.mu(modes.held + k))), 1.0,
                1e-7);
}

TEST(Damping, OfFreeModesAndCraigChangHoldsTheInterfacesWithinTheModes) {
  for (const ModeMethod method : {ModeMethod::free_free, ModeMethod::craig_chang}) {
    PartOptions options = both_ends(20);
    options.interfaces = {bore("A")};
    options.method = method;
    const FlexibleBody body = damped_beam(options, damping_of(0.03, DampingReference::mounted));
    const auto modes = damped_modes(body, DampingReference::mounted);
    ASSERT_FALSE(modes.empty());
    for (const DampedMode& m : modes) EXPECT_NEAR(m.fraction, 0.03, 1e-7);
    EXPECT_GT(least_eigenvalue(body.D), -1e-12 * body.D.norm());
    // The cantilever, from above: its modes are within those of the body.
    PartOptions fixed = options;
    fixed.method = ModeMethod::craig_bampton;
    const double exact = damped_beam(fixed, 0.01).fixed_interface_frequencies(0);
    const double found = modes.front().frequency / exact;
    EXPECT_GT(found, 1.0 - 1e-6);
    // Free modes alone hardly bend at a held end.
    EXPECT_LT(found, method == ModeMethod::craig_chang ? 1.001 : 1.2);
  }
}

TEST(Damping, ByModesBandsAndRayleigh) {
  const FlexibleBody plain = damped_beam(both_ends(), 0.0);
  const MatX M = modal_mass(plain.invariants);
  EXPECT_TRUE(plain.D.isZero(0.0));
  ModalDamping list;
  list.fractions = {0.01, 0.02, 0.05};
  auto modes = damped_modes(damped_beam(both_ends(), list), DampingReference::frame);
  const std::vector<double> expected{0.01, 0.02, 0.05, 0.05};
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(modes[k].fraction, expected[k], 1e-9);
  const double middle = 0.5 * (modes[3].frequency + modes[4].frequency);
  ModalDamping bands;
  bands.bands = {{middle, 0.03}, {}};
  bands.bands.back().fraction = 0.4;
  modes = damped_modes(damped_beam(both_ends(), bands), DampingReference::frame);
  for (std::size_t k = 0; k < modes.size(); ++k)
    EXPECT_NEAR(modes[k].fraction, k < 4 ? 0.03 : 0.4, 1e-9);
  EXPECT_EQ(usual_damping_bands()[1].below, 1000.0);
  EXPECT_EQ(usual_damping_bands()[2].fraction, 1.0);
  ModalDamping rayleigh;
  rayleigh.alpha = 12.0;
  rayleigh.beta = 3e-6;
  const MatX D = 12.0 * M + 3e-6 * plain.K;
  EXPECT_LT((damped_beam(both_ends(), rayleigh).D - D).norm(), 1e-9 * D.norm());
  // Of the mounted part: beta K in every deformation, alpha in its modes.
  rayleigh.reference = DampingReference::mounted;
  for (const DampedMode& m :
       damped_modes(damped_beam(both_ends(), rayleigh), DampingReference::mounted)) {
    const double w = omega_of(m.frequency);
    EXPECT_NEAR(m.fraction / (6.0 / w + 1.5e-6 * w), 1.0, 1e-8);
  }
  rayleigh.alpha = 0.0;
  EXPECT_LT((damped_beam(both_ends(), rayleigh).D - 3e-6 * plain.K).norm(), 1e-14 * plain.K.norm());
}

// Bars: held at the body reference and where static modes are, all or some directions.
TEST(Damping, OfMountedBars) {
  const FeModel model = build_bar_frame(a_arm_frame(10));
  ReductionOptions options = a_arm_options();
  options.normal_modes = 6;
  options.damping = damping_of(0.02, DampingReference::mounted);
  const FlexibleBody body = reduce(model, options);
  const auto modes = damped_modes(body, DampingReference::mounted);
  ASSERT_EQ(modes.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(modes[k].frequency / body.fixed_interface_frequencies(k), 1.0, 1e-6);
    EXPECT_NEAR(modes[k].fraction, 0.02, 1e-7);
  }
  // The frame of bars follows what is clamped: its first fraction as a free body is another one.
  options.damping = 0.02;
  const OwnDamping own = own_damping(reduce(model, options));
  ASSERT_FALSE(own.frame.empty());
  EXPECT_NEAR(own.frame.front().fraction, 0.02, 1e-9);
  EXPECT_GT(std::abs(own.free.front().fraction - 0.02), 1e-3);
}

/// The beam as matrices, with a damping matrix.
FeModel as_matrices(double alpha, double beta) {
  const FeModel mesh = beam();
  const FeSystem system = assemble(mesh);
  FeModel model;
  model.positions = mesh.positions;
  model.node_sets = mesh.node_sets;
  model.matrices.emplace();
  model.matrices->K = system.K;
  model.matrices->M = system.M;
  model.matrices->C = alpha * system.M + beta * system.K;
  model.matrices->dofs = system.dofs;
  return model;
}

TEST(Damping, OfAMatrixWithStiffnessAndMass) {
  for (const bool at_node : {false, true}) {
    PartOptions options = both_ends();
    if (at_node) options.reference = {BodyReference::Kind::node, "A"};
    const ReducedPart part = reduce_part(as_matrices(12.0, 3e-6), options);
    // Rayleigh's, in every frame that of the free part: its share of the mass acts on deformations.
    for (const DampedMode& m : damped_modes(part.body, DampingReference::free)) {
      const double w = omega_of(m.frequency);
      EXPECT_NEAR(m.fraction / (6.0 / w + 1.5e-6 * w), 1.0, 1e-7);
    }
    ASSERT_FALSE(part.health.notes.empty());
    EXPECT_EQ(part.health.notes.back().substr(0, 47),
              "the damping matrix resists rigid motions too (a");
  }
  const ReducedPart stiff = reduce_part(as_matrices(0.0, 3e-6), both_ends());
  EXPECT_TRUE(stiff.health.notes.empty());
  EXPECT_LT((stiff.body.D - 3e-6 * stiff.body.K).norm(), 1e-9 * stiff.body.D.norm());
  // Fractions add to it.
  PartOptions more = both_ends();
  more.damping = 0.01;
  const FlexibleBody both = reduce_part(as_matrices(0.0, 3e-6), more).body;
  EXPECT_NEAR(damped_modes(both, DampingReference::frame).front().fraction,
              damped_modes(stiff.body, DampingReference::frame).front().fraction + 0.01, 1e-8);
  EXPECT_EQ(error_of([] { reduce_part(as_matrices(0.0, -3e-6), both_ends()); }).substr(0, 51),
            "out_of_range");
}

TEST(Damping, ErrorsAndRemainder) {
  const auto refused = [](const ModalDamping& damping, PartOptions options = both_ends()) {
    options.damping = damping;
    return error_of([&] { reduce_part(beam(), options); });
  };
  EXPECT_EQ(refused(2.0), "out_of_range");
  ModalDamping d;
  d.fractions.assign(15, 0.01);
  EXPECT_EQ(refused(d), "wrong_count");
  d.bands = usual_damping_bands();
  EXPECT_EQ(refused(d), "out_of_range");
  d.fractions.clear();
  d.bands.pop_back();
  EXPECT_EQ(refused(d), "out_of_range");
  d = 0.02;
  d.interface_frequency = 3.0;
  EXPECT_EQ(refused(d), "out_of_range");
  PartOptions loose = both_ends();
  loose.method = ModeMethod::free_free;
  loose.interfaces.clear();
  const ModalDamping mounted = damping_of(0.02, DampingReference::mounted);
  EXPECT_EQ(refused(mounted, loose), "missing");
  PartOptions statics = both_ends(0);
  statics.damping = mounted;
  const ReducedPart part = reduce_part(beam(), statics);
  EXPECT_TRUE(part.health.damping.mounted.empty());
  EXPECT_GT(least_eigenvalue(part.body.D), 0.0);
  ASSERT_FALSE(part.health.warnings.empty());
  EXPECT_TRUE(
      contains(part.health.warnings, "damping is given for the mounted part, but no mode is left"));
}

}  // namespace
}  // namespace floatframe::test
