#pragma once
// The model files of a model as one text, with the values of their parameters in place of the
// expressions: the input of a run, for people; without subsystems it is a valid model file.
#include <string>

namespace floatframe {

struct ModelInstance;

/// The model file, then each use of a subsystem file as a separate document, "--- # front_left".
std::string resolved_text(const ModelInstance& root);

}  // namespace floatframe
