#pragma once
// A mass on a spring behind floatframe.h, for tests of what stands on it: mass a = force -
// stiffness x - damping v,  by the explicit-implicit rule of Euler. It starts at rest, where
// force = stiffness x. Inputs: 0 force in [-100, 100] N (clamped beyond), 1 any number in
// [-1000, 1000]. Outputs: 0 x [m], 1 v [m/s], 2 force + any [N]. Parameters: 0 stiffness > 0 [N/m],
// 1 mass > 0 [kg], 2 the time from which steps fail [s]. The model is any file that begins with
// "fake"; its fingerprint is the rest.
#include <filesystem>
#include <string>

#include "floatframe/c_interface/function_table.hpp"

namespace floatframe::testing {

inline constexpr double fake_step = 0.01;  // [s]

/// A folder `resources` with a fake model of the fingerprint 0123abcd, for the life of the program.
const std::filesystem::path& fake_resources();
/// Simulations that are open now.
int open_fakes();
/// Successful calls of step and step_by since the program began, in all threads.
long fake_steps();
/// How long each step takes at least [s], for tests of overruns.
void slow_down_fakes(double seconds);

}  // namespace floatframe::testing
