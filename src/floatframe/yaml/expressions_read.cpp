#include "floatframe/yaml/expressions_read.hpp"

#include <algorithm>

#include "floatframe/formulas/function_words.hpp"

namespace floatframe {
namespace {

thread_local ExpressionsRead* reading = nullptr;

SyntaxNode literal(const ParameterValue& value) {
  using Kind = SyntaxNode::Kind;
  if (const bool* b = std::get_if<bool>(&value))
    return {Kind::truth, *b ? 1.0 : 0.0, *b ? "true" : "false", {}};
  if (const double* x = std::get_if<double>(&value)) return {Kind::number, *x, "", {}};
  return {Kind::text, 0.0, std::get<std::string>(value), {}};
}

/// The expression of a text that is nothing but `${...}`.
std::optional<std::string_view> only_expression(std::string_view text) {
  if (text.substr(0, 2) != "${" || text.find('}') != text.size() - 1) return std::nullopt;
  return text.substr(2, text.size() - 3);
}

}  // namespace

void collect_names(const SyntaxNode& node, std::set<std::string>& names) {
  if (node.kind == SyntaxNode::Kind::name) names.insert(node.word);
  for (const SyntaxNode& part : node.parts) collect_names(part, names);
}

ExpressionsRead::ExpressionsRead() : before_(reading) { reading = this; }
ExpressionsRead::~ExpressionsRead() { stop(); }
void ExpressionsRead::stop() noexcept {
  if (!stopped_) reading = before_;
  stopped_ = true;
}
ExpressionsRead* ExpressionsRead::current() noexcept { return reading; }

void ExpressionsRead::declare(const ParameterScope& scope, const std::string& name,
                              const ParameterValue& value, bool free) {
  const double* x = std::get_if<double>(&value);
  if (free && x) {
    free_.emplace_back(name, *x);
    meaning_[&scope][name] = {SyntaxNode::Kind::name, 0.0, name, {}};
  } else {
    meaning_[&scope][name] = literal(value);
  }
}

void ExpressionsRead::declare_as(const ParameterScope& scope, const std::string& name,
                                 std::string_view text, const ParameterScope& from,
                                 const ParameterValue& value) {
  const auto expression = only_expression(text);
  meaning_[&scope][name] = std::holds_alternative<double>(value) && expression
                               ? resolved(parse_expression(*expression), from)
                               : literal(value);
  std::set<std::string> names;
  collect_names(meaning_[&scope][name], names);
  if (&scope == &from && !names.empty()) following_.insert(name);
}

void ExpressionsRead::describe(const std::string& name, ParameterWords words) {
  words_[name] = std::move(words);
}

void ExpressionsRead::stands_at(std::string_view text, const ParameterScope& scope,
                                const char* unit) {
  const auto expression = only_expression(text);
  if (!expression || !*unit) return;
  const SyntaxNode tree = resolved(parse_expression(*expression), scope);
  if (tree.kind != SyntaxNode::Kind::name) return;
  std::string& known = words_[tree.word].unit;
  if (known.empty()) known = unit;
}

/// Names of parameters in place of those of the scope, values in place of constants.
SyntaxNode ExpressionsRead::resolved(SyntaxNode node, const ParameterScope& scope) const {
  if (node.kind == SyntaxNode::Kind::name) {
    if (const auto known = meaning_.find(&scope); known != meaning_.end())
      if (const auto it = known->second.find(node.word); it != known->second.end())
        return it->second;
    if (const auto it = scope.find(node.word); it != scope.end()) return literal(it->second);
    if (const auto value = constant_value(node.word)) return literal(*value);
    return node;
  }
  for (SyntaxNode& part : node.parts) part = resolved(std::move(part), scope);
  return node;
}

void ExpressionsRead::add_number(const SyntaxNode& tree) {
  std::set<std::string> names;
  collect_names(tree, names);
  if (!names.empty()) numbers_.insert(expression_text(tree));
}

void ExpressionsRead::evaluated(std::string_view expression, const ParameterScope& scope,
                                const ParameterValue& value) {
  const SyntaxNode tree = resolved(parse_expression(expression), scope);
  if (std::holds_alternative<double>(value)) return add_number(tree);
  std::set<std::string> names;
  collect_names(tree, names);
  for (const std::string& name : names) deciding_.emplace(name, expression);
}

bool ExpressionsRead::constant(const SyntaxNode& node, const ParameterScope& scope) const {
  if (node.kind == SyntaxNode::Kind::name)
    return scope.contains(node.word) || constant_value(node.word).has_value();
  if (node.kind == SyntaxNode::Kind::call && !is_function_name(node.word, true)) return false;
  return std::all_of(node.parts.begin(), node.parts.end(),
                     [&](const SyntaxNode& part) { return constant(part, scope); });
}

void ExpressionsRead::in_formula(const SyntaxNode& node, const ParameterScope& scope) {
  if (constant(node, scope)) return add_number(resolved(node, scope));
  if (node.kind == SyntaxNode::Kind::chain)  // a formula takes its first numbers together
    for (std::size_t n = 2; n < node.parts.size(); ++n) {
      SyntaxNode first = node;
      first.parts.resize(n);
      first.word.resize(n - 1);
      if (constant(first, scope)) add_number(resolved(first, scope));
    }
  for (const SyntaxNode& part : node.parts) in_formula(part, scope);
}

}  // namespace floatframe
