#pragma once
// A structure held at its interface dofs: the matrix part of the Craig-Bampton
// method. With the dofs split into boundary b, inner i and others that are zero in every mode,
//   constraint modes            X_i = -K_ii^-1 K_ib        one for each boundary dof
//   fixed-interface modes       K_ii x = w^2 M_ii x        x^T M_ii x = 1
//   Guyan stiffness             K_bb - K_bi K_ii^-1 K_ib
// Load time: allocates and throws InputError.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/math/sparse_factors.hpp"
#include "floatframe/reduction/eigenmodes.hpp"

namespace floatframe {

/// `solve` returns the normal modes of `inner` dofs. Throws InputError if `count` exceeds the
/// number of dofs or massive directions.
Eigenmodes inner_modes(int count, int inner, const std::function<Eigenmodes(int)>& solve,
                       bool at_most = false);

/// Rows and columns of A in any order.
SparseMatrix pick(const SparseMatrix& A, const std::vector<int>& rows,
                  const std::vector<int>& columns);

class FixedInterface {
 public:
  /// `boundary`: rows of K; `zero`: further rows that are held in every mode. `label` names a row
  /// in the message about a singular stiffness.
  FixedInterface(const SparseMatrix& K, const SparseMatrix& M, const std::vector<int>& boundary,
                 const std::vector<int>& zero, const std::function<std::string(int)>& label,
                 SparseSolver solver = SparseSolver::automatic);

  int size() const noexcept { return size_; }
  int inner() const noexcept { return static_cast<int>(inner_.size()); }
  const std::string& solver_name() const noexcept { return factors_.name(); }

  /// size x boundary: the constraint modes.
  MatX constraint_modes() const;
  /// Guyan stiffness: the stiffness of the constraint modes X, exactly symmetric.
  MatX guyan_stiffness(const MatX& X) const;
  /// Response of the inner dofs to forces (size x k; those on other rows do not count).
  MatX inner_response(const MatX& forces) const;

  /// Shapes with all rows. Throws if more are requested than the inner mass allows.
  /// `at_most`: fewer are returned instead.
  Eigenmodes normal_modes(int count, bool at_most = false) const;
  /// Number of fixed-interface modes below a frequency [Hz].
  int count_below(double frequency) const;

 private:
  MatX with_all_rows(const MatX& inner) const;

  int size_ = 0;
  SparseSolver solver_;
  std::vector<int> boundary_, inner_;
  SparseMatrix Kii_, Mii_, Kib_, Kbb_;
  SparseFactors factors_;
};

}  // namespace floatframe
