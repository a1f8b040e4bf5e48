// Models as points: the kinetic energy is that of the assembled mass matrix, whatever the elements,
// and what is fixed to nodes that turn moves on circles.
#include <gtest/gtest.h>

#include <cmath>

#include "fe/mixed_model.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/lumped_mass.hpp"
#include "floatframe/fe/rigid_leaders.hpp"
#include "floatframe/math/so3.hpp"
#include "support/fe_models.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {
namespace {

/// A bent row of beams; the sections differ in Iy and Iz.
FeModel bent_row(int n, const BeamSection& section) {
  FeModel model;
  model.materials = {steel};
  model.sections = {section};
  for (int k = 0; k <= n; ++k)
    model.positions.emplace_back(0.2 * k, 0.01 * k * k, 0.1 * std::sin(0.7 * k));
  for (int k = 0; k < n; ++k)
    add_element(model, FeElementType::beam2, {k, k + 1}).reference = Vec3(0.1, 0.3 * k, 1.0);
  return model;
}

BeamSection flat() { return BeamSection::rectangle(0.02, 0.05); }

BeamSection with_shear(double slenderness) {
  BeamSection s = flat();
  s.shear_y = 0.5 * s.A;
  s.shear_z = 0.7 * s.A;
  s.slenderness = slenderness;
  return s;
}

/// The end of a bar or a mass beside a node, by equations as readers write them.
int on_an_arm(FeModel& model, int node, const Vec3& arm) {
  model.positions.push_back(model.positions[node] + arm);
  const int end = model.nodes() - 1;
  for (int k = 0; k < 3; ++k) {
    LinearEquation move, turn;
    turn.terms = {{end, 3 + k, 1.0}, {node, 3 + k, -1.0}};
    move.terms = {{end, k, 1.0}, {node, k, -1.0}};
    const Vec3 lever = arm.cross(Vec3::Unit(k));
    for (int i = 0; i < 3; ++i)
      if (lever(i) != 0.0) move.terms.push_back({node, 3 + i, -lever(i)});
    model.equations.push_back(move);
    model.equations.push_back(turn);
  }
  return end;
}

Mat3 some_inertia() {
  Mat3 J;
  J << 3, 0.2, 0.1, 0.2, 4, -0.3, 0.1, -0.3, 5;
  return 1e-2 * J;
}

/// Both ends of the second beam lie beside the nodes, and so does a mass.
FeModel with_offsets() {
  FeModel model = bent_row(3, with_shear(0.0));
  const int a = on_an_arm(model, 1, Vec3(0.0, 0.03, 0.05));
  const int b = on_an_arm(model, 2, Vec3(0.01, 0.03, -0.02));
  model.elements[1].nodes = {a, b};
  const int c = on_an_arm(model, 3, Vec3(0.2, -0.1, 0.05));
  model.masses.push_back({c, 2.0, some_inertia()});
  return model;
}

FeModel shells_with_offset() {
  FeModel model;
  model.materials = {steel};
  model.shells = {{0.01}};
  model.shells[0].offset = 0.004;
  model.positions = {{0, 0, 0}, {0.2, 0, 0.01}, {0.22, 0.1, 0}, {0, 0.12, 0}, {0.4, 0.05, 0.02}};
  add_element(model, FeElementType::quad4, {0, 1, 2, 3});
  add_element(model, FeElementType::tri3, {1, 4, 2});
  return model;
}

/// T^T M_s T, M_s for the three directions.
MatX mass_of_points(const PointModel& points) {
  const auto n = points.T.cols();
  MatX M = MatX::Zero(n, n);
  for (int i = 0; i < 3; ++i) {
    MatX T(points.p.cols(), n);
    for (Eigen::Index k = 0; k < points.p.cols(); ++k) T.row(k) = MatX(points.T.row(3 * k + i));
    M += T.transpose() * (points.M_s * T);
  }
  return M;
}

void expect_mass_of_system(FeModel model) {
  validate(model);
  const FeSystem system = assemble(model);
  const PointModel points = point_model(model, system);
  EXPECT_EQ(points.anisotropy < 1e-12, true) << points.anisotropy;
  // Of all pairs of columns, the rigid motions among them: entries beside the diagonal.
  const MatX M = system.M;
  const VecX size = M.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(1e-12);
  const MatX off = mass_of_points(points) - M;
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    for (Eigen::Index j = 0; j < M.cols(); ++j)
      EXPECT_LT(std::abs(off(i, j)), 1e-11 * size(i) * size(j)) << i << " " << j;
  // Integrals with the undeformed positions: those of the rigid motions.
  const MatX R = rigid_motions_of(model, system);
  const Mat6 M_rr = R.transpose() * M * R;
  const VecX m = points.M_s * VecX::Ones(points.p.cols());
  const Mat3 P = points.p * (points.M_s * points.p.transpose());
  const Vec3 static_moment = points.p * m;
  EXPECT_NEAR(m.sum(), M_rr(0, 0), 1e-12 * M_rr(0, 0));
  EXPECT_LT((skew(static_moment) - M_rr.block<3, 3>(3, 0)).norm(), 1e-12 * M_rr.norm());
  EXPECT_LT((Mat3(P.trace() * Mat3::Identity() - P) - M_rr.block<3, 3>(3, 3)).norm(),
            1e-12 * M_rr.norm());
}

TEST(PointModels, HoldTheMassOfEveryElement) {
  for (const BeamSection& section : {flat(), with_shear(0.0), with_shear(0.25)})
    expect_mass_of_system(bent_row(3, section));
  expect_mass_of_system(with_offsets());
  expect_mass_of_system(shells_with_offset());
  for (const Spider::Kind kind : {Spider::Kind::rigid, Spider::Kind::mean})
    expect_mass_of_system(mixed_model(kind));
  FeModel lumped = bent_row(3, flat());
  lumped.elements[1].mass_form = MassForm::lumped;
  lumped.elements[2].mass_form = MassForm::lumped_without_rotation;
  expect_mass_of_system(lumped);
  FeModel curved = bent_row(4, flat());
  curved.elements.resize(2);
  for (int k = 0; k < 2; ++k) {
    curved.elements[k].type = FeElementType::beam3;
    curved.elements[k].nodes = {2 * k, 2 * k + 1, 2 * k + 2};
  }
  expect_mass_of_system(curved);
}

// Stations are the mass of the kernel, moments by the axes of the section.
TEST(PointModels, StationsAreTheConsistentMass) {
  const FeModel model = bent_row(1, with_shear(0.0));
  const ElementInput in = gather(model, model.elements[0]);
  std::vector<MassStation> stations;
  beam2_kernel.mass_stations(in, stations);
  MatX sum = MatX::Zero(12, 12), M;
  for (const MassStation& s : stations) {
    const Mat3 P = s.axes * s.moments.asDiagonal() * s.axes.transpose();
    const Mat3 J = P.trace() * Mat3::Identity() - P;
    sum += s.mass * s.u.transpose() * s.u + s.theta.transpose() * J * s.theta;
  }
  beam2_kernel.mass(in, true, M);
  EXPECT_LT((sum - M).norm(), 1e-13 * M.norm());
}

// Every point that turns keeps its distance from what it is fixed to, to second order, and the
// points of a structure that turns as one about a node move on circles about it.
TEST(PointModels, ArmsOfFixedPoints) {
  FeModel model = with_offsets();
  model.positions.emplace_back(0.9, 0.2, 0.3);
  const int last = model.nodes() - 1;
  model.masses.push_back({last, 0.5, Mat3::Zero()});
  add_spider(model, last - 1, {last});  // a chain: fixed to a node that is fixed to a node
  validate(model);
  const FeSystem system = assemble(model);
  const std::vector<int> leaders = rigid_leaders(model, system);
  EXPECT_EQ(leaders, (std::vector<int>{-1, -1, -1, -1, 1, 2, 3, 6}));
  const PointModel points = point_model(model, system);
  EXPECT_TRUE(points.strained_arms.empty());
  ASSERT_EQ(points.followers.size(), 4u);
  // All turn with theta about the origin: u = theta x p, and to second order what is fixed to the
  // node k has beside 1/2 theta x (theta x (p - p_k)).
  const MatX R = rigid_motions_of(model, system);
  const Vec3 theta(0.3, -0.2, 0.5);
  const VecX q = R.rightCols<3>() * theta;
  const VecX turned = points.rotations * q;
  for (Eigen::Index r = 0; r < turned.size() / 3; ++r)
    EXPECT_LT((turned.segment<3>(3 * r) - theta).norm(), 1e-12);
  Mat3X arms = Mat3X::Zero(3, points.p.cols());
  for (const PointArm& a : points.arms) arms.col(a.point) += a.arm;
  // The mass at the end of the chain is fixed to node 3 by one arm.
  EXPECT_LT((arms.col(7) - (model.positions[7] - model.positions[3])).norm(), 1e-14);
  // The ends of the second beam hang on the nodes 1 and 2, its stations on both.
  int hanging = 0;
  for (Eigen::Index k = 0; k < points.p.cols(); ++k) {
    if (points.T.middleRows(3 * k, 3).nonZeros() == 0) continue;
    const VecX u = points.T.middleRows(3 * k, 3) * q;
    EXPECT_LT((u - theta.cross(points.p.col(k))).norm(), 1e-12);
    hanging += arms.col(k).isZero(0.0) ? 0 : 1;
  }
  EXPECT_GT(hanging, 10);
}

// Nodes of solids that a spider holds are strained by their elements: stiffening counts them.
TEST(PointModels, ArmsOfSolidsAreStrained) {
  const FeModel model = mixed_model(Spider::Kind::rigid);
  const FeSystem system = assemble(model);
  const PointModel points = point_model(model, system);
  EXPECT_EQ(points.strained_arms.size(), 4u);
  EXPECT_EQ(points.followers.size(), 4u);
  for (const PointArm& a : points.strained_arms)
    EXPECT_EQ(a.arm, model.positions[a.point] - model.positions[12]);
  EXPECT_FALSE(points.arms.empty());  // of the beam and the heavy node
  // Without rotations that carry mass nothing turns.
  const FeModel solids = brick_beam(2, 1, 1, 0.3, 0.1);
  const PointModel none = point_model(solids, assemble(solids));
  EXPECT_TRUE(none.arms.empty());
  EXPECT_FALSE(none.rotary);
  EXPECT_EQ(none.rotations.rows(), 0);
  // Of a mean spider the nodes are not fixed.
  const FeModel mean = mixed_model(Spider::Kind::mean);
  EXPECT_TRUE(point_model(mean, assemble(mean)).followers.empty());
}

}  // namespace
}  // namespace floatframe::test
