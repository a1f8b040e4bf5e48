#pragma once
// The values of parameters: the text inside `${...}` (formulas/syntax_tree.hpp) with
//   numbers, 'text', true, false, pi, deg, mm, km_h, rpm, inch, g0, parameter names
//   sqrt sin cos tan asin acos atan atan2 tanh exp log abs min max floor ceil round
//   clip(x, lowest, highest), smoothstep(x, x0, y0, x1, y1), sign, if(condition, a, b)
// Angles in radians. Every result is finite: a division by zero or the root of a negative number is
// an error. `if`, `and` and `or` compute only the operands they need; the others are checked for
// syntax, names and types.
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/formulas/syntax_tree.hpp"

namespace floatframe {

using ParameterValue = std::variant<bool, double, std::string>;
using ParameterScope = std::map<std::string, ParameterValue, std::less<>>;

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

}  // namespace floatframe
