#pragma once
// Keeps the energy balance and the range watch of a run of any formulation. Powers and phases are
// taken after every step, deformations and spin at recorded instants, energies at some of these
// (the kinetic energy costs as much as half an iteration). `start` and `step` do not allocate and
// leave the run as it is, bit for bit.
#include <vector>

#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/simulation/energy_balance.hpp"
#include "floatframe/simulation/range_watch.hpp"

namespace floatframe {

template <class F>
class RunWatch {
 public:
  /// `records`: rows that will be recorded.
  RunWatch(F& formulation, double step, long records)
      : f_(formulation),
        watch_(formulation.model(), step),
        every_(std::max(1L, records / energy_checks)) {
    int modes = 0;
    for (const Body& b : f_.model().bodies) modes = std::max(modes, b.modes());
    y_ = VecX::Zero(modes);
    double total = 0.0;
    for (const Body& b : f_.model().bodies) mass_.push_back(b.data->invariants.m);
    for (const double m : mass_) total += m;
    // Without any mass the penalty is scaled by 1 kg, and so is what rounding leaves of it.
    if (total == 0.0) mass_.assign(mass_.size(), massless * f_.model().mean_mass);
  }

  /// At the start of the run; `lambda` belongs to its accelerations.
  void start(const State& s) noexcept {
    evaluate(s);
    balance_.start(s.t, flows(f_, s.v, s.lambda), energies(s), watch_.noise());
    look(s);
    meters(s, [](PhaseMeter& m, const Vec3& v) { m.start(v); });
  }

  /// After a step; `sampled`: outputs have just been taken there.
  void step(const State& s, const VecX& reactions, bool sampled, bool full) noexcept {
    if (!sampled) {
      // A step with constraints leaves positions and velocities of its end behind.
      if (f_.constraints() > 0)
        f_.forces();
      else
        evaluate(s);
    }
    balance_.advance(s.t, flows(f_, s.v, reactions));
    if (full) meters(s, [](PhaseMeter& m, const Vec3& v) { m.observe(v); });
    if (!sampled) return;
    look(s);
    if (++records_ % every_ == 0) balance_.check(s.t, energies(s));
  }

  /// Fills the balance and the warnings of the summary, with the state at the end.
  void finish(const State& s, double spectral_radius, RunSummary& out) {
    evaluate(s);
    balance_.check(s.t, energies(s));
    out.energy.balanced = true;
    balance_.write(out.energy);
    out.warnings = watch_.sentences(out.energy, spectral_radius);
  }

 private:
  /// In a run: the work is summed over all steps, so that a remainder does not get lost between
  /// checks. Each costs as much as 8 % of a step of a vehicle, all else that is watched 2 %.
  static constexpr long energy_checks = 50;
  /// Of the mean mass, for bodies in a model without mass: a millionth of their energy is the least
  /// that counts as exchanged, and rounding is 1e-11 of it.
  static constexpr double massless = 1e-4;

  void evaluate(const State& s) noexcept {
    f_.positions(s.t, s.q);
    f_.velocities(s.v);
    f_.forces();
  }

  EnergyBalance::Energies energies(const State& s) noexcept {
    EnergyBalance::Energies e;
    e.kinetic = f_.kinetic_energy(s.v);
    e.potential = f_.gravity_energy(s.q);
    for (std::size_t k = 0; k < f_.model().forces.size(); ++k)
      e.potential += f_.force(static_cast<int>(k)).energy;
    e.elastic = f_.elastic_energy(s.q);
    for (std::size_t i = 0; i < f_.model().bodies.size(); ++i) {
      const Body& b = f_.model().bodies[i];
      const int body = static_cast<int>(i);
      const double fastest =
          f_.body_velocity(body).norm() + f_.body_angular_velocity(body).norm() * b.length;
      e.motion += 0.5 * mass_[i] * fastest * fastest;
    }
    return e;
  }

  void look(const State& s) noexcept {
    for (std::size_t i = 0; i < watch_.bodies().size(); ++i) {
      const int body = static_cast<int>(i);
      for (int k = 0; k < f_.model().bodies[i].modes(); ++k) y_[k] = f_.amplitude(s.q, body, k);
      const Vec3 w = f_.body_rotation(body).transpose() * f_.body_angular_velocity(body);
      watch_.bodies()[i].observe(s.t, watch_.step(), w, y_.data(), watch_.limits());
    }
  }

  template <class Use>
  void meters(const State& s, const Use& use) noexcept {
    for (std::size_t i = 0; i < f_.model().bodies.size(); ++i) {
      const int body = static_cast<int>(i);
      std::vector<PhaseMeter>& m = watch_.meters(body);
      use(m[0], f_.body_velocity(body));
      use(m[1], f_.body_angular_velocity(body));
      for (std::size_t k = 2; k < m.size(); ++k)
        use(m[k], Vec3(f_.amplitude_rate(s.v, body, static_cast<int>(k) - 2), 0.0, 0.0));
    }
  }

  F& f_;
  RangeWatch watch_;
  EnergyBalance balance_;
  VecX y_;
  std::vector<double> mass_;  ///< of the bodies, for the energy of their motion [kg]
  long every_, records_ = 0;
};

}  // namespace floatframe
