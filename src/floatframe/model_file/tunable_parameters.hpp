#pragma once
// Which parameters of a model file can take new values in a packed model, and how its numbers
// follow from them. Found by trial: the file is read again with other values, and each number that
// changes must be one of the expressions of the file, bit for bit (matched_number.hpp). A
// parameter is fixed if more than numbers changes, if a flexible body would be reduced anew, if a
// number is not explained, or if it decides what is no number (`when`, names of files).
#include <functional>
#include <string>
#include <vector>

#include "floatframe/description/description.hpp"
#include "floatframe/model_file/parameter_override.hpp"
#include "floatframe/packed/packed_model.hpp"
#include "floatframe/yaml/expressions_read.hpp"

namespace floatframe {

struct TunableParameters {
  /// The number at a place among those of the description, in the order of
  /// `DescriptionBytes::doubles`: factor x formula.
  struct Number {
    std::size_t place = 0;
    std::uint32_t formula = 0;
    double factor = 1.0;
    double value = 0.0;  ///< as it was read
  };
  std::vector<PackedParameter> parameters;
  std::vector<SharedFormula> formulas;
  std::vector<Number> numbers;
  std::vector<std::string> fixed;  ///< sentences about the other ones, without their full stops
};

/// Reads the description with these values after the others.
using DescriptionReader =
    std::function<ModelDescription(const std::vector<ParameterOverride>& values)>;

/// `given`: as it was read without other values, while `read` collected the expressions. Reads it
/// a few times for each parameter.
TunableParameters tunable_parameters(const ModelDescription& given, const ExpressionsRead& read,
                                     const DescriptionReader& reader);

}  // namespace floatframe
