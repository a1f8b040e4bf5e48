#pragma once
// The reactions of least norm among those that move the bodies alike. With the rows of all joints,
// rods and motions in J (each scaled to lengths), on what each body can do by itself - its frame
// moves and turns, its amplitudes change - the wrenches J^T lambda do not change if a lambda with
// J^T lambda = 0 is added. With an orthonormal basis U of the columns of J,
//   lambda_least = U U^T lambda,                                                             (1)
// and a quantity c . lambda is unique if (I - U U^T) c = 0. Tree joints of relative coordinates
// have no multipliers; their lambda is what their wrench needs: J_k^T lambda_k = wrench. So the
// numbers are the same in both formulations, and those of `ConstraintAnalysis` at rest.
//
// U by Gram-Schmidt with pivoting, each column twice; columns that are shorter than 1e-7 of the
// longest are what closed loops are off by. Step time: no heap, noexcept.
#include <vector>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/model/reactions.hpp"

namespace floatframe {

/// Adds the wrenches of these multipliers to those of the joints, and sets those of rods and
/// motions.
void add_part_wrenches(const ConstraintSet& set, const VecX& lambda, Reactions& reactions) noexcept;

template <class F>
class LeastReactions {
 public:
  /// Allocates.
  explicit LeastReactions(const Model& model);

  int rows() const noexcept { return all_.count(); }
  /// U at the present positions of f.
  void place(const F& f, double t) noexcept;
  /// lambda of these wrenches, after `place`.
  void multipliers(const Reactions& reactions, VecX& lambda) noexcept;
  /// (1), in place.
  void shorten(VecX& lambda) noexcept;
  /// The wrenches of lambda.
  void wrenches(const VecX& lambda, Reactions& reactions) const noexcept;

 private:
  void add_column_block(int row, const F& f, int marker, const Vec3& force,
                        const Vec3& torque) noexcept;
  void orthonormalise() noexcept;

  const Model& model_;
  ConstraintSet all_;
  std::vector<int> column_;       ///< of each body: 3 of its frame, 3 of its turning, its modes
  std::vector<VecX> mode_scale_;  ///< of each body: 1 / its largest displacement, mode by mode
  MatX U_;                        ///< J, then its basis in the leading columns
  Eigen::Index rank_ = 0;
  VecX lengths_, projected_;
};

extern template class LeastReactions<RelativeFormulation>;
extern template class LeastReactions<AbsoluteFormulation>;

}  // namespace floatframe
