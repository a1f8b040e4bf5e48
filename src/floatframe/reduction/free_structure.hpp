#pragma once
// A free structure. Its stiffness is singular, so A = K - sigma M with a negative
// shift is factored instead; M may be singular as well.
//   free modes        K x = w^2 M x; the first six are rigid motions
//   inertia relief    K u = f - M R (R^T M R)^-1 R^T f,   R^T M u = 0: elastic displacements of the
//                     free body under the forces f
// Load time: allocates and throws InputError.
#include <functional>
#include <string>

#include "floatframe/fe/fe_system.hpp"
#include "floatframe/reduction/eigenmodes.hpp"

namespace floatframe {

/// Rows of a system in a rigid motion: n x 6, three translations, three rotations about `origin`.
MatX rigid_motions(const FeModel& model, const FeSystem& system, const Vec3& origin);

/// A bound of the lowest elastic eigenvalue [rad2/s2] from above: Rayleigh-Ritz with displacements
/// that are quadratic in the coordinates. 0 if there is no such (no mass).
/// `softest`: the corresponding displacements; empty if there are none.
double elastic_estimate(const FeModel& model, const FeSystem& system, VecX* softest = nullptr);

class FreeStructure {
 public:
  /// R: rigid motions, n x 6. `estimate`: about the lowest elastic eigenvalue. `label`: of a row,
  /// for messages.
  FreeStructure(const SparseMatrix& K, const SparseMatrix& M, MatX R, double estimate,
                SparseSolver solver = SparseSolver::automatic,
                const std::function<std::string(int)>& label = {});

  const std::string& solver_name() const noexcept { return factors_.name(); }
  /// The `count` lowest, rigid motions among them.
  Eigenpairs modes(int count) const;
  /// Elastic response to forces (n x k) with inertia relief; `elastic`: known elastic modes, which
  /// speed it up.
  MatX relieved_response(const MatX& forces, const Eigenpairs& elastic) const;
  /// Number of modes below a frequency [Hz], rigid motions among them.
  int count_below(double frequency) const;

 private:
  const SparseMatrix& K_;
  const SparseMatrix& M_;
  MatX R_, MR_;
  Mat6 M_rr_;
  double sigma_;
  SparseSolver solver_;
  SparseMatrix A_;
  SparseFactors factors_;
};

}  // namespace floatframe
