#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {

void validate_entity(const YamlSection& section, const Origin& origin,
                     const std::function<void(const validation::Entity&)>& check) {
  ErrorList found;
  check({found, origin, section.path()});
  for (ErrorEntry& e : found.take()) section.value().context().errors->add(std::move(e));
}

}  // namespace floatframe
