#pragma once
// The parameters of one use of a model or subsystem file: declared in it with their defaults, given
// from outside by --set or by the entry of `subsystems`.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/model_file/model_instance.hpp"

namespace floatframe {

/// A parameter with its value from outside.
struct GivenParameter {
  std::string name;
  ParameterValue value;
  SourceMark mark;
  std::string subject;    ///< "subsystems.left.parameters" or "--set"
  std::string raw;        ///< as it was written on the command line: the value of a text
  std::string complaint;  ///< why it is neither a number nor true or false, though it looks so
};

/// "--set name=value" for the file `path`. A text is taken as it is written; quotes around it may
/// be there. nullopt and an error if it has no value.
std::optional<GivenParameter> read_override(const ParameterOverride& o, const std::string& path,
                                            ReadErrors& errors);

/// Fills the scope of an instance with what its file declares and what is given.
void read_parameters(ModelInstance& self, const std::vector<GivenParameter>& given);

}  // namespace floatframe
