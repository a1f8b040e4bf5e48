#pragma once
// The words of expressions: constants and functions.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/formulas/scalars.hpp"

namespace floatframe {

/// In SI units.
std::optional<double> constant_value(std::string_view name);
std::vector<std::string> constant_names();

/// A function of one number.
struct UnaryFunction {
  const char* name;
  FunctionValue (*at)(double x);
  bool (*defined)(double x);
  /// Where it ends with a finite value: the end of its range next to x. Null: nowhere.
  double (*end)(double x) = nullptr;
  bool jumps = false;

  /// Beyond an end e a function of a held piece goes on as the image of what is before it, turned
  /// about its end: 2 f(e) - f(2 e - x).
  FunctionValue beyond(double x) const {
    const double e = end(x);
    const FunctionValue image = at(2.0 * e - x);
    return {2.0 * at(e).f - image.f, image.df, -image.ddf};
  }
};
/// nullptr if there is none of that name.
const UnaryFunction* unary_function(std::string_view name);

/// The other functions.
enum class Function {
  atan2,
  min,
  max,
  if_,
  clip,
  smoothstep,
  sign,
  chirp,
  sum_of_sines,
  noise,
  table,
  table2,
  delay
};
struct FunctionWord {
  Function function;
  const char* name;
  std::size_t fewest, most;    ///< numbers of arguments
  bool formulas_only = false;  ///< not in parameters
};
const FunctionWord* function_word(std::string_view name);

/// Functions of any number of arguments; those of parameters only, if `in_parameters`.
bool is_function_name(std::string_view name, bool in_parameters = false);
std::vector<std::string> function_names(bool in_parameters);

/// A constant that a parameter of the same name may hide (deg, mm, ...).
bool is_constant_name(std::string_view name);
/// A name that a parameter cannot have: pi, true, and, ...
bool is_reserved_name(std::string_view name);

/// atan2, min, max, clip, smoothstep or sign of numbers.
double function_of(Function f, const std::vector<double>& x);
/// Of the cubic from (x0, y0) to (x1, y1) that is flat at both ends and beyond.
FunctionValue smoothstep(double x, double x0, double y0, double x1, double y1) noexcept;
/// "clip takes 3 arguments, found 2"; empty if the count is right.
std::string argument_complaint(const std::string& name, std::size_t fewest, std::size_t most,
                               std::size_t found);
/// Of arguments that are no numbers together; those that are not constant are NaN. Empty: none.
std::string constants_complaint(const std::string& name, const std::vector<double>& x);

}  // namespace floatframe
