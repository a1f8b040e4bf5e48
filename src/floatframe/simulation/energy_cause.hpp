#pragma once
// What a model prescribes over time that no step resolves, and so opens the energy balance whatever
// the step: corners of a motion, where velocities jump, and jumps of targets, actuators and loads.
#include <string>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// The largest of these in a window of time [s], with its instant and what to do, as a part of
/// a sentence: "the velocity of the motion of joint 'a' jumps by 2 rad/s at t = 1 s ...". Empty:
/// there is none. What takes less than a `step` [s] counts as a jump.
std::string energy_cause(const Model& model, double from, double to, double step);

}  // namespace floatframe
