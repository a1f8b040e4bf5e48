#pragma once
// Constraints between markers that a formulation enforces with multipliers: parts of joints and
// elements (model/constraint_part.hpp), numbered row by row,
//   Phi_i(q, t) = 0,
//   Phidot_i  = F_a.v_a + T_a.w_a + F_b.v_b + T_b.w_b + dPhi/dt                     (1)
//   Phiddot_i = F_a.a_a + T_a.alpha_a + F_b.a_b + T_b.alpha_b + quad + d2Phi/dt2    (2)
// with the gradient (F_a, T_a, F_b, T_b) of row i, a wrench on the markers a and b of its part,
// their velocities (v, w) and accelerations (a, alpha), and quad the contribution of the velocities
// due to the change of the gradient. A weight w_i on each row acts on the bodies as the sum of w_i
// times these wrenches, which is Phi_q^T w.
//
// The motion of a marker depends on the formulation and is supplied by callables. Rows may begin
// after other rows (`first`), so that the vectors contain all constraints of a formulation. A part
// that continues the one before has a gradient of its own, and values, rates and accelerations that
// are added to those of the row. Step time: no heap, noexcept.
#include <cassert>
#include <span>
#include <string>
#include <vector>

#include "floatframe/formulation/element_set.hpp"
#include "floatframe/formulation/point_motion.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/model/constraint_part.hpp"

namespace floatframe {

class ConstraintSet {
 public:
  /// Parts of these joints, then of all elements. Allocates.
  ConstraintSet(const Model& model, std::span<const int> joints);
  /// Numbers the rows, starting at `first`. Allocates.
  void number_rows(int first);
  /// Angles that are held over several turns are continued from those of `elements`.
  void count_turns_with(const ElementSet& elements);

  const std::vector<ConstraintPart>& parts() const noexcept { return parts_; }
  /// First row of a part; of one that continues the row of the part before, that row.
  int offset(std::size_t part) const noexcept {
    assert(part < offsets_.size());
    return offsets_[part];
  }
  /// Number of all rows, including those before the first.
  int count() const noexcept { return count_; }
  /// Row r of a part, without what parts after it add.
  const ConstraintRow& row(std::size_t part, int r) const noexcept {
    assert(part < parts_.size() && r >= 0 && r < parts_[part].rows());
    return rows_[stored_[part] + r];
  }
  /// The row of the part before goes on with this one; false past the end.
  bool continues(std::size_t part) const noexcept {
    return part < parts_.size() && parts_[part].continues;
  }
  /// The first part that row i belongs to; none (`parts().size()`) for rows before the first.
  std::size_t part_of_row(int i) const noexcept;
  /// "joint 'hinge'", "rod 'tie'" that row i belongs to.
  std::string owner_of_row(int i) const;

  /// Phi [m], all rows; those before the first are filled by the formulation.
  VecX& values() noexcept { return values_; }
  const VecX& values() const noexcept { return values_; }
  /// lambda [N], those of the last `set_multipliers`.
  const VecX& multipliers() const noexcept { return multipliers_; }
  /// lambda + alpha Phi [N], of the last `set_multipliers`.
  const VecX& weights() const noexcept { return weights_; }
  void set_multipliers(const VecX& lambda, double alpha) noexcept {
    assert(lambda.size() == count_ && alpha >= 0.0);
    multipliers_ = lambda;
    weights_ = lambda;
    weights_ += alpha * values_;
  }

  /// Rows and values at time t; `state(marker)` is a MarkerState.
  template <class StateOf>
  void evaluate(double t, const StateOf& state) noexcept {
    assert(offsets_.size() == parts_.size() && values_.size() == count_);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const ConstraintPart& p = parts_[k];
      ConstraintRow* rows = rows_.data() + stored_[k];
      evaluate_constraint(p, state(p.a), state(p.b), t, rows);
      put(k, values_, [&](const ConstraintRow& row) { return row.phi; });
    }
  }

  /// (1), with `state(marker)` as above.
  template <class StateOf>
  void rates(const StateOf& state, VecX& out) const noexcept {
    assert(out.size() == count_);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const ConstraintPart& p = parts_[k];
      const MarkerState& a = state(p.a);
      const MarkerState& b = state(p.b);
      put(k, out, [&](const ConstraintRow& row) {
        const WrenchRow& g = row.gradient;
        return g.a.F.dot(a.v) + g.a.T.dot(a.w) + g.b.F.dot(b.v) + g.b.T.dot(b.w) + row.phi_t;
      });
    }
  }

  /// out = Phi_q x, `motion(marker)` the PointMotion under the increment x.
  template <class MotionOf>
  void increments(const MotionOf& motion, VecX& out) const noexcept {
    assert(out.size() == count_);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const ConstraintPart& p = parts_[k];
      const PointMotion a = motion(p.a), b = motion(p.b);
      put(k, out, [&](const ConstraintRow& row) {
        const WrenchRow& g = row.gradient;
        return g.a.F.dot(a.linear) + g.a.T.dot(a.angular) + g.b.F.dot(b.linear) +
               g.b.T.dot(b.angular);
      });
    }
  }

  /// (2), `motion(marker)` the PointMotion of accelerations.
  template <class MotionOf>
  void accelerations(const MotionOf& motion, VecX& out) const noexcept {
    assert(out.size() == count_);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const ConstraintPart& p = parts_[k];
      const PointMotion a = motion(p.a), b = motion(p.b);
      put(k, out, [&](const ConstraintRow& row) {
        const WrenchRow& g = row.gradient;
        return g.a.F.dot(a.linear) + g.a.T.dot(a.angular) + g.b.F.dot(b.linear) +
               g.b.T.dot(b.angular) + row.quad + row.phi_tt;
      });
    }
  }

  /// The gradient of the whole row r that begins with a part: the wrenches on the markers of the
  /// part and of those that continue it, two of each. Returns their number.
  std::size_t gradient(std::size_t part, int r, std::span<Wrench> out) const noexcept {
    std::size_t n = 0;
    do {
      assert(n + 2 <= out.size());
      const WrenchRow& g = row(part, r).gradient;
      out[n++] = g.a;
      out[n++] = g.b;
    } while (continues(++part));
    return n;
  }
  /// The same markers. Allocates.
  std::vector<int> markers(std::size_t part) const;
  /// The wrench of a part whose rows have the weights w.
  WrenchRow wrench(std::size_t part, const VecX& w) const noexcept;
  /// The force of the element whose first part this is, with the multipliers from its first row on:
  /// of one row with its sign, of several the size of the force on the point, or of the torque if
  /// it holds directions alone.
  double force_of(std::size_t part, const double* lambda) const noexcept;
  /// Phi_q^T w: calls add(marker, force, torque) twice for each part.
  template <class Add>
  void add_wrenches(const VecX& w, const Add& add) const noexcept {
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const WrenchRow sum = wrench(k, w);
      add(parts_[k].a, sum.a.F, sum.a.T);
      add(parts_[k].b, sum.b.F, sum.b.T);
    }
  }

  /// Power of prescribed motions with these multipliers, after `evaluate` [W].
  double motion_power(const VecX& lambda) const noexcept;

 private:
  /// value(row) of each row of a part into `out`; of a part that continues a row, added to it.
  template <class Value>
  void put(std::size_t part, VecX& out, const Value& value) const noexcept {
    const ConstraintRow* rows = rows_.data() + stored_[part];
    double* place = out.data() + offsets_[part];
    if (parts_[part].continues) {
      *place += value(*rows);
      return;
    }
    const int count = parts_[part].rows();
    for (int r = 0; r < count; ++r) place[r] = value(rows[r]);
  }

  const Model& model_;
  std::vector<ConstraintPart> parts_;
  std::vector<int> offsets_, stored_;  ///< first row of each part, and its place in `rows_`
  std::vector<ConstraintRow> rows_;    ///< of the parts, one after the other
  int count_ = 0;
  VecX values_, multipliers_, weights_;
};

}  // namespace floatframe
