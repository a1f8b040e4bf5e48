#pragma once
// Whoever wants to see the state where forces jump, just before and just after it.
#include "floatframe/integrator/step.hpp"

namespace floatframe {

/// The formulation is at the positions and velocities of the state, with the forces of that side.
struct EdgeWatch {
  void* who = nullptr;
  void (*look)(void* who, const State& state, const VecX& reactions) noexcept = nullptr;

  void operator()(const State& state, const VecX& reactions) const noexcept {
    if (look) look(who, state, reactions);
  }
};

}  // namespace floatframe
