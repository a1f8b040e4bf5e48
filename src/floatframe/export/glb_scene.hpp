#pragma once
// A motion as a glTF 2.0 scene in one file (.glb), y up: a node for each body with its translation
// and rotation animated, its modes as morph targets with animated weights (docs/export.md). glTF
// holds floats: a target is a mode times the largest amplitude of the motion, in metres
// (morph_targets), and a scene far from the origin of the world has one of its own.
//
// What bends as y^T h y (geometric stiffening) is exact too: a target for each product of two
// amplitudes that moves a point visibly.
#include <memory>

#include "floatframe/export/export_file.hpp"

namespace floatframe {

/// Nothing is written before `finish`.
std::unique_ptr<ExportFile> glb_scene(const ExportBodies& bodies, const std::string& path);

}  // namespace floatframe
