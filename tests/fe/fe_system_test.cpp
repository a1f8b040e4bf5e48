// Assembled matrices against those that CalculiX 2.20 exported (tests/data/fe/ccx, the rows that
// the files name), spiders and equations by elimination, the model as points.
#include "floatframe/fe/fe_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <charconv>
#include <cmath>
#include <map>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/unit_system.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/math/so3.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

const std::string folder = FLOATFRAME_TEST_DATA "/fe/";

/// An entry of the exported matrices. Rows are named by node and direction.
struct Entry {
  int row_node, row_axis, column_node, column_axis;
  double K, M;
};

std::vector<Entry> read_entries(const std::string& file) {
  const std::string text = read_whole_file(folder + "ccx/" + file);
  std::vector<Entry> entries;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto number = [&](auto& value) {
    while (at < end && (*at == ' ' || *at == '\n' || *at == '.')) ++at;
    at = std::from_chars(at, end, value).ptr;
  };
  while (at < end) {
    if (*at == '#') {
      while (at < end && *at++ != '\n') {
      }
      continue;
    }
    Entry e{};
    number(e.row_node);
    number(e.row_axis);
    number(e.column_node);
    number(e.column_axis);
    number(e.K);
    number(e.M);
    entries.push_back(e);
    if (at < end && *at == '\n') ++at;
  }
  return entries;
}

struct Comparison {
  double K = 0.0, M = 0.0;  ///< largest deviations, relative to the largest entry
  std::size_t entries = 0;
};

/// Columns that the file holds are complete: what it does not name is zero.
Comparison compare(const FeModel& model, const FeSystem& system, const std::string& file) {
  std::map<int, int> index;
  for (int k = 0; k < model.nodes(); ++k) {
    index[model.node_ids.empty() ? k + 1 : model.node_ids[k]] = k;
  }
  std::map<int, int> turning;  // CalculiX keeps the rotations of a spider in a node of their own
  for (const Spider& s : model.spiders) turning[s.rotation_node] = s.reference;
  const auto row = [&](int id, int axis) {
    const int node = index.at(id);
    const auto it = turning.find(node);
    return it == turning.end() ? system.row(node, axis - 1) : system.row(it->second, axis + 2);
  };
  Comparison c;
  double K = 0.0, M = 0.0;
  const std::vector<Entry> entries = read_entries(file);
  for (const Entry& e : entries) {
    const int i = row(e.row_node, e.row_axis), j = row(e.column_node, e.column_axis);
    K = std::max(K, std::abs(e.K));
    M = std::max(M, std::abs(e.M));
    c.K = std::max(c.K, std::abs(e.K - system.K.coeff(i, j)));
    c.M = std::max(c.M, std::abs(e.M - system.M.coeff(i, j)));
  }
  c.K /= K;
  c.M /= M;
  c.entries = entries.size();
  return c;
}

TEST(FeSystem, EqualsCalculixMatricesOfTheParts) {
  for (const char* name : {"aarm_coarse", "conrod_coarse", "beam_c3d20", "beam_c3d20r"}) {
    SCOPED_TRACE(name);
    const FeModel model = read_fe_file(folder + name + "_free.inp");
    validate(model);
    const Comparison c =
        compare(model, assemble(model, Integration::ccx), std::string(name) + ".txt.gz");
    EXPECT_GT(c.entries, 10000u);
    EXPECT_LT(c.K, 1e-12);
    EXPECT_LT(c.M, 1e-12);
  }
}

TEST(FeSystem, RigidSpidersEqualCalculixRigidBodies) {
  for (const char* name : {"aarm_coarse", "conrod_coarse"}) {
    SCOPED_TRACE(name);
    const FeModel model = read_fe_file(folder + name + "_rbe2_free.inp");
    validate(model);
    const FeSystem system = assemble(model, Integration::ccx);
    const Comparison c = compare(model, system, std::string(name) + "_rbe2.txt.gz");
    EXPECT_LT(c.K, 1e-12);
    EXPECT_LT(c.M, 1e-12);
    // The reference has its six rows, the nodes of the spider none.
    const Spider& s = model.spiders[0];
    EXPECT_EQ(system.row(s.reference, 5), system.first[s.reference] + 5);
    EXPECT_EQ(system.row(s.nodes[0], 0), -1);
  }
}

// Small distorted meshes of every solid, quadratic ones with curved edges.
TEST(FeSystem, EqualsCalculixOnDistortedPatches) {
  const char* equal[] = {"c3d4", "c3d6", "c3d8", "c3d10", "c3d15", "c3d20", "c3d20r"};
  for (const char* name : equal) {
    SCOPED_TRACE(name);
    const FeModel model = read_fe_file(folder + "ccx/patch_" + name + ".inp.gz");
    const Comparison c =
        compare(model, assemble(model, Integration::ccx), "patch_" + std::string(name) + ".txt.gz");
    EXPECT_GT(c.entries, 1000u);
    EXPECT_LT(c.K, 1e-12);
    EXPECT_LT(c.M, 1e-12);
  }
}

struct MassProperties {
  double mass;
  Vec3 centre;
  Mat3 J;
};

MassProperties mass_properties(const PointModel& points) {
  const VecX m = points.M_s * VecX::Ones(points.p.cols());
  const Mat3 S = points.p * (points.M_s * points.p.transpose());
  return {m.sum(), points.p * m / m.sum(), S.trace() * Mat3::Identity() - S};
}

/// T rho = rigid motion of all points: dofs from the position of their nodes.
MatX rigid_motions(const FeModel& model, const FeSystem& system) {
  MatX R(system.size(), 6);
  for (int i = 0; i < system.size(); ++i) {
    const Dof& d = system.dofs[i];
    Eigen::Matrix<double, 6, 6> A = Mat6::Identity();
    A.topRightCorner<3, 3>() = -skew(model.positions[d.node]);
    R.row(i) = A.row(d.axis);
  }
  return R;
}

// README of the data set: mass properties that follow from the exported mass matrix, in mm and t.
TEST(PointModels, MassPropertiesOfTheParts) {
  struct Case {
    const char* name;
    double mass;
    Vec3 centre, J;
  };
  const Case cases[] = {
      {"aarm_coarse",
       5.504932e-3,
       {-4.44839, 159.06175, 1.57664},
       {189.80474, 47.47849, 236.28763}},
      {"conrod_coarse", 6.240875e-4, {46.22882, 0, -0.0013}, {0.22280, 3.37508, 3.55595}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const FeModel model = read_fe_file(folder + c.name + "_free.inp");
    const FeSystem system = assemble(model, Integration::ccx);
    const MassProperties got = mass_properties(point_model(model, system, Integration::ccx));
    EXPECT_NEAR(got.mass / c.mass, 1.0, 1e-7);
    EXPECT_LT((got.centre - c.centre).cwiseAbs().maxCoeff(), 3e-5);
    EXPECT_LT((got.J.diagonal() - c.J).cwiseAbs().maxCoeff(), 6e-6);
    // The exact mass matrix has the same mass up to the points on curved edges.
    const MassProperties exact = mass_properties(point_model(model, assemble(model)));
    EXPECT_NEAR(exact.mass / c.mass, 1.0, 2e-5);
  }
}

/// A brick of two elements with a beam on it, a heavy node and a spider.
FeModel mixed_model(Spider::Kind kind) {
  FeModel model;
  Random random(8);
  model.materials = {{2e11, 0.3, 7500.0}};
  model.sections = {BeamSection::rectangle(0.02, 0.05)};
  for (int k = 0; k < 12; ++k) {
    model.positions.push_back(Vec3(k / 4, k % 2, k / 2 % 2) * 0.1 + random.vec3(0.01));
  }
  for (int k = 0; k < 2; ++k) {
    const int a = 4 * k;
    Element e;
    e.type = ElementType::hex8;
    e.nodes = {a, a + 4, a + 5, a + 1, a + 2, a + 6, a + 7, a + 3};
    model.elements.push_back(e);
  }
  model.positions.emplace_back(0.25, 0.06, 0.04);  // 12: reference
  model.positions.emplace_back(0.45, 0.03, 0.07);  // 13: end of the beam
  Element beam;
  beam.type = ElementType::beam2;
  beam.nodes = {12, 13};
  model.elements.push_back(beam);
  Mat3 J;
  J << 3, 0.2, 0.1, 0.2, 4, -0.3, 0.1, -0.3, 5;
  model.masses.push_back({13, 1.5, J * 1e-2});
  model.masses.push_back({2, 0.3, Mat3::Zero()});
  Spider s;
  s.kind = kind;
  s.name = "FLANGE";
  s.reference = 12;
  s.nodes = {8, 9, 10, 11};
  model.spiders.push_back(s);
  return model;
}

TEST(PointModels, KineticEnergyOfMixedModels) {
  for (const Spider::Kind kind : {Spider::Kind::rigid, Spider::Kind::mean}) {
    const FeModel model = mixed_model(kind);
    const FeSystem system = assemble(model);
    const PointModel points = point_model(model, system);
    // Rigid motions: exact, whatever the elements.
    const MatX R = rigid_motions(model, system);
    const MatX V = points.T * R;
    Mat6 energy = Mat6::Zero();
    for (int i = 0; i < 3; ++i) {
      MatX component(points.p.cols(), 6);
      for (int k = 0; k < points.p.cols(); ++k) component.row(k) = V.row(3 * k + i);
      energy += component.transpose() * points.M_s * component;
    }
    const Mat6 expected = R.transpose() * system.M * R;
    // The axial and the bending inertia of the Hermite beam differ: the mean of both is what the
    // points have, and the model says so.
    EXPECT_LT((energy - expected).cwiseAbs().maxCoeff(), 1e-3 * expected.cwiseAbs().maxCoeff());
    EXPECT_GT(points.anisotropy, 1e-4);
    EXPECT_LT(points.anisotropy, 0.05);
    EXPECT_NEAR(mass_properties(points).mass, expected(0, 0), 1e-12 * expected(0, 0));
  }
}

TEST(PointModels, ElementsWithRotaryInertiaAreExact) {
  // Shells, 3-node beams and point masses: translation isotropic, rotation any.
  FeModel model = mixed_model(Spider::Kind::rigid);
  model.elements.pop_back();
  model.shells = {{0.01}};
  model.positions.emplace_back(0.4, 0.2, 0.1);
  Element shell;
  shell.type = ElementType::tri3;
  shell.nodes = {12, 13, 14};
  model.elements.push_back(shell);
  model.positions.emplace_back(0.35, 0.04, 0.06);
  Element beam;
  beam.type = ElementType::beam3;
  beam.nodes = {12, 15, 13};
  model.elements.push_back(beam);
  validate(model);
  const FeSystem system = assemble(model);
  const PointModel points = point_model(model, system);
  EXPECT_LT(points.anisotropy, 1e-12);
  Random random(4);
  const VecX q = random.matrix(system.size(), 1);
  const VecX v = points.T * q;
  double energy = 0.0;
  for (int i = 0; i < 3; ++i) {
    VecX component(points.p.cols());
    for (int k = 0; k < points.p.cols(); ++k) component(k) = v(3 * k + i);
    energy += component.dot(points.M_s * component);
  }
  EXPECT_NEAR(energy / q.dot(system.M * q), 1.0, 1e-12);
}

TEST(Spiders, MeanMovesAsTheLeastSquaresRigidMotion) {
  FeModel model = mixed_model(Spider::Kind::mean);
  model.elements.pop_back();
  model.masses.clear();
  model.spiders[0].weights = {1.0, 2.0, 0.5, 1.5};
  const FeSystem system = assemble(model);
  // Four nodes with 12 dofs, of which six follow: 24 + 6 + 6 rows.
  EXPECT_EQ(system.size(), 3 * 8 + 12 - 6 + 6);
  Random random(6);
  const VecX q = random.matrix(system.size(), 1);
  const VecX u = system.T * q, theta = system.T_theta * q;
  // The rigid motion of the reference minimises sum w |u_i - u_r - theta x r_i|^2: the residual has
  // no weighted resultant force and no moment.
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const Spider& s = model.spiders[0];
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 r = model.positions[s.nodes[i]] - model.positions[12];
    const Vec3 residual =
        u.segment<3>(3 * s.nodes[i]) - u.segment<3>(36) - Vec3(theta.segment<3>(36)).cross(r);
    force += s.weights[i] * residual;
    moment += s.weights[i] * r.cross(residual);
  }
  EXPECT_LT(force.norm(), 1e-12 * u.norm());
  EXPECT_LT(moment.norm(), 1e-12 * u.norm());
  // Rigid motion of everything, and its energy.
  const MatX R = rigid_motions(model, system);
  EXPECT_LT((system.K * R).cwiseAbs().maxCoeff(), 1e-11 * system.K.coeffs().cwiseAbs().maxCoeff());
  FeModel free = model;
  free.spiders.clear();
  const FeSystem plain = assemble(free);
  const MatX R_free = rigid_motions(free, plain);
  const Mat6 expected = R_free.transpose() * plain.M * R_free;
  EXPECT_LT((R.transpose() * system.M * R - expected).cwiseAbs().maxCoeff(),
            1e-12 * expected.cwiseAbs().maxCoeff());
}

TEST(Spiders, ForceOnAMeanReferenceIsCarriedInEquilibrium) {
  // A brick held at one end by a mean spider, loaded at the other by another one: the reaction at
  // the held reference balances the load, and both ends are not stiffened: the same brick with
  // rigid spiders is stiffer.
  FeModel model = mixed_model(Spider::Kind::mean);
  model.elements.pop_back();
  model.masses.clear();
  model.positions.emplace_back(-0.05, 0.05, 0.05);  // 14
  Spider other = model.spiders[0];
  other.name = "ROOT";
  other.reference = 14;
  other.nodes = {0, 1, 2, 3};
  model.spiders.push_back(other);
  double deflection[2] = {};
  for (const Spider::Kind kind : {Spider::Kind::mean, Spider::Kind::rigid}) {
    for (Spider& s : model.spiders) s.kind = kind;
    const FeSystem system = assemble(model);
    const int root = system.first[14], tip = system.first[12];
    MatX K(system.K);
    VecX f = VecX::Zero(system.size());
    Vec6 load;
    load << 100, 20, -30, 1, -2, 3;
    f.segment<6>(tip) = load;
    MatX held = K;
    held.middleRows<6>(root).setZero();
    held.block<6, 6>(root, root).setIdentity();
    const VecX u = held.partialPivLu().solve(f);
    const Vec6 reaction = (K * u).segment<6>(root);
    const Vec3 arm = model.positions[12] - model.positions[14];
    EXPECT_LT((reaction.head<3>() + load.head<3>()).norm(), 1e-9 * 100);
    EXPECT_LT((reaction.tail<3>() + load.tail<3>() + arm.cross(Vec3(load.head<3>()))).norm(), 1e-9);
    deflection[kind == Spider::Kind::rigid ? 1 : 0] = u.segment<6>(tip).dot(load);
  }
  EXPECT_GT(deflection[0], 1.01 * deflection[1]);
}

TEST(Spiders, ChainsAndEquations) {
  // Node 13 hangs rigidly on node 12, which is the rigid reference of the flange, by an equation
  // for a single direction and by a spider of a spider.
  FeModel model = mixed_model(Spider::Kind::rigid);
  model.masses.clear();
  Spider outer;
  outer.name = "OUTER";
  outer.reference = 14;
  outer.nodes = {12, 13};
  model.positions.emplace_back(0.6, 0.0, 0.1);
  model.spiders.push_back(outer);
  LinearEquation tie;  // ux of node 0 = 0.5 (ux of node 1 + ux of node 2)
  tie.terms = {{0, 0, 2.0}, {1, 0, -1.0}, {2, 0, -1.0}};
  model.equations.push_back(tie);
  const FeSystem system = assemble(model);
  EXPECT_EQ(system.size(), 8 * 3 - 1 + 6);
  EXPECT_EQ(system.first[0], -1);
  EXPECT_EQ(system.row(0, 1), 0);
  Random random(9);
  const VecX q = random.matrix(system.size(), 1);
  const VecX u = system.T * q;
  EXPECT_NEAR(u(0), 0.5 * (u(3) + u(6)), 1e-14);
  const int r = system.first[14];
  for (const int node : {8, 9, 10, 11, 12, 13}) {
    const Vec3 arm = model.positions[node] - model.positions[14];
    const Vec3 expected = q.segment<3>(r) + Vec3(q.segment<3>(r + 3)).cross(arm);
    EXPECT_LT((u.segment<3>(3 * node) - expected).norm(), 1e-13) << node;
  }
}

std::string refusal(const FeModel& model) {
  try {
    validate(model);
    assemble(model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Spiders, Refusals) {
  const FeModel good = mixed_model(Spider::Kind::rigid);
  EXPECT_EQ(refusal(good), "no error");
  FeModel f = good;
  f.files = {"deck.inp"};
  Spider second = f.spiders[0];
  second.name = "SECOND";
  second.reference = 13;
  second.nodes = {3, 9};
  second.source = {0, 88};
  f.spiders.push_back(second);
  EXPECT_EQ(refusal(f),
            "deck.inp:88: spider 'SECOND': ux of node 9 depends already on spider 'FLANGE'; a "
            "degree of freedom can depend only once");
  f = good;
  f.spiders[0].kind = Spider::Kind::mean;
  f.spiders[0].nodes = {8, 9};
  EXPECT_EQ(
      refusal(f),
      "spider 'FLANGE': its 2 nodes lie on a line or in a point and cannot define a rotation");
  f = good;
  second.reference = 8;
  second.nodes = {12};
  second.source = {};
  f.spiders.push_back(second);
  EXPECT_EQ(refusal(f),
            "spider 'SECOND': ux of node 12 would depend on itself, by a chain of spiders or "
            "equations");
  f = good;
  LinearEquation e;
  e.terms = {{0, 0, 1.0}, {1, 4, 1.0}};
  f.equations.push_back(e);
  EXPECT_EQ(refusal(f), "equation for node 0: node 1 has no degree of freedom ry");
  f.equations[0].terms = {{0, 0, 0.0}, {1, 1, 1.0}};
  EXPECT_EQ(refusal(f), "equation 1: the factor of its first term must not be zero");
}

// Matrices of another program in place of elements: the same system, with spiders on top.
TEST(FeSystem, GivenMatricesAreReducedLikeElements) {
  FeModel elements = mixed_model(Spider::Kind::rigid);
  elements.elements.pop_back();
  elements.masses.clear();
  FeModel plain = elements;
  plain.spiders.clear();
  const FeSystem made = assemble(plain);
  FeModel given = elements;
  given.elements.clear();
  given.matrices.emplace();
  // Rows in an order of their own.
  const int n = made.size();
  Eigen::PermutationMatrix<Eigen::Dynamic> order(n);
  for (int i = 0; i < n; ++i) order.indices()(i) = (7 * i + 3) % n;
  ASSERT_EQ(n % 7 != 0, true);
  given.matrices->K = made.K.twistedBy(order);
  given.matrices->M = made.M.twistedBy(order);
  given.matrices->dofs.resize(n);
  for (int i = 0; i < n; ++i) {
    given.matrices->dofs[order.indices()(i)] = made.dofs[i];
  }
  validate(given);
  const FeSystem a = assemble(elements), b = assemble(given);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LT((MatX(a.K) - MatX(b.K)).cwiseAbs().maxCoeff(), 1e-12 * a.K.coeffs().maxCoeff());
  EXPECT_LT((MatX(a.M) - MatX(b.M)).cwiseAbs().maxCoeff(), 1e-12 * a.M.coeffs().maxCoeff());
  EXPECT_EQ(MatX(a.T), MatX(b.T));
}

}  // namespace
}  // namespace floatframe::test
