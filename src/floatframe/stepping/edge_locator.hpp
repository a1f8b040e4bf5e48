#pragma once
// Divides steps where the law of a force changes its branch (model/element_evaluation.hpp): across
// such an edge the force or its slope jumps, and an undivided step over it is only of first
// order.
//
// A step is made with the branches at its beginning, on which all forces are smooth. If a force has
// left its branch at the end, the time of the first edge is found by a secant rule with steps from
// the same beginning (regula falsi with the Illinois weights), to a fraction `close` of the step.
// That step is kept, the force changes its branch, accelerations and multipliers of the new forces
// are solved for, and the rest of the step is made. An edge close to the beginning, and an end
// close to an edge, are reached by an explicit move (explicit_move.hpp).
//
// A force that leaves its branch and returns within a step is looked for in the middle of the step,
// on the cubic through both ends; if one is found there, half the step is made. A return within
// half a step is not detected. A step with more than `most_edges` of them (a wheel resting on an
// edge, friction that sticks) is finished without division: also its substeps, if what is left of
// it does not converge.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <vector>

#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/stepping/edge_watch.hpp"
#include "floatframe/stepping/explicit_move.hpp"

namespace floatframe {

class EdgeLocator {
 public:
  EdgeLocator(Formulation& formulation, Integrator& integrator)
      : f_(formulation), integrator_(integrator), move_(formulation, integrator) {
    const std::vector<Element>& forces = f_.model().elements;
    for (std::size_t k = 0; k < forces.size(); ++k)
      if (has_branches(forces[k])) forces_.push_back(k);
    first_.resize(forces_.size());
    here_ = between_ = last_ = first_;
    free_.assign(forces.size(), free_branch);
    angles_.resize(f_.spring_angles().size());
    x_ = VecX::Zero(f_.velocities());
    q_ = VecX::Zero(f_.configurations());
    from_.q = q_;
    from_.v = from_.a = from_.a_alg = x_;
    from_.lambda = VecX::Zero(f_.constraints());
    from_.z = from_.zd = from_.zd_alg = z_ = VecX::Zero(f_.element_states().count());
  }

  void set_watch(const EdgeWatch& watch) noexcept { watch_ = watch; }

  /// Holds the branches of the forces at this state.
  void hold(const State& state) noexcept {
    assert(free_.size() == f_.model().elements.size() && state.q.size() == q_.size());
    f_.hold_force_branches(free_);
    look(state, here_);
    for (std::size_t k = 0; k < forces_.size(); ++k)
      f_.hold_force_branch(forces_[k], here_[k].next);
  }

  /// The beginning of a step, which `step` may make in parts, and its end at this state.
  void begin() noexcept { undivided_ = false; }
  void end(const State& state, std::int64_t& passed) noexcept {
    if (!undivided_) return;
    hold(state);
    ++passed;
  }
  /// The first force with too many edges in a step, and when; -1: none.
  int crowded() const noexcept { return crowded_; }
  double crowded_at() const noexcept { return crowded_at_; }

  /// One step of size h. If it is not accepted, the state is that of the last edge that was passed.
  StepAttempt step(State& state, double h, std::int64_t& edges) noexcept {
    if (forces_.empty()) return integrator_.attempt(state, h);
    if (undivided_) f_.hold_force_branches(free_);
    if (undivided_) return integrator_.attempt(state, h);
    assert(h > 0.0 && state.q.size() == q_.size() && state.v.size() == x_.size());
    const double end = state.t + h;
    StepAttempt total;
    for (int count = 0;; ++count) {
      const double left = count == 0 ? h : end - state.t;
      if (left < shortest * h) {
        move_(state, left, h);
        look(state, here_);
        break;
      }
      keep(state);
      look(state, first_);
      attempt(state, left, total);
      if (!total.accepted()) return total;
      look_between(state, left);
      look(state, last_);
      double span = 1.0;  // that holds the first edge
      if (earliest(between_, 0.5, none).force != none) {
        return_to(state);
        attempt(state, 0.5 * left, total);
        if (!total.accepted()) return total;
        look(state, here_);
        if (earliest(here_, 0.5, none).force == none) continue;  // the prediction was wrong
        last_ = here_;
        span = 0.5;
      } else if (earliest(last_, 1.0, none).force == none) {
        break;
      }
      if (count == most_edges) {
        return_to(state);
        crowd(state.t);
        f_.hold_force_branches(free_);
        attempt(state, left, total);
        break;
      }
      if (!locate(state, h, left, span, total)) return total;
      pass(state, h);
      ++edges;
    }
    if (total.accepted()) state.t = end;
    return total;
  }

 private:
  static constexpr int most_edges = 16, most_passes = 20;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static constexpr double shortest = 0.02;  ///< of the step: the shortest that is made as a step
  static constexpr double close = 1e-6;     ///< of the step: tolerance of the located edge
  using Sides = std::vector<BranchSide>;

  struct Crossing {
    std::size_t force = none;  ///< index into `forces_`
    double at = 1.0;           ///< part of the step
  };

  void look(const State& state, Sides& sides) noexcept {
    assert(sides.size() == forces_.size());
    kinematics_at(f_, state);
    for (std::size_t k = 0; k < forces_.size(); ++k) sides[k] = f_.branch_side(forces_[k]);
  }

  void crowd(double t) noexcept {
    undivided_ = true;
    if (crowded_ >= 0 || found_ == none) return;
    crowded_ = static_cast<int>(forces_[found_]);
    crowded_at_ = t;
  }

  /// Looks in the middle of a step of size h, from `from_` to the state.
  void look_between(const State& state, double h) noexcept {
    assert(h > 0.0 && between_.size() == forces_.size());
    x_ = (0.125 * h) * (3.0 * from_.v + state.v);
    f_.retract(from_.q, x_, q_);
    x_ = 0.5 * (from_.v + state.v) + (0.125 * h) * (from_.a - state.a);
    z_ = 0.5 * (from_.z + state.z) + (0.125 * h) * (from_.zd - state.zd);
    f_.element_states().give(z_);
    kinematics_at(f_, state.t - 0.5 * h, q_, x_);
    for (std::size_t k = 0; k < forces_.size(); ++k) between_[k] = f_.branch_side(forces_[k]);
  }

  void attempt(State& state, double h, StepAttempt& total) noexcept {
    const StepAttempt r = integrator_.attempt(state, h);
    const StepAttempt before = total;
    total = r;
    total.iterations += before.iterations;
    total.factorizations += before.factorizations;
  }

  void keep(const State& state) noexcept {
    copy(state, from_);
    const auto angles = f_.spring_angles();
    assert(angles.size() == angles_.size());
    std::copy(angles.begin(), angles.end(), angles_.begin());
  }
  void return_to(State& state) noexcept {
    copy(from_, state);
    f_.set_spring_angles(angles_);
  }
  static void copy(const State& a, State& b) noexcept {  // of the same sizes: no allocation
    assert(a.q.size() == b.q.size() && a.v.size() == b.v.size() && a.a.size() == b.a.size());
    assert(a.a_alg.size() == b.a_alg.size() && a.lambda.size() == b.lambda.size());
    b.t = a.t;
    b.q = a.q;
    b.v = a.v;
    b.a = a.a;
    b.a_alg = a.a_alg;
    b.lambda = a.lambda;
    b.z = a.z;
    b.zd = a.zd;
    b.zd_alg = a.zd_alg;
  }

  /// By linear interpolation from the beginning to `sides`, at `at`; `but`: the force to skip.
  Crossing earliest(const Sides& sides, double at, std::size_t but) const noexcept {
    assert(at >= 0.0 && sides.size() == first_.size());  // 0: a force that begins on its edge
    Crossing c;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      if (k == but || !(sides[k].beyond > 0.0)) continue;
      const double before = std::min(first_[k].beyond, 0.0);
      const double x = at * before / (before - sides[k].beyond);
      if (c.force == none || x < c.at) c = {k, x};
    }
    return c;
  }

  /// Moves the state to the first edge. Returns false if a step to it was not accepted; the state
  /// is then that of the beginning.
  bool locate(State& state, double h, double left, double span, StepAttempt& total) noexcept {
    const double enough = close * h / left;
    std::size_t force = earliest(last_, span, none).force;
    assert(force != none && left > 0.0 && span > 0.0 && span <= 1.0);
    double low = 0.0, high = span;
    double low_side = std::min(first_[force].beyond, 0.0), high_side = last_[force].beyond;
    int idle = 0;  // passes in a row that kept the other end: > 0 the upper one
    for (int pass = 0; pass < most_passes; ++pass) {
      const double at = std::min(high, low + (high - low) * low_side / (low_side - high_side));
      assert(at >= low && at <= high);
      return_to(state);
      moved_ = at * left < shortest * h;
      if (moved_)
        move_(state, at * left, h);
      else
        attempt(state, at * left, total);
      if (!total.accepted()) return false;
      look(state, here_);
      // The event functions are curved: another edge may be first.
      const Crossing other = earliest(here_, at, force);
      if (other.force != none && other.at < at - 2.0 * enough) {
        force = other.force;
        low = 0.0;
        high = at;
        low_side = std::min(first_[force].beyond, 0.0);
        high_side = here_[force].beyond;
        idle = 0;
        continue;
      }
      const double side = here_[force].beyond;
      const double slope = (last_[force].beyond - first_[force].beyond);
      const double distance = high - low;
      // The secant through the bracket estimates the distance of the edge.
      const double gap = std::abs(side) * distance / (high_side - low_side);
      if (gap <= enough || !(std::abs(side) > 1e-15 * std::abs(slope))) break;
      if (side > 0.0) {
        high = at;
        high_side = side;
        if (idle > 0) low_side *= 0.5;
        idle = 1;
      } else {
        low = at;
        low_side = side;
        if (idle < 0) high_side *= 0.5;
        idle = -1;
      }
    }
    found_ = force;
    near_ = 2.0 * enough / span;
    return true;
  }

  /// The located force, and all others that are at an edge as well, change their branches.
  void pass(State& state, double h) noexcept {
    assert(found_ < forces_.size());
    f_.forces();
    // Multipliers that are available in a restored state, too.
    watch_(state, moved_ ? state.lambda : integrator_.reactions());
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      const double way = last_[k].beyond - first_[k].beyond;  // in the first attempt at the step
      const bool at_edge = last_[k].beyond > 0.0 && std::abs(here_[k].beyond) <= near_ * way;
      if (k == found_ || at_edge) f_.hold_force_branch(forces_[k], here_[k].next);
    }
    integrator_.restart(state, h);
    watch_(state, integrator_.reactions());
  }

  Formulation& f_;
  Integrator& integrator_;
  ExplicitMove move_;
  EdgeWatch watch_;
  std::vector<std::size_t> forces_;  ///< whose laws have branches
  Sides first_, here_, last_;        ///< at the beginning, at the last trial, at the end
  Sides between_;                    ///< in the middle
  std::vector<std::int64_t> free_;
  std::vector<double> angles_;
  State from_;
  VecX x_, q_, z_;
  std::size_t found_ = none;
  double near_ = 0.0, crowded_at_ = 0.0;
  int crowded_ = -1;
  bool moved_ = false, undivided_ = false;
};

}  // namespace floatframe
