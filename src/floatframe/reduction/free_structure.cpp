#include "floatframe/reduction/free_structure.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/rigid_motion.hpp"

namespace floatframe {

MatX rigid_motions(const FeModel& model, const FeSystem& system, const Vec3& origin) {
  MatX R(system.size(), 6);
  for (int row = 0; row < system.size(); ++row) {
    const Dof& dof = system.dofs[row];
    if (model.matrices && model.matrices->is_scalar(dof.node))
      R.row(row).setZero();
    else
      R.row(row) = rigid_motion_at(model.positions[dof.node] - origin).row(dof.axis);
  }
  return R;
}

namespace {

/// Smallest eigenvalue of a single degree of freedom; 0 if none has mass and stiffness.
double softest_row(const FeSystem& system) {
  const VecX k = system.K.diagonal(), m = system.M.diagonal();
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < k.size(); ++i)
    if (m(i) > 0.0 && k(i) > 0.0) least = std::min(least, k(i) / m(i));
  return std::isfinite(least) ? least : 0.0;
}

}  // namespace

double elastic_estimate(const FeModel& model, const FeSystem& system, VecX* softest) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : model.positions) box.extend(p);
  const Vec3 centre = box.center();
  const double size = std::max(box.diagonal().norm(), 1e-300);
  // u = e_i r_a r_b; the rotation of a node is half the curl.
  MatX U = MatX::Zero(system.size(), 18);
  for (int row = 0; row < system.size(); ++row) {
    const Dof& dof = system.dofs[row];
    if (model.matrices && model.matrices->is_scalar(dof.node)) continue;
    const Vec3 r = (model.positions[dof.node] - centre) / size;
    int column = 0;
    for (int a = 0; a < 3; ++a) {
      for (int b = a; b < 3; ++b) {
        const Vec3 gradient = (Vec3::Unit(a) * r(b) + Vec3::Unit(b) * r(a)) / size;
        for (int i = 0; i < 3; ++i, ++column) {
          if (dof.axis < 3) {
            U(row, column) = dof.axis == i ? r(a) * r(b) : 0.0;
          } else {
            U(row, column) = 0.5 * gradient.cross(Vec3::Unit(i))(dof.axis - 3);
          }
        }
      }
    }
  }
  // About the centre and with rotations over the size: accuracy is independent of place and scale.
  MatX R = rigid_motions(model, system, centre);
  R.rightCols<3>() /= size;
  const MatX MR = system.M * R;
  const Mat6 M_rr = R.transpose() * MR;
  U -= R * LeastNorm(M_rr).solve(MatX(MR.transpose() * U));
  const MatX Kr = U.transpose() * (system.K * U);
  const MatX Mr = U.transpose() * (system.M * U);
  // Directions with mass only.
  const SymmetricEigen mass = symmetric_eigen(0.5 * (Mr + Mr.transpose()));
  const VecX& m = mass.values;
  Eigen::Index first = 0;
  while (first < m.size() && !(m(first) > 1e-8 * m(m.size() - 1))) ++first;
  const bool no_elements = model.elements.empty() && !model.matrices;
  if (first == m.size()) return no_elements ? softest_row(system) : 0.0;
  const MatX Q = mass.vectors.rightCols(m.size() - first) *
                 m.tail(m.size() - first).cwiseSqrt().cwiseInverse().asDiagonal();
  const SymmetricEigen modes = symmetric_eigen(Q.transpose() * Kr * Q);
  const VecX shape = U * (Q * modes.vectors.col(0));
  if (softest != nullptr) *softest = shape;
  if (!no_elements) return std::max(modes.values(0), 0.0);
  // Coincident bodies on springs: such shapes do not separate them.
  const double energy = shape.dot(system.K * shape);
  const double rounding =
      shape.cwiseAbs().dot(SparseMatrix(system.K.cwiseAbs()) * shape.cwiseAbs());
  return energy > 1e-13 * rounding ? modes.values(0) : softest_row(system);
}

FreeStructure::FreeStructure(const SparseMatrix& K, const SparseMatrix& M, MatX R, double estimate,
                             SparseSolver solver, const std::function<std::string(int)>& label)
    : K_(K),
      M_(M),
      R_(std::move(R)),
      MR_(M * R_),
      M_rr_(R_.transpose() * MR_),
      sigma_(-estimate),
      solver_(solver),
      A_(K - sigma_ * M),
      factors_(A_, solver) {
  if (!(estimate > 0.0))
    throw InputError(
        ErrorCode::singular,
        "there are no free modes: what the part can do besides moving rigidly moves no "
        "mass, or nothing resists it (a mechanism)");
  if (factors_.singular() >= 0)
    throw InputError(
        ErrorCode::singular,
        "neither the stiffness nor the mass of the free part holds " +
            (label ? label(static_cast<int>(factors_.singular())) : std::string("some motion")));
  if (factors_.negative_pivots() > 0)
    throw InputError(ErrorCode::singular,
                     "the stiffness or the mass is not positive: an energy is negative");
}

Eigenpairs FreeStructure::modes(int count) const {
  return lowest_eigenpairs(A_, factors_, sigma_, M_, count);
}

MatX FreeStructure::relieved_response(const MatX& forces, const Eigenpairs& elastic) const {
  const Eigen::LDLT<Mat6> rigid(M_rr_);
  const auto balance = [&](MatX& f) { f -= MR_ * rigid.solve(R_.transpose() * f); };
  MatX f = forces;
  balance(f);
  // The part of the known modes is x x^T f / w^2; the rest by A u = f + sigma M (...), repeated.
  MatX modal(f.rows(), f.cols());
  const MatX& X = elastic.shapes;
  const MatX MX = M_ * X;
  modal.noalias() = X * elastic.lambda.cwiseInverse().asDiagonal() * (X.transpose() * f);
  f -= MX * (X.transpose() * f);
  const auto clean = [&](MatX& u) {
    u -= R_ * rigid.solve(MR_.transpose() * u);
    u -= X * (MX.transpose() * u);
  };
  MatX u = factors_.solve(f);
  clean(u);
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 60; ++step) {
    // K u = f  <=>  A u = f - sigma M u
    MatX next = factors_.solve(f - sigma_ * (M_ * u));
    clean(next);
    const double change = (next - u).norm();
    u = std::move(next);
    if (!(change < 0.9 * last) || change <= 1e-14 * u.norm()) break;
    last = change;
  }
  return u + modal;
}

int FreeStructure::count_below(double frequency) const {
  const double omega = omega_of(frequency);
  return SparseFactors(SparseMatrix(K_ - omega * omega * M_), solver_).negative_pivots();
}

}  // namespace floatframe
