#include "floatframe/description/simulation_option.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/description/rules.hpp"
#include "floatframe/formulas/syntax_tree.hpp"

namespace floatframe {
namespace {

std::string found(const std::string& value, const std::string& expected) {
  return fmt::format("found '{}', expected {}", value, expected);
}

template <class E>
std::string choose(E& field, const std::string& value, const char* first, const char* second) {
  if (value != first && value != second)
    return found(value, fmt::format("{} or {}", first, second));
  field = static_cast<E>(value == second ? 1 : 0);
  return "";
}

}  // namespace

const std::vector<SimulationNumber>& simulation_numbers() {
  using S = SimulationDescription;
  static const std::vector<SimulationNumber> numbers{
      {"step", &S::step, rules::step},
      {"duration", &S::duration, rules::duration},
      {"output_interval", &S::output_interval, rules::output_interval},
      {"spectral_radius", &S::spectral_radius, rules::spectral_radius},
      {"tolerance", &S::tolerance, rules::tolerance},
      {"min_step", &S::min_step, rules::min_step},
      {"penalty", &S::penalty, rules::penalty},
      {"position_tolerance", &S::position_tolerance, rules::position_tolerance},
      {"velocity_tolerance", &S::velocity_tolerance, rules::velocity_tolerance}};
  return numbers;
}

const std::vector<std::string>& simulation_option_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> n{"coordinates",    "inertia",      "start",
                               "max_iterations", "locate_edges", "input"};
    for (const SimulationNumber& o : simulation_numbers()) n.emplace_back(o.name);
    return n;
  }();
  return names;
}

std::string set_simulation_option(SimulationDescription& s, const std::string& name,
                                  const std::string& value) {
  if (name == "coordinates") return choose(s.coordinates, value, "relative", "absolute");
  if (name == "inertia") return choose(s.inertia, value, "preprocessing", "projection");
  if (name == "input") return choose(s.input, value, "held", "ramp");
  if (name == "start") return choose(s.start, value, "given", "equilibrium");
  const PlainScalar scalar = classify_plain_scalar(value);
  if (name == "locate_edges") {
    if (scalar.kind != PlainScalar::Kind::boolean) return found(value, "true or false");
    s.locate_edges = scalar.boolean;
    return "";
  }
  const bool is_number = scalar.kind == PlainScalar::Kind::number;
  if (name == "max_iterations") {
    if (!is_number || scalar.number < 1 || scalar.number > 1000 ||
        scalar.number != std::floor(scalar.number))
      return found(value, "a number of iterations from 1 to 1000");
    s.max_iterations = static_cast<int>(scalar.number);
    return "";
  }
  for (const SimulationNumber& o : simulation_numbers())
    if (name == o.name) {
      if (!is_number || !o.rule.holds(scalar.number)) return found(value, o.rule.expectation());
      s.*o.at = scalar.number;
      s.given_by("", o.name);
      return "";
    }
  return fmt::format("unknown option '{}'", name);
}

std::string simulation_error(const SimulationDescription& s) {
  constexpr double most_steps = 1e9;
  if (s.duration > most_steps * s.step)
    return fmt::format("a duration of {:g} s with a step of {:g} s takes more than {:g} steps",
                       s.duration, s.step, most_steps);
  if (s.min_step > s.step)
    return fmt::format("found a smallest substep of {:g} s, expected at most the step, {:g} s",
                       s.min_step, s.step);
  return "";
}

}  // namespace floatframe
