#pragma once
// What makes one step of size h, and solves again where forces jump: the interface between the
// stepping and an integrator, which is compiled for each formulation. Nothing here allocates after
// construction, throws or prints.
#include <cassert>
#include <memory>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/step.hpp"

namespace floatframe {

class Integrator {
 public:
  virtual ~Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// One step of size h from `state`, which is replaced only if the step is accepted.
  virtual StepAttempt attempt(State& state, double h) noexcept = 0;
  /// For discontinuities of forces; see restart.hpp. h: step size.
  virtual void project_velocities(State& state, double h) noexcept = 0;
  virtual bool restart(State& state, double h) noexcept = 0;
  virtual bool restart_in_course(State& state, double h) noexcept = 0;

  /// Switches the next steps to the trapezoidal rule, or back to the scheme of the options.
  void trapezoidal(bool on) noexcept { options_.spectral_radius = on ? 1.0 : spectral_radius_; }
  const StepOptions& options() const noexcept { return options_; }

  /// Equal states and equal reuse records give bit-identical next steps.
  const TangentReuse& tangent_reuse() const noexcept { return reuse_; }
  void set_tangent_reuse(const TangentReuse& e) noexcept {
    assert(e.contraction >= 0.0 && e.contraction <= 1.0);
    reuse_ = e;
  }

  /// Multipliers consistent with the projected accelerations of the last accepted step. Those of
  /// the state belong to the accelerations before projection, which have an error of O(h).
  const VecX& reactions() const noexcept { return reactions_; }
  /// If enabled: impulses i of the constraints in the velocity projection of the last accepted
  /// step, W dv = -Phi_q^T i [N s].
  const VecX& impulses() const noexcept {
    assert(keeps_impulses_);
    return impulses_;
  }
  void keep_impulses() {
    keeps_impulses_ = true;
    impulses_ = VecX::Zero(reactions_.size());
  }

 protected:
  Integrator(const StepOptions& options, int constraints)
      : options_(options), spectral_radius_(options.spectral_radius) {
    assert(are_valid(options));
    reactions_ = VecX::Zero(constraints);
  }

  StepOptions options_;
  const double spectral_radius_;  ///< as given in the options
  TangentReuse reuse_;
  VecX reactions_, impulses_;
  bool keeps_impulses_ = false;
};

/// Of this formulation, compiled once for each kind.
std::unique_ptr<Integrator> make_integrator(Formulation& f, const StepOptions& options);

}  // namespace floatframe
