#pragma once
// Common parts of analyses over the speed of a rotor: the speeds, and geometric stiffening, which
// is included unless the model specifies it (counted_stiffening.hpp); where it is omitted, or
// cannot be complete, notes.
#include <string>
#include <vector>

#include "floatframe/linear/counted_stiffening.hpp"
#include "floatframe/rotors/rotor.hpp"

namespace floatframe {

/// from, from + step, ..., to [rad/s]. Throws InputError, which names the joint, unless they ascend
/// and are neither too many nor too fast.
std::vector<double> rotor_speeds(const std::string& joint, double from, double to, double step);

/// The model with stiffening of the rotor on this joint.
CountedStiffening stiffened_rotor(const Model& model, const std::string& joint);

/// Omissions for the bodies of the rotor at a speed [rad/s], sentences without their full stops.
std::vector<std::string> stiffening_notes(const Model& model, const Rotor& rotor, double speed);

}  // namespace floatframe
