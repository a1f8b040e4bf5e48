// Where formulas cross zero: the outputs that are times of crossings, and the formula `until`,
// which ends a run. A formula whose sign has changed in a step is searched for its zero by steps of
// other lengths from the same beginning (regula falsi with the Illinois weights, every fourth pass
// a bisection), until a bracket of `close` is left: the crossing is that of the scheme of the
// steps, not of an interpolation. The step is then made again, to its end or to the zero of
// `until`, behind which the sign has changed. Substeps, edges and corners are those of any step; a
// length below `shortest` is covered by an explicit move with the acceleration of its middle. A
// step that ends a little before an instant of sampled elements takes their values of the instant:
// what crosses zero exactly where that begins does so at the instant. Where
// the work of a step is bounded, a secant through its ends gives the time. A formula that crosses
// zero and comes back within a step is not seen.
#include <algorithm>
#include <limits>

#include "floatframe/stepping/stepper.hpp"

namespace floatframe {
namespace {

constexpr double close = 1e-10;  // [s], and less of steps below 1 ms

}  // namespace

void Stepper::watch_formulas() {
  for (std::size_t k = 0; k < model().outputs.size(); ++k)
    if (output_kind(model().outputs[k].type).of == OutputOf::crossing)
      watched_.push_back({&model().outputs[k], k});
  if (until_) {
    watched_.push_back({&*model().until, outputs_.size()});
    outputs_.push_back(followed_outputs({&*model().until, 1}).front());
  }
  if (watched_.empty()) return;
  for (const WatchedFormula& w : watched_) watched_needs_ = watched_needs_ | needs_of(*w.output);
  move_.emplace(f_, *integrator_);
  a_end_ = state_.a;
  zd_end_ = state_.zd;
}

double Stepper::value_of(const WatchedFormula& w) noexcept {
  const SystemMotion& motion = present_motion(watched_needs_);
  return sampled_formula(motion, *w.output->formula, outputs_[w.memory].parts);
}

/// Values at the present state; true if one of them has crossed zero since the step before.
bool Stepper::look_at_formulas() noexcept {
  bool any = false;
  for (WatchedFormula& w : watched_) {
    const FollowedOutput& memory = outputs_[w.memory];
    w.value = value_of(w);
    w.crosses = memory.values[Crossing::found] == 0.0 &&
                Crossing::between(memory.values[Crossing::value], w.value, w.output->component);
    any = any || w.crosses;
  }
  return any;
}

/// Takes what `look_at_formulas` has seen into the memory of outputs.
void Stepper::note_crossings() noexcept {
  for (const WatchedFormula& w : watched_) {
    FollowedOutput& memory = outputs_[w.memory];
    memory.started = true;
    if (w.crosses) {
      memory.values[Crossing::found] = 1.0;
      memory.values[Crossing::time] = w.at;
    }
    if (std::isfinite(w.value) && w.value != 0.0) memory.values[Crossing::value] = w.value;
  }
}

/// After an accepted step. False if a shorter one was not.
bool Stepper::look_for_crossings(const PlannedStep& step) noexcept {
  const double begin = before_->state.t;
  if (look_at_formulas()) {
    const EdgeWatch watch = watch_;
    set_edge_watch({});  // the step has been watched
    a_end_ = state_.a;
    zd_end_ = state_.zd;
    double end = step.size;
    ended_ = until_ && watched_.back().crosses;
    if (ended_) {
      end = crossing_in(watched_.back(), step.size, end);
      return_to_begin();
      ended_ = reach(end, step.size);
      look_at_formulas();
    }
    for (WatchedFormula& w : watched_)
      if (w.crosses) w.at = begin + crossing_in(w, step.size, end);
    bool good = true;
    if (!bounded_) {
      return_to_begin();
      good = reach(end, step.size);
      if (good && !ended_) state_.t = step.to;
      look_at_formulas();
    }
    set_edge_watch(watch);
    if (!good || has_thrown()) return false;
  }
  note_crossings();
  return true;
}

/// The far end of a bracket of the crossing in the step up to `end`, at which `w` has its value
/// [s from the beginning].
double Stepper::crossing_in(const WatchedFormula& w, double h, double end) noexcept {
  const double begin = before_->state.t, rounding = std::numeric_limits<double>::epsilon();
  const double enough = std::max(std::min(close, 1e-7 * h), 4.0 * rounding * std::abs(begin + end));
  double low = 0.0, high = end, at_high = w.value;
  double at_low = before_->outputs[w.memory].values[Crossing::value];
  if (bounded_) return end * at_low / (at_low - at_high);
  int idle = 0;  // passes in a row that kept the other end: > 0 the upper one
  for (int pass = 0; pass < 100 && high - low > enough; ++pass) {
    const double secant = low + (high - low) * at_low / (at_low - at_high);
    const double at = pass % 4 == 3 ? 0.5 * (low + high)
                                    : std::clamp(secant, low + 0.4 * enough, high - 0.4 * enough);
    return_to_begin();
    if (!reach(at, h)) break;
    const double value = value_of(w);
    if (value != 0.0 && (value > 0.0) == (at_low > 0.0)) {
      low = at;
      at_low = value;
      if (idle < 0) at_high *= 0.5;
      idle = -1;
    } else {
      high = at;
      at_high = value;
      if (idle > 0) at_low *= 0.5;
      idle = 1;
    }
  }
  return sampled_instant(low, high);
}

/// If the values of an instant of samples begin to count in the bracket: the instant; else `high`.
double Stepper::sampled_instant(double low, double high) const noexcept {
  const double begin = before_->state.t, width = time_corner_width * grid_.step();
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * std::abs(begin + high);
  for (const SampleTicks& x : ticks_) {
    const double at = x.after(begin + high), edge = at - width;
    if (begin + low <= edge + rounding && edge <= begin + high + rounding) return at - begin;
  }
  return high;
}

/// The state and all that determines the step from there.
void Stepper::return_to_begin() noexcept {
  state_ = before_->state;
  f_.set_spring_angles(before_->angles);
  f_.hold_force_branches(before_->branches);
  integrator_->set_tangent_reuse(before_->tangent_reuse);
  std::copy(before_->outputs.begin(), before_->outputs.end(), outputs_.begin());
  std::copy(before_->inputs.begin(), before_->inputs.end(), inputs_.begin());
  counters_ = before_->counters;
}

/// A part of the step from its beginning. False if it is not accepted.
bool Stepper::reach(double dt, double h) noexcept {
  if (!(dt < CornerSteps::shortest * h) || (corners_ && corners_->within(state_.t, dt)))
    return cover(dt);
  take_inputs(h);
  const double middle = 0.5 * dt / h;  // of the whole step
  state_.a += middle * (a_end_ - state_.a);
  state_.zd += middle * (zd_end_ - state_.zd);
  (*move_)(state_, dt, h);
  integrator_->restart(state_, h);
  if (dt > 2.0 * time_corner_width * grid_.step()) {  // else they may be those of the beginning
    ticked_ = -TimeGrid::endless;
    sample_elements(h);
  }
  take_samples();
  ++counters_.steps;
  return true;
}

}  // namespace floatframe
