#pragma once
// What looks at the steps of a simulation from within: a recording (run/recording.hpp).
#include "floatframe/core/thread_clock.hpp"
#include "floatframe/stepping/stepper.hpp"

namespace floatframe {

/// How a simulation has come to the state that its next steps go on from.
enum class StepsBegin {
  here,     ///< it is looked at from here on
  again,    ///< a state was restored or set
  changed,  ///< it has another model
};

class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Load time: allocates. The stepper and its outputs are at the state, and stay alive until the
  /// next call.
  virtual void begin(Stepper& steps, std::span<const double> row, StepsBegin why) = 0;
  /// After a step and its sample; `taken`: processor time, 0 unless `timed`.
  virtual void step(Stepper& steps, std::span<const double> row, const PlannedStep& planned,
                    Nanoseconds taken) noexcept = 0;
  /// A step has failed; the formulation is at the failed iteration.
  virtual void failed(Stepper& steps) noexcept = 0;
  /// The simulation ends before its observer.
  virtual void end() noexcept = 0;
  virtual bool timed() const noexcept = 0;
};

}  // namespace floatframe
