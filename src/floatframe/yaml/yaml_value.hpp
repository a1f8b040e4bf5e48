#pragma once
// Typed, checked access to a YAML tree. A `YamlValue` is one value with its path in the file
// ("bodies.arm.mass"), a `YamlSection` is a map whose keys are read one by one; keys that were not
// read are errors. Every accessor reports the value found and the value expected and continues, so
// that all errors of a file are found at once. Scalars may contain `${...}` expressions.
#include <algorithm>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/yaml/csv_file.hpp"
#include "floatframe/yaml/expression.hpp"
#include "floatframe/yaml/yaml_tree.hpp"

namespace floatframe {

/// Data shared by all values of one file.
struct ReadContext {
  const std::string* file = nullptr;
  const ParameterScope* scope = nullptr;
  ReadErrors* errors = nullptr;
  CsvFiles* tables = nullptr;  ///< those parsed already, optional
};

class YamlSection;

class YamlValue {
 public:
  YamlValue(const ReadContext& context, const YamlNode& node, std::string path)
      : context_(&context),
        node_(&node),
        path_(std::move(path)),
        line_(node.line),
        column_(node.column) {}
  /// The value of a key; errors about the whole entity point at the key.
  YamlValue(const ReadContext& context, const YamlEntry& entry, std::string path)
      : context_(&context),
        node_(&entry.value),
        path_(std::move(path)),
        line_(entry.line),
        column_(entry.column) {}

  const std::string& path() const { return path_; }
  const YamlNode& node() const { return *node_; }
  const ReadContext& context() const { return *context_; }
  SourceMark mark() const { return {*context_->file, node_->line, node_->column}; }
  SourceMark entity_mark() const { return {*context_->file, line_, column_}; }
  bool is_list() const { return node_->kind == YamlNode::Kind::sequence; }
  bool is_map() const { return node_->kind == YamlNode::Kind::map; }
  bool is_scalar() const { return node_->kind == YamlNode::Kind::scalar; }

  /// Adds the error "path: sentence" at this value.
  void error(ErrorCode code, const std::string& sentence, std::size_t count = 1) const {
    context_->errors->add({mark(), code, path_ + ": " + sentence, count, path_});
  }
  /// The same at the key of the value.
  void entity_error(ErrorCode code, const std::string& sentence) const {
    context_->errors->add({entity_mark(), code, path_ + ": " + sentence, 1, path_});
  }
  void complain(ErrorCode code, const std::optional<std::string>& complaint) const {
    if (complaint) error(code, *complaint);
  }
  /// Error about a name that is not one of `known()`, with a suggestion if possible.
  template <class Known>
  void not_known(const std::string& sentence, const std::string& name, const Known& known) const {
    error(ErrorCode::not_found, sentence + context_->errors->suggestion(name, known));
  }
  /// "found ..., expected `what`".
  void unexpected(const std::string& what, ErrorCode code = ErrorCode::wrong_value) const {
    error(code, "found " + found() + ", expected " + what);
  }
  /// The value in error messages: -3, 'abc', a list of 2, a map, nothing.
  std::string found() const;

  // Accessors: an error and nullopt (or an empty list) if the value has another form.
  std::optional<double> number(const NumberRule& rule) const;
  std::optional<int> integer(int low, int high, const char* what) const {
    return integer(WholeNumberRule{what, low, high});
  }
  std::optional<int> integer(const WholeNumberRule& rule) const;
  std::optional<bool> boolean() const;
  std::optional<std::string> text(const char* what = "a text") const;
  /// One of the words; returns its index.
  std::optional<std::size_t> word(std::span<const char* const> words) const;
  std::optional<std::size_t> word(std::initializer_list<const char*> words) const {
    return word(std::span<const char* const>(words.begin(), words.size()));
  }
  std::optional<std::size_t> word(const std::vector<std::string>& words) const {
    std::vector<const char*> list;
    for (const std::string& w : words) list.push_back(w.c_str());
    return word(std::span<const char* const>(list));
  }
  /// Any scalar: a parameter value.
  std::optional<ParameterValue> parameter() const;
  std::vector<YamlValue> list(const char* what = "a list") const;
  /// List of `smallest` to `largest` numbers.
  std::optional<std::vector<double>> numbers(std::size_t smallest, std::size_t largest,
                                             const NumberRule& rule, const char* what) const;
  std::optional<Vec3> vector(const char* unit) const;
  std::optional<YamlSection> section(const char* what = "a map of keys") const;
  /// A map of names to values, in the order of the file; names must be identifiers (unless
  /// `free_names`) and not too long.
  std::vector<std::pair<std::string, YamlValue>> named(const char* what,
                                                       bool free_names = false) const;
  /// True if the scalar holds a number (after substitution); adds no errors.
  bool looks_like_number() const;

 private:
  using Scalar = std::variant<std::monostate, bool, double, std::string>;
  /// The substituted scalar; none after an error, which is not reported if `quiet`.
  std::optional<Scalar> scalar(const std::string& expected, bool quiet = false) const;
  template <class Rule>
  std::optional<double> number_by(const Rule& rule) const;

  const ReadContext* context_;
  const YamlNode* node_;
  std::string path_;
  int line_, column_;
};

/// A map being read. `mark` is the location of the key that opens it, for errors about the entity
/// as a whole.
class YamlSection {
 public:
  explicit YamlSection(const YamlValue& value) : value_(value), mark_(value.entity_mark()) {}

  const std::string& path() const { return value_.path(); }
  const SourceMark& mark() const { return mark_; }
  const YamlValue& value() const { return value_; }
  void error(ErrorCode code, const std::string& sentence) const {
    value_.context().errors->add({mark_, code, path_prefix() + sentence, 1, path()});
  }
  bool has(const char* key) const { return find(key) != nullptr; }
  /// The value of an optional key.
  std::optional<YamlValue> get(const char* key);
  /// The value of a required key; an error if it is missing.
  std::optional<YamlValue> require(const char* key);
  /// Reports all keys that were not read. `elsewhere`: keys of other groups, as "group.key",
  /// suggested if no key here is similar.
  void finish(const std::vector<std::string>& elsewhere = {});

  /// True if the key is a key of this section.
  bool was_asked(const std::string& key) const {
    return std::find(asked_.begin(), asked_.end(), key) != asked_.end();
  }

  /// Marks of the entity and of all its keys.
  Origin origin() const;

  // Shorthands: the value if the key is present and valid, else the default.
  double number(const char* key, const NumberRule& rule, double absent);
  double required_number(const char* key, const NumberRule& rule, double when_wrong);
  bool boolean(const char* key, bool absent);
  /// Into `place`, which is unchanged if the key is absent or its value is invalid.
  void vector(const char* key, const char* unit, Vec3& place);
  /// An enumerator by its word, in the order of the enumeration; else unchanged.
  template <class Enum>
  void word(const char* key, std::span<const char* const> words, Enum& place) {
    if (const auto v = get(key))
      if (const auto k = v->word(words)) place = static_cast<Enum>(*k);
  }

 private:
  const YamlEntry* find(const char* key) const;
  std::string path_prefix() const { return path().empty() ? std::string() : path() + ": "; }
  std::string path_of(const std::string& key) const {
    return path().empty() ? key : path() + "." + key;
  }
  YamlValue value_;
  SourceMark mark_;
  std::vector<std::string> asked_;
};

}  // namespace floatframe
