#pragma once
// The files that a model was read from, to check later whether they have changed.
#include <map>
#include <string>

namespace floatframe {

struct ModelSource {
  /// The names under which they were opened, and a fingerprint of their content.
  std::map<std::string, std::string> files;
  std::map<std::string, std::string> relative;  ///< the same by names from the model file
  std::string text;                             ///< all of them with the values of parameters
};

}  // namespace floatframe
