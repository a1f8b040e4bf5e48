#include "floatframe/io/expression.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "floatframe/core/suggest.hpp"

namespace floatframe {
namespace {

constexpr std::array function_names{"sqrt", "sin",   "cos",  "tan",   "asin", "acos",
                                    "atan", "atan2", "exp",  "log",   "abs",  "min",
                                    "max",  "floor", "ceil", "round", "if"};
constexpr std::array word_names{"pi", "true", "false", "and", "or", "not"};
constexpr int deepest_nesting = 100;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::string in_quotes(std::string_view s) {
  std::string t(1, '\'');
  t += s;
  t += '\'';
  return t;
}

/// Recursive descent; one function a level of precedence.
class Parser {
 public:
  Parser(std::string_view text, const ParameterScope& scope) : text_(text), scope_(scope) {}

  ParameterValue whole() {
    skip_blanks();
    if (at_ == text_.size()) throw ExpressionError("the expression is empty");
    ParameterValue v = disjunction();
    skip_blanks();
    if (at_ != text_.size()) throw ExpressionError("unexpected " + here());
    return v;
  }

 private:
  struct Deeper {  // bounds the recursion, whatever the text
    explicit Deeper(int& d) : depth(d) {
      if (++depth > deepest_nesting) throw ExpressionError("nested too deeply");
    }
    ~Deeper() { --depth; }
    int& depth;
  };

  ParameterValue disjunction() {
    ParameterValue v = conjunction();
    while (word("or")) {
      const bool a = boolean(v, "or"), b = boolean(conjunction(), "or");
      v = a || b;
    }
    return v;
  }
  ParameterValue conjunction() {
    ParameterValue v = negation();
    while (word("and")) {
      const bool a = boolean(v, "and"), b = boolean(negation(), "and");
      v = a && b;
    }
    return v;
  }
  ParameterValue negation() {
    const Deeper deeper(depth_);
    if (word("not")) return !boolean(negation(), "not");
    return comparison();
  }
  ParameterValue comparison() {
    ParameterValue a = sum();
    for (const char* op : {"==", "!=", "<=", ">=", "<", ">"}) {
      if (!symbol(op)) continue;
      const ParameterValue b = sum();
      const std::string o = op;
      if (a.index() != b.index())
        throw ExpressionError("cannot compare " + std::string(type_name(a)) + " with " +
                              type_name(b));
      if (o == "==") return a == b;
      if (o == "!=") return a != b;
      const double x = number(a, op), y = number(b, op);
      return o == "<=" ? x <= y : o == ">=" ? x >= y : o == "<" ? x < y : x > y;
    }
    return a;
  }
  ParameterValue sum() {
    ParameterValue v = product();
    for (;;) {
      if (symbol("+")) {
        const double a = number(v, "+");
        v = finite(a + number(product(), "+"));
      } else if (symbol("-")) {
        const double a = number(v, "-");
        v = finite(a - number(product(), "-"));
      } else {
        return v;
      }
    }
  }
  ParameterValue product() {
    ParameterValue v = sign();
    for (;;) {
      if (symbol("*")) {
        const double a = number(v, "*");
        v = finite(a * number(sign(), "*"));
      } else if (symbol("/")) {
        const double a = number(v, "/"), b = number(sign(), "/");
        if (b == 0.0) throw ExpressionError("division by zero");
        v = finite(a / b);
      } else {
        return v;
      }
    }
  }
  ParameterValue sign() {
    const Deeper deeper(depth_);
    if (symbol("-")) return -number(sign(), "-");
    if (symbol("+")) return number(sign(), "+");
    return power();
  }
  ParameterValue power() {
    ParameterValue v = primary();
    if (!symbol("^")) return v;
    const double a = number(v, "^"), b = number(sign(), "^");
    return finite(std::pow(a, b));
  }
  ParameterValue primary() {
    skip_blanks();
    if (at_ == text_.size()) throw ExpressionError("a value is missing at the end");
    const char c = text_[at_];
    if (c == '(') {
      ++at_;
      ParameterValue v = disjunction();
      if (!symbol(")")) throw ExpressionError("a ')' is missing");
      return v;
    }
    if (c == '\'' || c == '"') return quoted(c);
    if (is_digit(c) || c == '.') return literal();
    if (!is_letter(c)) throw ExpressionError("unexpected " + here());
    const std::string_view name = identifier();
    if (symbol("(")) return call(name);
    if (name == "pi") return std::numbers::pi;
    if (name == "true") return true;
    if (name == "false") return false;
    const auto it = scope_.find(name);
    if (it != scope_.end()) return it->second;
    if (is_reserved_name(name)) throw ExpressionError("unexpected '" + std::string(name) + "'");
    std::vector<std::string> known;
    for (const auto& [key, value] : scope_) known.push_back(key);
    throw ExpressionError("unknown parameter '" + std::string(name) + "'" +
                          did_you_mean(name, known));
  }
  ParameterValue quoted(char quote) {
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) throw ExpressionError("a text is not closed");
    std::string s(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return s;
  }
  ParameterValue literal() {
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
  ParameterValue call(std::string_view name) {
    std::vector<ParameterValue> v;
    if (!symbol(")")) {
      do v.push_back(disjunction());
      while (symbol(","));
      if (!symbol(")")) throw ExpressionError("a ')' is missing");
    }
    const std::string f(name);
    if (std::find(function_names.begin(), function_names.end(), name) == function_names.end()) {
      const std::vector<std::string> known(function_names.begin(), function_names.end());
      throw ExpressionError("unknown function '" + f + "'" + did_you_mean(name, known));
    }
    const auto need = [&](std::size_t n) {
      if (v.size() != n)
        throw ExpressionError(f + " takes " + std::to_string(n) +
                              (n == 1 ? " argument" : " arguments") + ", found " +
                              std::to_string(v.size()));
    };
    if (f == "if") {
      need(3);
      return boolean(v[0], "if") ? v[1] : v[2];
    }
    if (f == "min" || f == "max") {
      if (v.empty()) throw ExpressionError(f + " takes at least 1 argument, found 0");
      double best = number(v[0], f);
      for (const ParameterValue& x : v) {
        const double y = number(x, f);
        best = f == "min" ? std::min(best, y) : std::max(best, y);
      }
      return best;
    }
    if (f == "atan2") {
      need(2);
      return std::atan2(number(v[0], f), number(v[1], f));
    }
    need(1);
    const double x = number(v[0], f);
    const auto outside = [&] {
      throw ExpressionError(f + " of " + number_text(x) + " is not defined");
    };
    if (f == "sqrt" && x < 0.0) outside();
    if (f == "log" && x <= 0.0) outside();
    if ((f == "asin" || f == "acos") && std::abs(x) > 1.0) outside();
    return finite(f == "sqrt"    ? std::sqrt(x)
                  : f == "sin"   ? std::sin(x)
                  : f == "cos"   ? std::cos(x)
                  : f == "tan"   ? std::tan(x)
                  : f == "asin"  ? std::asin(x)
                  : f == "acos"  ? std::acos(x)
                  : f == "atan"  ? std::atan(x)
                  : f == "exp"   ? std::exp(x)
                  : f == "log"   ? std::log(x)
                  : f == "abs"   ? std::abs(x)
                  : f == "floor" ? std::floor(x)
                  : f == "ceil"  ? std::ceil(x)
                                 : std::round(x));
  }

  static double number(const ParameterValue& v, std::string_view where) {
    if (const double* x = std::get_if<double>(&v)) return *x;
    throw ExpressionError("'" + std::string(where) + "' needs numbers, found " + describe(v));
  }
  static bool boolean(const ParameterValue& v, std::string_view where) {
    if (const bool* x = std::get_if<bool>(&v)) return *x;
    throw ExpressionError("'" + std::string(where) + "' needs true or false, found " + describe(v));
  }
  static std::string describe(const ParameterValue& v) {
    return v.index() == 2 ? in_quotes(std::get<std::string>(v)) : value_text(v);
  }
  static double finite(double x) {
    if (!std::isfinite(x)) throw ExpressionError("the result is not a finite number");
    return x;
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
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

ParameterValue evaluate_expression(std::string_view text, const ParameterScope& scope) {
  return Parser(text, scope).whole();
}

ParameterValue substitute_parameters(std::string_view text, const ParameterScope& scope) {
  std::string result;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = text.find("${", at);
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string_view::npos) throw ExpressionError("a '}' is missing");
    ParameterValue v = evaluate_expression(text.substr(open + 2, close - open - 2), scope);
    if (open == 0 && close + 1 == text.size()) return v;
    result += text.substr(at, open - at);
    result += value_text(v);
    at = close + 1;
  }
  result += text.substr(at);
  return result;
}

std::string value_text(const ParameterValue& value) {
  if (const bool* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
  if (const double* x = std::get_if<double>(&value)) return number_text(*x);
  return std::get<std::string>(value);
}

const char* type_name(const ParameterValue& value) {
  constexpr std::array names{"true or false", "a number", "a text"};
  return names[value.index()];
}

bool is_reserved_name(std::string_view name) {
  return std::find(function_names.begin(), function_names.end(), name) != function_names.end() ||
         std::find(word_names.begin(), word_names.end(), name) != word_names.end();
}

PlainScalar classify_plain_scalar(std::string_view text) {
  PlainScalar s;
  if (text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL") {
    s.kind = PlainScalar::Kind::null;
    return s;
  }
  if (text == "true" || text == "false") {
    s.kind = PlainScalar::Kind::boolean;
    s.boolean = text == "true";
    return s;
  }
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const char* word : {"true", "yes", "on", "false", "no", "off"}) {
    if (lower != word) continue;
    const bool truth = lower == "true" || lower == "yes" || lower == "on";
    s.kind = PlainScalar::Kind::bad_boolean;
    s.complaint = truth ? "write true" : "write false";
    return s;
  }
  std::string_view body = lower;
  if (body[0] == '+' || body[0] == '-') body.remove_prefix(1);
  if (body == ".inf" || body == ".nan" || body == "inf" || body == "nan" || body == "infinity") {
    s.kind = PlainScalar::Kind::bad_number;
    s.complaint = "numbers must be finite";
    return s;
  }
  if (body.empty() ||
      !(is_digit(body[0]) || (body[0] == '.' && body.size() > 1 && is_digit(body[1]))))
    return s;
  // digits [. digits] [e [+-] digits]
  std::size_t k = 0;
  const auto digits = [&] {
    const std::size_t begin = k;
    while (k < body.size() && is_digit(body[k])) ++k;
    return k - begin;
  };
  const std::size_t whole = digits();
  std::size_t fraction = 0;
  if (k < body.size() && body[k] == '.') ++k, fraction = digits();
  bool well_formed = whole + fraction > 0;
  if (well_formed && k < body.size() && body[k] == 'e') {
    ++k;
    if (k < body.size() && (body[k] == '+' || body[k] == '-')) ++k;
    well_formed = digits() > 0;
  }
  if (!well_formed || k != body.size()) {
    const bool other_base =
        body.size() > 2 && body[0] == '0' && (body[1] == 'x' || body[1] == 'o' || body[1] == 'b');
    if (other_base || body.find('_') != std::string_view::npos) {
      s.kind = PlainScalar::Kind::bad_number;
      s.complaint = "write a decimal number";
    }
    return s;
  }
  if (whole > 1 && body[0] == '0') {
    s.kind = PlainScalar::Kind::bad_number;
    s.complaint = "a number must not start with 0";
    return s;
  }
  const auto r = std::from_chars(body.data(), body.data() + body.size(), s.number);
  const bool tiny =
      r.ec == std::errc::result_out_of_range && body.find("e-") != std::string_view::npos;
  if (tiny) s.number = 0.0;
  if (!tiny && (r.ec != std::errc() || !std::isfinite(s.number))) {
    s.kind = PlainScalar::Kind::bad_number;
    s.complaint = "numbers must be finite";
    return s;
  }
  if (lower[0] == '-') s.number = -s.number;
  s.kind = PlainScalar::Kind::number;
  return s;
}

}  // namespace floatframe
