#pragma once
// Which expression of parameters a number of a description follows from: known at some sets of
// values of the parameters, it must be, bit for bit, one of
//   factor E,   E / c,   c / E,   a + E,   a - E,   (E - a) / c,   (a - E) / c
// for an expression E of the file and constants that fit all of them.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "floatframe/formulas/formula.hpp"

namespace floatframe {

using ParameterNumbers = std::map<std::string, double>;

/// An expression of the file, with its values at the sets.
struct CandidateExpression {
  std::string text;
  SharedFormula formula;
  std::vector<double> values;
};
/// factor x the expression `text`.
struct MatchedNumber {
  std::string text;
  double factor = 1.0;
};

/// Compiled so that it has the bits that `${...}` has. ExpressionError: it is no formula.
SharedFormula parameter_formula(const std::string& text);
/// As it is evaluated from a packed model; not a number where it has no value.
double formula_value(const Formula& formula, const ParameterNumbers& parameters);
/// `text` at all sets; nullopt: it has no value at one of them, or is no formula.
std::optional<CandidateExpression> candidate(const std::string& text,
                                             std::span<const ParameterNumbers> sets);
/// `numbers`: one for each set.
std::optional<MatchedNumber> matched_number(std::span<const CandidateExpression> candidates,
                                            std::span<const double> numbers,
                                            std::span<const ParameterNumbers> sets);

}  // namespace floatframe
