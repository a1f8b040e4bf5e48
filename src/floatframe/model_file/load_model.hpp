#pragma once
// Model files for programs.
#include <string>
#include <vector>

#include "floatframe/description/model_source.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model_file/parameter_override.hpp"

namespace floatframe {

/// Reads a model file (docs/model-file.md) and the files it refers to. Throws InputError with
/// every error found, each with file, line and column.
ModelDescription load_description(const std::string& path,
                                  const std::vector<ParameterOverride>& parameters = {},
                                  ModelSource* source = nullptr);

/// The same for the text of a model file. `path` is its name in messages, and files that it refers
/// to are relative to the folder of `path`.
ModelDescription read_description(const std::string& text, const std::string& path,
                                  const std::vector<ParameterOverride>& parameters = {},
                                  ModelSource* source = nullptr);

/// As `load_description`, with the model built.
Model load_model(const std::string& path, const std::vector<ParameterOverride>& parameters = {});

}  // namespace floatframe
