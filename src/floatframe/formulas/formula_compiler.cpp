// From syntax trees to formulas.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/formulas/formula.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"

namespace floatframe {
namespace {

enum class Type { number, truth };

std::string in_quotes(const std::string& s) { return "'" + s + "'"; }

void require_constants(const std::string& function, const std::vector<double>& constants) {
  if (const std::string why = constants_complaint(function, constants); !why.empty())
    throw ExpressionError(why);
}

/// Steps of each node after those of its parts.
class Compiler {
 public:
  Compiler(Formula& out, const FormulaTables& tables) : out_(out), tables_(tables) {}

  Type emit(const SyntaxNode& node) {
    switch (node.kind) {
      case Kind::number:
        return constant(node.number);
      case Kind::truth:
        constant(node.number);
        return Type::truth;
      case Kind::text:
        throw ExpressionError("found the text " + in_quotes(node.word) + ", expected a number");
      case Kind::name:
        return name(node);
      case Kind::chain:
        return chain(node);
      case Kind::power:
        return power(node);
      case Kind::sign:
        number(node.parts[0], node.word);
        if (node.word == "-") add(node, FormulaOp::negative, 1);
        return Type::number;
      case Kind::comparison:
        return comparison(node);
      case Kind::all:
      case Kind::any:
        return junction(node);
      case Kind::negation:
        truth(node.parts[0], node.word);
        add(node, FormulaOp::not_, 1);
        return Type::truth;
      case Kind::call:
        return call(node);
    }
    return Type::number;
  }

 private:
  using Kind = SyntaxNode::Kind;
  void add(const SyntaxNode& node, FormulaOp op, int operands, int index = -1, double value = 0.0,
           const UnaryFunction* function = nullptr) {
    depth_ += 1 - operands;
    if (depth_ > Formula::deepest_stack) throw ExpressionError("nested too deeply");
    out_.steps.push_back({op, index, value, function});
    out_.sources.push_back(expression_text(node));
    fold(operands);
  }
  /// Replaces a step of numbers alone by its value, if that is finite.
  void fold(int operands) {
    const auto n = std::ssize(out_.steps);
    const FormulaStep& last = out_.steps.back();
    if (operands < 1 || n <= operands || n - 1 - operands < target_ || last.index >= 0) return;
    const std::string why = fold_last_step(out_, operands);
    // A branch may not be reached.
    if (!why.empty() && branches_ == 0) throw ExpressionError(why);
  }
  Type constant(double value) {
    add({SyntaxNode::Kind::number, value, "", {}}, FormulaOp::number, 0, -1, value);
    return Type::number;
  }
  void number(const SyntaxNode& part, const std::string& where) { need(part, where, Type::number); }
  void truth(const SyntaxNode& part, const std::string& where) { need(part, where, Type::truth); }
  void need(const SyntaxNode& part, const std::string& where, Type type) {
    if (emit(part) != type)
      throw ExpressionError(in_quotes(where) + " needs " +
                            (type == Type::number ? "numbers" : "true or false") + ", found " +
                            in_quotes(expression_text(part)));
  }
  int new_switch() { return out_.switches++; }
  /// A step that decides between pieces.
  void add_switch(const SyntaxNode& node, FormulaOp op, int operands, std::ptrdiff_t first) {
    add(node, op, operands, new_switch());
    add_kink(out_, node.word, first, out_.switches - 1);
  }

  /// If the steps from `first` on are one number that no jump leaves out: it, without the step.
  std::optional<double> take_number(std::ptrdiff_t first) {
    if (std::ssize(out_.steps) != first + 1 || out_.steps.back().op != FormulaOp::number ||
        first < target_)
      return std::nullopt;
    const double value = out_.steps.back().number;
    out_.steps.pop_back();
    out_.sources.pop_back();
    --depth_;
    return value;
  }
  /// A number on either side of + and *, or behind -, is a part of the step.
  Type chain(const SyntaxNode& node) {
    const auto first = std::ssize(out_.steps);
    number(node.parts[0], std::string(1, node.word[0]));
    for (std::size_t k = 1; k < node.parts.size(); ++k) {
      const char op = node.word[k - 1];
      auto side = op == '*' || op == '+' ? take_number(first) : std::nullopt;
      const auto second = std::ssize(out_.steps);
      number(node.parts[k], std::string(1, op));
      if (side) {
        if (const auto other = take_number(second)) {  // to be folded
          constant(*side);
          constant(*other);
          side.reset();
        }
      } else if (op != '/' && out_.steps[second - 1].op != FormulaOp::number) {
        side = take_number(second);
        if (side && op == '-') side = -*side;
      }
      SyntaxNode part{SyntaxNode::Kind::chain,
                      0.0,
                      node.word.substr(0, k),
                      {node.parts.begin(), node.parts.begin() + k + 1}};
      if (side)
        add(part, op == '*' ? FormulaOp::multiply_number : FormulaOp::add_number, 1, -1, *side);
      else
        add(part,
            op == '+'   ? FormulaOp::add
            : op == '-' ? FormulaOp::subtract
            : op == '*' ? FormulaOp::multiply
                        : FormulaOp::divide,
            2);
    }
    return Type::number;
  }
  Type power(const SyntaxNode& node) {
    number(node.parts[0], "^");
    const auto before = std::ssize(out_.steps);
    number(node.parts[1], "^");
    const auto n = take_number(before);
    const bool small = n && *n >= 2.0 && *n <= Formula::small_exponent && *n == std::floor(*n);
    if (n)
      add(node, small ? FormulaOp::small_power : FormulaOp::power_of_number, 1, -1, *n);
    else
      add(node, FormulaOp::power, 2);
    return Type::number;
  }
  Type comparison(const SyntaxNode& node) {
    const std::string& o = node.word;
    const auto start = std::ssize(out_.steps);
    const bool turned = o == ">" || o == ">=", equality = o == "==" || o == "!=";
    const Type first = emit(node.parts[turned ? 1 : 0]);
    const Type second = emit(node.parts[turned ? 0 : 1]);
    if (first != second || (first == Type::truth && !equality))
      throw ExpressionError("cannot compare the operands of " + in_quotes(o) + " in " +
                            in_quotes(expression_text(node)));
    if (equality) {
      add(node, FormulaOp::equal, 2);
      add_kink(out_, o, start);
      if (o == "!=") add(node, FormulaOp::not_, 1);
    } else {
      const bool strict = o == "<" || o == ">";
      add_switch(node, strict ? FormulaOp::less : FormulaOp::less_equal, 2, start);
    }
    return Type::truth;
  }
  /// A jump whose target is set by `arrive`. What stands behind it begins without the condition, or
  /// without the result of the branch that has jumped.
  std::size_t leap(const SyntaxNode& node, FormulaOp op) {
    add(node, op, 2, 0);
    return out_.steps.size() - 1;
  }
  void arrive(std::size_t from) { out_.steps[from].index = target_ = std::ssize(out_.steps); }
  /// The parts in order, until one decides: b and c is if(b, c, false).
  Type junction(const SyntaxNode& node) {
    const bool any = node.kind == SyntaxNode::Kind::any;
    std::vector<std::size_t> decided;
    for (std::size_t k = 0; k + 1 < node.parts.size(); ++k) {
      truth(node.parts[k], node.word);
      if (any) add(node.parts[k], FormulaOp::not_, 1);
      decided.push_back(leap(node, FormulaOp::jump_unless));
      ++branches_;
    }
    truth(node.parts.back(), node.word);
    branches_ -= std::ssize(decided);
    const std::size_t over = leap(node, FormulaOp::jump);
    for (const std::size_t from : decided) arrive(from);
    constant(any ? 1.0 : 0.0);
    arrive(over);
    return Type::truth;
  }
  Type selection(const SyntaxNode& node) {
    truth(node.parts[0], "if");
    const std::size_t unless = leap(node, FormulaOp::jump_unless);
    ++branches_;
    const Type type = emit(node.parts[1]);
    const std::size_t over = leap(node, FormulaOp::jump);
    arrive(unless);
    if (emit(node.parts[2]) != type)
      throw ExpressionError("found a number and a condition as the results of " +
                            in_quotes(expression_text(node)) + ", expected the same kind");
    --branches_;
    arrive(over);
    return type;
  }

  Type name(const SyntaxNode& node) {
    if (const auto value = constant_value(node.word)) return constant(*value);
    return reference(node, {"", node.word == "time" ? "t" : node.word, ""});
  }
  Type reference(const SyntaxNode& node, const FormulaReference& r) {
    const auto it = std::find(out_.references.begin(), out_.references.end(), r);
    const auto index = it - out_.references.begin();
    if (it == out_.references.end()) out_.references.push_back(r);
    add(node, FormulaOp::reference, 0, index);
    return Type::number;
  }

  Type call(const SyntaxNode& node) {
    const std::string& f = node.word;
    const UnaryFunction* unary = unary_function(f);
    const FunctionWord* word = function_word(f);
    if (!unary && !word) return measure(node);
    if (const std::string complaint = argument_complaint(f, unary ? 1 : word->fewest,
                                                         unary ? 1 : word->most, node.parts.size());
        !complaint.empty())
      throw ExpressionError(complaint);
    if (unary) {
      const auto start = std::ssize(out_.steps);
      number(node.parts[0], f);
      f == "abs"
          ? add_switch(node, FormulaOp::abs, 1, start)
          : add(node, unary->jumps ? FormulaOp::stairs : FormulaOp::unary, 1, -1, 0.0, unary);
      if (unary->jumps) add_kink(out_, f, start);
      return Type::number;
    }
    return function(node, word->function);
  }
  /// `angle(arm)`, `rotation(body, yaw)`, `force('front-left')`
  Type measure(const SyntaxNode& node) {
    const auto word_of = [&](const SyntaxNode& part) -> std::string {
      if (part.kind == Kind::name || part.kind == Kind::text) return part.word;
      if (part.kind == Kind::number) return number_text(part.number);
      throw ExpressionError("found " + in_quotes(expression_text(part)) + " in " +
                            in_quotes(node.word) + ", expected a name");
    };
    if (node.parts.empty() || node.parts.size() > 2)
      throw ExpressionError(argument_complaint(node.word, 1, 2, node.parts.size()));
    return reference(node, {node.word, word_of(node.parts[0]),
                            node.parts.size() > 1 ? word_of(node.parts[1]) : ""});
  }
  Type of_numbers(const SyntaxNode& node, FormulaOp op, bool switches = false) {
    const auto start = std::ssize(out_.steps);
    std::vector<double> constants;  // NaN: of another part
    for (const SyntaxNode& part : node.parts) {
      const auto before = std::ssize(out_.steps);
      number(part, node.word);
      const auto value = take_number(before);
      constants.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
      if (value) constant(*value);
    }
    require_constants(node.word, constants);
    switches ? add_switch(node, op, std::ssize(node.parts), start)
             : add(node, op, std::ssize(node.parts));
    return Type::number;
  }
  /// A part that is the same number at any time.
  double constant_part(const SyntaxNode& part, const std::string& where) {
    const auto before = std::ssize(out_.steps);
    number(part, where);
    if (const auto value = take_number(before)) return *value;
    throw ExpressionError("found " + in_quotes(expression_text(part)) + " in " + in_quotes(where) +
                          ", expected a constant number");
  }

  Type function(const SyntaxNode& node, Function f) {
    switch (f) {
      case Function::if_:
        return selection(node);
      case Function::min:
      case Function::max:
        return least_or_most(node, f == Function::min ? FormulaOp::min : FormulaOp::max);
      case Function::atan2:
        return of_numbers(node, FormulaOp::atan2);
      case Function::clip:
        return of_numbers(node, FormulaOp::clip, true);
      case Function::smoothstep:
        return of_numbers(node, FormulaOp::smoothstep);
      case Function::sign:
        return node.parts.size() > 1 ? of_numbers(node, FormulaOp::smooth_sign)
                                     : of_numbers(node, FormulaOp::sign, true);
      case Function::chirp:
        number(node.parts[0], node.word);
        for (std::size_t k = 1; k < 4; ++k) constant(constant_part(node.parts[k], node.word));
        require_constants(node.word, {0.0, 0.0, 0.0, out_.steps.back().number});
        add(node, FormulaOp::chirp, 4);
        return Type::number;
      case Function::sum_of_sines:
        return sines(node);
      case Function::noise:
        return noise(node);
      case Function::table:
      case Function::table2:
        return table(node, f == Function::table2);
      case Function::delay:
        return delay(node);
    }
    return Type::number;
  }
  Type least_or_most(const SyntaxNode& node, FormulaOp op) {
    const auto start = std::ssize(out_.steps);
    number(node.parts[0], node.word);
    for (std::size_t k = 1; k < node.parts.size(); ++k) {
      number(node.parts[k], node.word);
      add_switch(node, op, 2, start);
    }
    return Type::number;
  }
  /// sum a sin(2 pi f x + p) of sum_of_sines(x, a, f, p, a, f, p, ...)
  Type sines(const SyntaxNode& node) {
    if (node.parts.size() % 3 != 1)
      throw ExpressionError("found " + std::to_string(node.parts.size()) +
                            " arguments of sum_of_sines, expected x and amplitude, frequency, "
                            "phase of each sine");
    for (std::size_t k = 1; k < node.parts.size(); k += 3) {
      const double a = constant_part(node.parts[k], node.word),
                   f = constant_part(node.parts[k + 1], node.word),
                   p = constant_part(node.parts[k + 2], node.word);
      number(node.parts[0], node.word);
      add(node, FormulaOp::multiply_number, 1, -1, 2.0 * std::numbers::pi * f);
      add(node, FormulaOp::add_number, 1, -1, p);
      add(node, FormulaOp::unary, 1, -1, 0.0, unary_function("sin"));
      add(node, FormulaOp::multiply_number, 1, -1, a);
      if (k > 1) add(node, FormulaOp::add, 2);
    }
    return Type::number;
  }
  Type noise(const SyntaxNode& node) {
    const double seed = constant_part(node.parts[0], node.word),
                 dt = constant_part(node.parts[1], node.word);
    require_constants(node.word, {seed, dt});
    reference(node, {"", "t", ""});
    constant(dt);
    add(node, FormulaOp::divide, 2);
    add(node, FormulaOp::noise, 1, -1, seed);
    return Type::number;
  }
  /// A value of the model, which keeps the past of another formula.
  Type delay(const SyntaxNode& node) {
    const double time = constant_part(node.parts[1], node.word);
    require_constants(node.word, {time});
    return reference(node, {node.word, expression_text(node.parts[0]), number_text(time),
                            compile_formula(node.parts[0], tables_, out_.mirror), time});
  }
  Type table(const SyntaxNode& node, bool grid) {
    const SyntaxNode& first = node.parts[0];
    if (first.kind != Kind::name && first.kind != Kind::text)
      throw ExpressionError("found " + in_quotes(expression_text(first)) + " in " +
                            in_quotes(node.word) + ", expected the name of a table");
    const int index = used_table(out_, first.word, grid, tables_);
    const auto start = std::ssize(out_.steps);
    for (std::size_t k = 1; k < node.parts.size(); ++k) number(node.parts[k], node.word);
    if (grid || !out_.curves[index]->edges().empty()) add_kink(out_, node.word, start);
    add(node, grid ? FormulaOp::grid : FormulaOp::curve, grid ? 2 : 1, index);
    return Type::number;
  }

  Formula& out_;
  const FormulaTables& tables_;
  int depth_ = 0;
  int branches_ = 0;           ///< around, which may not be reached
  std::ptrdiff_t target_ = 0;  ///< steps before are not folded: a jump ends here
};

}  // namespace

SharedFormula compile_formula(const SyntaxNode& tree, const FormulaTables& tables,
                              const FormulaMirror& mirror) {
  auto out = std::make_shared<Formula>();
  out->mirror = mirror;
  out->text = expression_text(tree);
  if (Compiler(*out, tables).emit(tree) != Type::number)
    throw ExpressionError("found a condition, expected a number: if(condition, a, b) chooses one");
  return out;
}

}  // namespace floatframe
