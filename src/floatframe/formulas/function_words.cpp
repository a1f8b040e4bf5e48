#include "floatframe/formulas/function_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "floatframe/core/number_rule.hpp"

namespace floatframe {
namespace {

/// Constants without a reserved name are hidden by a parameter of the same name.
constexpr std::array<std::pair<const char*, double>, 7> constants{{
    {"pi", std::numbers::pi},
    {"deg", std::numbers::pi / 180.0},
    {"mm", 1e-3},
    {"km_h", 1.0 / 3.6},
    {"rpm", std::numbers::pi / 30.0},
    {"inch", 0.0254},
    {"g0", 9.80665},
}};

bool any_argument(double) { return true; }
bool within_one(double x) { return std::abs(x) <= 1.0; }
double nearer_one(double x) { return x < 0.0 ? -1.0 : 1.0; }
double squared(double x) { return x * x; }

constexpr std::array unary_functions{
    UnaryFunction{"sqrt",
                  [](double x) -> FunctionValue {
                    const double r = std::sqrt(x);
                    return {r, 0.5 / r, -0.25 / (x * r)};
                  },
                  [](double x) { return x >= 0.0; }, [](double) { return 0.0; }},
    UnaryFunction{"sin",
                  [](double x) -> FunctionValue {
                    const double s = std::sin(x);
                    return {s, std::cos(x), -s};
                  },
                  any_argument},
    UnaryFunction{"cos",
                  [](double x) -> FunctionValue {
                    const double c = std::cos(x);
                    return {c, -std::sin(x), -c};
                  },
                  any_argument},
    UnaryFunction{"tan",
                  [](double x) -> FunctionValue {
                    const double t = std::tan(x), d = 1.0 + t * t;
                    return {t, d, 2.0 * t * d};
                  },
                  any_argument},
    UnaryFunction{"asin",
                  [](double x) -> FunctionValue {
                    const double d = 1.0 / std::sqrt(1.0 - x * x);
                    return {std::asin(x), d, x * d * d * d};
                  },
                  within_one, nearer_one},
    UnaryFunction{"acos",
                  [](double x) -> FunctionValue {
                    const double d = 1.0 / std::sqrt(1.0 - x * x);
                    return {std::acos(x), -d, -x * d * d * d};
                  },
                  within_one, nearer_one},
    UnaryFunction{"atan",
                  [](double x) -> FunctionValue {
                    const double d = 1.0 / (1.0 + x * x);
                    return {std::atan(x), d, -2.0 * x * d * d};
                  },
                  any_argument},
    UnaryFunction{"tanh",
                  [](double x) -> FunctionValue {
                    const double t = std::tanh(x), d = 1.0 / squared(std::cosh(x));
                    return {t, d, -2.0 * t * d};
                  },
                  any_argument},
    UnaryFunction{"exp",
                  [](double x) -> FunctionValue {
                    const double e = std::exp(x);
                    return {e, e, e};
                  },
                  any_argument},
    UnaryFunction{"log",
                  [](double x) -> FunctionValue {
                    return {std::log(x), 1.0 / x, -1.0 / (x * x)};
                  },
                  [](double x) { return x > 0.0; }},
    UnaryFunction{"abs",
                  [](double x) -> FunctionValue {
                    return {std::abs(x), x < 0.0 ? -1.0 : 1.0};
                  },
                  any_argument},
    UnaryFunction{"floor", [](double x) -> FunctionValue { return {std::floor(x)}; }, any_argument,
                  nullptr, true},
    UnaryFunction{"ceil", [](double x) -> FunctionValue { return {std::ceil(x)}; }, any_argument,
                  nullptr, true},
    UnaryFunction{"round", [](double x) -> FunctionValue { return {std::round(x)}; }, any_argument,
                  nullptr, true},
};
constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();
constexpr std::array function_words{
    FunctionWord{Function::atan2, "atan2", 2, 2},
    FunctionWord{Function::min, "min", 1, endless},
    FunctionWord{Function::max, "max", 1, endless},
    FunctionWord{Function::if_, "if", 3, 3},
    FunctionWord{Function::clip, "clip", 3, 3},
    FunctionWord{Function::smoothstep, "smoothstep", 5, 5},
    FunctionWord{Function::sign, "sign", 1, 2},
    FunctionWord{Function::chirp, "chirp", 4, 4, true},
    FunctionWord{Function::sum_of_sines, "sum_of_sines", 4, endless, true},
    FunctionWord{Function::noise, "noise", 2, 2, true},
    FunctionWord{Function::table, "table", 2, 2, true},
    FunctionWord{Function::table2, "table2", 3, 3, true},
    FunctionWord{Function::delay, "delay", 2, 2, true}};
constexpr std::array<std::string_view, 6> reserved_words{"pi", "true", "false", "and", "or", "not"};

}  // namespace

std::optional<double> constant_value(std::string_view name) {
  for (const auto& [constant, value] : constants)
    if (name == constant) return value;
  return std::nullopt;
}

std::vector<std::string> constant_names() {
  std::vector<std::string> names;
  for (const auto& [constant, value] : constants) names.emplace_back(constant);
  return names;
}

const UnaryFunction* unary_function(std::string_view name) {
  const auto it = std::find_if(unary_functions.begin(), unary_functions.end(),
                               [&](const UnaryFunction& f) { return name == f.name; });
  return it == unary_functions.end() ? nullptr : &*it;
}

const FunctionWord* function_word(std::string_view name) {
  const auto it = std::find_if(function_words.begin(), function_words.end(),
                               [&](const FunctionWord& f) { return name == f.name; });
  return it == function_words.end() ? nullptr : &*it;
}

bool is_function_name(std::string_view name, bool in_parameters) {
  const FunctionWord* word = function_word(name);
  return unary_function(name) || (word && !(in_parameters && word->formulas_only));
}

std::vector<std::string> function_names(bool in_parameters) {
  std::vector<std::string> names;
  for (const UnaryFunction& f : unary_functions) names.emplace_back(f.name);
  for (const FunctionWord& f : function_words)
    if (!(in_parameters && f.formulas_only)) names.emplace_back(f.name);
  return names;
}

bool is_constant_name(std::string_view name) {
  return constant_value(name) && !is_reserved_name(name);
}

bool is_reserved_name(std::string_view name) {
  return std::find(reserved_words.begin(), reserved_words.end(), name) != reserved_words.end();
}

FunctionValue smoothstep(double x, double x0, double y0, double x1, double y1) noexcept {
  const double w = x1 - x0, s = (x - x0) / w;
  if (s <= 0.0) return {y0};
  if (s >= 1.0) return {y1};
  const double rise = y1 - y0;
  return {y0 + rise * s * s * (3.0 - 2.0 * s), rise * 6.0 * s * (1.0 - s) / w,
          rise * (6.0 - 12.0 * s) / (w * w)};
}

double function_of(Function f, const std::vector<double>& x) {
  switch (f) {
    case Function::atan2:
      return std::atan2(x[0], x[1]);
    case Function::min:
      return *std::min_element(x.begin(), x.end());
    case Function::max:
      return *std::max_element(x.begin(), x.end());
    case Function::clip:
      return std::min(std::max(x[0], x[1]), x[2]);
    case Function::smoothstep:
      return smoothstep(x[0], x[1], x[2], x[3], x[4]).f;
    case Function::sign:
      return x.size() > 1 ? std::tanh(x[0] / x[1]) : x[0] > 0.0 ? 1.0 : x[0] < 0.0 ? -1.0 : 0.0;
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

std::string argument_complaint(const std::string& name, std::size_t fewest, std::size_t most,
                               std::size_t found) {
  if (found >= fewest && found <= most) return "";
  return name + " takes " + (most == endless ? "at least " : "") + std::to_string(fewest) +
         (most > fewest && most != endless ? " or " + std::to_string(most) : "") +
         (fewest == 1 && (most == 1 || most == endless) ? " argument" : " arguments") + ", found " +
         std::to_string(found);
}

std::string constants_complaint(const std::string& name, const std::vector<double>& x) {
  if (name == "clip" && x[1] > x[2])
    return "found the limits " + number_text(x[1]) + " and " + number_text(x[2]) +
           " of clip, expected ascending ones";
  if (name == "smoothstep" && x[1] == x[3])
    return "found x0 = x1 = " + number_text(x[1]) + " of smoothstep, expected two numbers";
  if ((name == "chirp" || name == "noise" || name == "delay") && !(x.back() > 0.0))
    return "found the " +
           std::string(name == "chirp"   ? "duration "
                       : name == "noise" ? "interval "
                                         : "time ") +
           number_text(x.back()) + " of " + name + ", expected a positive number";
  if (name == "sign" && x.size() > 1 && x[1] == 0.0)
    return "found the width 0 of sign, expected another number";
  return "";
}

}  // namespace floatframe
