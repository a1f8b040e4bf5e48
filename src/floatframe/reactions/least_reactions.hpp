#pragma once
// The reactions of least norm among those with the same effect on the bodies. Let J contain the
// rows of all joints, rods and motions (each scaled to lengths), on the motions of the separate
// bodies: translation and rotation of the frame, amplitudes. The wrenches J^T lambda do not change
// if a lambda with J^T lambda = 0 is added. The one of least norm is
//   lambda_least = J x,   J^T J x = J^T lambda,                                              (1)
// and a quantity c . lambda is unique if it has the same value for both. J^T lambda is the action
// of the joints on the bodies, so the results are the same in both formulations, and equal to those
// of `ConstraintAnalysis` at rest.
//
// J^T J couples bodies with common joints: sparse factors of J^T J + e, with a small e for motions
// that the constraints leave free, with one correction. If the residual exceeds 1e-8 of J^T lambda,
// close to singular configurations, an orthonormal basis U of the columns of J is used instead,
// lambda_least = U U^T lambda, by Gram-Schmidt with pivoting, each column twice; columns shorter
// than 1e-7 of the longest are gaps of closed loops. Step time: no heap, noexcept.
#include <vector>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/math/block_ldlt.hpp"
#include "floatframe/model/reactions.hpp"

namespace floatframe {

class LeastReactions {
 public:
  /// Allocates.
  explicit LeastReactions(const Model& model);

  int rows() const noexcept { return all_.count(); }
  /// J at the present positions of f.
  void place(const Formulation& f) noexcept;
  /// Replaces reactions by those of least norm with the same effect, in place, after `place`.
  void project_to_minimum_norm(const Formulation& f, Reactions& reactions) noexcept;
  /// Equation (1) applied to multipliers, in place.
  void project_to_minimum_norm(VecX& lambda) noexcept;
  /// The wrenches of lambda.
  void wrenches(const VecX& lambda, Reactions& reactions) const noexcept;

 private:
  /// Rows on one body, stored as consecutive columns.
  struct Side {
    int body = -1;   ///< -1: the ground
    int size = 0;    ///< columns
    int at = 0;      ///< of the first row in `rows_of_J_`
    int column = 0;  ///< of J
  };
  /// Consecutive parts between the same bodies: a joint with its motion, the parts of one row.
  struct Group {
    std::vector<Side> sides;
    int first = 0, parts = 0;  ///< parts
    int row = 0, rows = 0;
  };
  void fill(const Formulation& f, const SystemMotion& motion, const Group& group, int part,
            bool of_b) noexcept;
  void add_normal_equations(const Side& s, const Side& t, int rows) noexcept;
  /// Calls f with the rows of a side as columns: of a rigid body at most six of six numbers.
  template <class Call>
  void with_rows(const Side& s, int rows, const Call& f) const noexcept {
    const double* data = rows_of_J_.data() + s.at;
    if (s.size == 6 && rows <= 6)
      f(Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>>(data, 6, rows));
    else if (s.size > 0)
      f(Eigen::Map<const MatX>(data, s.size, rows));
  }
  void times_transpose(const VecX& lambda, VecX& out) const noexcept;
  void add_times(const VecX& x, VecX& lambda) const noexcept;
  /// load_ = J^T lambda for these reactions.
  void find_load(const Formulation& f, const Reactions& reactions) noexcept;
  void add_load(const LocalMarker& m, const SystemMotion& motion, const Vec3& force,
                const Vec3& torque) noexcept;
  void multipliers(const Reactions& reactions, VecX& lambda) noexcept;
  /// least_ from load_; false if it is not accurate enough.
  bool solve_sparse() noexcept;
  void shorten_dense(VecX& lambda) noexcept;
  void orthonormalise() noexcept;

  const Model& model_;
  ConstraintSet all_;
  std::vector<VecX> mode_scale_;  ///< of each body: 1 / its largest displacement, mode by mode
  std::vector<Group> groups_;
  std::vector<std::vector<int>> held_;  ///< parts of elements that hold coordinates of a joint
  std::vector<double> rows_of_J_;
  std::vector<int> column_;  ///< of each body
  BlockLdlt normal_;
  bool factorised_ = false, dense_ = false;
  MatX U_;  ///< J, then its basis in the leading columns
  Eigen::Index rank_ = 0;
  VecX lengths_, projected_, load_, left_, x_, least_;
};

}  // namespace floatframe
