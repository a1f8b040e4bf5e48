#pragma once
// Whether the inputs of a vehicle do what their roles say, found by trying. From the start of the
// run it is driven on for a moment without inputs and with one of them; with the time t of both,
// the speed v and the wheelbase L the input acts if
//   steering by 0.01 rad:             |r - r_0| > 1e-2 (0.01 v/L) t/s
//   drive or brake force F = m a:     |v - v_0| > 1e-2 a t,   a = 0.5 m/s2, within its limits
// and its sign is right if r - r_0 > 0, v - v_0 > 0, for the brake v - v_0 < 0. An input that does
// not act within 0.1 s has 2 s; one whose force is off changes not a bit.
#include "floatframe/vehicle/vehicle_run.hpp"

namespace floatframe {

/// For the steering and the drive, and for the brake if there is one. The run is in its state of
/// before. Throws InputError with a sentence that names the input, RunError if a step fails.
void require_inputs_that_act(VehicleRun& run);

}  // namespace floatframe
