#pragma once
// Quality indicators of a run at its recorded instants: violations of constraints and the effort of
// the steps since the previous instant, every term of the energy balance (energy_balance.hpp), and
// the deformation of flexible bodies. Columns of a row of states (state_layout.hpp); writing them
// does not allocate.
#include <algorithm>
#include <vector>

#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/run/energy_balance.hpp"
#include "floatframe/run/range_watch.hpp"
#include "floatframe/run/state_layout.hpp"
#include "floatframe/stepping/step_report.hpp"

namespace floatframe {

/// Since the previous instant: largest violations at the ends of steps [m, m/s], numbers of steps,
/// of extra steps due to halving, of iterations and of factorizations.
class HealthEffort {
 public:
  static constexpr int columns = 6;

  /// To be called after every step.
  void observe(const StepAttempt& last) noexcept {
    position_ = std::max(position_, last.position_violation);
    velocity_ = std::max(velocity_, last.velocity_violation);
  }
  void write(const StepCounters& c, double* row) noexcept {
    const long now[4] = {c.steps, c.substeps, c.iterations, c.factorizations};
    *row++ = position_;
    *row++ = velocity_;
    for (int k = 0; k < 4; ++k) {
      *row++ = static_cast<double>(now[k] - before_[k]);
      before_[k] = now[k];
    }
    position_ = velocity_ = 0.0;
  }
  /// For runs that are continued elsewhere (state_bytes.hpp).
  template <class Stream>
  void serialize(Stream& s) {
    for (double* x : {&position_, &velocity_}) s(*x);
    for (long& n : before_) s(n);
  }

 private:
  double position_ = 0.0, velocity_ = 0.0;
  long before_[4] = {0, 0, 0, 0};  ///< counts at the instant before
};

/// Columns of energies: kinetic, of gravity, springs, tyres and modes, works, remainder.
inline constexpr int energy_columns = 6 + static_cast<int>(EnergyFlows::size());
/// Columns before the two of each flexible body.
inline constexpr int health_of_system = HealthEffort::columns + energy_columns;

inline void write_energies(const EnergyBalance::Energies& e, const EnergyFlows& work,
                           double remainder, double* row) noexcept {
  for (const double x : {e.kinetic, e.gravity, e.springs, e.tyres, e.elastic}) *row++ = x;
  for (const double x : work.value) *row++ = x;
  *row = remainder;
}

/// All health columns, in the order of a row.
std::vector<HealthColumn> health_columns(const Model& model, const RangeWatch& range);

}  // namespace floatframe
