#include "floatframe/model_file/keep_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "floatframe/core/suggest.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

bool is_meant(const std::string& name, const OutputDescription& output) {
  return output.name == name || (output.name.size() > name.size() &&
                                 output.name.starts_with(name) && output.name[name.size()] == '.');
}

bool may_be_named(const OutputDescription& output) {
  return output.formula || output_kind(output.type).value != nullptr;
}

}  // namespace

void keep_outputs(ModelDescription& description, const std::vector<std::string>& names) {
  std::vector<OutputDescription> all = std::move(description.outputs);
  description.outputs.clear();
  ErrorList errors;
  for (const std::string& name : names)
    if (std::none_of(all.begin(), all.end(), [&](const auto& o) { return is_meant(name, o); })) {
      std::vector<std::string> known;
      for (const OutputDescription& o : all) known.push_back(o.name);
      errors.add(ErrorCode::not_found, {},
                 fmt::format("--outputs: found '{}', which is no output of the model{}", name,
                             did_you_mean(name, known)));
    }
  errors.throw_if_any();
  for (OutputDescription& output : all) {
    const bool kept = std::any_of(names.begin(), names.end(),
                                  [&](const std::string& name) { return is_meant(name, output); });
    if (kept)
      description.outputs.push_back(std::move(output));
    else if (may_be_named(output))
      description.measures.push_back(std::move(output));
  }
}

}  // namespace floatframe
