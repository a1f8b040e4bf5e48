#pragma once
// What a body's own inertia and weight add to the stress of a page: the 12 load coefficients of
// body_stress.hpp at each frame, from the accelerations of the run. Those of the modes'
// accelerations are left to gauges and `floatframe stress`.
#include "floatframe/model/model.hpp"
#include "floatframe/report/scene_frames.hpp"

namespace floatframe {

class StateHistory;

/// Of the bodies that know what these loads do. `options`: those of the run. Without a state to
/// start from, as of a model that cannot start, nothing is added.
void add_load_coefficients(const Model& model, const StateHistory& history,
                           const SimulationDescription& options, SceneFrames& frames);

}  // namespace floatframe
