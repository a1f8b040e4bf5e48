#pragma once
// The words of the expression language: constants and functions.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

/// In SI units.
std::optional<double> constant_value(std::string_view name);
std::vector<std::string> constant_names();

/// A function of one number.
struct UnaryFunction {
  const char* name;
  double (*value)(double x);
  bool (*defined)(double x);
};
/// nullptr if there is none of that name.
const UnaryFunction* unary_function(std::string_view name);

/// Functions of any number of arguments.
bool is_function_name(std::string_view name);
std::vector<std::string> function_names();

}  // namespace floatframe
