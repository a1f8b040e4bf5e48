#pragma once
// What a model prescribes over time that opens the energy balance: corners of a motion, where
// velocities jump, which no step resolves, and entries of targets, actuators and loads that steps
// are not divided at.
#include <span>
#include <string>

#include "floatframe/simulation/time_corners.hpp"

namespace floatframe {

/// The largest of these in a window of time [s], with its instant and what to do, as a part of
/// a sentence: "the velocity of the motion of joint 'a' jumps by 2 rad/s at t = 1 s ...". Empty:
/// there is none. `corners`: what steps, of size `step` [s], are divided at and so resolve.
std::string energy_cause(const Model& model, double from, double to, double step,
                         std::span<const TimeCorner> corners);

}  // namespace floatframe
