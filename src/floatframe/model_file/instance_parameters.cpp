#include "floatframe/model_file/instance_parameters.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/formulas/function_words.hpp"
#include "floatframe/yaml/expressions_read.hpp"

namespace floatframe {
namespace {

/// True if an expression in `text` uses `name`.
bool mentions(std::string_view text, std::string_view name) {
  const auto part_of_name = [&](std::size_t k) {
    return k < text.size() && is_identifier(std::string("_") + text[k]);
  };
  for (std::size_t open = text.find("${"); open != std::string_view::npos;
       open = text.find("${", open)) {
    const std::size_t close = std::min(text.find('}', open), text.size());
    for (std::size_t k = text.find(name, open); k < close; k = text.find(name, k + 1))
      if (!part_of_name(k - 1) && !part_of_name(k + name.size())) return true;
    open = close;
  }
  return false;
}

/// "speed, mass or length", the first of them, or that there are none.
std::string known_parameters_text(const std::vector<std::string>& known) {
  constexpr std::size_t most = 20;
  if (known.empty()) return "none: the file declares no parameters";
  std::vector<const char*> words;
  for (std::size_t i = 0; i < std::min(known.size(), most); ++i) words.push_back(known[i].c_str());
  const std::string more = std::to_string(known.size() - words.size()) + " more";
  if (known.size() > most) words.push_back(more.c_str());
  return alternatives(words);
}

std::string shown(const ParameterValue& v) {
  std::string text = value_text(v);
  if (v.index() == 2) {
    text.insert(text.begin(), '\'');
    text += '\'';
  }
  return text;
}

/// The value of an entry: itself, or `value` of a map that says more.
std::optional<YamlValue> declared_value(const YamlValue& entry, ParameterWords& words) {
  if (!entry.is_map()) return entry;
  YamlSection section(entry);
  auto value = section.require("value");
  if (const auto unit = section.get("unit")) words.unit = unit->text("a unit").value_or("");
  if (const auto about = section.get("about"))
    words.about = about->text("what the parameter is").value_or("");
  section.finish();
  return value;
}

/// For models that are packed: what the value of a parameter follows from.
void note_meaning(const ModelInstance& self, const std::string& name, const YamlValue& value,
                  const ParameterValue& v, const GivenParameter* given) {
  auto* read = ExpressionsRead::current();
  if (!read) return;
  const bool outermost = self.outer == nullptr;
  if (given && given->scope)
    read->declare_as(self.scope, name, given->text, *given->scope, v);
  else if (given)
    read->declare(self.scope, name, v, outermost);
  else if (value.is_scalar() && value.node().text.find("${") != std::string::npos)
    read->declare_as(self.scope, name, value.node().text, self.scope, v);
  else
    read->declare(self.scope, name, v, outermost);
}

/// Values from outside, the last one of the type of the declared one.
void take_given(const std::vector<const GivenParameter*>& given, const std::string& name,
                ReadErrors& errors, std::optional<ParameterValue>& v) {
  for (const GivenParameter* g : given) {
    if (v && v->index() == 2 && !g->raw.empty())
      v = g->raw;
    else if (!g->complaint.empty())
      errors.add(
          ErrorCode::out_of_range, g->mark,
          g->subject + " " + name + "=" + g->raw + ": found " + g->raw + " (" + g->complaint + ")");
    else if (v && v->index() != g->value.index())
      errors.add(
          ErrorCode::wrong_value, g->mark,
          g->subject + "." + name + ": found " + shown(g->value) + ", expected " + type_name(*v));
    else
      v = g->value;
  }
}

}  // namespace

std::optional<GivenParameter> read_override(const ParameterOverride& o, const std::string& path,
                                            ReadErrors& errors) {
  const SourceMark mark{path, 0, 0};
  const auto refuse = [&](ErrorCode code, const std::string& why) {
    errors.add(code, mark, "--set " + o.name + "=" + o.value.substr(0, 100) + ": " + why);
    return std::nullopt;
  };
  if (o.value.size() > longest_text)
    return refuse(ErrorCode::out_of_range, "found a text of " + std::to_string(o.value.size()) +
                                               " characters, expected at most " +
                                               std::to_string(longest_text));
  if (printable(o.value) != o.value)
    return refuse(ErrorCode::wrong_value, "expected UTF-8 text without control characters");
  GivenParameter given{o.name, {}, mark, "--set", {}, {}};
  const std::size_t n = o.value.size();
  if (n > 2 && (o.value[0] == '\'' || o.value[0] == '"') && o.value[n - 1] == o.value[0]) {
    given.raw = o.value.substr(1, n - 2);
    given.value = given.raw;
    return given;
  }
  if (o.value.find("${") != std::string::npos) {
    try {
      given.value = substitute_parameters(o.value, {});
    } catch (const ExpressionError& error) {
      return refuse(ErrorCode::wrong_value, error.what());
    }
    return given;
  }
  const PlainScalar p = classify_plain_scalar(o.value);
  if (o.value.empty()) return refuse(ErrorCode::missing, "found nothing, expected a value");
  given.raw = o.value;
  given.value = given.raw;
  if (p.kind == PlainScalar::Kind::number) given.value = p.number;
  if (p.kind == PlainScalar::Kind::boolean) given.value = p.boolean;
  given.complaint =
      p.kind == PlainScalar::Kind::null ? std::string("this is no value") : p.complaint;
  return given;
}

void read_parameters(ModelInstance& self, const std::vector<GivenParameter>& given) {
  ReadErrors& errors = *self.context.errors;
  std::multimap<std::string, std::size_t> by_name;  // in the order given
  for (std::size_t i = 0; i < given.size(); ++i) by_name.emplace(given[i].name, i);
  std::vector<bool> used(given.size(), false);
  std::vector<std::string> known;
  if (const auto list = self.root->get("parameters")) {
    const auto declared = list->named("a map of names to values");
    std::set<std::string> hiding;  // not declared yet, but will hide a constant
    for (const auto& [name, value] : declared) {
      known.push_back(name);
      if (is_constant_name(name)) hiding.insert(name);
    }
    for (const auto& [name, value] : declared) {
      if (is_reserved_name(name)) {
        value.entity_error(ErrorCode::duplicate, "the name is used by the expression language");
        continue;
      }
      if (!is_identifier(name)) {
        value.entity_error(ErrorCode::wrong_value,
                           "found a hyphen, expected letters, digits and _ in a parameter name");
        continue;
      }
      ParameterWords words;
      const auto inner = declared_value(value, words);
      if (!inner) {
        self.scope.emplace(name, 1.0);
        continue;
      }
      for (const std::string& later : hiding)
        if (inner->is_scalar() && mentions(inner->node().text, later))
          inner->error(ErrorCode::contradiction, "found " + inner->found() +
                                                     ", but the parameter '" + later +
                                                     "', which takes the place of the constant, is "
                                                     "declared later; expected it before its uses");
      hiding.erase(name);
      auto v = inner->parameter();
      std::vector<const GivenParameter*> own;
      for (auto [it, end] = by_name.equal_range(name); it != end; ++it) {
        used[it->second] = true;
        own.push_back(&given[it->second]);
      }
      take_given(own, name, errors, v);
      // An invalid parameter is still declared, so that its uses are not errors too.
      if (v && v->index() == 2 &&
          !errors.take_of("characters in the texts of all parameters",
                          std::get<std::string>(*v).size(), limits::parameter_text, inner->mark(),
                          inner->path()))
        v = std::string("?");
      self.scope.emplace(name, v.value_or(1.0));
      if (!v) continue;
      note_meaning(self, name, *inner, *v, own.empty() ? nullptr : own.back());
      if (auto* read = ExpressionsRead::current(); read && !self.outer)
        read->describe(name, std::move(words));
    }
  }
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!used[i]) {
      std::string hint = errors.suggestion(given[i].name, [&] { return known; });
      if (hint.empty()) hint = ", expected " + known_parameters_text(known);
      errors.add(ErrorCode::unknown_key, given[i].mark,
                 given[i].subject + ": unknown parameter '" + given[i].name + "'" + hint);
    }
}

}  // namespace floatframe
