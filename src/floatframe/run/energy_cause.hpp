#pragma once
// Prescribed functions of time that violate the energy balance: corners of a motion, where
// velocities jump, which no step resolves, and kinks and jumps of targets, actuators and loads at
// which steps are not divided.
#include <span>
#include <string>

#include "floatframe/stepping/time_corners.hpp"

namespace floatframe {

/// The largest of these in a time window [s], with its instant and the remedy, as part of a
/// sentence: "the velocity of the motion of joint 'a' jumps by 2 rad/s at t = 1 s ...". Empty if
/// there is none. `corners`: those at which steps, of size `step` [s], are divided.
std::string energy_cause(const Model& model, double from, double to, double step,
                         std::span<const TimeCorner> corners);

}  // namespace floatframe
