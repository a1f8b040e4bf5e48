#pragma once
// Redundant constraints. Let J contain the rows of all joints, rods, couplings and motions (each
// scaled to lengths), on the motions of the separate bodies (three translations, three rotations
// and the amplitudes each):
//   a row that depends on the rows before it is redundant, in the order of joints, rods, couplings,
//   motions;
//   reactions are J^T lambda, so a lambda with J^T lambda = 0 may be added to them: a component
//   unaffected by all of these is unique, for the others the lambda of least norm is given.
// Tree joints of the relative formulation have no multipliers, so the rows are those of the
// absolute formulation. Load time only.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/loops/start_report.hpp"

namespace floatframe {

struct BalancedMultipliers {
  VecX lambda;    ///< of least norm
  MatX balanced;  ///< orthonormal columns that may be added to it
};

class ConstraintAnalysis {
 public:
  /// For the model as stored in `tree` at the configuration q, at rest.
  ConstraintAnalysis(RelativeFormulation& tree, const VecX& q);

  /// Rows that repeat earlier ones, except those of `held_motions`.
  std::vector<RedundantDirection> redundant() const;
  /// Joints with a prescribed motion that other constraints prevent.
  std::vector<std::string> held_motions() const;

  /// Those of the rows that balance the model; none if they leave more than this residual.
  std::optional<BalancedMultipliers> multipliers(double residual) const;
  /// Orthonormal multipliers of the rows that balance each other, as columns.
  MatX balanced() const;
  const std::vector<ConstraintPart>& parts() const { return f_.constraint_set().parts(); }
  /// First row of a part.
  Eigen::Index row_of(std::size_t part) const { return f_.constraint_set().offset(part) - first_; }
  /// `ConstraintSet::force_of` with multipliers of the rows.
  double force_of(std::size_t part, const VecX& lambda) const {
    return f_.constraint_set().force_of(part, lambda.data() + row_of(part));
  }
  const ConstraintRow& row(std::size_t part, int r) const {
    return f_.constraint_set().row(part, r);
  }

 private:
  bool holds_motion(std::size_t part) const;

  const Model& model_;
  AbsoluteFormulation f_;
  Eigen::Index first_ = 0;  ///< row of the first part, after the rows of bodies
  SparseRowMatrix J_;       ///< rows of the parts on the motions of the bodies
  VecX load_;               ///< required value of J_^T lambda
};

/// Adds redundant directions at the start and the sentence that names them. The full analysis is
/// made only if the rank of the constraints of the relative formulation shows that there are any.
void report_redundancy(RelativeFormulation& f, const State& state, StartReport& report);

/// Rank of the rows of J.
int rank_of(const SparseRowMatrix& J);
/// The rows with the largest coefficients in the combination of rows of J with the smallest nonzero
/// norm.
std::vector<int> dependent_rows(const MatX& J);
/// True if some independent rows of J are independent to a hundredth only.
bool nearly_dependent(const MatX& J);
/// Smallest part of a row of J that is independent of the rows before it, over the rows that are
/// not redundant; relative to the longest row.
double independence(const MatX& J);

}  // namespace floatframe
