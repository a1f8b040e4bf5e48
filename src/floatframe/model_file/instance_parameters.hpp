#pragma once
// The parameters of one use of a model or subsystem file: declared in it with their defaults, set
// externally by --set or by the entry of `subsystems`.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/model_file/model_instance.hpp"

namespace floatframe {

/// A parameter with an external value.
struct GivenParameter {
  std::string name;
  ParameterValue value;
  SourceMark mark;
  std::string subject;    ///< "subsystems.left.parameters" or "--set"
  std::string raw;        ///< as written on the command line: the value of a text
  std::string complaint;  ///< error of a malformed number, true or false
  std::string text = {};  ///< with its expressions, which are of `scope`
  const ParameterScope* scope = nullptr;
};

/// "--set name=value" for the file `path`. A text is taken as written, without quotes around it.
/// nullopt and an error if it has no value.
std::optional<GivenParameter> read_override(const ParameterOverride& o, const std::string& path,
                                            ReadErrors& errors);

/// Fills the scope of an instance with the declared and the given parameters.
void read_parameters(ModelInstance& self, const std::vector<GivenParameter>& given);

}  // namespace floatframe
