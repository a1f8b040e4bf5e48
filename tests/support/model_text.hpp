#pragma once
// Models written in a test as the text of a model file.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/model_file/model_reader.hpp"

namespace floatframe::test {

/// What the model file with `text` below its first line, "floatframe: 1", describes.
ModelDescription description_of(const std::string& text,
                                const std::vector<ParameterOverride>& values = {});
Model model_of(const std::string& text);

}  // namespace floatframe::test
