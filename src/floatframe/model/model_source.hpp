#pragma once
// What a model was read from, for those who look later whether it is still the same.
#include <map>
#include <string>

namespace floatframe {

struct ModelSource {
  /// As they were opened, and a fingerprint of what is in them.
  std::map<std::string, std::string> files;
  std::map<std::string, std::string> relative;  ///< the same by names from the model file
  std::string text;                             ///< all of them with the values of parameters
};

}  // namespace floatframe
