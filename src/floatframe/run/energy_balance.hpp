#pragma once
// Energy balance of a run: the change of kinetic, potential and elastic energy compared with the
// work of everything that adds or removes energy,
//   remainder(t) = E(t) - E(0) - sum W_k(t),   W_k = int P_k dt,
// with the powers evaluated after every accepted step and integrated by the trapezoidal rule.
// Springs, gravity and modal stiffness are part of E; constraints do no work except prescribed
// motions, whose power is sum lambda dPhi/dt with the multipliers of the projected accelerations.
// The energy stored in tyres jumps at the steps of a road and where their dampers make them lose
// contact; these changes count as work of the tyres, in addition to that of their forces. Likewise
// changes of springs whose target jumps, a set point or an input, count as work of the actuators.
// The remainder is the integration error, of order h^2, and for a spectral radius below 1 the
// dissipation of the integrator. Nothing here allocates.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/system_motion.hpp"
#include "floatframe/run/results.hpp"

namespace floatframe {

/// Powers [W], positive into the system, and the energies stored in tyres and in springs whose
/// target may jump [J].
struct FlowSample {
  EnergyFlows power;
  double tyres = 0.0, targeted = 0.0;
};

/// In a motion; `reactions`: the multipliers of the constraints.
inline FlowSample flows(const SystemMotion& motion, const ConstraintSet& constraints,
                        const VecX& reactions) noexcept {
  FlowSample sample;
  EnergyFlows& p = sample.power;
  const Model& model = motion.model;
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& force = model.elements[k];
    const Efforts& s = motion.efforts[k];
    // Power of the wrench that the spring neither stores nor releases.
    const double rest = motion.power(static_cast<int>(k)) + s.energy_rate;
    const EnergyCategory category = energy_category(force.type);
    if (category == EnergyCategory::tyres) {
      p[EnergyFlow::tyres] += rest;
      sample.tyres += s.energy;
    } else if (category == EnergyCategory::loads) {
      p[EnergyFlow::loads] += rest;
    } else {
      p[EnergyFlow::dampers] -= s.damping;
      if (force.target_jumps) {
        p[EnergyFlow::actuators] += rest - s.energy_rate + s.damping;
        sample.targeted += s.energy;
      } else if (force.driven)
        p[EnergyFlow::actuators] += rest + s.damping;
    }
  }
  p[EnergyFlow::modal_damping] = -modal_damping_power(motion);
  p[EnergyFlow::motions] = constraints.motion_power(reactions);
  return sample;
}

class EnergyBalance {
 public:
  struct Energies {
    double kinetic = 0.0, potential = 0.0, elastic = 0.0;
    double motion = 0.0;   ///< kinetic, if all mass moved at the largest possible speed
    double present = 0.0;  ///< reference of the errors of a step
    double gravity = 0.0, springs = 0.0, tyres = 0.0;  ///< terms of `potential`
    double total() const noexcept { return kinetic + potential + elastic; }
  };

  /// `noise`: energies below it are insignificant [J].
  void start(double t, const FlowSample& flows, const Energies& e, double noise) noexcept {
    assert(std::isfinite(t) && noise >= 0.0);
    time_ = t;
    noise_ = noise;
    last_ = flows;
    start_ = e.total();
    low_ = high_ = e;
    checked_at_ = t;
    check(t, e);
  }

  /// To be called after every step.
  void advance(double t, const FlowSample& flows) noexcept {
    const double half = 0.5 * (t - time_);
    for (std::size_t k = 0; k < EnergyFlows::size(); ++k) {
      double work = half * (last_.power.value[k] + flows.power.value[k]);
      if (k == index_of(EnergyFlow::tyres)) work += flows.tyres - last_.tyres;
      if (k == index_of(EnergyFlow::actuators)) work += flows.targeted - last_.targeted;
      work_.value[k] += work;
      moved_.value[k] += std::abs(work);
    }
    time_ = t;
    last_ = flows;
  }

  /// The energies at the time of the last `advance`.
  void check(double t, const Energies& e) noexcept {
    low_.kinetic = std::min(low_.kinetic, e.kinetic);
    low_.potential = std::min(low_.potential, e.potential);
    low_.elastic = std::min(low_.elastic, e.elastic);
    high_.kinetic = std::max(high_.kinetic, e.kinetic);
    high_.potential = std::max(high_.potential, e.potential);
    high_.elastic = std::max(high_.elastic, e.elastic);
    high_.motion = std::max(high_.motion, e.motion);
    present_ = std::max(present_, e.present);
    const double before = remainder_;
    remainder_ = remainder(e);
    if (std::abs(remainder_ - before) > growth_) {
      growth_ = std::abs(remainder_ - before);
      growth_from_ = checked_at_;
      growth_to_ = t;
    }
    checked_at_ = t;
    if (std::abs(remainder_) > std::abs(largest_)) {
      largest_ = remainder_;
      largest_at_ = t;
    }
  }

  const EnergyFlows& work() const noexcept { return work_; }  ///< up to the last `advance`
  /// With the energies at that time.
  double remainder(const Energies& e) const noexcept { return e.total() - start_ - work_.total(); }

  /// Reference value of the remainder [J]: the largest of the ranges of the energies and of the
  /// amounts of work, and at least a millionth of the largest energy and the noise, below which the
  /// tolerances of the solver are visible. In a motion with little energy the work of its drive is
  /// the rounding of a multiplier: penalty (1e5 masses) times 1e-16 of the acceleration, 1e-11 of
  /// `motion` per radian turned.
  double exchanged() const noexcept {
    double most = std::max({high_.kinetic - low_.kinetic, high_.potential - low_.potential,
                            high_.elastic - low_.elastic});
    for (const double w : moved_.value) most = std::max(most, w);
    const double size = std::max({std::abs(high_.kinetic), std::abs(high_.potential),
                                  std::abs(low_.potential), std::abs(high_.elastic), high_.motion});
    return std::max({most, 1e-6 * size, noise_});
  }

  void write(EnergySummary& out) const noexcept {
    out.work = work_;
    out.remainder = remainder_;
    out.largest_remainder = largest_;
    out.largest_remainder_at = largest_at_;
    out.exchanged = exchanged();
    out.present = present_;
    out.largest_growth = growth_;
    out.largest_growth_from = growth_from_;
    out.largest_growth_to = growth_to_;
  }

  /// For runs that are continued elsewhere (state_bytes.hpp).
  template <class Stream>
  void serialize(Stream& s) {
    for (double* x :
         {&time_, &start_, &remainder_, &largest_, &largest_at_, &noise_, &last_.tyres,
          &last_.targeted, &present_, &growth_, &growth_from_, &growth_to_, &checked_at_})
      s(*x);
    for (EnergyFlows* flows : {&last_.power, &work_, &moved_})
      for (double& x : flows->value) s(x);
    for (Energies* e : {&low_, &high_})
      for (double* x : {&e->kinetic, &e->potential, &e->elastic, &e->motion}) s(*x);
  }

 private:
  double time_ = 0.0, start_ = 0.0, remainder_ = 0.0, largest_ = 0.0, largest_at_ = 0.0;
  double noise_ = 0.0, present_ = 0.0;
  double growth_ = 0.0, growth_from_ = 0.0, growth_to_ = 0.0, checked_at_ = 0.0;
  FlowSample last_;
  EnergyFlows work_, moved_;
  Energies low_, high_;
};

}  // namespace floatframe
