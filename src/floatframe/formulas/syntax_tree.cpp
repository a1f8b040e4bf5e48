#include "floatframe/formulas/syntax_tree.hpp"

#include <utility>

#include "floatframe/core/ascii.hpp"
#include "floatframe/core/number_rule.hpp"

namespace floatframe {
namespace {

constexpr int deepest_expression = 100;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::string quoted_name(std::string_view s) {
  std::string t(1, '\'');
  t += s;
  t += '\'';
  return t;
}

/// Recursive descent; one function per level of precedence.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  SyntaxNode whole() {
    skip_blanks();
    if (at_ == text_.size()) throw ExpressionError("the expression is empty");
    SyntaxNode v = disjunction();
    skip_blanks();
    if (at_ != text_.size()) throw ExpressionError("unexpected " + here());
    return v;
  }

 private:
  using Kind = SyntaxNode::Kind;
  struct DepthGuard {  // bounds the recursion for any text
    explicit DepthGuard(int& d) : depth(d) {
      if (++depth > deepest_expression) throw ExpressionError("nested too deeply");
    }
    ~DepthGuard() { --depth; }
    int& depth;
  };

  /// Operands with a word between them.
  SyntaxNode words(Kind kind, const char* w, SyntaxNode (Parser::*next)()) {
    SyntaxNode first = (this->*next)();
    if (!word(w)) return first;
    SyntaxNode v{kind, 0.0, w, {}};
    v.parts.push_back(std::move(first));
    do v.parts.push_back((this->*next)());
    while (word(w));
    return v;
  }
  SyntaxNode disjunction() { return words(Kind::any, "or", &Parser::conjunction); }
  SyntaxNode conjunction() { return words(Kind::all, "and", &Parser::negation); }
  SyntaxNode negation() {
    const DepthGuard deeper(depth_);
    if (!word("not")) return comparison();
    return one(Kind::negation, "not", negation());
  }
  SyntaxNode comparison() {
    SyntaxNode a = chain("+", "-", &Parser::product);
    for (const char* op : {"==", "!=", "<=", ">=", "<", ">"}) {
      if (!symbol(op)) continue;
      SyntaxNode v = one(Kind::comparison, op, std::move(a));
      v.parts.push_back(chain("+", "-", &Parser::product));
      return v;
    }
    return a;
  }
  SyntaxNode product() { return chain("*", "/", &Parser::sign); }
  /// Operands of one level with operators between them.
  SyntaxNode chain(const char* first, const char* second, SyntaxNode (Parser::*next)()) {
    SyntaxNode v = (this->*next)();
    for (bool begun = false;; begun = true) {
      const char* op = symbol(first) ? first : symbol(second) ? second : nullptr;
      if (op == nullptr) return v;
      if (!begun) v = one(Kind::chain, "", std::move(v));
      v.word += op;
      v.parts.push_back((this->*next)());
    }
  }
  SyntaxNode sign() {
    const DepthGuard deeper(depth_);
    for (const char* op : {"-", "+"})
      if (symbol(op)) return one(Kind::sign, op, sign());
    SyntaxNode v = primary();
    if (!symbol("^")) return v;
    SyntaxNode power = one(Kind::power, "^", std::move(v));
    power.parts.push_back(sign());
    return power;
  }
  SyntaxNode primary() {
    skip_blanks();
    if (at_ == text_.size()) throw ExpressionError("a value is missing at the end");
    const char c = text_[at_];
    if (c == '(') {
      ++at_;
      SyntaxNode v = disjunction();
      if (!symbol(")")) throw ExpressionError("a ')' is missing");
      return v;
    }
    if (c == '\'' || c == '"') return {Kind::text, 0.0, quoted(c), {}};
    if (is_digit(c) || c == '.') return {Kind::number, literal(), "", {}};
    if (!is_letter(c)) throw ExpressionError("unexpected " + here());
    const std::string name(identifier());
    if (symbol("(")) return {Kind::call, 0.0, name, arguments()};
    if (name == "true" || name == "false")
      return {Kind::truth, name == "true" ? 1.0 : 0.0, name, {}};
    for (const char* reserved : {"and", "or", "not"})
      if (name == reserved) throw ExpressionError("unexpected " + quoted_name(name));
    return {Kind::name, 0.0, name, {}};
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
      throw ExpressionError(quoted_name(s) + " is not a number" +
                            (p.complaint.empty() ? "" : " (" + p.complaint + ")"));
    return p.number;
  }
  std::vector<SyntaxNode> arguments() {
    std::vector<SyntaxNode> v;
    if (symbol(")")) return v;
    do v.push_back(disjunction());
    while (symbol(","));
    if (!symbol(")")) throw ExpressionError("a ')' is missing");
    return v;
  }

  static SyntaxNode one(Kind kind, const char* word, SyntaxNode part) {
    SyntaxNode v{kind, 0.0, word, {}};
    v.parts.push_back(std::move(part));
    return v;
  }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  std::string here() const { return quoted_name(text_.substr(at_, 12)); }
  bool symbol(std::string_view s) {
    skip_blanks();
    if (text_.substr(at_, s.size()) != s) return false;
    at_ += s.size();
    return true;
  }
  bool is_part_of_name(std::size_t at) const {
    return at < text_.size() && (is_letter(text_[at]) || is_digit(text_[at]));
  }
  bool word(std::string_view w) {
    skip_blanks();
    if (text_.substr(at_, w.size()) != w || is_part_of_name(at_ + w.size())) return false;
    at_ += w.size();
    return true;
  }
  std::string_view identifier() {
    const std::size_t begin = at_;
    while (is_part_of_name(at_) ||
           (at_ < text_.size() && text_[at_] == '.' && is_part_of_name(at_ + 1)))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

SyntaxNode parse_expression(std::string_view text) { return Parser(text).whole(); }

std::string expression_text(const SyntaxNode& node) {
  using Kind = SyntaxNode::Kind;
  const auto joined = [&](const std::string& between) {
    std::string text;
    for (std::size_t k = 0; k < node.parts.size(); ++k)
      text += (k == 0 ? "" : between) + expression_text(node.parts[k]);
    return text;
  };
  switch (node.kind) {
    case Kind::number:
      return number_text(node.number);
    case Kind::truth:
    case Kind::name:
      return node.word;
    case Kind::text: {
      const char* quote = node.word.find('\'') == std::string::npos ? "'" : "\"";
      return quote + node.word + quote;
    }
    case Kind::call:
      return node.word + "(" + joined(", ") + ")";
    case Kind::negation:
    case Kind::sign:
      return "(" + node.word + " " + joined("") + ")";
    case Kind::chain: {
      std::string text = "(" + expression_text(node.parts[0]);
      for (std::size_t k = 1; k < node.parts.size(); ++k)
        text += std::string(" ") + node.word[k - 1] + " " + expression_text(node.parts[k]);
      return text + ")";
    }
    case Kind::power:
    case Kind::comparison:
    case Kind::all:
    case Kind::any:
      return "(" + joined(" " + node.word + " ") + ")";
  }
  return "";
}

}  // namespace floatframe
