#include "support/model_text.hpp"

#include "support/temporary_folder.hpp"

namespace floatframe::test {

ModelDescription description_of(const std::string& text,
                                const std::vector<ParameterOverride>& values) {
  const TemporaryFolder folder;
  return read_model(folder.write("model.yaml", "floatframe: 1\n" + text), values);
}

Model model_of(const std::string& text) { return build_model(description_of(text)); }

}  // namespace floatframe::test
