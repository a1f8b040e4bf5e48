#include "floatframe/yaml/expression.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "floatframe/core/suggest.hpp"
#include "floatframe/formulas/function_words.hpp"
#include "floatframe/yaml/expressions_read.hpp"

namespace floatframe {
namespace {

std::string in_quotes(std::string_view s) {
  std::string t(1, '\'');
  t += s;
  t += '\'';
  return t;
}

/// Value of a part of an expression. In a branch that is not needed nothing is computed: only the
/// types of its parts are known, or not even those if they depend on values.
struct Operand {
  ParameterValue value;
  bool computed = true;
  bool typed = true;
};

/// Everything is checked: names, numbers of arguments, types; values are computed only if
/// `needed_`.
class Evaluator {
 public:
  Evaluator(const ParameterScope& scope, bool suggest) : scope_(scope), suggest_(suggest) {}

  Operand of(const SyntaxNode& node) {
    using Kind = SyntaxNode::Kind;
    switch (node.kind) {
      case Kind::number:
        return {node.number};
      case Kind::truth:
        return {node.number != 0.0};
      case Kind::text:
        return {node.word};
      case Kind::name:
        return named(node.word);
      case Kind::chain:
        return chain(node);
      case Kind::power: {
        const double a = number(of(node.parts[0]), "^"), b = number(of(node.parts[1]), "^");
        return result([&] { return std::pow(a, b); });
      }
      case Kind::sign: {
        const double a = number(of(node.parts[0]), node.word);
        return result([&] { return node.word == "-" ? -a : a; });
      }
      case Kind::comparison:
        return comparison(node);
      case Kind::all:
      case Kind::any:
        return junction(node);
      case Kind::negation:
        return truth(!boolean(of(node.parts[0]), "not"));
      case Kind::call:
        return call(node);
    }
    return {};
  }

 private:
  struct NeededScope {  // in its scope, parts are needed only if the condition holds
    NeededScope(bool& n, bool condition) : needed(n), before(n) { needed = needed && condition; }
    ~NeededScope() { needed = before; }
    NeededScope(const NeededScope&) = delete;
    NeededScope& operator=(const NeededScope&) = delete;
    bool& needed;
    bool before;
  };

  Operand truth(bool x) const { return {x, needed_, true}; }
  /// The number returned by `compute`, if it is needed.
  template <class Compute>
  Operand result(Compute compute) const {
    if (!needed_) return {1.0, false, true};
    const double x = compute();
    if (!std::isfinite(x)) throw ExpressionError("the result is not a finite number");
    return {x, true, true};
  }

  Operand junction(const SyntaxNode& node) {
    const bool stops = node.kind == SyntaxNode::Kind::any;
    bool v = boolean(of(node.parts[0]), node.word);
    for (std::size_t k = 1; k < node.parts.size(); ++k) {
      const NeededScope other(needed_, v != stops);
      const bool b = boolean(of(node.parts[k]), node.word);
      v = stops ? b || v : b && v;
    }
    return truth(v);
  }
  Operand comparison(const SyntaxNode& node) {
    const Operand a = of(node.parts[0]), b = of(node.parts[1]);
    const std::string& o = node.word;
    if (a.typed && b.typed && a.value.index() != b.value.index())
      throw ExpressionError("cannot compare " + std::string(type_name(a.value)) + " with " +
                            type_name(b.value));
    if (o == "==") return truth(a.value == b.value);
    if (o == "!=") return truth(a.value != b.value);
    const double x = number(a, o), y = number(b, o);
    return truth(o == "<=" ? x <= y : o == ">=" ? x >= y : o == "<" ? x < y : x > y);
  }
  Operand chain(const SyntaxNode& node) {
    Operand v = of(node.parts[0]);
    for (std::size_t k = 1; k < node.parts.size(); ++k) {
      const char op = node.word[k - 1];
      const double a = number(v, std::string(1, op));
      const double b = number(of(node.parts[k]), std::string(1, op));
      v = result([&] {
        if (op == '/' && b == 0.0) throw ExpressionError("division by zero");
        return op == '+' ? a + b : op == '-' ? a - b : op == '*' ? a * b : a / b;
      });
    }
    return v;
  }
  Operand named(const std::string& name) const {
    const auto it = scope_.find(name);  // a parameter hides a constant of the same name
    if (it != scope_.end()) return {it->second};
    if (const auto value = constant_value(name)) return {*value};
    if (is_function_name(name, true)) throw ExpressionError("unexpected " + in_quotes(name));
    throw ExpressionError("unknown parameter " + in_quotes(name) + suggestion(name));
  }
  std::string suggestion(std::string_view name) const {
    if (!suggest_) return "";
    std::vector<std::string> known;
    for (const auto& [key, value] : scope_) known.push_back(key);
    for (std::string& name_of_constant : constant_names())
      known.push_back(std::move(name_of_constant));
    return did_you_mean(name, known);
  }
  /// The arguments; for an `if` only the branch selected by its condition is needed.
  std::vector<Operand> arguments(const SyntaxNode& node) {
    std::vector<Operand> v;
    bool condition = true;
    for (const SyntaxNode& part : node.parts) {
      const NeededScope chosen(needed_,
                               node.word != "if" || v.empty() || (v.size() == 1) == condition);
      v.push_back(of(part));
      if (v.size() == 1)
        if (const bool* x = std::get_if<bool>(&v[0].value)) condition = *x;
    }
    return v;
  }
  Operand call(const SyntaxNode& node) {
    const std::string& f = node.word;
    const std::vector<Operand> v = arguments(node);
    if (!is_function_name(f, true))
      throw ExpressionError(
          (is_function_name(f) ? "only formulas have the function " : "unknown function ") +
          in_quotes(f) + (suggest_ ? did_you_mean(f, function_names(true)) : ""));
    const UnaryFunction* unary = unary_function(f);
    const FunctionWord* word = function_word(f);
    if (const std::string complaint =
            argument_complaint(f, unary ? 1 : word->fewest, unary ? 1 : word->most, v.size());
        !complaint.empty())
      throw ExpressionError(complaint);
    if (word && word->function == Function::if_) return selected(v);
    std::vector<double> x;
    for (const Operand& operand : v) x.push_back(number(operand, f));
    return result([&] {
      if (!unary) return function_of(word->function, x);
      if (!unary->defined(x[0]))
        throw ExpressionError(f + " of " + number_text(x[0]) + " is not defined");
      return unary->at(x[0]).f;
    });
  }
  Operand selected(const std::vector<Operand>& v) const {
    const bool first = boolean(v[0], "if");
    if (needed_) return v[first ? 1 : 2];
    const bool same = v[1].typed && v[2].typed && v[1].value.index() == v[2].value.index();
    return {v[1].value, false, same};
  }

  static double number(const Operand& v, std::string_view where) {
    if (!v.typed) return 1.0;
    if (const double* x = std::get_if<double>(&v.value)) return *x;
    throw ExpressionError(in_quotes(where) + " needs numbers, found " + describe(v));
  }
  static bool boolean(const Operand& v, std::string_view where) {
    if (!v.typed) return true;
    if (const bool* x = std::get_if<bool>(&v.value)) return *x;
    throw ExpressionError(in_quotes(where) + " needs true or false, found " + describe(v));
  }
  static std::string describe(const Operand& v) {
    if (!v.computed) return type_name(v.value);
    return v.value.index() == 2 ? in_quotes(std::get<std::string>(v.value)) : value_text(v.value);
  }

  const ParameterScope& scope_;
  bool suggest_;
  bool needed_ = true;
};

}  // namespace

std::string value_text(const ParameterValue& value) {
  if (const bool* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  if (const double* x = std::get_if<double>(&value)) return number_text(*x);
  return std::get<std::string>(value);
}

const char* type_name(const ParameterValue& value) {
  constexpr std::array names{"true or false", "a number", "a text"};
  return names[value.index()];
}

ParameterValue evaluate_expression(std::string_view text, const ParameterScope& scope,
                                   bool suggest) {
  return Evaluator(scope, suggest).of(parse_expression(text)).value;
}

ParameterValue substitute_parameters(std::string_view text, const ParameterScope& scope,
                                     bool suggest) {
  std::string result;
  const auto append = [&](std::string_view part) {
    if (part.size() > longest_text - result.size())
      throw ExpressionError("the text is longer than " + std::to_string(longest_text) +
                            " characters");
    result += part;
  };
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = text.find("${", at);
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string_view::npos) throw ExpressionError("a '}' is missing");
    const std::string_view inside = text.substr(open + 2, close - open - 2);
    ParameterValue v = evaluate_expression(inside, scope, suggest);
    if (auto* read = ExpressionsRead::current()) read->evaluated(inside, scope, v);
    if (open == 0 && close + 1 == text.size()) return v;
    append(text.substr(at, open - at));
    append(value_text(v));
    at = close + 1;
  }
  append(text.substr(at));
  return result;
}

}  // namespace floatframe
