#pragma once
// The states of all elements of a model, z, one element after the other: of each its states and
// behind them its kept numbers. They are given, or they follow the motion: at each evaluation
//   w z + z_hat = zdot(ports, z)                                                               (1)
// is solved for the states of each element by a damped Newton iteration with the slopes of its law.
// w, z_hat: those of a step (integrator/state_scheme.hpp); w = 0 = z_hat: at rest. A state that has
// no equation at rest (its rate is zero whatever it is: a bristle that sticks) keeps its value.
// Step time: no heap, noexcept.
#include <Eigen/LU>
#include <cassert>
#include <limits>
#include <span>
#include <vector>

#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

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
    follow_ = false;
  }
  /// From now on by (1), beginning with the present values; `z_hat` must outlive this.
  void follow(double weight, const VecX& z_hat) noexcept {
    assert(weight >= 0.0 && z_hat.size() == z_.size());
    weight_ = weight;
    z_hat_ = &z_hat;
    follow_ = count() > 0;
    unsolved_ = -1;
  }
  /// (1) at rest.
  void rest() noexcept { follow(0.0, zero_); }
  /// From now on constant, with the present values.
  void stop() noexcept { follow_ = false; }
  bool follow() const noexcept { return follow_; }
  double weight() const noexcept {
    return follow_ ? weight_ : std::numeric_limits<double>::infinity();
  }
  /// The first element whose (1) had no solution since `follow`; -1: none.
  int unsolved() const noexcept { return unsolved_; }

  /// (1) of an element, and its efforts there.
  void solve(std::size_t element, const Ports& in, Efforts& out) noexcept;
  void start(std::size_t element, const Ports& in) noexcept;
  void after_step(std::size_t element, const Ports& in) noexcept;
  void take_rates(const std::vector<Efforts>& efforts) noexcept;

 private:
  /// Of an element: what a Newton step needs, and the size that each of its states has had.
  struct Scratch {
    MatX slopes;
    Eigen::PartialPivLU<MatX> lu;
    VecX z, gap, dz, next, size;
  };
  void find_gap(std::size_t element, const Efforts& out, Scratch& s) noexcept;
  bool find_increment(const Efforts& out, Scratch& s) const noexcept;
  bool damped_step(std::size_t element, const Ports& in, Efforts& out, Scratch& s) noexcept;

  const Model& model_;
  std::vector<int> offsets_;
  std::vector<std::size_t> elements_;
  std::vector<Scratch> scratch_;  ///< of each element
  VecX z_, rates_, zero_;
  const VecX* z_hat_ = nullptr;
  double weight_ = 0.0;
  bool follow_ = false;
  int unsolved_ = -1;
};

}  // namespace floatframe
