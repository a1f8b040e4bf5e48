#pragma once
#include <string>

namespace floatframe {

/// A parameter of a model file with a value that replaces the one in the file: {"speed", "10"}. The
/// value is text, as after --set on the command line.
struct ParameterOverride {
  std::string name, value;
};

}  // namespace floatframe
