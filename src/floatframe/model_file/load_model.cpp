#include "floatframe/model_file/load_model.hpp"

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/model_file/pack_model.hpp"

namespace floatframe {
namespace {

ModelDescription read_with_source(const std::string& path,
                                  const std::vector<ParameterOverride>& parameters,
                                  ReadOptions options, ModelSource* source) {
  if (!source) return read_model(path, parameters, nullptr, options);
  ModelFingerprint used;
  options.keep_text = true;
  ModelDescription description = read_model(path, parameters, &used, options);
  *source = {used.files, relative_to_model(path, used.files), std::move(used.text)};
  return description;
}

}  // namespace

ModelDescription load_description(const std::string& path,
                                  const std::vector<ParameterOverride>& parameters,
                                  ModelSource* source) {
  if (path.empty())
    throw InputError(ErrorCode::missing, "found an empty path, expected that of a model file");
  return read_with_source(path, parameters, {}, source);
}

ModelDescription read_description(const std::string& text, const std::string& path,
                                  const std::vector<ParameterOverride>& parameters,
                                  ModelSource* source) {
  ReadOptions options;
  options.text = &text;
  return read_with_source(path, parameters, options, source);
}

Model load_model(const std::string& path, const std::vector<ParameterOverride>& parameters) {
  if (!path.empty() && is_packed_file(path)) {
    const PackedModel model = read_packed_model(path);
    return model.build(packed_values(model, parameters));
  }
  return build_model(load_description(path, parameters));
}

}  // namespace floatframe
