#pragma once
// A callback on both sides of a discontinuity of the forces.
#include "floatframe/integrator/step.hpp"

namespace floatframe {

/// The formulation is at the positions and velocities of the state, with the forces of one side.
struct EdgeWatch {
  void* who = nullptr;
  void (*look)(void* who, const State& state, const VecX& reactions) noexcept = nullptr;

  void operator()(const State& state, const VecX& reactions) const noexcept {
    if (look) look(who, state, reactions);
  }
};

}  // namespace floatframe
