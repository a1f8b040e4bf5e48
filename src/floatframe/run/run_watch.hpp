#pragma once
// Updates the energy balance and the range checks of a run. Powers and phases
// are evaluated after every step, deformations and spin at recorded instants, energies at some of
// these (the kinetic energy costs as much as half an iteration). `start` and `step` do not allocate
// and do not change the run, bit for bit.
#include <algorithm>
#include <span>
#include <vector>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/step.hpp"
#include "floatframe/run/branch_watch.hpp"
#include "floatframe/run/contact_watch.hpp"
#include "floatframe/run/energy_balance.hpp"
#include "floatframe/run/health.hpp"
#include "floatframe/run/motion_watch.hpp"

namespace floatframe {

class RunWatch {
 public:
  /// `records`: number of rows that will be recorded.
  RunWatch(Formulation& formulation, double step, long records)
      : f_(formulation),
        watch_(formulation.model(), step),
        branches_(step, formulation.configurations()),
        contacts_(formulation.model(), step),
        every_(std::max(1L, records / energy_checks)) {
    double total = 0.0;
    for (const Body& b : f_.model().bodies) mass_.push_back(b.data->invariants.m);
    for (const double m : mass_) total += m;
    // Without any mass the penalty is scaled by 1 kg, and so is its rounding error.
    weightless_ = total == 0.0;
    if (weightless_) mass_.assign(mass_.size(), massless * f_.model().mean_mass);
  }

  /// The columns that `health` writes.
  std::vector<HealthColumn> health_columns() const {
    return floatframe::health_columns(f_.model(), watch_.range());
  }

  /// At the start of the run; `lambda` is consistent with its accelerations.
  void start(const State& s) noexcept {
    evaluate(s);
    const SystemMotion& motion = f_.motion();
    balance_.start(s.t, flows(motion, f_.constraint_set(), s.lambda), energies(s),
                   watch_.range().noise());
    watch_.look(motion);
    watch_.start(motion);
  }

  /// Where steps go on from another state: the balance begins anew, what left the range is kept.
  void start_again(const State& s) noexcept {
    balance_ = EnergyBalance();
    start(s);
  }
  /// Up to the last check, by the numbers alone.
  EnergySummary balance() const noexcept {
    EnergySummary out;
    out.balanced = true;
    balance_.write(out);
    return out;
  }
  /// With this balance; allocates.
  std::vector<RangeWarning> range_warnings(double spectral_radius,
                                           std::span<const TimeCorner> corners) const {
    return watch_.range().warnings(balance(), spectral_radius, corners);
  }
  const RangeLimits& limits() const noexcept { return watch_.range().limits(); }

  /// To be called after a step; `sampled`: outputs were evaluated at its end.
  void step(const State& s, const VecX& reactions, bool sampled, bool full) noexcept {
    if (!sampled) {
      // A step with constraints leaves the formulation at its end positions and velocities.
      if (f_.constraints() > 0)
        f_.forces();
      else
        evaluate(s);
    }
    const SystemMotion& motion = f_.motion();
    balance_.advance(s.t, flows(motion, f_.constraint_set(), reactions));
    if (full) {
      watch_.follow(motion);
      contacts_.follow(motion);
    }
    if (!sampled) return;
    watch_.look(motion);
    if (++records_ % every_ == 0) balance_.check(s.t, energies(s));
  }

  /// The health of the run (health.hpp) at a recorded instant, after `start` or `attempt`.
  void health(const StepCounters& counters, double* row) noexcept {
    effort_.write(counters, row);
    EnergyBalance::Energies e;
    const SystemMotion& motion = f_.motion();
    e.kinetic = watch_.kinetic_energy(motion);
    add_stored(motion, e);
    write_energies(e, balance_.work(), balance_.remainder(e), row + HealthEffort::columns);
    watch_.deformations(motion, row + health_of_system);
  }

  /// Before and after an edge at which a step was divided: powers jump there. The formulation is at
  /// this state, with its forces.
  void edge(const State& s, const VecX& reactions) noexcept {
    balance_.advance(s.t, flows(f_.motion(), f_.constraint_set(), reactions));
  }

  /// Also after a step: its last attempt.
  void attempt(const State& s, const StepAttempt& a) noexcept {
    branches_.observe(s, a);
    effort_.observe(a);
  }

  /// Stores and restores the record, for runs that are continued elsewhere (state_bytes.hpp).
  template <class Stream>
  void serialize(Stream& s) {
    balance_.serialize(s);
    watch_.serialize(s);
    branches_.serialize(s);
    contacts_.serialize(s);
    effort_.serialize(s);
    s(records_);
  }

  /// Fills the balance and the warnings of the summary, with the state at the end. `corners`: those
  /// at which steps were divided.
  void finish(const State& s, double spectral_radius, std::span<const TimeCorner> corners,
              RunSummary& out) {
    const auto branch = branches_.warning(f_);
    evaluate(s);
    balance_.check(s.t, energies(s));
    out.energy.balanced = true;
    balance_.write(out.energy);
    out.warnings = watch_.range().warnings(out.energy, spectral_radius, corners);
    contacts_.warn(out.warnings);
    if (branch) out.warnings.push_back(*branch);
  }

 private:
  /// Number of checks in a run: work is summed over all steps, so that a remainder between checks
  /// is not lost. Each check costs up to 8 % of a step of a vehicle, all other monitoring 2 %.
  static constexpr long energy_checks = 50;
  /// Fraction of the mean mass, for bodies in a model without mass: a millionth of their energy is
  /// the smallest exchanged energy, and rounding is 1e-11 of it.
  static constexpr double massless = 1e-4;

  void evaluate(const State& s) noexcept {
    kinematics_at(f_, s);
    f_.forces();
  }

  EnergyBalance::Energies energies(const State& s) noexcept {
    EnergyBalance::Energies e;
    e.kinetic = f_.kinetic_energy(s.v);
    const SystemMotion& motion = f_.motion();
    add_stored(motion, e);
    for (std::size_t i = 0; i < f_.model().bodies.size(); ++i) {
      const Body& b = f_.model().bodies[i];
      const BodyKinematics& m = motion.bodies[i];
      const double fastest = m.v_WB.norm() + m.w_WB.norm() * b.length;
      e.motion += 0.5 * mass_[i] * fastest * fastest;
    }
    e.present = e.kinetic + e.elastic;
    if (weightless_) e.present += e.motion;
    return e;
  }

  /// All energies except the kinetic one.
  void add_stored(const SystemMotion& motion, EnergyBalance::Energies& e) const noexcept {
    e.potential = e.gravity = f_.gravity_energy();
    for (std::size_t k = 0; k < f_.model().elements.size(); ++k) {
      const double energy = motion.efforts[k].energy;
      e.potential += energy;
      (energy_category(f_.model().elements[k].type) == EnergyCategory::tyres ? e.tyres
                                                                             : e.springs) += energy;
    }
    e.elastic = elastic_energy(motion);
  }

  Formulation& f_;
  MotionWatch watch_;
  BranchWatch branches_;
  ContactWatch contacts_;
  EnergyBalance balance_;
  HealthEffort effort_;
  std::vector<double> mass_;  ///< of the bodies, for the energy of their motion [kg]
  bool weightless_ = false;   ///< nothing has mass
  long every_, records_ = 0;
};

}  // namespace floatframe
