#pragma once
// Valid combinations of inertia method and mass model.
#include "floatframe/description/description.hpp"

namespace floatframe {

/// Throws InputError, with the place of the mass model, for every flexible body whose mass model
/// cannot be used with `method`.
void check_inertia_method(const ModelDescription& description, InertiaMethod method);

}  // namespace floatframe
