#pragma once
// Divides steps at the corners of functions of time (time_corners.hpp) and at the instants of
// sampled elements (model/sampling.hpp) within them, which are known or, of formulas, found:
// the step to a corner ends with the values before it, accelerations and multipliers of the forces
// after it are solved for, and the rest of the step follows. An interval much shorter than a step
// is bridged by an explicit formula, with the accelerations of its middle: between two corners so
// close together a load may change by any amount. The parts of the step use the trapezoidal rule:
// generalised-alpha, restarted, has an error of gamma (1 - alpha_f) / (1 - alpha_m) - 1/2 times the
// change of the force, which a smaller step does not reduce at a steep flank.
//
// A corner at the end of a step belongs to this step: samples there take the right-hand limit, as
// the functions do. Times are sums of steps, which rounding leaves on either side of a corner given
// as a number: distances below a small fixed fraction of a step are treated as zero. Nothing here
// allocates after construction.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "floatframe/model/sampling.hpp"
#include "floatframe/stepping/edge_watch.hpp"
#include "floatframe/stepping/explicit_move.hpp"
#include "floatframe/stepping/time_corners.hpp"

namespace floatframe {

class CornerSteps {
 public:
  static constexpr double shortest = shortest_part;

  /// `step`: the nominal step size [s].
  CornerSteps(Formulation& formulation, Integrator& integrator, std::vector<TimeCorner> corners,
              std::vector<SampleTicks> ticks, std::vector<FormulaOfTime> formulas, double step)
      : f_(formulation),
        integrator_(integrator),
        move_(formulation, integrator),
        corners_(std::move(corners)),
        ticks_(std::move(ticks)),
        formulas_(std::move(formulas)),
        slack_(time_corner_width * step) {
    assert(step > 0.0);
    assert(std::is_sorted(corners_.begin(), corners_.end(),
                          [](const TimeCorner& a, const TimeCorner& b) { return a.to < b.to; }));
  }

  const std::vector<TimeCorner>& corners() const noexcept { return corners_; }
  void set_watch(const EdgeWatch& watch) noexcept { watch_ = watch; }

  /// True if a step of size h from time t contains a corner.
  bool within(double t, double h) const noexcept {
    return next(listed_after(t), t, t + h, true).from < endless;
  }

  /// One step of size h. `smooth(size)` makes a step in which no function has a corner; `behind()`
  /// is called at a corner, before accelerations are solved for again; false: the step ends there.
  /// If the step is not accepted, the state is that of the last corner that was passed.
  template <class Smooth, class Behind>
  StepAttempt step(State& state, double h, std::int64_t& passed, const Smooth& smooth,
                   const Behind& behind) noexcept {
    assert(h > 0.0);
    const double end = state.t + h;
    StepAttempt total;
    auto listed = listed_after(state.t);
    int count = 0;
    for (TimeCorner c; (c = next(listed, state.t, end, count < most_of_formulas)).from < endless;
         ++count) {
      const double left = std::min(before(c.from, state.t, h), end);
      if (!reach(state, left, h, smooth, total)) return total;
      if (!pass(state, c, h, behind)) {
        total.status = AttemptStatus::not_finite;
        return total;
      }
      while (listed != corners_.end() && !(listed->to > c.to)) ++listed;
      ++passed;
    }
    if (!reach(state, end, h, smooth, total)) return total;
    // An explicit move leaves the accelerations of its middle.
    if (made_ == Made::moved) integrator_.restart(state, h);
    state.t = end;
    return total;
  }

 private:
  static constexpr double rounding = 1e-10;  ///< of time, as a fraction of a step
  /// Corners in a step up to which formulas are looked at: others are sampled by the step.
  static constexpr int most_of_formulas = 16;
  static constexpr double endless = std::numeric_limits<double>::infinity();

  enum class Made { nothing, moved, stepped };

  using Listed = std::vector<TimeCorner>::const_iterator;
  Listed listed_after(double t) const noexcept {
    return std::upper_bound(corners_.begin(), corners_.end(), t + slack_,
                            [](double x, const TimeCorner& c) { return x < c.to; });
  }
  /// The next corner up to `end`: `listed`, or an instant of samples or of a formula after t; none:
  /// at infinity. An instant of samples at the end of a step does not divide it.
  TimeCorner next(Listed listed, double t, double end, bool of_formulas) const noexcept {
    TimeCorner c{endless, endless};
    if (listed != corners_.end() && !(listed->from > end + slack_)) c = *listed;
    const auto take = [&](double at) {
      if (at > c.from + slack_) return;
      c = at < c.from - slack_ ? TimeCorner{at, at}
                               : TimeCorner{std::min(at, c.from), std::max(at, c.to)};
    };
    for (const SampleTicks& x : ticks_)
      if (const double at = x.after(t + slack_); at < end - slack_) take(at);
    if (of_formulas)
      for (const FormulaOfTime& x : formulas_)
        if (const double at = formula_corner(x, t + slack_, end + slack_); at < endless) take(at);
    return c;
  }

  /// The latest time before a corner that a step from t does not exceed by rounding.
  static double before(double corner, double t, double h) noexcept {
    return corner - 4.0 * std::numeric_limits<double>::epsilon() *
                        std::max(std::abs(corner), std::abs(t) + h);
  }

  /// Steps to the time `to`. Returns false if the step was not accepted.
  template <class Smooth>
  bool reach(State& state, double to, double h, const Smooth& smooth, StepAttempt& total) noexcept {
    const double dt = to - state.t;
    assert(h > 0.0 && dt < (1.0 + 1e-6) * h + slack_);
    made_ = Made::nothing;
    if (!(dt > rounding * h)) return true;
    if (dt < shortest * h) {
      made_ = Made::moved;
      const double begin = state.t;
      state.t = begin + 0.5 * dt;
      integrator_.restart(state, h);
      state.t = begin;
      move_(state, dt, h);
      return true;
    }
    made_ = Made::stepped;
    const StepAttempt last = total;
    state.a_alg = state.a;
    state.zd_alg = state.zd;
    integrator_.trapezoidal(true);
    total = smooth(dt);
    integrator_.trapezoidal(false);
    total.iterations += last.iterations;
    total.factorizations += last.factorizations;
    return total.accepted();
  }

  template <class Behind>
  bool pass(State& state, const TimeCorner& c, double h, const Behind& behind) noexcept {
    assert(c.from <= c.to);
    if (watch_.look) {
      kinematics_at(f_, state);
      f_.forces();
      // Multipliers that are available in a restored state, too.
      watch_(state, made_ == Made::stepped ? integrator_.reactions() : state.lambda);
    }
    if (c.to > c.from) move_(state, c.to - state.t, h);
    state.t = std::max(state.t, c.to);
    if (!behind()) return false;
    integrator_.restart(state, h);
    watch_(state, integrator_.reactions());
    return true;
  }

  Formulation& f_;
  Integrator& integrator_;
  ExplicitMove move_;
  std::vector<TimeCorner> corners_;
  std::vector<SampleTicks> ticks_;
  std::vector<FormulaOfTime> formulas_;
  double slack_;  ///< [s]
  EdgeWatch watch_;
  Made made_ = Made::nothing;
};

}  // namespace floatframe
