#pragma once
// Everything that the reading of a model file depended on: a study finds out which runs share one
// model and whether its files have changed since it began.
#include <map>
#include <string>
#include <vector>

namespace floatframe {

struct ModelInstance;

struct ModelFingerprint {
  /// Names of the parameters of the model file; empty if it could not be read at all.
  std::vector<std::string> parameters;
  /// Every file that was read, by the name it was opened with, and the fingerprint of its content.
  std::map<std::string, std::string> files;
  /// Fingerprint of the files, with every expression replaced by its value, except the group
  /// `simulation` (and the definitions of parameters): equal fingerprints mean equal models.
  std::string model;
  /// The same for the group `simulation`.
  std::string simulation;
  /// The files with the values of parameters, if requested (ReadOptions).
  std::string text;
};

/// Names of files relative to the model file, independent of the location of its folder.
std::map<std::string, std::string> relative_to_model(
    const std::string& model, const std::map<std::string, std::string>& files);

/// `model` and `simulation` of a loaded model file with its subsystems.
void fingerprint(const ModelInstance& root, ModelFingerprint& out);

}  // namespace floatframe
