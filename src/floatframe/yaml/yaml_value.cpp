#include "floatframe/yaml/yaml_value.hpp"

#include <algorithm>

#include "floatframe/core/printable.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/yaml/expressions_read.hpp"

namespace floatframe {

namespace {

std::string shortened(const std::string& s) {
  std::size_t end = std::min<std::size_t>(s.size(), 40);
  while (end < s.size() && (static_cast<unsigned char>(s[end]) & 0xC0u) == 0x80u) --end;
  std::string t;
  for (char c : s.substr(0, end)) t += c == '\n' ? ' ' : c;
  t = printable(t);
  return s.size() > 40 ? t + "..." : t;
}

std::string short_in_quotes(const std::string& s) {
  std::string t(1, '\'');
  t += shortened(s);
  t += '\'';
  return t;
}

bool has_expression(const YamlNode& n) {
  return n.kind == YamlNode::Kind::scalar && n.text.find("${") != std::string::npos;
}

}  // namespace

std::optional<YamlValue::Scalar> YamlValue::scalar(const std::string& expected, bool quiet) const {
  if (node_->refused) return std::nullopt;
  const auto complain = [&](ErrorCode code, const std::string& sentence) {
    if (!quiet) error(code, sentence);
    return std::nullopt;
  };
  if (node_->kind == YamlNode::Kind::null) return Scalar();
  if (!is_scalar())
    return complain(ErrorCode::wrong_value, "found " + found() + ", expected " + expected);
  if (has_expression(*node_)) {
    try {
      return std::visit([](const auto& value) { return Scalar(value); },
                        substitute_parameters(node_->text, *context_->scope, false));
    } catch (const ExpressionError&) {
      if (quiet) return std::nullopt;
    }
    try {  // again, for the error message
      substitute_parameters(node_->text, *context_->scope, context_->errors->suggest());
    } catch (const ExpressionError& error) {
      complain(ErrorCode::wrong_value, "in " + shortened(node_->text) + ": " + error.what());
    }
    return std::nullopt;
  }
  if (node_->quoted) return node_->text;
  const PlainScalar p = classify_plain_scalar(node_->text);
  const std::string why = "found " + node_->text + ", expected " + expected + " (" + p.complaint;
  switch (p.kind) {
    case PlainScalar::Kind::null:
      return Scalar();
    case PlainScalar::Kind::boolean:
      return p.boolean;
    case PlainScalar::Kind::number:
      return p.number;
    case PlainScalar::Kind::text:
      return node_->text;
    case PlainScalar::Kind::bad_number:
      return complain(ErrorCode::not_a_number, why + ")");
    case PlainScalar::Kind::bad_boolean:
      return complain(ErrorCode::wrong_value, why + ", or put a text in quotes)");
  }
  return std::nullopt;
}

std::string YamlValue::found() const {
  if (is_list()) return "a list of " + std::to_string(node_->items.size());
  if (is_map()) return "a map";
  if (!is_scalar()) return "nothing";
  const std::string written = shortened(node_->text);
  if (has_expression(*node_)) {
    const auto s = scalar("", true);
    if (!s) return written;
    if (const bool* truth = std::get_if<bool>(&*s)) return written + " = " + value_text(*truth);
    if (const double* x = std::get_if<double>(&*s)) return written + " = " + value_text(*x);
    const std::string* text = std::get_if<std::string>(&*s);
    return text ? written + " = " + short_in_quotes(*text) : written;
  }
  if (node_->quoted) return short_in_quotes(node_->text);
  const PlainScalar::Kind kind = classify_plain_scalar(node_->text).kind;
  if (kind == PlainScalar::Kind::null) return "nothing";
  return kind == PlainScalar::Kind::text ? short_in_quotes(node_->text) : written;
}

template <class Rule>
std::optional<double> YamlValue::number_by(const Rule& rule) const {
  const auto s = scalar(rule.expectation());
  if (!s) return std::nullopt;
  const double* x = std::get_if<double>(&*s);
  if constexpr (std::is_same_v<Rule, NumberRule>)
    if (auto* read = ExpressionsRead::current(); read && x)
      read->stands_at(node_->text, *context_->scope, rule.unit);
  if (x && rule.holds(*x)) return *x;
  unexpected(rule.expectation(), x ? ErrorCode::out_of_range : ErrorCode::not_a_number);
  return std::nullopt;
}

std::optional<double> YamlValue::number(const NumberRule& rule) const { return number_by(rule); }

std::optional<int> YamlValue::integer(const WholeNumberRule& rule) const {
  const auto x = number_by(rule);
  return x ? std::optional(static_cast<int>(*x)) : std::nullopt;
}

std::optional<bool> YamlValue::boolean() const {
  const auto s = scalar("true or false");
  const bool* truth = s ? std::get_if<bool>(&*s) : nullptr;
  if (s && !truth) unexpected("true or false");
  return truth ? std::optional(*truth) : std::nullopt;
}

std::optional<std::string> YamlValue::text(const char* what) const {
  const auto s = scalar(what);
  const std::string* text = s ? std::get_if<std::string>(&*s) : nullptr;
  if (text && !text->empty()) return *text;
  if (s) unexpected(what);
  return std::nullopt;
}

std::optional<std::size_t> YamlValue::word(std::span<const char* const> words) const {
  const std::string expected = alternatives(words);
  const auto t = text(expected.c_str());
  if (!t) return std::nullopt;
  const auto it = std::find(words.begin(), words.end(), *t);
  if (it != words.end()) return it - words.begin();
  const std::string hint = did_you_mean(*t, {words.begin(), words.end()});
  error(ErrorCode::wrong_value, "found " + found() + ", expected " + expected + hint);
  return std::nullopt;
}

std::optional<ParameterValue> YamlValue::parameter() const {
  const char* what = "a number, a text, true or false";
  const auto s = scalar(what);
  if (!s) return std::nullopt;
  if (const bool* truth = std::get_if<bool>(&*s)) return *truth;
  if (const double* x = std::get_if<double>(&*s)) return *x;
  if (const std::string* text = std::get_if<std::string>(&*s)) return *text;
  unexpected(what);
  return std::nullopt;
}

std::vector<YamlValue> YamlValue::list(const char* what) const {
  std::vector<YamlValue> out;
  if (!is_list()) {
    unexpected(what);
    return out;
  }
  out.reserve(node_->items.size());
  for (std::size_t i = 0; i < node_->items.size(); ++i)
    out.emplace_back(*context_, node_->items[i], path_ + "[" + std::to_string(i + 1) + "]");
  return out;
}

std::optional<std::vector<double>> YamlValue::numbers(std::size_t smallest, std::size_t largest,
                                                      const NumberRule& rule,
                                                      const char* what) const {
  if (!is_list() || node_->items.size() < smallest || node_->items.size() > largest) {
    unexpected(what);
    return std::nullopt;
  }
  std::vector<double> out;
  bool good = true;
  for (const YamlValue& v : list()) {
    const auto x = v.number(rule);
    good = good && x;
    out.push_back(x.value_or(0.0));
  }
  if (!good) return std::nullopt;
  return out;
}

std::optional<Vec3> YamlValue::vector(const char* unit) const {
  const std::string what = "a list of three numbers [x, y, z]" +
                           (*unit ? " [" + std::string(unit) + "]" : std::string());
  const auto v = numbers(3, 3, any_number(unit), what.c_str());
  if (!v) return std::nullopt;
  return Vec3((*v)[0], (*v)[1], (*v)[2]);
}

std::optional<YamlSection> YamlValue::section(const char* what) const {
  if (!is_map()) {
    unexpected(what);
    return std::nullopt;
  }
  return YamlSection(*this);
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::named(const char* what,
                                                                bool free_names) const {
  std::vector<std::pair<std::string, YamlValue>> out;
  if (!is_map()) {
    unexpected(what);
    return out;
  }
  const std::string prefix = path_.empty() ? "" : path_ + ".";
  for (const YamlEntry& e : node_->entries) {
    const auto refuse = [&](ErrorCode code, const std::string& sentence) {
      context_->errors->add(code, {*context_->file, e.line, e.column}, sentence);
    };
    const std::string found_name = path_ + ": found the name " + short_in_quotes(e.key);
    if (e.key.size() > limits::name_length)
      refuse(ErrorCode::too_large,
             prefix + shortened(e.key) + ": found a name of " + std::to_string(e.key.size()) +
                 " characters, expected at most " + std::to_string(limits::name_length));
    else if (free_names && e.key.find("${") != std::string::npos)
      refuse(ErrorCode::wrong_value,
             found_name + ", but expressions stand for values, not in names");
    else if (!free_names && !is_identifier(e.key, true))
      refuse(ErrorCode::wrong_value,
             found_name + ", expected letters, digits, _ and -, with a letter first");
    else
      out.emplace_back(e.key, YamlValue(*context_, e, prefix + e.key));
  }
  return out;
}

bool YamlValue::looks_like_number() const {
  const auto s = is_scalar() ? scalar("", true) : std::nullopt;
  return s && std::holds_alternative<double>(*s);
}

// -----------------------------------------------------------------------------------------------
// sections

const YamlEntry* YamlSection::find(const char* key) const {
  for (const YamlEntry& e : value_.node().entries)
    if (e.key == key) return &e;
  return nullptr;
}

std::optional<YamlValue> YamlSection::get(const char* key) {
  asked_.emplace_back(key);
  const YamlEntry* e = find(key);
  if (!e) return std::nullopt;
  return YamlValue(value_.context(), *e, path_of(key));
}

std::optional<YamlValue> YamlSection::require(const char* key) {
  auto v = get(key);
  if (!v) error(ErrorCode::missing, "missing key '" + std::string(key) + "'");
  return v;
}

void YamlSection::finish(const std::vector<std::string>& elsewhere) {
  ReadErrors& errors = *value_.context().errors;
  std::vector<const YamlEntry*> unknown;
  for (const YamlEntry& e : value_.node().entries)
    if (std::find(asked_.begin(), asked_.end(), e.key) == asked_.end()) unknown.push_back(&e);
  if (unknown.empty()) return;
  std::vector<std::string> free;
  for (const std::string& k : asked_)
    if (!has(k.c_str())) free.push_back(k);
  const auto place = [&](const YamlEntry& e) {
    return SourceMark{*value_.context().file, e.line, e.column};
  };
  const std::size_t shown = std::min(unknown.size(), limits::errors_of_a_kind);
  for (std::size_t i = 0; i < shown; ++i) {
    const YamlEntry& e = *unknown[i];
    std::string hint = errors.suggestion(e.key, [&] { return free; });
    if (hint.empty() && !elsewhere.empty()) {  // a key of another group: suggest its path
      std::vector<std::string> last;
      for (const std::string& k : elsewhere) last.push_back(k.substr(k.rfind('.') + 1));
      const std::string* best = errors.suggest() ? nearest(e.key, last) : nullptr;
      if (best) hint = ", did you mean '" + elsewhere[best - last.data()] + "'?";
    }
    errors.add({place(e), ErrorCode::unknown_key,
                path_prefix() + "unknown key '" + shortened(e.key) + "'" + hint, 1,
                path_of(shortened(e.key))});
  }
  if (const std::size_t more = unknown.size() - shown; more > 0)
    errors.add({place(*unknown[shown]), ErrorCode::unknown_key,
                path_prefix() + "... and " + std::to_string(more) +
                    (more == 1 ? " more unknown key" : " more unknown keys"),
                more, path()});
}

Origin YamlSection::origin() const {
  Origin o;
  o.mark = mark_;
  for (const YamlEntry& e : value_.node().entries)
    o.keys.emplace(e.key, SourceMark{*value_.context().file, e.value.line, e.value.column});
  return o;
}

double YamlSection::number(const char* key, const NumberRule& rule, double absent) {
  const auto v = get(key);
  return v ? v->number(rule).value_or(absent) : absent;
}

double YamlSection::required_number(const char* key, const NumberRule& rule, double when_wrong) {
  const auto v = require(key);
  return v ? v->number(rule).value_or(when_wrong) : when_wrong;
}

void YamlSection::vector(const char* key, const char* unit, Vec3& place) {
  if (const auto v = get(key)) place = v->vector(unit).value_or(place);
}

bool YamlSection::boolean(const char* key, bool absent) {
  const auto v = get(key);
  return v ? v->boolean().value_or(absent) : absent;
}

}  // namespace floatframe
