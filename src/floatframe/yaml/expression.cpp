#include "floatframe/yaml/expression.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "floatframe/core/ascii.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/yaml/expression_words.hpp"

namespace floatframe {
namespace {

constexpr int deepest_expression = 100;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

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

/// Recursive descent; one function per level of precedence. Everything is read and checked: syntax,
/// names, numbers of arguments, types; values are computed only if `needed_`.
class Parser {
 public:
  Parser(std::string_view text, const ParameterScope& scope, bool suggest)
      : text_(text), scope_(scope), suggest_(suggest) {}

  ParameterValue whole() {
    skip_blanks();
    if (at_ == text_.size()) throw ExpressionError("the expression is empty");
    Operand v = disjunction();
    skip_blanks();
    if (at_ != text_.size()) throw ExpressionError("unexpected " + here());
    return std::move(v.value);
  }

 private:
  struct DepthGuard {  // bounds the recursion for any text
    explicit DepthGuard(int& d) : depth(d) {
      if (++depth > deepest_expression) throw ExpressionError("nested too deeply");
    }
    ~DepthGuard() { --depth; }
    int& depth;
  };
  struct NeededScope {  // in its scope, parts read are needed only if the condition holds
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

  Operand disjunction() {
    Operand v = conjunction();
    while (word("or")) {
      const bool a = boolean(v, "or");
      const NeededScope other(needed_, !a);
      v = truth(boolean(conjunction(), "or") || a);
    }
    return v;
  }
  Operand conjunction() {
    Operand v = negation();
    while (word("and")) {
      const bool a = boolean(v, "and");
      const NeededScope other(needed_, a);
      v = truth(boolean(negation(), "and") && a);
    }
    return v;
  }
  Operand negation() {
    const DepthGuard deeper(depth_);
    if (word("not")) return truth(!boolean(negation(), "not"));
    return comparison();
  }
  Operand comparison() {
    const Operand a = sum();
    for (const char* op : {"==", "!=", "<=", ">=", "<", ">"}) {
      if (!symbol(op)) continue;
      const Operand b = sum();
      const std::string o = op;
      if (a.typed && b.typed && a.value.index() != b.value.index())
        throw ExpressionError("cannot compare " + std::string(type_name(a.value)) + " with " +
                              type_name(b.value));
      if (o == "==") return truth(a.value == b.value);
      if (o == "!=") return truth(a.value != b.value);
      const double x = number(a, op), y = number(b, op);
      return truth(o == "<=" ? x <= y : o == ">=" ? x >= y : o == "<" ? x < y : x > y);
    }
    return a;
  }
  /// Operands of one level with operators between them, from left to right.
  template <class Compute>
  Operand chain(const char* first, const char* second, Operand (Parser::*next)(), Compute compute) {
    Operand v = (this->*next)();
    for (;;) {
      const char* op = symbol(first) ? first : symbol(second) ? second : nullptr;
      if (op == nullptr) return v;
      const double a = number(v, op), b = number((this->*next)(), op);
      v = result([&] { return compute(op == first, a, b); });
    }
  }
  Operand sum() {
    return chain("+", "-", &Parser::product,
                 [](bool plus, double a, double b) { return plus ? a + b : a - b; });
  }
  Operand product() {
    return chain("*", "/", &Parser::sign, [](bool times, double a, double b) {
      if (!times && b == 0.0) throw ExpressionError("division by zero");
      return times ? a * b : a / b;
    });
  }
  Operand sign() {
    const DepthGuard deeper(depth_);
    for (const char* op : {"-", "+"})
      if (symbol(op)) {
        const double a = number(sign(), op);
        return result([&] { return *op == '-' ? -a : a; });
      }
    return power();
  }
  Operand power() {
    Operand v = primary();
    if (!symbol("^")) return v;
    const double a = number(v, "^"), b = number(sign(), "^");
    return result([&] { return std::pow(a, b); });
  }
  Operand primary() {
    skip_blanks();
    if (at_ == text_.size()) throw ExpressionError("a value is missing at the end");
    const char c = text_[at_];
    if (c == '(') {
      ++at_;
      Operand v = disjunction();
      if (!symbol(")")) throw ExpressionError("a ')' is missing");
      return v;
    }
    if (c == '\'' || c == '"') return {quoted(c)};
    if (is_digit(c) || c == '.') return {literal()};
    if (!is_letter(c)) throw ExpressionError("unexpected " + here());
    const std::string_view name = identifier();
    if (symbol("(")) return call(name);
    if (name == "true") return {true};
    if (name == "false") return {false};
    const auto it = scope_.find(name);  // a parameter hides a constant of the same name
    if (it != scope_.end()) return {it->second};
    if (const auto value = constant_value(name)) return {*value};
    if (is_reserved_name(name)) throw ExpressionError("unexpected " + in_quotes(name));
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
  std::string quoted(char quote) {
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) throw ExpressionError("a text is not closed");
    std::string s(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return s;
  }
  double literal() {
    const std::size_t begin = at_;
    const auto digits = [&] {
      while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    };
    digits();
    if (at_ < text_.size() && text_[at_] == '.') ++at_, digits();
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      std::size_t k = at_ + 1;
      if (k < text_.size() && (text_[k] == '+' || text_[k] == '-')) ++k;
      if (k < text_.size() && is_digit(text_[k])) at_ = k, digits();
    }
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '.'))
      ++at_;
    const std::string_view s = text_.substr(begin, at_ - begin);
    const PlainScalar p = classify_plain_scalar(s);
    if (p.kind != PlainScalar::Kind::number)
      throw ExpressionError("'" + std::string(s) + "' is not a number" +
                            (p.complaint.empty() ? "" : " (" + p.complaint + ")"));
    return p.number;
  }
  /// The arguments of `f`; for an `if` only the branch selected by its condition is needed.
  std::vector<Operand> arguments(const std::string& f) {
    std::vector<Operand> v;
    if (symbol(")")) return v;
    bool condition = true;
    do {
      const NeededScope chosen(needed_, f != "if" || v.empty() || (v.size() == 1) == condition);
      v.push_back(disjunction());
      if (v.size() == 1)
        if (const bool* x = std::get_if<bool>(&v[0].value)) condition = *x;
    } while (symbol(","));
    if (!symbol(")")) throw ExpressionError("a ')' is missing");
    return v;
  }
  Operand call(std::string_view name) {
    const std::string f(name);
    const std::vector<Operand> v = arguments(f);
    if (!is_function_name(name))
      throw ExpressionError("unknown function " + in_quotes(f) +
                            (suggest_ ? did_you_mean(name, function_names()) : ""));
    const auto need = [&](std::size_t n) {
      if (v.size() != n)
        throw ExpressionError(f + " takes " + std::to_string(n) +
                              (n == 1 ? " argument" : " arguments") + ", found " +
                              std::to_string(v.size()));
    };
    if (f == "if") {
      need(3);
      const bool first = boolean(v[0], "if");
      if (needed_) return v[first ? 1 : 2];
      const bool same = v[1].typed && v[2].typed && v[1].value.index() == v[2].value.index();
      return {v[1].value, false, same};
    }
    if (f == "min" || f == "max") {
      if (v.empty()) throw ExpressionError(f + " takes at least 1 argument, found 0");
      double best = number(v[0], f);
      for (const Operand& x : v) {
        const double y = number(x, f);
        best = f == "min" ? std::min(best, y) : std::max(best, y);
      }
      return result([&] { return best; });
    }
    if (f == "atan2") {
      need(2);
      const double y = number(v[0], f), x = number(v[1], f);
      return result([&] { return std::atan2(y, x); });
    }
    need(1);
    const double x = number(v[0], f);
    return result([&] {
      const UnaryFunction& g = *unary_function(name);
      if (!g.defined(x)) throw ExpressionError(f + " of " + number_text(x) + " is not defined");
      return g.value(x);
    });
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

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  std::string here() const { return in_quotes(text_.substr(at_, 12)); }
  bool symbol(std::string_view s) {
    skip_blanks();
    if (text_.substr(at_, s.size()) != s) return false;
    at_ += s.size();
    return true;
  }
  bool word(std::string_view w) {
    skip_blanks();
    if (text_.substr(at_, w.size()) != w) return false;
    const std::size_t next = at_ + w.size();
    if (next < text_.size() && (is_letter(text_[next]) || is_digit(text_[next]))) return false;
    at_ = next;
    return true;
  }
  std::string_view identifier() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::string_view text_;
  const ParameterScope& scope_;
  bool suggest_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool needed_ = true;
};

}  // namespace

ParameterValue evaluate_expression(std::string_view text, const ParameterScope& scope,
                                   bool suggest) {
  return Parser(text, scope, suggest).whole();
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
    ParameterValue v = evaluate_expression(text.substr(open + 2, close - open - 2), scope, suggest);
    if (open == 0 && close + 1 == text.size()) return v;
    append(text.substr(at, open - at));
    append(value_text(v));
    at = close + 1;
  }
  append(text.substr(at));
  return result;
}

}  // namespace floatframe
