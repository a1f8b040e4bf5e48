#pragma once
// From a model file to a packed model, with the parameters that take new values without a build.
#include <functional>
#include <string>
#include <vector>

#include "floatframe/model_file/parameter_override.hpp"
#include "floatframe/packed/pack.hpp"

namespace floatframe {

struct ModelPacking {
  PackOptions contents = {};
  /// Changes the description after it was read, always in the same way: outputs that are left out.
  std::function<void(ModelDescription&)> change = {};
};

/// `fixed`, if given, receives a sentence about each parameter that is a number and cannot take
/// another value, without its full stop. Throws InputError as `load_description` and `build_model`,
/// and for laws that have no bytes.
PackedModel pack_model(const std::string& path,
                       const std::vector<ParameterOverride>& overrides = {},
                       const ModelPacking& packing = {}, std::vector<std::string>* fixed = nullptr);

/// The values of the parameters of a packed model with `--set name=value` among them, in its order.
/// InputError that lists its parameters for another name, and for what is no number.
std::vector<double> packed_values(const PackedModel& model,
                                  const std::vector<ParameterOverride>& overrides);

/// True for a file that begins as packed models do.
bool is_packed_file(const std::string& path);

}  // namespace floatframe
