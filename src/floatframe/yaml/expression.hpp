#pragma once
// The expression language of model files: the text inside `${...}`.
//   numbers, 'text', true, false, pi, deg, mm, km_h, rpm, inch, g0, parameter names
//   + - * / ^ (right associative), unary -, parentheses
//   == != < <= > >=   and or not
//   sqrt sin cos tan asin acos atan atan2 exp log abs min max floor ceil round if(condition, a, b)
// Angles in radians. Every result is finite: a division by zero or the root of a negative number is
// an error. `if`, `and` and `or` compute only the operands they need; the others are checked for
// syntax, names and types.
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "floatframe/core/number_rule.hpp"

namespace floatframe {

using ParameterValue = std::variant<bool, double, std::string>;
using ParameterScope = std::map<std::string, ParameterValue, std::less<>>;

/// The error in an expression, without its location.
class ExpressionError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Maximum length of a text of a model file, written or composed of parameters [bytes].
inline constexpr std::size_t longest_text = 16384;

/// Value of the expression `text` (without `${` and `}`). Throws ExpressionError; `suggest`: with
/// the closest known name for an unknown one, which takes time.
ParameterValue evaluate_expression(std::string_view text, const ParameterScope& scope,
                                   bool suggest = true);

/// Replaces every `${...}` in `text`. A text that is a single `${...}` keeps the type of its value,
/// otherwise the values are inserted as text. Throws ExpressionError.
ParameterValue substitute_parameters(std::string_view text, const ParameterScope& scope,
                                     bool suggest = true);

/// Value as text: true, false, number_text or the text itself.
std::string value_text(const ParameterValue& value);
/// "a number", "true or false", "a text".
const char* type_name(const ParameterValue& value);

/// A constant that a parameter of the same name may hide (deg, mm, ...).
bool is_constant_name(std::string_view name);
/// A name reserved by the expression language (pi, true, and, sqrt, ...).
bool is_reserved_name(std::string_view name);

/// Interpretation of a plain (unquoted) scalar in the YAML 1.2 subset of model files.
struct PlainScalar {
  enum class Kind { null, boolean, number, text, bad_number, bad_boolean };
  Kind kind = Kind::text;
  bool boolean = false;
  double number = 0.0;
  std::string complaint = {};  ///< reason why a bad_number or a bad_boolean is rejected
};
PlainScalar classify_plain_scalar(std::string_view text);

}  // namespace floatframe
