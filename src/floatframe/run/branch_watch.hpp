#pragma once
// Detects whether a mechanism passes a singular configuration, in which independent constraints
// become dependent, so that the motion can continue on more than one branch.
//
// The metric of the projections is W = M + 0.01 s K + penalty Phi_q^T Phi_q. A constraint direction
// with singular value sigma contributes a factor 1 + penalty sigma^2 to its determinant, which
// falls to 1 as sigma vanishes. Positions at which the sum of the logarithms of the pivots falls
// far below its earlier values are kept: the first such dip and the deepest one. At the end of the
// run the constraints there are examined by dense linear algebra, and only this result counts:
// constraints that are redundant everywhere cause no dip, and other dips (long levers that become
// short) are not singular. Whether an angle is small depends on lengths, so the constraints are
// compared with those at the start and at the position with the highest sum.
#include <optional>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/step.hpp"
#include "floatframe/run/range_warning.hpp"

namespace floatframe {

class BranchWatch {
 public:
  /// For runs with this step size [s] and this number of configuration coordinates.
  BranchWatch(double step, int configurations);

  /// To be called after a step, with its last attempt. No allocation.
  void observe(const State& s, const StepAttempt& last) noexcept;

  /// Stores and restores the record, for runs that are continued elsewhere (state_bytes.hpp).
  template <class Stream>
  void serialize(Stream& s) {
    s(highest_);
    s(first_ended_);
    for (Dip* d : {&first_, &deepest_, &start_, &best_}) d->serialize(s);
  }

  /// The sentence about the first singular configuration, if there was one. Moves the formulation.
  std::optional<RangeWarning> warning(Formulation& f) const;

 private:
  /// Decrease of the sum of logarithms that counts as a dip: a factor of twenty.
  static constexpr double depth = 3.0;
  /// Increase of the sum of logarithms above which a new position becomes the highest.
  static constexpr double rise = 0.1;
  /// Largest remaining independence of the constraints in a singular configuration, as a fraction.
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
