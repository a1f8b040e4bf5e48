#pragma once
// Which numbers of a file are expressions of parameters: a model that is packed keeps those
// expressions, so that its parameters take new values later.
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/yaml/expression.hpp"

namespace floatframe {

/// What a user says of a parameter.
struct ParameterWords {
  std::string unit, about;
};

/// In its scope, collects the expressions that are evaluated on this thread, with names of
/// parameters of the model file alone: those of subsystems are replaced by what they are given.
class ExpressionsRead {
 public:
  ExpressionsRead();
  ~ExpressionsRead();
  ExpressionsRead(const ExpressionsRead&) = delete;
  ExpressionsRead& operator=(const ExpressionsRead&) = delete;
  /// Collects no more.
  void stop() noexcept;
  /// That of this thread; null: none.
  static ExpressionsRead* current() noexcept;

  /// A parameter of the model file itself, or one that has a value of its own.
  void declare(const ParameterScope& scope, const std::string& name, const ParameterValue& value,
               bool free);
  /// One whose value is that of a text with expressions, read in `from`.
  void declare_as(const ParameterScope& scope, const std::string& name, std::string_view text,
                  const ParameterScope& from, const ParameterValue& value);
  void describe(const std::string& name, ParameterWords words);
  /// The unit of a place where the parameter stands alone.
  void stands_at(std::string_view text, const ParameterScope& scope, const char* unit);

  void evaluated(std::string_view expression, const ParameterScope& scope,
                 const ParameterValue& value);
  /// A formula of the model: the parts of it that are numbers.
  void in_formula(const SyntaxNode& tree, const ParameterScope& scope);

  /// Texts of the expressions that are numbers and depend on a parameter.
  const std::set<std::string>& numbers() const noexcept { return numbers_; }
  /// The parameters that decide something which is no number, and one such expression.
  const std::map<std::string, std::string>& deciding() const noexcept { return deciding_; }
  /// Of the model file: numbers that do not follow from others, in its order.
  const std::vector<std::pair<std::string, double>>& free() const noexcept { return free_; }
  /// Of the model file: numbers that follow from others.
  const std::set<std::string>& following() const noexcept { return following_; }
  const std::map<std::string, ParameterWords>& words() const noexcept { return words_; }

 private:
  using Meaning = std::map<std::string, SyntaxNode>;
  SyntaxNode resolved(SyntaxNode node, const ParameterScope& scope) const;
  void add_number(const SyntaxNode& tree);
  bool constant(const SyntaxNode& node, const ParameterScope& scope) const;

  std::map<const ParameterScope*, Meaning> meaning_;
  std::set<std::string> numbers_, following_;
  std::map<std::string, std::string> deciding_;
  std::vector<std::pair<std::string, double>> free_;
  std::map<std::string, ParameterWords> words_;
  ExpressionsRead* before_;
  bool stopped_ = false;
};

/// The names in an expression, with those of constants that a parameter hides.
void collect_names(const SyntaxNode& node, std::set<std::string>& names);

}  // namespace floatframe
