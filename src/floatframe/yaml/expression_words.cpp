#include "floatframe/yaml/expression_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "floatframe/yaml/expression.hpp"

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

constexpr std::array unary_functions{
    UnaryFunction{"sqrt", [](double x) { return std::sqrt(x); }, [](double x) { return x >= 0.0; }},
    UnaryFunction{"sin", [](double x) { return std::sin(x); }, any_argument},
    UnaryFunction{"cos", [](double x) { return std::cos(x); }, any_argument},
    UnaryFunction{"tan", [](double x) { return std::tan(x); }, any_argument},
    UnaryFunction{"asin", [](double x) { return std::asin(x); }, within_one},
    UnaryFunction{"acos", [](double x) { return std::acos(x); }, within_one},
    UnaryFunction{"atan", [](double x) { return std::atan(x); }, any_argument},
    UnaryFunction{"exp", [](double x) { return std::exp(x); }, any_argument},
    UnaryFunction{"log", [](double x) { return std::log(x); }, [](double x) { return x > 0.0; }},
    UnaryFunction{"abs", [](double x) { return std::abs(x); }, any_argument},
    UnaryFunction{"floor", [](double x) { return std::floor(x); }, any_argument},
    UnaryFunction{"ceil", [](double x) { return std::ceil(x); }, any_argument},
    UnaryFunction{"round", [](double x) { return std::round(x); }, any_argument},
};
constexpr std::array<std::string_view, 4> other_functions{"atan2", "min", "max", "if"};
constexpr std::array<std::string_view, 6> other_words{"pi", "true", "false", "and", "or", "not"};

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

bool is_function_name(std::string_view name) {
  return unary_function(name) ||
         std::find(other_functions.begin(), other_functions.end(), name) != other_functions.end();
}

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const UnaryFunction& f : unary_functions) names.emplace_back(f.name);
  names.insert(names.end(), other_functions.begin(), other_functions.end());
  return names;
}

bool is_constant_name(std::string_view name) {
  return constant_value(name) && !is_reserved_name(name);
}

bool is_reserved_name(std::string_view name) {
  return is_function_name(name) ||
         std::find(other_words.begin(), other_words.end(), name) != other_words.end();
}

}  // namespace floatframe
