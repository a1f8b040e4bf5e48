#pragma once
// Geometric stiffening of a rotor in analyses over its speed: counted in where the model does not
// say (counted_stiffening.hpp); where it is left out, or cannot be complete, notes.
#include <string>
#include <vector>

#include "floatframe/simulation/counted_stiffening.hpp"
#include "floatframe/simulation/rotor.hpp"

namespace floatframe {

/// The model with stiffening of the rotor on this joint.
CountedStiffening stiffened_rotor(const Model& model, const std::string& joint);

/// What is left out of the bodies of the rotor at a speed [rad/s], sentences without their points.
std::vector<std::string> stiffening_notes(const Model& model, const Rotor& rotor, double speed);

}  // namespace floatframe
