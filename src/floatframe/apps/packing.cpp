#include "floatframe/apps/packing.hpp"

#include "floatframe/core/text_pieces.hpp"
#include "floatframe/model_file/keep_outputs.hpp"
#include "floatframe/model_file/pack_model.hpp"

namespace floatframe {

PackedModel packed_of(const ModelArguments& model, const std::string& outputs,
                      PackOptions::Contents contents, std::vector<std::string>& fixed) {
  const ModelSettings settings = settings_of(model);
  ModelPacking packing;
  packing.contents.contents = contents;
  std::vector<std::string> names;
  if (!outputs.empty()) names = pieces_of(outputs, ',');
  packing.change = [&](ModelDescription& description) {
    set_options(settings.options, description.simulation);
    if (!names.empty()) keep_outputs(description, names);
  };
  return pack_model(model.path, settings.parameters, packing, &fixed);
}

}  // namespace floatframe
