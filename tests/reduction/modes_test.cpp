// Craig-Bampton modes: rebuilt reference bodies, analytic shapes as limits, options, and every
// error a user can make.
#include <gtest/gtest.h>

#include <numbers>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/eigenmodes.hpp"
#include "support/error_of.hpp"
#include "support/iltis_parts.hpp"
#include "support/random_body.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

/// Sine of the largest angle between the spans of two bases; rows scaled so that metres and radians
/// compare.
double subspace_distance(const MatX& a, const MatX& b) {
  const MatX Qa = pivoted_qr(a).Q.leftCols(a.cols()), Qb = pivoted_qr(b).Q.leftCols(b.cols());
  const MatX rest = Qb - Qa * (Qa.transpose() * Qb);
  return singular_values(rest).values(0);
}

struct Rebuild {
  const char* name;
  std::vector<NodeDofs> clamped, interfaces;
  int normal_modes;
};

TEST(ReferenceModes, FrequenciesAndSubspace) {
  const auto node = [](int k, unsigned mask) { return NodeDofs{"", mask, k}; };
  const std::vector<Rebuild> cases = {
      {"aarm_eb_section",
       {node(0, 7), node(3, 7), node(6, 63 - 4), node(7, 3)},
       {node(6, 4), node(7, 4)},
       2},
      {"beam_eb_line", {node(0, 63)}, {node(5, 7 + 16 + 32)}, 2},
      {"beam_iso", {node(0, 63)}, {node(5, 6 + 16 + 32)}, 2},
      {"hex8", {node(0, 7), node(4, 7), node(8, 7), node(12, 7)}, {node(15, 6)}, 4},
      {"tet4", {node(0, 7), node(3, 7), node(6, 7), node(9, 7)}, {node(11, 6)}, 3},
  };
  for (const Rebuild& c : cases) {
    SCOPED_TRACE(c.name);
    const Json file = reference_body(c.name);
    const FeModel model = to_model(file);
    ReductionOptions options;
    options.clamped = c.clamped;
    options.interfaces = c.interfaces;
    options.normal_modes = c.normal_modes;
    options.mass_model = hermite(file) ? MassModel::hermite : MassModel::isoparametric;
    options.eigen_mass = MassModel::hermite;
    options.section_inertia = section_inertia(file);
    const ModeSet set = craig_bampton_modes(model, options);
    const MatX X = to_matrix(file["X"]);
    ASSERT_EQ(set.X.cols(), X.cols());
    const VecX omega = to_vector(file["fixed_interface_omega"]);
    EXPECT_LT(relative_error(set.frequencies * (2.0 * std::numbers::pi), omega), 1e-9);
    EXPECT_LT(subspace_distance(X, set.X), 1e-7);
    // Modal stiffness up to the signs of the dynamic modes.
    const MatX K = to_matrix(file["K_modal"]);
    EXPECT_LT(relative_error(set.K.cwiseAbs(), K.cwiseAbs()), 1e-8);
    // The whole body again, with its own modes.
    const FlexibleBody body = reduce(model, options);
    EXPECT_NEAR(body.invariants.m / file["invariants"]["m"].get<double>(), 1.0, 1e-12);
    EXPECT_EQ(body.modes(), X.cols());
  }
}

TEST(CraigBampton, ConstraintModesAreUnitDisplacements) {
  const FeModel model = build_bar_frame(a_arm_frame(10));
  const ModeSet set = craig_bampton_modes(model, a_arm_options());
  const int shock = model.find_node("shock"), ball = model.find_node("ball");
  EXPECT_EQ(set.X(6 * shock + 2, 0), 1.0);
  EXPECT_EQ(set.X(6 * ball + 2, 0), 0.0);
  EXPECT_EQ(set.X(6 * shock + 2, 1), 0.0);
  EXPECT_EQ(set.X(6 * ball + 2, 1), 1.0);
  for (const char* end : {"front", "rear"}) {
    EXPECT_EQ(set.X.middleRows(6 * model.find_node(end), 6).cwiseAbs().maxCoeff(), 0.0);
  }
  // K_y = X^T K X, although the coupling blocks are set to zero exactly.
  const MatX K = set.X.transpose() * (assemble_stiffness(model) * set.X);
  EXPECT_LT(relative_error(set.K, K), 1e-9);
  EXPECT_EQ(set.names, (std::vector<std::string>{"static shock uz", "static ball uz", "normal 1",
                                                 "normal 2"}));
}

TEST(CraigBampton, SparseAndDenseEigensolversAgree) {
  // 40 elements per bar: 486 dofs, subspace iteration; against the dense solver by asking for many
  // modes.
  const FeModel model = build_bar_frame(a_arm_frame(40));
  ReductionOptions options = a_arm_options();
  options.normal_modes = 6;
  const ModeSet sparse = craig_bampton_modes(model, options);
  options.normal_modes = 150;
  const ModeSet dense = craig_bampton_modes(model, options);
  EXPECT_LT(relative_error(sparse.frequencies, dense.frequencies.head(6).eval()), 1e-9);
  EXPECT_LT(relative_error(sparse.X.rightCols(6), dense.X.middleCols(2, 6)), 1e-6);
  const ModeSet again = craig_bampton_modes(model, options);
  EXPECT_EQ(again.X, dense.X);  // bit for bit
}

TEST(CraigBampton, FrequencyLimit) {
  for (const int elements : {10, 60}) {
    const FeModel model = build_bar_frame(a_arm_frame(elements));
    ReductionOptions options = a_arm_options();
    options.normal_modes = 8;
    const VecX all = craig_bampton_modes(model, options).frequencies;
    options.normal_modes = 0;
    options.max_frequency = 0.5 * (all(4) + all(5));
    EXPECT_EQ(craig_bampton_modes(model, options).frequencies.size(), 5);
    options.normal_modes = 3;
    EXPECT_EQ(craig_bampton_modes(model, options).frequencies.size(), 3);
  }
}

TEST(CraigBampton, BarModesConvergeToAnalyticShapes) {
  const double L = 0.3366470704;
  double last_shape = 0.0, last_frequency = 0.0;
  for (const int elements : {4, 8, 16}) {
    const FeModel model = build_bar_frame(straight_bar(L, 0.030, elements));
    ReductionOptions options;
    options.clamped = {{"inner", all_dofs}};
    // y and z of the tip; ux and rx of a round bar do not couple.
    options.interfaces = {{"outer", 6u}};
    options.normal_modes = 4;
    options.mass_model = MassModel::hermite;
    const ModeSet fe = craig_bampton_modes(model, options);
    const ModeSet analytic = analytic_bar_modes(model, 2);
    // Static shapes are exact at the nodes.
    EXPECT_LT(subspace_distance(fe.X.leftCols(2), analytic.X.leftCols(2)), 1e-7);
    EXPECT_LT(relative_error(fe.K.topLeftCorner(2, 2), analytic.K.topLeftCorner(2, 2)), 1e-9);
    const double shape = subspace_distance(fe.X.rightCols(4), analytic.X.rightCols(4));
    const double mass = 7500.0 * std::numbers::pi / 4.0 * 0.030 * 0.030 * L;
    const double exact = std::sqrt(analytic.K(5, 5) / mass) / (2.0 * std::numbers::pi);
    const double frequency = std::abs(fe.frequencies(3) / exact - 1.0);
    if (last_shape > 0.0) {
      EXPECT_GT(std::log2(last_shape / shape), 1.9);
      EXPECT_NEAR(std::log2(last_frequency / frequency), 4.0, 0.2);  // cubic beams: order 4
    }
    last_shape = shape;
    last_frequency = frequency;
  }
  EXPECT_LT(last_shape, 1e-3);
  EXPECT_LT(last_frequency, 1e-4);
}

TEST(AnalyticBar, RootsOfTheFrequencyEquation) {
  EXPECT_NEAR(clamped_pinned_root(1), 3.9266023120, 1e-9);
  EXPECT_NEAR(clamped_pinned_root(2), 7.0685827456, 1e-9);
  EXPECT_NEAR(clamped_pinned_root(3), 10.2101761228, 1e-9);
}

// What docs/model-file.md promises: by shape, then by plane; the static shape is +1 at the tip,
// the dynamic ones leave the clamped end on the positive side. Local y lies in the plane of the bar
// and the reference.
TEST(AnalyticBar, OrderAndSigns) {
  BarFrame frame = straight_bar(2.0, 0.030, 40);
  for (const Vec3& reference : {Vec3(0, 0, 1), Vec3(0.3, 0, -2), Vec3(0, 1, 1)}) {
    frame.bars[0].reference = reference;
    const FeModel model = build_bar_frame(frame);
    const ModeSet set = analytic_bar_modes(model, 2);
    EXPECT_EQ(set.names, (std::vector<std::string>{"static tip y", "static tip z",
                                                   "clamped-pinned 1 y", "clamped-pinned 1 z",
                                                   "clamped-pinned 2 y", "clamped-pinned 2 z"}));
    const int inner = model.find_node("inner"), tip = model.find_node("outer");
    const Vec3 along = (model.positions[tip] - model.positions[inner]).normalized();
    const Vec3 y = (reference - along * along.dot(reference)).normalized(), z = along.cross(y);
    for (int a = 0; a < 6; ++a) {
      const Vec3 plane = a % 2 == 0 ? y : z;
      const Vec3 moved = a < 2 ? set.X.block<3, 1>(6 * tip, a) : set.X.block<3, 1>(6 * 1, a);
      EXPECT_NEAR(moved.dot(plane), moved.norm(), 1e-12) << a;
      if (a < 2) {
        EXPECT_NEAR(moved.norm(), 1.0, 1e-12);
      }
      EXPECT_GT(moved.norm(), 1e-4) << a;
    }
  }
}

TEST(AnalyticBar, ShapesSatisfyTheEndConditions) {
  const FeModel model = build_bar_frame(straight_bar(2.0, 0.030, 400));
  const ModeSet set = analytic_bar_modes(model, 3);
  ASSERT_EQ(set.X.cols(), 8);
  const int tip = model.find_node("outer");
  for (int a = 0; a < 8; ++a) {
    EXPECT_LT(set.X.col(a).head(6).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(set.X.col(a).segment(6 * tip, 3).norm(), a < 2 ? 1.0 : 0.0, 1e-11);
    // Slopes are derivatives: rz = v', ry = -w'; unit mean square of the dynamic shapes.
    double square = 0.0;
    for (int k = 1; k < tip; ++k) {
      const double h = 2.0 / 400;
      const VecX slope =
          (set.X.col(a).segment(6 * (k + 1), 3) - set.X.col(a).segment(6 * (k - 1), 3)) / (2 * h);
      EXPECT_NEAR(set.X(6 * k + 5, a), slope(1), 2e-3);
      EXPECT_NEAR(set.X(6 * k + 4, a), -slope(2), 2e-3);
      square += set.X.col(a).segment(6 * k, 3).squaredNorm() / 400;
    }
    if (a >= 2) {
      EXPECT_NEAR(square, 1.0, 1e-4);
    }
  }
}

TEST(Reduction, ChordFrameOfARod) {
  // Pinned-pinned reference: both ends without translation, no rotation about the axis at one end.
  const FeModel model = build_bar_frame(straight_bar(0.4, 0.02, 10));
  ReductionOptions options;
  options.clamped = {{"inner", 7u + 8u}, {"outer", 7u}};
  options.normal_modes = 2;
  options.mass_model = MassModel::hermite;
  const FlexibleBody body = reduce(model, options);
  const double mass = body.invariants.m;
  const double EI = 2e11 * BeamSection::solid_round(0.02).Iy;
  const double exact = std::numbers::pi * std::numbers::pi *
                       std::sqrt(EI / (mass / 0.4) / std::pow(0.4, 4)) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(body.fixed_interface_frequencies(0) / exact, 1.0, 1e-4);
  EXPECT_NEAR(body.fixed_interface_frequencies(1) / exact, 1.0, 1e-4);
}

TEST(Reduction, OrthonormalModesAndModalDamping) {
  const FeModel model = build_bar_frame(a_arm_frame(10));
  ReductionOptions options = a_arm_options();
  options.damping = 0.02;
  const FlexibleBody plain = reduce(model, options);
  options.orthonormalise = true;
  const FlexibleBody body = reduce(model, options);
  EXPECT_LT((modal_mass(body.invariants) - MatX::Identity(4, 4)).cwiseAbs().maxCoeff(), 1e-10);
  for (int a = 0; a < 4; ++a)
    EXPECT_NEAR(body.D(a, a) / (0.04 * std::sqrt(body.K(a, a))), 1.0, 1e-9);
  EXPECT_LT((body.D - MatX(body.D.diagonal().asDiagonal())).cwiseAbs().maxCoeff(),
            1e-8 * body.D.maxCoeff());
  // The same damping in other coordinates: D_plain = T^-T D T^-1 with X_orth = X_plain T.
  const MatX T = qr_solve(plain.projection->X, body.projection->X);
  EXPECT_LT(relative_error(T.transpose() * plain.D * T, body.D), 1e-8);
}

TEST(Reduction, GivenBasisAndMassModels) {
  const FeModel model = build_bar_frame(a_arm_frame(5));
  Random random(7);
  ReductionOptions options;
  options.basis = random.matrix(6 * model.nodes(), 3);
  options.mass_model = MassModel::six_dof;
  const FlexibleBody six = reduce(model, options);
  ASSERT_TRUE(six.projection && six.projection->six_dof());
  EXPECT_EQ(six.nodes[3].X, six.projection->X.middleRows<3>(9));
  EXPECT_EQ(six.nodes[3].X_theta, options.basis->middleRows<3>(21));
  EXPECT_LT(relative_error(
                six.K, options.basis->transpose() * (assemble_stiffness(model) * *options.basis)),
            1e-13);
  options.mass_model = MassModel::hermite;
  EXPECT_FALSE(reduce(model, options).projection);
  options.mass_model = MassModel::isoparametric;
  EXPECT_FALSE(reduce(model, options).projection->six_dof());
}

TEST(ReductionErrors, Codes) {
  const FeModel arm = build_bar_frame(a_arm_frame(5));
  const auto with = [&](auto change) {
    return error_of([&] {
      ReductionOptions options = a_arm_options();
      change(options);
      reduce(arm, options);
    });
  };
  EXPECT_EQ(with([](ReductionOptions& o) { o.clamped.clear(); }), "singular");
  EXPECT_EQ(with([](ReductionOptions& o) {
              o.clamped = {{"front", 7u}, {"rear", 7u}};
            }),
            "singular");
  EXPECT_EQ(with([](ReductionOptions& o) { o.clamped = {{"front", 2u + 4u + 56u}}; }), "singular");
  EXPECT_EQ(with([](ReductionOptions& o) { o.clamped.push_back({"frnt", 7u}); }), "not_found");
  EXPECT_EQ(with([](ReductionOptions& o) { o.interfaces = {{"", 4u, 99}}; }), "not_found");
  EXPECT_EQ(with([](ReductionOptions& o) { o.interfaces = {{"front", 4u}}; }), "duplicate");
  EXPECT_EQ(with([](ReductionOptions& o) { o.interfaces.push_back({"ball", 4u}); }), "duplicate");
  EXPECT_EQ(with([](ReductionOptions& o) { o.normal_modes = 1000; }), "out_of_range");
  EXPECT_EQ(with([](ReductionOptions& o) { o.normal_modes = 50; }), "out_of_range");
  EXPECT_EQ(with([](ReductionOptions& o) { o.damping = -0.1; }), "out_of_range");
  EXPECT_EQ(with([](ReductionOptions& o) { o.basis = MatX::Zero(5, 1); }), "wrong_count");
  EXPECT_EQ(with([](ReductionOptions& o) { o.analytic = AnalyticShapes{2}; }), "unsupported");

  FeModel loose = arm;
  loose.positions.push_back(Vec3(5, 5, 5));
  loose.node_names.push_back("lost");
  EXPECT_EQ(error_of([&] { reduce(loose, a_arm_options()); }), "singular");
  FeModel flywheel = arm;
  flywheel.masses.push_back({arm.find_node("ball"), 1.0, Mat3::Identity()});
  EXPECT_EQ(error_of([&] { reduce(flywheel, a_arm_options()); }), "unsupported");
  const FeModel tet = to_model(reference_body("tet4"));
  ReductionOptions options;
  options.clamped = {{"", 7u, 0}, {"", 7u, 3}, {"", 7u, 6}};
  options.interfaces = {{"", 8u, 11}};
  EXPECT_EQ(error_of([&] { reduce(tet, options); }), "contradiction");
}

}  // namespace
}  // namespace floatframe::test
