#pragma once
// Watches whether a mechanism passes a singular position: there constraints depend on each other
// that elsewhere do not, so that it may go on in more than one way.
//
// The metric of the projections is W = M + 0.01 s K + penalty Phi_q^T Phi_q. A direction of
// constraints that moves the system by sigma has a share of 1 + penalty sigma^2 in its determinant,
// which falls to 1 where sigma does. So positions where the sum of the logarithms of the pivots
// falls far below what it was are kept: the first such dip and the deepest. At the end of the run
// the constraints there are looked at closely, with dense linear algebra, and only what they say
// counts: constraints that are redundant everywhere make no dip, and other dips (long levers that
// become short) are none of singular positions. What is a small angle depends on lengths, so the
// constraints are compared with themselves at the start and at the highest position.
#include <algorithm>
#include <optional>
#include <span>

#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/integrator/step.hpp"
#include "floatframe/simulation/range_warning.hpp"
#include "floatframe/simulation/redundancy.hpp"

namespace floatframe {

class BranchWatch {
 public:
  /// Of runs in steps of this size [s] with so many configuration numbers.
  BranchWatch(double step, int configurations);

  /// After a step, with the last attempt at it. No allocation.
  void observe(const State& s, const StepAttempt& last) noexcept;

  /// What was met so far, for a run that goes on elsewhere (state_bytes.hpp).
  template <class Stream>
  void serialize(Stream& s) {
    s(highest_);
    s(first_ended_);
    for (Dip* d : {&first_, &deepest_, &start_, &best_}) d->serialize(s);
  }

  /// The sentence about the first singular position, if there was one. Moves the formulation.
  template <class F>
  std::optional<RangeWarning> warning(F& f) const {
    for (const Dip* d : {&first_, &deepest_}) {
      if (d->found == 0.0 || d->q.size() != f.configurations() || f.velocities() > most_coordinates)
        continue;
      const auto constraints_at = [&](const Dip& dip) {
        kinematics_at(f, dip.t, dip.q, VecX::Zero(f.velocities()));
        return f.constraint_jacobian();
      };
      const double usual =
          std::max(independence(constraints_at(start_)), independence(constraints_at(best_)));
      if (auto found = judged(constraints_at(*d), usual, f.constraint_set(), d->t)) return found;
    }
    return {};
  }

 private:
  /// Fall of the sum of logarithms that is looked at: twentyfold.
  static constexpr double depth = 3.0;
  /// Of the sum of logarithms, before another position counts as the highest.
  static constexpr double rise = 0.1;
  /// What is left of the independence of constraints in a singular position, at most.
  static constexpr double part_of_usual = 0.1;
  static constexpr int most_coordinates = 1000;  ///< dense linear algebra

  struct Dip {
    double found = 0.0, value = 0.0, t = 0.0;
    VecX q;
    void offer(double x, const State& s) noexcept {
      if (found != 0.0 && x >= value) return;
      keep(x, s);
    }
    void offer_first(double x, const State& s) noexcept {
      if (found == 0.0) keep(x, s);
    }
    void keep(double x, const State& s) noexcept {
      found = 1.0;
      value = x;
      t = s.t;
      q = s.q;  // of the same size
    }
    template <class Stream>
    void serialize(Stream& s) {
      for (double* x : {&found, &value, &t}) s(*x);
      s(q);
    }
  };

  static std::optional<RangeWarning> judged(const MatX& J, double usual,
                                            const ConstraintSet& constraints, double t);

  double step_;
  double highest_;
  double first_ended_ = 0.0;  ///< 1: the first dip is over
  Dip first_, deepest_;
  Dip start_, best_;  ///< the first and the highest position
};

}  // namespace floatframe
