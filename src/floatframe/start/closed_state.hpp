#pragma once
// A state of a model with other values of some coordinates and rates: what is given is met, all
// else changes as little as the loops need,
//   Phi(q) = 0, then Phi_q v + Phi_t = 0, with x of least weighted norm in J x = -r             (1)
// in increments from the present positions, so that a mechanism stays on its branch of assembly.
// Load time (allocates, throws).
#include <span>

#include "floatframe/description/state_name.hpp"
#include "floatframe/description/system_state.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// `present` is a state of the model, with its loops closed; of `given` joints and modes. Throws
/// InputError for what the model does not have and for numbers that are not finite, RunError with
/// the remaining gap if the loops do not close with these values.
SystemState closed_state(const Model& model, InertiaMethod inertia, const SystemState& present,
                         std::span<const GivenState> given);

}  // namespace floatframe
