// Stress stiffness: uniform states of stress in every element, the buckling of a plate, and the
// second order of a nonlinear static solution.
#include "floatframe/fe/stress_stiffness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/fe/model_checks.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/sparse_factors.hpp"
#include "support/fe_parts.hpp"
#include "support/midside_sheets.hpp"
#include "support/quadratic_mesh.hpp"
#include "support/shell_sheets.hpp"

namespace floatframe::test {
namespace {

/// Displacements G x of all nodes, with the rotation of the field.
NodalShapes linear_fields(const FeModel& model, const std::vector<Mat3>& fields) {
  const auto count = static_cast<Eigen::Index>(fields.size());
  NodalShapes out{MatX(3 * model.nodes(), count), MatX(3 * model.nodes(), count)};
  for (Eigen::Index a = 0; a < count; ++a) {
    const Mat3& G = fields[a];
    const Vec3 turn = 0.5 * Vec3(G(2, 1) - G(1, 2), G(0, 2) - G(2, 0), G(1, 0) - G(0, 1));
    for (int k = 0; k < model.nodes(); ++k) {
      out.U.col(a).segment<3>(3 * k) = G * model.positions[k];
      out.Theta.col(a).segment<3>(3 * k) = turn;
    }
  }
  return out;
}

Mat3 stress_of(const Material& m, const Mat3& G) {
  const Mat3 e = 0.5 * (G + G.transpose());
  const double lambda = 2.0 * m.shear() * m.poisson / (1.0 - 2.0 * m.poisson);
  return lambda * e.trace() * Mat3::Identity() + 2.0 * m.shear() * e;
}

TEST(StressStiffness, UniformStressInSolids) {
  FeModel bricks = brick_beam(2, 1, 1, 0.3, 0.1);
  for (Vec3& p : bricks.positions) p += 0.1 * Vec3(p.y() * p.z(), p.x() * p.y(), p.x() * p.z());
  std::vector<FeModel> meshes = {bricks, hex20_of(bricks), tets_of(bricks, false),
                                 tets_of(bricks, true)};
  for (const FeElementType type : {FeElementType::hex8i, FeElementType::hex8r}) {
    meshes.push_back(bricks);
    for (FeElement& e : meshes.back().elements) e.type = type;
  }
  Mat3 A, B, C;
  A << 1, 2, 3, -1, 0.5, 2, 0.3, -2, 1.2;
  B << 0.2, 1, -3, 2, 0.1, 0.7, 1.5, 1, -1;
  C << 1, -0.4, 0.2, 0.8, -0.5, 2, 0.1, 0.9, 3;
  for (const FeModel& model : meshes) {
    SCOPED_TRACE(fe_element_name(model.elements[0].type));
    const NodalShapes modes = linear_fields(model, {A, B});
    const NodalShapes cases = linear_fields(model, {C, 2.0 * A});
    const MatX K = stress_stiffness(model, modes, cases);
    const double V = volume(model);
    const Mat3 s = stress_of(steel, C);
    const Vec3 expected(V * (A * s * A.transpose()).trace(), V * (A * s * B.transpose()).trace(),
                        V * (B * s * B.transpose()).trace());
    EXPECT_LT((K.col(0) - expected).norm(), 1e-9 * expected.norm());
    const double other = 2.0 * V * (A * stress_of(steel, A) * A.transpose()).trace();
    EXPECT_NEAR(K(0, 1), other, 1e-9 * std::abs(other));
    EXPECT_EQ(symmetric_of(K.col(0))(1, 0), K(1, 0));
  }
}

/// 4 pi^2 D / b^2 of a square plate with simple supports under a force along x: the error of
/// Rayleigh's quotient with the deflection under a pressure sin sin.
double buckling_error(int n, FeElementType type) {
  constexpr double b = 0.5, t = 0.005;
  const bool middles = type == FeElementType::tri6 || type == FeElementType::quad8;
  const auto place = [](double x, double y) { return Vec3(b * x, b * y, 0); };
  const FeModel model = middles ? midside_sheet(type, n / 2, n / 2, place, steel, t).model
                                : sheet(type, n, n, place, steel, t);
  const FeSystem system = assemble(model);
  SparseMatrix K = system.K;
  VecX f = VecX::Zero(system.size());
  std::vector<char> held(system.size(), 0);
  for (int row = 0; row < system.size(); ++row) {
    const Dof& dof = system.dofs[row];
    const Vec3& p = model.positions[dof.node];
    const bool x_edge = p.x() < 1e-9 || p.x() > b - 1e-9, y_edge = p.y() < 1e-9 || p.y() > b - 1e-9;
    const bool in_plane = dof.axis == 0 || dof.axis == 1 || dof.axis == 5;
    held[row] = in_plane || (dof.axis == 2 && (x_edge || y_edge)) || (dof.axis == 3 && x_edge) ||
                (dof.axis == 4 && y_edge);
    if (dof.axis == 2 && held[row] == 0)
      f(row) = std::sin(std::numbers::pi * p.x() / b) * std::sin(std::numbers::pi * p.y() / b);
  }
  for (int j = 0; j < K.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(K, j); it; ++it)
      if (held[it.row()] != 0 || held[j] != 0) it.valueRef() = it.row() == j ? 1.0 : 0.0;
  const VecX w = SparseFactors(K).solve(f);
  const NodalShapes mode{system.T * w, system.T_theta * w};
  Mat3 squeezed = Mat3::Zero();
  squeezed.diagonal() << -1.0 / (steel.young * t), steel.poisson / (steel.young * t), 0.0;
  const double softening = -stress_stiffness(model, mode, linear_fields(model, {squeezed}))(0, 0);
  const double D = steel.young * t * t * t / (12.0 * (1.0 - steel.poisson * steel.poisson));
  const double exact = 4.0 * std::numbers::pi * std::numbers::pi * D / (b * b);
  return w.dot(f) / softening / exact - 1.0;
}

TEST(StressStiffness, BucklingOfAPlate) {
  for (const FeElementType type :
       {FeElementType::quad4, FeElementType::tri3, FeElementType::quad8, FeElementType::tri6}) {
    SCOPED_TRACE(fe_element_name(type));
    const double coarse = buckling_error(8, type), fine = buckling_error(16, type);
    RecordProperty(fe_element_name(type), std::to_string(coarse) + " " + std::to_string(fine));
    EXPECT_LT(std::abs(coarse), 0.005);
    EXPECT_LT(std::abs(fine), 0.001);
    if (type == FeElementType::quad4 || type == FeElementType::quad8) {
      EXPECT_NEAR(coarse / fine, 4.0, 1.0);
    }
  }
}

/// A block of tetrahedra with its first four nodes held and the strain energy of Green's strains.
struct Block {
  FeModel model = tets_of(brick_beam(1, 1, 1, 0.1, 0.1), false);
  static constexpr int held = 12;

  /// Internal forces by central differences of the energy would lose digits: they are
  /// int F S grad N dV, F = 1 + grad u, S = D E.
  VecX forces(const VecX& u) const {
    VecX f = VecX::Zero(u.size());
    for (const FeElement& e : model.elements) {
      Mat3 J;
      for (int i = 0; i < 3; ++i)
        J.col(i) = model.positions[e.nodes[i + 1]] - model.positions[e.nodes[0]];
      Eigen::Matrix<double, 3, 4> g;
      const Mat3 inverse = J.inverse();
      for (int i = 0; i < 3; ++i) g.col(i + 1) = inverse.row(i).transpose();
      g.col(0) = -(g.col(1) + g.col(2) + g.col(3));
      Mat3 F = Mat3::Identity();
      for (int a = 0; a < 4; ++a) F += u.segment<3>(3 * e.nodes[a]) * g.col(a).transpose();
      const Mat3 E = 0.5 * (F.transpose() * F - Mat3::Identity());
      const Mat3 P = J.determinant() / 6.0 * F * stress_of(steel, E);
      for (int a = 0; a < 4; ++a) f.segment<3>(3 * e.nodes[a]) += P * g.col(a);
    }
    return f;
  }
};

TEST(StressStiffness, SecondOrderOfANonlinearSolution) {
  const Block block;
  const FeSystem system = assemble(block.model);
  const int n = 3 * block.model.nodes(), free = n - Block::held;
  const MatX K = MatX(system.K).bottomRightCorner(free, free);
  const MatX inverse = lu_solve(K, MatX::Identity(free, free));
  VecX f = VecX::Zero(n);
  f.tail(free) = VecX::LinSpaced(free, -1.0, 1.5).cwiseAbs2() * 5e5;
  f(Block::held + 1) = -1e6;
  VecX linear = VecX::Zero(n);
  linear.tail(free) = inverse * f.tail(free);
  // Half of the sum of the solutions under f and -f, less what is linear.
  VecX second = VecX::Zero(n);
  for (const double sign : {1.0, -1.0}) {
    VecX u = sign * linear;
    for (int step = 0; step < 200; ++step) {
      const VecX rest = sign * f - block.forces(u);
      u.tail(free) += inverse * rest.tail(free);
    }
    EXPECT_LT((sign * f - block.forces(u)).tail(free).norm(), 1e-9 * f.norm());
    second += 0.5 * u;
  }
  // Of this displacement component k is -1/2 y^T K_sigma(e_k) y, and as the force turns the mode,
  // K dy = -K_sigma(f) y.
  NodalShapes unit{MatX::Zero(n, free), MatX::Zero(n, free)}, all = unit, load = unit;
  unit.U.bottomRows(free) = inverse;
  all.U.bottomRows(free).setIdentity();
  const MatX h = stress_stiffness(block.model, {linear, VecX::Zero(n)}, unit);
  load.U = linear;
  load.Theta = VecX::Zero(n);
  const MatX K_sigma = symmetric_of(stress_stiffness(block.model, all, load).col(0));
  const VecX expected = -0.5 * h.transpose() - inverse * (K_sigma * linear.tail(free));
  EXPECT_GT(expected.norm(), 1e-5 * linear.norm());
  // The next even order is the fourth.
  const double strain = linear.norm() / 0.1;
  EXPECT_LT((second.tail(free) - expected).norm(), 2.0 * strain * strain * expected.norm());
  EXPECT_LT(strain, 0.01);
}

}  // namespace
}  // namespace floatframe::test
