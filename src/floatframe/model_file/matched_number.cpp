#include "floatframe/model_file/matched_number.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"

namespace floatframe {
namespace {

using Numbers = std::span<const double>;

bool fits(const std::vector<double>& e, Numbers y, const std::function<double(double)>& form) {
  for (std::size_t k = 0; k < y.size(); ++k)
    if (form(e[k]) != y[k]) return false;
  return true;
}

/// A constant that is known but for rounding: numbers of few digits first, then those around.
std::vector<double> around(double x) {
  std::vector<double> out;
  if (!std::isfinite(x)) return out;
  char text[40];
  for (const int digits : {6, 12}) {
    std::snprintf(text, sizeof text, "%.*g", digits, x);
    out.push_back(std::strtod(text, nullptr));
  }
  out.push_back(x);
  double low = x, high = x;
  for (int k = 0; k < 3; ++k) {
    out.push_back(low = std::nextafter(low, -HUGE_VAL));
    out.push_back(high = std::nextafter(high, HUGE_VAL));
  }
  return out;
}

std::string text_of(const char* before, const std::string& e, const char* operation,
                    double constant) {
  return before + e + operation + number_text(constant) + ")";
}

std::optional<MatchedNumber> as_product(const CandidateExpression& c, Numbers y) {
  for (const double factor : around(y[0] / c.values[0]))
    if (factor != 0.0 && fits(c.values, y, [&](double e) { return factor * e; }))
      return MatchedNumber{c.text, factor};
  return std::nullopt;
}

/// (E - a) / c and (a - E) / c.
std::optional<std::string> as_slope(const CandidateExpression& c, Numbers y) {
  const std::vector<double>& e = c.values;
  const double slope = (e[1] - e[0]) / (y[1] - y[0]);
  const bool down = slope < 0.0;
  for (const double width : around(std::abs(slope))) {
    if (!(width > 0.0)) continue;
    for (const double a : around(down ? e[0] + width * y[0] : e[0] - width * y[0])) {
      if (!down && fits(e, y, [&](double x) { return (x - a) / width; }))
        return text_of("((", c.text, " - ", a) + " / " + number_text(width) + ")";
      if (down && fits(e, y, [&](double x) { return (a - x) / width; }))
        return "((" + number_text(a) + " - " + c.text + ") / " + number_text(width) + ")";
    }
  }
  return std::nullopt;
}

std::optional<std::string> as_other(const CandidateExpression& c, Numbers y) {
  const std::vector<double>& e = c.values;
  for (const double a : around(e[0] / y[0]))
    if (a != 0.0 && fits(e, y, [&](double x) { return x / a; }))
      return text_of("(", c.text, " / ", a);
  for (const double a : around(e[0] * y[0]))
    if (a != 0.0 && fits(e, y, [&](double x) { return a / x; }))
      return "(" + number_text(a) + " / " + c.text + ")";
  for (const double a : around(y[0] - e[0]))
    if (fits(e, y, [&](double x) { return a + x; })) return text_of("(", c.text, " + ", a);
  for (const double a : around(y[0] + e[0]))
    if (fits(e, y, [&](double x) { return a - x; }))
      return "(" + number_text(a) + " - " + c.text + ")";
  return as_slope(c, y);
}

}  // namespace

SharedFormula parameter_formula(const std::string& text) {
  Formula f = *compile_formula(parse_expression(text));
  for (FormulaStep& step : f.steps)  // `${x^3}` is a power, not a product
    if (step.op == FormulaOp::small_power) step.op = FormulaOp::power_of_number;
  return std::make_shared<const Formula>(std::move(f));
}

double formula_value(const Formula& f, const ParameterNumbers& parameters) {
  FormulaSwitches switches;
  FormulaFault fault;
  return evaluate_formula<double>(
      f, [&](int k) { return parameters.at(f.references[k].name); }, switches, fault);
}

std::optional<CandidateExpression> candidate(const std::string& text,
                                             std::span<const ParameterNumbers> sets) {
  CandidateExpression out{text, nullptr, {}};
  try {
    out.formula = parameter_formula(text);
  } catch (const ExpressionError&) {
    return std::nullopt;
  }
  for (const FormulaReference& r : out.formula->references)
    if (!r.function.empty()) return std::nullopt;
  for (const ParameterNumbers& set : sets) {
    out.values.push_back(formula_value(*out.formula, set));
    if (!std::isfinite(out.values.back())) return std::nullopt;
  }
  return out;
}

std::optional<MatchedNumber> matched_number(std::span<const CandidateExpression> candidates,
                                            Numbers y, std::span<const ParameterNumbers> sets) {
  for (const double factor : {1.0, -1.0})
    for (const CandidateExpression& c : candidates)
      if (fits(c.values, y, [&](double e) { return factor * e; }))
        return MatchedNumber{c.text, factor};
  for (const CandidateExpression& c : candidates)
    if (auto match = as_product(c, y)) return match;
  for (const CandidateExpression& c : candidates)
    if (const auto text = as_other(c, y))
      if (const auto form = candidate(*text, sets))  // as it is evaluated later
        if (fits(form->values, y, [](double e) { return e; })) return MatchedNumber{*text, 1.0};
  return std::nullopt;
}

}  // namespace floatframe
