#pragma once
// Linear systems from files: `.npz` of NumPy or `.mat` of MATLAB, as `floatframe linearize` writes
// them: the matrices A, B, C, D, and as texts the names `inputs`, `outputs`. D and the names may be
// left out, other variables are ignored.
#include <optional>
#include <vector>

#include "floatframe/description/elements.hpp"
#include "floatframe/yaml/yaml_value.hpp"

namespace floatframe {

struct ElementDescription;
struct ModelInstance;

/// Sets the keys A, B, C, D and `outputs`, which exclude the file, from the file named by the
/// value, relative to the model file. Returns the names of its inputs, without names their
/// numbers. One error at the value if there is no such system.
std::vector<std::string> take_linear_file(const ModelInstance& self, const YamlValue& value,
                                          const YamlSection& section, ElementDescription& element);
/// A map of inputs of the file to signals, rather than one signal.
bool names_inputs(const YamlValue& value, const std::vector<std::string>& inputs);
/// In the order of the file; those that are not given are zero.
std::vector<SignalDescription> read_named_signals(const ModelInstance& self, const YamlValue& value,
                                                  const std::vector<std::string>& inputs);
/// The name or number of one of several values; empty after an error.
std::string read_value_name(const YamlValue& value);
/// A list of names.
std::optional<std::vector<std::string>> read_names(const YamlValue& value);

}  // namespace floatframe
