#pragma once
// The force elements of a model in a formulation: their inputs, their states at the last
// evaluation, and the turns counted by the angles of joint springs. An angle is known up to whole
// turns; the value nearest to the angle of the last evaluation is used, so the angles are a part of
// the state that q does not contain. Step time: no heap, noexcept.
#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

#include "floatframe/model/force_evaluation.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

class ForceSet {
 public:
  /// All angles start at zero (`count_turns_from`). Allocates.
  explicit ForceSet(const Model& model);

  /// Values of `model.inputs`, constant until they are set again; at first their initial values.
  void set_inputs(std::span<const double> values) noexcept {
    assert(values.size() == inputs_.size());
    std::copy(values.begin(), values.end(), inputs_.begin());
  }
  std::span<const double> inputs() const noexcept { return inputs_; }

  /// Angles of the joint springs at the last evaluation, a number for each force [rad].
  std::span<const double> angles() const noexcept { return angles_; }
  void set_angles(std::span<const double> angles) noexcept {
    assert(angles.size() == angles_.size());
    std::copy(angles.begin(), angles.end(), angles_.begin());
  }
  void set_angle(std::size_t force, double angle) noexcept { angles_[force] = angle; }
  /// Turns are counted starting at the start values of these joints, or their motions at time t.
  void count_turns_from(const Model& values, double t) noexcept;

  /// Held branches of the laws (`force_side`), a number for each force; `free_branch` if none is
  /// held.
  std::span<const std::int64_t> branches() const noexcept { return branches_; }
  void hold_branches(std::span<const std::int64_t> branches) noexcept {
    assert(branches.size() == branches_.size());
    std::copy(branches.begin(), branches.end(), branches_.begin());
  }
  void hold_branch(std::size_t force, std::int64_t branch) noexcept { branches_[force] = branch; }
  /// Result of `force_side` for a force whose law has branches.
  template <class StateOf>
  ForceSide side(std::size_t k, const Vec3& p_WO, double t, const StateOf& state) const noexcept {
    const Force& f = model_.forces[k];
    const MarkerState& b = state(f.b);
    const MarkerState& a = f.a >= 0 ? state(f.a) : b;
    return force_side(model_, f, a, b, p_WO, t, angles_[k], inputs_, branches_[k]);
  }

  /// The beginning of a step, and its end: changes of the angles in a rejected step are
  /// discarded.
  void stepping(bool on, bool accepted) noexcept {
    if (on)
      std::copy(angles_.begin(), angles_.end(), kept_angles_.begin());
    else if (!accepted)
      std::copy(kept_angles_.begin(), kept_angles_.end(), angles_.begin());
  }

  const ForceState& state(std::size_t k) const noexcept { return states_[k]; }
  std::span<const ForceState> states() const noexcept { return states_; }

  /// All states at time t; `state(marker)` is a MarkerState with positions from `p_WO`.
  template <class StateOf>
  void evaluate(const Vec3& p_WO, double t, const StateOf& state) noexcept {
    for (std::size_t k = 0; k < model_.forces.size(); ++k) {
      const Force& f = model_.forces[k];
      const MarkerState& b = state(f.b);
      const MarkerState& a = f.a >= 0 ? state(f.a) : b;
      evaluate_force(model_, f, a, b, p_WO, t, angles_[k], states_[k], inputs_, branches_[k]);
      if (f.rotational) angles_[k] = states_[k].length;
    }
  }

  /// Left-hand side of the forces, -Q: calls add(marker, force, torque) for each marker of each
  /// force.
  template <class Add>
  void add_wrenches(const Add& add) const noexcept {
    for (std::size_t k = 0; k < model_.forces.size(); ++k) {
      const Force& f = model_.forces[k];
      const WrenchRow& w = states_[k].wrench;
      if (f.a >= 0) add(f.a, -w.Fa, -w.Ta);
      add(f.b, -w.Fb, -w.Tb);
    }
  }

 private:
  const Model& model_;
  std::vector<ForceState> states_;
  std::vector<double> angles_;       ///< select the turn of the next evaluation [rad]
  std::vector<double> kept_angles_;  ///< those at the beginning of the step
  std::vector<double> inputs_;
  std::vector<std::int64_t> branches_;
};

}  // namespace floatframe
