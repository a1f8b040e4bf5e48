#pragma once
// What a reading of a model file depended on, so that a study of many runs knows which of them
// share one model and whether the files are still those it began with.
#include <map>
#include <string>
#include <vector>

namespace floatframe {

struct ModelInstance;

struct ModelFingerprint {
  /// Names of the parameters of the model file; empty if it could not be read at all.
  std::vector<std::string> parameters;
  /// Every file that was read, as it was opened, and the fingerprint of its content.
  std::map<std::string, std::string> files;
  /// Of all that is written in the files, with every expression replaced by its value, except the
  /// group `simulation` (and the definitions of parameters): equal fingerprints, equal models.
  std::string model;
  /// The same of the group `simulation`.
  std::string simulation;
  /// The files with the values of parameters, if it was asked for (ReadOptions).
  std::string text;
};

/// Names of files relative to the model file: a folder may be moved or reached by another path.
std::map<std::string, std::string> relative_to_model(
    const std::string& model, const std::map<std::string, std::string>& files);

/// `model` and `simulation` of a loaded model file with its subsystems.
void fingerprint(const ModelInstance& root, ModelFingerprint& out);

}  // namespace floatframe
