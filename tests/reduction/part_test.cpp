// Reduced finite-element parts: body references, methods, selection of modes, inertia integrals,
// the health report.
#include "floatframe/reduction/part.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/inertia/projection.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/reduction/body_reference.hpp"
#include "floatframe/reduction/fixed_interface.hpp"
#include "floatframe/reduction/free_structure.hpp"
#include "reduction/part_beam.hpp"
#include "support/error_of.hpp"
#include "support/fe_parts.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

/// Elastic frequencies of the free body from its integrals and its stiffness alone.
VecX free_frequencies(const FlexibleBody& body) {
  const int nm = body.modes();
  const InertiaInvariants& v = body.invariants;
  MatX M = MatX::Zero(6 + nm, 6 + nm), K = M;
  M.topLeftCorner(3, 3) = v.m * Mat3::Identity();
  M.block<3, 3>(0, 3) = -skew(v.m_u);
  M.block<3, 3>(3, 0) = skew(v.m_u);
  M.block<3, 3>(3, 3) = v.inertia_about_origin();
  M.topRightCorner(6, nm) = momentum_of_modes(v);
  M.bottomLeftCorner(nm, 6) = momentum_of_modes(v).transpose();
  M.bottomRightCorner(nm, nm) = v.Sij[0][0] + v.Sij[1][1] + v.Sij[2][2];
  K.bottomRightCorner(nm, nm) = body.K;
  return generalised_eigenvalues(K, M).values.tail(nm).cwiseSqrt() / (2.0 * std::numbers::pi);
}

TEST(PartReferences, HoldTheirConditionsAndSpanTheSame) {
  FeModel model = beam();
  // Half of it heavier, so that mass and volume weigh differently.
  model.materials.push_back(steel);
  model.materials[1].density *= 3.0;
  for (std::size_t e = 0; e < model.elements.size() / 2; ++e) model.elements[e].material = 1;
  PartOptions options = both_ends();
  options.keep_projection = true;
  VecX expected;
  for (const auto kind :
       {BodyReference::Kind::mean_axis, BodyReference::Kind::buckens, BodyReference::Kind::node}) {
    options.reference = {kind, "A"};
    const ReducedPart part = reduce_part(model, options);
    const FlexibleBody& body = part.body;
    ASSERT_EQ(body.modes(), 12 + 8 - 6);
    const MatX M_ff =
        body.invariants.Sij[0][0] + body.invariants.Sij[1][1] + body.invariants.Sij[2][2];
    EXPECT_LT((M_ff - MatX::Identity(14, 14)).cwiseAbs().maxCoeff(), 1e-10);
    const MatX momentum = momentum_of_modes(body.invariants);
    const double held = momentum.cwiseAbs().maxCoeff();
    if (kind == BodyReference::Kind::mean_axis) {
      EXPECT_LT(held, 1e-11);
    } else {
      EXPECT_GT(held, 1e-2);
    }
    if (kind == BodyReference::Kind::node) {
      EXPECT_EQ(body.nodes[0].name, "A");
      EXPECT_LT(body.nodes[0].X.cwiseAbs().maxCoeff(),
                1e-11 * body.nodes[1].X.cwiseAbs().maxCoeff());
      EXPECT_LT(body.nodes[0].X_theta.cwiseAbs().maxCoeff(),
                1e-11 * body.nodes[1].X_theta.cwiseAbs().maxCoeff());
    }
    if (kind == BodyReference::Kind::buckens) {
      // The volume's own mass matrix, by other code: linear elements of unit density.
      FeModel unit = model;
      for (Material& m : unit.materials) m.density = 1.0;
      const SparseRows M_v = assemble_scalar_mass(unit);
      const VecX weight = M_v * VecX::Ones(M_v.cols());
      Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
      for (int k = 0; k < unit.nodes(); ++k) {
        const Vec3 x = body.projection->X.block<3, 1>(3 * k, 0);
        sum += weight(k) * x;
        // int r x X dV with r and X linear in the elements: the full matrix.
        for (SparseRows::InnerIterator it(M_v, k); it; ++it)
          moment += it.value() * unit.positions[it.col()].cross(x);
      }
      EXPECT_LT(sum.norm(), 1e-11 * weight.sum());
      EXPECT_LT(moment.norm(), 1e-11 * weight.sum());
    }
    const VecX f = free_frequencies(body);
    if (expected.size() == 0) expected = f;
    EXPECT_LT((f.cwiseQuotient(expected).array() - 1.0).abs().maxCoeff(), 1e-8);
    for (std::size_t k = 0; k < part.health.free_frequencies.size(); ++k)
      EXPECT_NEAR(part.health.free_frequencies[k].reduced, f(static_cast<Eigen::Index>(k)),
                  1e-8 * f(static_cast<Eigen::Index>(k)));
    for (const InterfaceHealth& h : part.health.interfaces) EXPECT_LT(h.static_error, 1e-8);
  }
}

TEST(PartReferences, BuckensIsMeanAxisForUniformDensity) {
  PartOptions options = both_ends();
  const FlexibleBody mean = reduce_part(beam(), options).body;
  options.reference.kind = BodyReference::Kind::buckens;
  const FlexibleBody buckens = reduce_part(beam(), options).body;
  EXPECT_EQ(mean.K, buckens.K);
  EXPECT_EQ(mean.nodes[1].X, buckens.nodes[1].X);
}

double relative_error(const MatX& a, const MatX& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST(PartInertia, ProjectionEqualsPreprocessing) {
  PartOptions options;
  options.interfaces = {bore("BIG_END"), bore("SMALL_END")};
  options.interfaces[1].kind = Spider::Kind::mean;
  options.modes = 6;
  options.keep_projection = true;
  options.check_free_modes = false;
  options.stresses = false;
  const FlexibleBody body =
      reduce_part(steel_part("conrod_coarse_mesh.inp.gz", "mm-t-s"), options).body;
  ASSERT_TRUE(body.projection);
  const int nm = body.modes();
  const PreprocessingData data(body.invariants);
  PreprocessingWorkspace work(nm);
  ProjectionWorkspace nodes(*body.projection);
  MatX Mp(12 + nm, 12 + nm), Mb(12 + nm, 12 + nm), Rp(6 + nm, 6 + nm), Rb(6 + nm, 6 + nm);
  VecX Qp(12 + nm), Qb(12 + nm), qp(6 + nm), qb(6 + nm);
  Random random(7);
  for (int i = 0; i < 3; ++i) {
    BodyState s = random_state(random, nm);
    s.y *= 0.01, s.ydot *= 0.01;
    relative_preprocessing(data, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), work, Rp, qp);
    relative_projection(*body.projection, s.r0, s.A, s.omega, s.y.data(), s.ydot.data(), nodes, Rb,
                        qb);
    EXPECT_LT(relative_error(Rp, Rb), 1e-12);
    EXPECT_LT(relative_error(qp, qb), 1e-12);
    absolute_preprocessing(data, s.A, s.Adot, s.y.data(), s.ydot.data(), work, Mp, Qp);
    absolute_projection(*body.projection, s.A, s.Adot, s.y.data(), s.ydot.data(), nodes, Mb, Qb);
    EXPECT_LT(relative_error(Mp, Mb), 1e-12);
    EXPECT_LT(relative_error(Qp, Qb), 1e-12);
  }
}

/// Deflection at the marker under a unit load in z there, interface A held.
double deflection(const FlexibleBody& body, std::size_t marker) {
  const ModalNode &held = body.nodes[0], &at = body.nodes[marker];
  const auto rows = [](const ModalNode& n) {
    MatX X(6, n.X.cols());
    X << n.X, n.X_theta;
    return X;
  };
  const auto rigid = [](const Vec3& p) {
    Mat6 R = Mat6::Identity();
    R.topRightCorner<3, 3>() = -skew(p);
    return R;
  };
  const VecX e = (rows(at) - rigid(at.p) * rigid(held.p).partialPivLu().solve(rows(held))).row(2);
  return e.dot(ldlt_solve(body.K, e).col(0));
}

TEST(PartMethods, AttachmentModesMakeLoadsAtMarkersExact) {
  const FeModel model = beam();
  // The full model: A held, the force spread over the nodes of the marker.
  FeModel full = model;
  const int reference = add_interface(full, bore("A"));
  const FeSystem system = assemble(full);
  std::vector<int> zero;
  for (int axis = 0; axis < 6; ++axis) zero.push_back(system.row(reference, axis));
  MatX f = MatX::Zero(system.size(), 1);
  const std::vector<int>& loaded = model.node_sets.at("MIDDLE");
  for (const int node : loaded) f(system.row(node, 2), 0) = 1.0 / double(loaded.size());
  const FixedInterface fixed(system.K, system.M, {}, zero, [](int) { return std::string(); });
  const double exact = f.col(0).dot(fixed.inner_response(f).col(0));

  for (const ModeMethod method :
       {ModeMethod::craig_bampton, ModeMethod::free_free, ModeMethod::craig_chang}) {
    PartOptions options = both_ends(4);
    options.interfaces.resize(1);
    options.method = method;
    options.markers = {{"load", {.by = NodeChoice::By::set, .set = "MIDDLE"}, std::nullopt, false},
                       {"again", {.by = NodeChoice::By::set, .set = "MIDDLE"}, std::nullopt, true}};
    const FlexibleBody without = [&] {
      PartOptions o = options;
      o.markers.pop_back();
      return reduce_part(model, o).body;
    }();
    EXPECT_GT(std::abs(deflection(without, 1) / exact - 1.0), 1e-6);
    const FlexibleBody with = reduce_part(model, options).body;
    if (method == ModeMethod::free_free) {
      // Free modes know nothing of the support's reaction.
      EXPECT_LT(std::abs(deflection(with, 1) / exact - 1.0),
                std::abs(deflection(without, 1) / exact - 1.0));
    } else {
      EXPECT_NEAR(deflection(with, 1), exact, 1e-8 * exact) << static_cast<int>(method);
    }
    // The same load twice brings no mode that depends on the others.
    options.markers[0].residual = true;
    EXPECT_EQ(reduce_part(model, options).body.modes(), with.modes());
    EXPECT_EQ(with.modes(), without.modes() + 3);
  }
}

TEST(PartMethods, FreeModesAreThoseOfTheFullModel) {
  PartOptions options = both_ends(6);
  options.method = ModeMethod::free_free;
  const ReducedPart part = reduce_part(beam(), options);
  ASSERT_EQ(part.body.modes(), 6);
  for (const FrequencyPair& pair : part.health.free_frequencies)
    EXPECT_LT(std::abs(pair.relative_error()), 1e-9);
  EXPECT_GT(part.health.interfaces[1].static_error, 0.01);
  options.method = ModeMethod::craig_chang;
  const ReducedPart chang = reduce_part(beam(), options);
  EXPECT_EQ(chang.body.modes(), 6 + 12);
  for (const InterfaceHealth& h : chang.health.interfaces) EXPECT_LT(h.static_error, 1e-8);
}

TEST(PartSolvers, MumpsEqualsEigen) {
  if (!mumps_available()) GTEST_SKIP() << "built without MUMPS";
  PartOptions options = both_ends();
  options.solver = SparseSolver::mumps;
  const ReducedPart a = reduce_part(beam(), options);
  options.solver = SparseSolver::eigen;
  const ReducedPart b = reduce_part(beam(), options);
  EXPECT_EQ(a.health.solver.substr(0, 5), "MUMPS");
  EXPECT_EQ(b.health.solver, "Eigen LDLT, METIS ordering");
  EXPECT_LT((a.body.K.diagonal().cwiseQuotient(b.body.K.diagonal()).array() - 1.0).abs().maxCoeff(),
            1e-8);
  const VecX fa = free_frequencies(a.body), fb = free_frequencies(b.body);
  EXPECT_LT((fa.cwiseQuotient(fb).array() - 1.0).abs().maxCoeff(), 1e-8);
}

TEST(PartSelection, ByNumberByFrequencyAndByEffectiveMass) {
  PartOptions options = both_ends(12);
  options.check_free_modes = false;
  const std::vector<ModeHealth> all = reduce_part(beam(), options).health.normal_modes;
  ASSERT_EQ(all.size(), 12u);
  options.max_frequency = 0.5 * (all[6].frequency + all[7].frequency);
  EXPECT_EQ(reduce_part(beam(), options).health.normal_modes.size(), 7u);
  options.modes = 3;
  EXPECT_EQ(reduce_part(beam(), options).health.normal_modes.size(), 3u);
  options.modes.reset();
  EXPECT_EQ(reduce_part(beam(), options).health.normal_modes.size(), 7u);
  options.max_frequency = 0.0;
  EXPECT_EQ(reduce_part(beam(), options).health.normal_modes.size(), 20u);  // nothing said

  // All modes of a small part have the mass that is not on the interfaces.
  const FeModel small = brick_beam(3, 1, 1, 0.3, 0.05);
  options.modes = 24;  // two layers of four nodes are free
  Vec6 sum = Vec6::Zero();
  for (const ModeHealth& m : reduce_part(small,
                                         [&] {
                                           PartOptions o = options;
                                           o.interfaces[0].mask = o.interfaces[1].mask = 63u;
                                           o.modes = 20;
                                           return o;
                                         }())
                                 .health.normal_modes)
    sum += m.effective_mass;
  EXPECT_LT(sum.maxCoeff(), 1.0);
  EXPECT_GT(sum.minCoeff(), 0.1);

  options.modes.reset();
  options.effective_mass = 0.8;
  const std::vector<ModeHealth> kept = reduce_part(beam(), options).health.normal_modes;
  EXPECT_GT(kept.size(), 2u);
  options.modes = static_cast<int>(kept.size()) - 1;
  EXPECT_EQ(reduce_part(beam(), options).health.normal_modes.size(), kept.size() - 1);
  options.modes = static_cast<int>(kept.size()) + 5;
  EXPECT_EQ(reduce_part(beam(), options).health.normal_modes.size(), kept.size());
}

TEST(PartHealth, MassPropertiesAndWarnings) {
  FeModel model = beam();
  model.positions.emplace_back(9.0, 9.0, 9.0);  // used by nothing
  model.node_ids.resize(model.positions.size());
  for (std::size_t k = 0; k < model.node_ids.size(); ++k)
    model.node_ids[k] = static_cast<int>(k) + 1;
  PartOptions options = both_ends();
  std::vector<std::string> stages;
  options.progress = [&](const std::string& stage, double) { stages.push_back(stage); };
  const HealthReport health = reduce_part(model, options).health;
  const double m = 7850.0 * 0.6 * 0.03 * 0.03;
  for (const MassProperties& p : {health.from_elements, health.from_invariants}) {
    EXPECT_NEAR(p.mass, m, 1e-12 * m);
    EXPECT_LT((p.centre - Vec3(0.3, 0.015, 0.015)).norm(), 1e-12);
    EXPECT_NEAR(p.J_origin(2, 2), m * (0.36 + 0.0009) / 3.0, 1e-12);
    EXPECT_NEAR(p.J_origin(0, 1), -m * 0.3 * 0.015, 1e-14);
  }
  EXPECT_NEAR(health.volume, 0.6 * 0.0009, 1e-15);
  EXPECT_NEAR(health.volume_times_density, m, 1e-12 * m);
  EXPECT_LT(health.rigid_residual, 1e-12);
  ASSERT_TRUE(health.rigid_eigenvalues);
  EXPECT_LT(health.rigid_eigenvalues->cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(health.nodes, 118);
  EXPECT_EQ(health.modes, 14);
  EXPECT_EQ(stages, (std::vector<std::string>{"model", "assembly", "modes", "unit loads", "body",
                                              "surface", "stress", "stress stiffness",
                                              "free modes of the full model"}));
  ASSERT_FALSE(health.warnings.empty());
  EXPECT_EQ(
      health.warnings[0],
      "1 node is in no element, mass or constraint (as those that only orient beams): node 118");

  FeModel wrong = beam();  // mm-t-s taken for m-kg-s
  for (Vec3& p : wrong.positions) p *= 1e3;
  wrong.materials[0] = {.young = 2.1e5, .poisson = 0.3, .density = 7.85e-9};
  const HealthReport guess = reduce_part(wrong, options).health;
  ASSERT_FALSE(guess.warnings.empty());
  EXPECT_EQ(guess.warnings[0],
            "the part has a Young's modulus of 2.1e+05 Pa, a density of 7.85e-09 kg/m3 and a size "
            "of 601 m, which is unusual; if the file was read as m-kg-s, it may be in mm-t-s: then "
            "it has a Young's modulus of 2.1e+11 Pa, a density of 7.85e+03 kg/m3 and a size of "
            "0.601 m");
  // It knows how the file was read.
  wrong.units = "m-kg-s";
  EXPECT_TRUE(contains(reduce_part(wrong, options).health.warnings[0],
                       "unusual; read as m-kg-s, it may be in mm-t-s: then it has"));
}

TEST(Part, BeyondAllNumbersIsNotWithoutElasticity) {
  FeModel huge = brick_beam(2, 2, 2, 1e3, 1e3);
  huge.materials[0].young = 1e308;
  PartOptions options;
  options.method = ModeMethod::free_free;
  EXPECT_EQ(error_of([&] { reduce_part(huge, options); }), "too_large");
}

}  // namespace
}  // namespace floatframe::test
