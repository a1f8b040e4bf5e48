#pragma once
// Modes by any method, and the body built from them: the common path of bars and parts.
#include <Eigen/SparseCore>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/body/cut_pair.hpp"
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/eigenmodes.hpp"

namespace floatframe {

/// Mode shapes and their properties, before the body is built.
struct ModeSet {
  MatX X;            ///< rows of the structure x nm
  MatX K;            ///< nm x nm
  VecX frequencies;  ///< of the dynamic modes [Hz]
  std::vector<std::string> names;
  int equal_left_out = 0;  ///< as of FlexibleBody
};

/// For a structure held at its interfaces (FixedInterface, BarChains): the number of normal modes
/// within a largest number and a frequency limit [Hz] (0: none).
template <class Fixed>
int normal_mode_count(const Fixed& fixed, std::optional<int> number, double max_frequency) {
  if (!(max_frequency > 0.0)) return number.value_or(fixed.inner());
  const int below = fixed.count_below(max_frequency);
  return number ? std::min(below, *number) : below;
}

/// Number of modes with at most the frequency [Hz] of the last of `kept`: more than kept if a
/// group of equal frequency is cut (body/cut_pair.hpp).
template <class Fixed>
int count_with_group(const Fixed& fixed, int kept, double last) {
  if (kept == 0 || kept >= fixed.inner()) return kept;
  return std::max(kept, fixed.count_below(last * (1.0 + equal_frequencies)));
}

/// Constraint modes of the interface dofs, named by `names`, then the normal modes. They do not
/// couple in the stiffness, normal modes not among themselves.
template <class Fixed>
ModeSet craig_bampton_set(const Fixed& fixed, const Eigenmodes& normal,
                          std::vector<std::string> names) {
  const auto nb = static_cast<Eigen::Index>(names.size()), nn = normal.omega.size();
  ModeSet set;
  set.X.resize(normal.shapes.rows(), nb + nn);
  if (nb > 0) set.X.leftCols(nb) = fixed.constraint_modes();
  set.X.rightCols(nn) = normal.shapes;
  set.K = MatX::Zero(nb + nn, nb + nn);
  if (nb > 0) set.K.topLeftCorner(nb, nb) = fixed.guyan_stiffness(set.X.leftCols(nb));
  set.K.diagonal().tail(nn) = normal.omega.cwiseAbs2();
  set.frequencies = normal.frequencies();
  for (Eigen::Index a = 0; a < nn; ++a) names.push_back("normal " + std::to_string(a + 1));
  set.names = std::move(names);
  return set;
}

/// Appends the residual shapes of unit forces on these rows of K, which the modes of the set lack:
///   R = K_ii^-1 F - Phi w^-2 Phi^T F,  G = F^T R = V diag(g) V^T,  shapes R V
/// orthogonal to all others in the stiffness, and among themselves; each has the largest component
/// 1. Those that add less than 1e-8 of the deflection are left out. After them a force on any of
/// these rows deflects the structure as without a reduction.
template <class Fixed>
void append_residual_shapes(const Fixed& fixed, const Eigen::SparseMatrix<double>& K,
                            const Eigenmodes& normal, const std::vector<int>& loaded,
                            ModeSet& set) {
  const Eigen::Index n = std::ssize(loaded);
  if (n == 0) return;
  MatX F = MatX::Zero(K.rows(), n);
  for (Eigen::Index k = 0; k < n; ++k) F(loaded[k], k) = 1.0;
  MatX R = fixed.inner_response(F);
  const double whole = F.cwiseProduct(R).colwise().sum().maxCoeff();
  const MatX share =
      normal.omega.cwiseAbs2().cwiseInverse().asDiagonal() * MatX(normal.shapes.transpose() * F);
  R -= normal.shapes * share;
  const MatX G = F.transpose() * R;
  const SymmetricEigen eig = symmetric_eigen(MatX(0.5 * (G + G.transpose())));
  Eigen::Index more = 0;
  while (more < n && eig.values[n - 1 - more] > 1e-8 * whole) ++more;
  MatX shapes = R * eig.vectors.rightCols(more).rowwise().reverse();
  for (Eigen::Index k = 0; k < more; ++k) {
    Eigen::Index largest = 0;
    shapes.col(k).cwiseAbs().maxCoeff(&largest);
    shapes.col(k) /= double(shapes(largest, k));
    set.names.push_back("residual " + std::to_string(k + 1));
  }
  const Eigen::Index before = set.X.cols();
  set.X.conservativeResize(Eigen::NoChange, before + more);
  set.X.rightCols(more) = shapes;
  // Of the shapes themselves, whose differences of flexibilities have lost digits.
  const MatX own = shapes.transpose() * MatX(K * shapes);
  set.K.conservativeResize(before + more, before + more);
  set.K.rightCols(more).setZero();
  set.K.bottomRows(more).setZero();
  set.K.bottomRightCorner(more, more) = 0.5 * (own + own.transpose());
}

/// The body from modes: everything except its nodes, its damping and the data of the projection
FlexibleBody body_of_modes(ModeSet modes, InertiaInvariants invariants);

}  // namespace floatframe
