#pragma once
// What a frame of bars looks like: its sections between the nodes of the reduced body.
#include "floatframe/body/body_shape.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/model/description.hpp"

namespace floatframe {

/// `model`: the frame as finite elements, whose nodes are those of the body.
BodyShape bar_shape(const FrameDescription& frame, const FeModel& model);

}  // namespace floatframe
