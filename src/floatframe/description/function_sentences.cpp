// Sentences about laws and functions of time.
#include <fmt/format.h>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/math/piecewise_build.hpp"

namespace floatframe::sentences {

std::optional<std::pair<std::size_t, std::string>> jump(const PiecewisePolynomial& f) {
  const JumpReport r = largest_jump(f);
  if (r.continuous()) return std::nullopt;
  const double x = f.breaks()[r.at];
  return std::make_pair(r.at, "the law jumps from " + number_text(f.piece_value(r.at, x).f) +
                                  " to " + number_text(f.piece_value(r.at + 1, x).f) + " at " +
                                  number_text(x) +
                                  ", expected pieces that meet within 1e-6 of the range of the "
                                  "law");
}

Complaint period(const TimeFunction& f, bool may_jump) {
  const std::vector<double>& b = f.pieces.breaks();
  if (b.empty()) return "found a period without a table or steps that repeat";
  const double width = b.back() - b.front();
  if (width > f.period && !fills_period(b.front(), b.back(), f.period))
    return "found " + number_text(f.period) + ", expected at least the " + number_text(width) +
           " s from the first time to the last one";
  if (may_jump) return std::nullopt;
  const JumpReport jump = largest_jump(
      repeated(f.pieces, f.period, b.front(), b.front() + 1.5 * f.period, 3 * b.size()));
  if (jump.continuous()) return std::nullopt;
  return "found the last value " + number_text(f.pieces(b.back()).f) + " and the first value " +
         number_text(f.pieces(b.front()).f) + ", expected equal ones: a motion cannot jump";
}

std::string missing_formula() { return "found no formula, expected one"; }

std::string formula_jumps(double by, double at) {
  return fmt::format(
      "found a jump by {:.6g} at t = {:.9g} s, expected a function without jumps: a motion cannot "
      "jump",
      by, at);
}

std::string formula_not_of_time(const Formula& formula) {
  for (const FormulaReference& r : formula.references)
    if (!r.is_time())
      return "found '" + (r.function.empty() ? r.name : r.function + "(" + r.name + ")") +
             "' in the formula of a motion, expected the time t alone";
  return "";
}

std::string formula_and_source(SignalSource source) {
  return std::string("excludes '") + signal_source_words[index_of(source)] +
         "'; a formula may refer to it";
}

std::string formula_name(const std::string& name) {
  return "found '" + name + "', expected t or the name of an input, a measure or an output";
}

std::string formula_function(const std::string& name) {
  return "found the function '" + name +
         "', expected one of the language, `angle`, `rate` or the word of an output";
}

std::string no_such_entity(const std::string& function, const char* kind, const std::string& name) {
  return "found " + function + "(" + name + "), expected the name of a " + kind;
}

std::string rate_of_two(const std::string& name) {
  return "found rate(" + name + ") of a joint and a force of this name, expected joint_velocity(" +
         name + ") or a measure {rate: " + name + "}";
}

std::string named_measures_only(const std::string& function) {
  return "found the function '" + function +
         "', expected the name of an entry of 'measures' or "
         "'outputs' with this quantity";
}

std::string formula_component(const std::string& function, const std::string& found,
                              std::span<const char* const> words) {
  return (found.empty() ? "found no second argument of " : "found '" + found + "' in ") + function +
         ", expected one of " + alternatives(words);
}

std::string one_argument(const std::string& function) {
  return "found two arguments of " + function + ", expected one";
}

std::string formula_coordinate(const std::string& joint, const std::string& found, int count) {
  if (count == 0) return "found joint '" + joint + "', expected one that moves";
  return (found.empty() ? "found no coordinate" : "found the coordinate '" + found + "'") +
         " of joint '" + joint + "', expected its number from 1 to " + std::to_string(count);
}

std::string formula_of_a_formula(const std::string& name) {
  return "found '" + name +
         "', an output with a formula; expected a controller of type formula, "
         "which formulas may refer to";
}

std::string off_the_mirror(const std::string& name) {
  return "found '" + name +
         "' about the origin of the world, which is not on the mirror of the subsystem, expected "
         "one about a point or relative to a body";
}

std::string formula_of_law(const std::string& name) {
  return "found '" + name + "', expected x, v, t, numbers and parameters in the formula of a law";
}

}  // namespace floatframe::sentences
