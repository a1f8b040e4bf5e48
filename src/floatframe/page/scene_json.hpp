#pragma once
// The scene of a page for the viewer (viewer/README.md): bodies with their surfaces and modes,
// their poses, joints and forces.
#include <nlohmann/json_fwd.hpp>

#include "floatframe/page/page_writer.hpp"
#include "floatframe/page/scene_frames.hpp"

namespace floatframe {

nlohmann::ordered_json scene_json(const Model& model, const SceneFrames& frames,
                                  PageBuffer& buffer);

}  // namespace floatframe
