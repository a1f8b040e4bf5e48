#pragma once
// The model files of a model as one text, with the values of their parameters in place of the
// expressions: what a run was made from, for people, and without subsystems a model file again.
#include <string>

namespace floatframe {

struct ModelInstance;

/// The model file, then each use of a subsystem file as a document of its own, "--- # front_left".
std::string resolved_text(const ModelInstance& root);

}  // namespace floatframe
