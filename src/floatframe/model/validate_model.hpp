#pragma once
// Checks of a whole description, and of what depends on the kind of a joint, element or output
// (description/validate.hpp).
#include "floatframe/description/validate.hpp"

namespace floatframe {

/// All checks possible before bodies are reduced; nodes of flexible bodies and numbers of modes are
/// left to `build_model`.
void validate(const ModelDescription& description, ErrorList& errors);

namespace validation {

/// Axes and start values of a joint, whose type is one of the list, and their consistency with its
/// motion.
void joint_values(const JointDescription& joint, const Entity& entity);

void joints(const ModelDescription& d, const Names& names, ErrorList& errors);
void elements(const ModelDescription& d, const Names& names, ErrorList& errors);
/// Of joints, rods and couplings.
void motions(const ModelDescription& d, ErrorList& errors);
void outputs(const ModelDescription& d, const Names& names, ErrorList& errors);
/// Of a vehicle whose names are known: kinds, bodies, sides and axes of what has a role.
void vehicle_roles(const ModelDescription& d, ErrorList& errors);

}  // namespace validation
}  // namespace floatframe
