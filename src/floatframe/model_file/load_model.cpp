#include "floatframe/model_file/load_model.hpp"

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model_file/model_reader.hpp"

namespace floatframe {

ModelDescription load_description(const std::string& path,
                                  const std::vector<ParameterOverride>& parameters) {
  if (path.empty()) throw InputError("found an empty path, expected that of a model file");
  return read_model(path, parameters);
}

ModelDescription read_description(const std::string& text, const std::string& path,
                                  const std::vector<ParameterOverride>& parameters) {
  ReadOptions options;
  options.text = &text;
  return read_model(path, parameters, nullptr, options);
}

Model load_model(const std::string& path, const std::vector<ParameterOverride>& parameters) {
  return build_model(load_description(path, parameters));
}

}  // namespace floatframe
