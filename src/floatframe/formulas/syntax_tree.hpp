#pragma once
// The grammar of the expressions of model files, of parameters, `${...}`, and of formulas:
//   numbers, 'text', true, false, names (letters, digits, _, with . between)
//   + - * / ^ (right associative), unary -, parentheses
//   == != < <= > >=   and or not   function(argument, ...)
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

/// The error in an expression, without its location.
class ExpressionError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Interpretation of a plain (unquoted) scalar in the YAML 1.2 subset of model files.
struct PlainScalar {
  enum class Kind { null, boolean, number, text, bad_number, bad_boolean };
  Kind kind = Kind::text;
  bool boolean = false;
  double number = 0.0;
  std::string complaint = {};  ///< reason why a bad_number or a bad_boolean is rejected
};
PlainScalar classify_plain_scalar(std::string_view text);

struct SyntaxNode {
  enum class Kind {
    number,
    truth,       ///< `number` is 0 or 1
    text,        ///< `word`
    name,        ///< `word`
    chain,       ///< operands of + and -, or of * and /, from left to right: `word` has an operator
                 ///< before each operand but the first
    power,       ///< of two
    sign,        ///< `word` + or - of one
    comparison,  ///< `word` of two
    all,         ///< `and` of two or more
    any,         ///< `or` of two or more
    negation,    ///< `not` of one
    call         ///< of the function `word`
  } kind = Kind::number;
  double number = 0.0;
  std::string word;
  std::vector<SyntaxNode> parts;
};

/// Throws ExpressionError.
SyntaxNode parse_expression(std::string_view text);

/// The expression with all parentheses, which `parse_expression` reads back to the same tree.
std::string expression_text(const SyntaxNode& node);

}  // namespace floatframe
