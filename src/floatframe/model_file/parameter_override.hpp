#pragma once
#include <string>

namespace floatframe {

/// A parameter of a model file with another value than the file gives it: {"speed", "10"}. The
/// value is text, as after --set of the command line.
struct ParameterOverride {
  std::string name, value;
};

}  // namespace floatframe
