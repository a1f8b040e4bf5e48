#pragma once
// A formula of a model: a text that is compiled once, by `compile_formula`, and evaluated in steps
// over double, dual numbers or functions of time. Immutable, shared by
// threads.
//   language     that of expressions in model files, with more functions
//   references   t, the time; names and functions that are no part of the language: to be
//                connected by the model: `tip.z`, `angle(arm)`, `rotation(body, yaw)`
//   switches     where a comparison, clip, min, max, abs or sign changes from one smooth piece to
//                another: they can be held, so that a step ends at their edges
// It is a stack machine: each step takes its operands from the top of the stack and leaves one.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/formulas/syntax_tree.hpp"
#include "floatframe/math/piecewise_polynomial.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// A table of two variables on a grid: bilinear between its points, its end values beyond.
struct GridTable {
  VecX x, y;    ///< ascending, at least two each
  MatX values;  ///< [x][y]
};
/// The tables of formulas by name.
struct FormulaTables {
  std::map<std::string, std::shared_ptr<const PiecewisePolynomial>> curves;
  std::map<std::string, std::shared_ptr<const GridTable>> grids;
};

struct Formula;
using SharedFormula = std::shared_ptr<const Formula>;

/// What a formula reads of its model.
struct FormulaReference {
  std::string function;  ///< empty: a name alone
  std::string name;      ///< `t` for the time; of a delay the text of what it delays
  std::string detail;    ///< second argument: a word, a number of a coordinate, the time of a delay
  SharedFormula delayed = nullptr;  ///< of a delay: the formula whose value at t - delay it is
  double delay = 0.0;               ///< [s]
  bool is_time() const noexcept { return function.empty() && (name == "t" || name == "time"); }
  bool operator==(const FormulaReference& other) const noexcept {
    return function == other.function && name == other.name && detail == other.detail;
  }
};

enum class FormulaOp : std::uint8_t {
  number,
  reference,
  add,
  subtract,
  multiply,
  add_number,       ///< `number`
  multiply_number,  ///< the same
  divide,
  power,
  stairs,           ///< a unary function that jumps
  power_of_number,  ///< exponent: `number`
  small_power,      ///< the same, of 2, 3, ... `Formula::small_exponent`
  negative,
  unary,
  atan2,
  min,
  max,
  abs,
  sign,
  smooth_sign,
  clip,
  smoothstep,
  chirp,
  noise,
  curve,
  grid,
  less,
  less_equal,
  equal,
  not_,
  jump,
  jump_unless  ///< takes the condition
};

/// The mirror of the subsystem that a formula is written in: x' = P x + t, P diagonal. References
/// have the values of the subsystem that is not mirrored.
struct FormulaMirror {
  Vec3 P = Vec3::Ones(), t = Vec3::Zero();
};

struct UnaryFunction;

struct FormulaStep {
  FormulaOp op = FormulaOp::number;
  int index = -1;  ///< reference, table, target of a jump, or the switch
  double number = 0.0;
  const UnaryFunction* function = nullptr;
};

/// Where a formula has a corner or jumps.
struct FormulaKink {
  std::string word;             ///< "clip", "<", "floor", "table"
  int held = -1;                ///< its switch, if that can be held
  std::vector<int> references;  ///< that its place depends on
  /// Of a function of time its instant is found (`piece_change`).
  bool between_pieces() const noexcept {
    return word != "==" && word != "!=" && word != "table" && word != "table2";
  }
};

struct Formula {
  std::string text;  ///< with all parentheses
  std::vector<FormulaStep> steps;
  std::vector<std::string> sources;  ///< the text of each step, for messages
  std::vector<FormulaReference> references;
  FormulaMirror mirror;
  std::vector<std::shared_ptr<const PiecewisePolynomial>> curves;
  std::vector<std::shared_ptr<const GridTable>> grids;
  int switches = 0;
  std::vector<FormulaKink> kinks;  ///< that something moves across

  static constexpr int deepest_stack = 32;
  static constexpr int small_exponent = 8;
  static constexpr int most_switches = 31;  ///< that can be held
  /// It depends on nothing but the time.
  bool is_of_time() const noexcept;
};

/// Of the last step, whose operands are the steps from `first` on.
void add_kink(Formula& f, const std::string& word, std::ptrdiff_t first, int a_switch = -1);
/// The value differs on both sides of this kink, where the numbers that it depends on are equal and
/// the others are any.
bool jumps_at(const Formula& f, const FormulaKink& kink) noexcept;

/// Replaces the last step and its operands by its value, if these are numbers. Returns why it has
/// none.
std::string fold_last_step(Formula& f, int operands);

/// The place of a table, a grid or a curve, among those that a formula uses from now on. Throws
/// ExpressionError.
int used_table(Formula& f, const std::string& name, bool grid, const FormulaTables& tables);
/// Throws ExpressionError. Its value is a number.
SharedFormula compile_formula(const SyntaxNode& tree, const FormulaTables& tables = {},
                              const FormulaMirror& mirror = {});
/// The same from a text: InputError.
SharedFormula formula(std::string_view text, const FormulaTables& tables = {});

}  // namespace floatframe
