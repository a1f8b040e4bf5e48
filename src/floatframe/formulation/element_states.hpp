#pragma once
// The states of all elements of a model, z, one element after the other: of each its states and
// behind them its kept numbers. They are given, or they follow the motion: at each evaluation
//   w z + z_hat = zdot(ports, z)                                                               (1)
// is solved for the states of each element by a damped Newton iteration with the slopes of its law.
// w, z_hat: those of a step (integrator/state_scheme.hpp); w = 0 = z_hat: at rest. A state that has
// no equation at rest, since its rate is the same whatever the states of its element are, keeps its
// value: an integral. Its rate there is its drift. A deflection (element_kind.hpp), of bristles
// that stick, follows the positions at rest, from its place s_0 at the start of the search on:
//   z = clamp(s - s_0, -z_s, z_s)                                                              (2)
// One that is not zero there belongs to a contact that slides, and keeps its value.
// Step time: no heap, noexcept.
#include <cassert>
#include <limits>
#include <span>
#include <vector>

#include "floatframe/math/local_newton.hpp"
#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// Which states and kept numbers begin: all that the model does not give; of sampled elements only;
/// none, but pasts become those of a start that has been found.
enum class StateStart { all, sampled, found };

class ElementStates {
 public:
  /// Zero, given. Allocates.
  explicit ElementStates(const Model& model);

  /// Of all elements.
  int count() const noexcept { return static_cast<int>(z_.size()); }
  /// The elements that have some.
  std::span<const std::size_t> elements() const noexcept { return elements_; }
  const VecX& values() const noexcept { return z_; }
  /// zdot at the last evaluation; zero for kept numbers.
  const VecX& rates() const noexcept { return rates_; }
  const double* of(std::size_t element) const noexcept { return z_.data() + offsets_[element]; }

  /// From now on constant.
  void give(const VecX& z) noexcept {
    assert(z.size() == z_.size());
    z_ = z;
    follow_ = at_rest_ = false;
    unsolved_ = -1;
  }
  /// From now on by (1), beginning with the present values; `z_hat` must outlive this.
  void follow(double weight, const VecX& z_hat) noexcept {
    assert(weight >= 0.0 && z_hat.size() == z_.size());
    weight_ = weight;
    z_hat_ = &z_hat;
    follow_ = count() > 0;
    at_rest_ = weight == 0.0;
    unsolved_ = -1;
  }
  /// (1) at rest.
  void rest() noexcept { follow(0.0, zero_); }
  /// At rest deflections are zero at these ports.
  void begin_deflection(std::size_t element, const Ports& in) noexcept;
  /// (2), if states follow at rest.
  void deflect(std::size_t element, const Ports& in) noexcept;
  /// What (2) gives at these ports, and its slope over s.
  struct Deflected {
    double z = 0.0, slope = 0.0;
  };
  Deflected deflected(std::size_t element, int state, const Ports& in) const noexcept;
  bool deflects(std::size_t element, int state) const noexcept {
    return rest_slopes(element) && deflects_[offsets_[element] + state];
  }
  /// dz/ds of (2) of the states of an element; null: not at rest.
  const double* rest_slopes(std::size_t element) const noexcept {
    static constexpr double nothing = 0.0;  // at rest without states
    if (!at_rest_) return nullptr;
    return rest_slopes_.size() > 0 ? rest_slopes_.data() + offsets_[element] : &nothing;
  }
  /// The rates of such states at the last evaluation at rest; zero for all others.
  const VecX& drift() const noexcept { return drift_; }
  /// The states that kept their values at that evaluation, by their places.
  bool keeps_value(Eigen::Index state) const noexcept { return held_[state]; }
  /// A change of them.
  void move(const VecX& dz) noexcept { z_ += dz; }
  /// From now on constant, with the present values.
  void stop() noexcept { follow_ = at_rest_ = false; }
  bool follow() const noexcept { return follow_; }
  double weight() const noexcept {
    return follow_ ? weight_ : std::numeric_limits<double>::infinity();
  }
  /// The first element whose (1), or whose ring of signals, had no solution since `follow` or
  /// `give`; -1: none.
  int unsolved() const noexcept { return unsolved_; }

  /// (1) of an element, and its efforts there.
  void solve(std::size_t element, const Ports& in, Efforts& out) noexcept;
  /// At a start; or, if it has been `found`, what is known then only.
  void start(std::size_t element, const Ports& in, bool found) noexcept;
  void after_step(std::size_t element, const Ports& in) noexcept;
  void take_rates(const std::vector<Efforts>& efforts) noexcept;
  /// Kept numbers have no rates, also if they change within a step.
  void clear_kept_rates(VecX& rates) const noexcept;

  // What solves for the states of several elements together uses:
  double* of(std::size_t element) noexcept { return z_.data() + offsets_[element]; }
  void find_gap(std::size_t element, const Efforts& out, double* gap, double* size) noexcept;
  /// Before a solution: no state of the element is held at its value.
  void release(std::size_t element) noexcept;
  /// At rest, of the states whose slopes are the rows from `row` on: those without an equation.
  void hold_drifting(std::size_t element, Eigen::Index row, LocalNewton& newton) noexcept;
  void fail(std::size_t element) noexcept {
    if (unsolved_ < 0) unsolved_ = static_cast<int>(element);
  }

 private:
  const Model& model_;
  std::vector<int> offsets_;
  std::vector<std::size_t> elements_;
  std::vector<LocalNewton> newton_;  ///< of each element
  VecX z_, rates_, drift_, zero_;
  VecX rest_slopes_, places_;   ///< of (2): dz/ds, s_0
  std::vector<char> deflects_;  ///< by (2)
  std::vector<char> held_;      ///< of each state, at rest
  const VecX* z_hat_ = nullptr;
  double weight_ = 0.0;
  bool follow_ = false;
  bool at_rest_ = false;  ///< following with the weight 0, or at rest without states
  int unsolved_ = -1;
};

}  // namespace floatframe
