#pragma once
// Linear systems from files: `.npz` of NumPy or `.mat` of MATLAB, as `floatframe linearize` writes
// them: the matrices A, B, C, D, and as texts the names `inputs`, `outputs`. D and the names may be
// left out, other variables are ignored.
#include <optional>
#include <vector>

#include "floatframe/formats/matlab/mat_file.hpp"
#include "floatframe/yaml/yaml_value.hpp"

namespace floatframe {

struct ModelInstance;

/// The variables of the file named by the value, relative to the model file; A, B, C are there.
/// Nothing and one error at the value if there is no such system.
std::optional<std::vector<MatVariable>> read_linear_file(const ModelInstance& self,
                                                         const YamlValue& value);

}  // namespace floatframe
