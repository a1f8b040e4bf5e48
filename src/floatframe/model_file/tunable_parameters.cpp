#include "floatframe/model_file/tunable_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "floatframe/formulas/function_words.hpp"
#include "floatframe/model_file/changed_entity.hpp"
#include "floatframe/model_file/description_numbers.hpp"
#include "floatframe/model_file/matched_number.hpp"

namespace floatframe {
namespace {

using Places = std::set<std::size_t>;

/// What differs between two descriptions.
struct Difference {
  enum class Kind { numbers, structure, bodies } kind = Kind::numbers;
  Places places;  ///< of numbers
};
Difference difference(const DescriptionBytes& a, const DescriptionBytes& b) {
  Difference out;
  out.kind = Difference::Kind::structure;
  if (a.bytes.size() != b.bytes.size() || a.doubles != b.doubles || a.bodies != b.bodies)
    return out;
  std::size_t at = 0;
  bool bodies = false;
  for (std::size_t k = 0; k <= a.doubles.size(); ++k) {
    const std::size_t end = k < a.doubles.size() ? a.doubles[k] : a.bytes.size();
    if (!std::equal(a.bytes.begin() + at, a.bytes.begin() + end, b.bytes.begin() + at)) return out;
    at = end + 8;
    if (k == a.doubles.size() || number_at(a, k) == number_at(b, k)) continue;
    bodies = bodies || a.doubles[k] >= a.bodies;
    out.places.insert(k);
  }
  out.kind = bodies ? Difference::Kind::bodies : Difference::Kind::numbers;
  return out;
}

/// A number from -1 to 1 that is like no other.
double scattered(std::size_t n) {
  const double x = std::fmod(0.6180339887498949 * (n + 1), 1.0);
  return 2.0 * std::fmod(97.0 * x * x, 1.0) - 1.0;
}
/// A value near another one.
double beside(double x, std::size_t n) {
  const double s = scattered(n), part = (s < 0.0 ? -0.01 : 0.01) + 0.04 * s;
  return x == 0.0 ? part : x * (1.0 + part);
}

SyntaxNode with_values(SyntaxNode node, const ParameterNumbers& values) {
  if (node.kind == SyntaxNode::Kind::name)
    if (const auto it = values.find(node.word); it != values.end())
      return {SyntaxNode::Kind::number, it->second, "", {}};
  for (SyntaxNode& part : node.parts) part = with_values(std::move(part), values);
  return node;
}

class Search {
 public:
  Search(const ModelDescription& given, const ExpressionsRead& read,
         const DescriptionReader& reader)
      : given_(given), read_(read), reader_(reader), base_(bytes_without_formula_texts(given)) {
    for (const auto& [name, value] : read.free()) values_[name] = value;
  }

  TunableParameters run() {
    for (const auto& [name, value] : read_.free()) alone(name, value);
    for (bool again = true; again;) {
      again = !match();
      if (!again) again = !verify();
    }
    return result();
  }

 private:
  void fix(const std::string& name, const std::string& why) {
    changes_.erase(name);
    fixed_.push_back("parameter '" + name + "' is fixed when the model is packed: " + why);
  }
  std::optional<ModelDescription> read_with(const ParameterNumbers& values,
                                            std::string* why = nullptr) const {
    std::vector<ParameterOverride> list;
    for (const auto& [name, value] : values) list.push_back({name, number_text(value)});
    try {
      return reader_(list);
    } catch (const InputError& e) {
      if (why) *why = e.errors().empty() ? e.what() : e.errors().front().message;
      return std::nullopt;
    }
  }

  /// What a parameter changes by itself, slightly.
  void alone(const std::string& name, double value) {
    if (const auto it = read_.deciding().find(name); it != read_.deciding().end())
      return fix(name, "it decides '${" + it->second + "}', which is no number");
    if (is_constant_name(name) || name == "t" || name == "time")
      return fix(name, "its name has another meaning in formulas");
    std::string why;
    std::optional<ModelDescription> changed;
    double at = value;
    for (std::size_t n = 0; n < 6 && !changed; ++n)
      changed = read_with({{name, at = beside(value, n)}}, &why);
    if (!changed) return fix(name, "with another value, " + why);
    const Difference d = difference(base_, bytes_without_formula_texts(*changed));
    if (d.kind == Difference::Kind::structure)
      return fix(name, "more than numbers follows from it in " + changed_entity(given_, *changed));
    if (d.kind == Difference::Kind::bodies)
      return fix(
          name, "shape, place or modes of " + changed_entity(given_, *changed) + " follow from it");
    if (d.places.empty()) return fix(name, "nothing follows from it");
    changes_[name] = d.places;
    beside_[name] = at;
  }

  /// Values of all parameters that are not fixed, and the numbers there.
  bool take_sets() {
    sets_.clear();
    numbers_.clear();
    constexpr std::size_t most = 4, attempts = 40;
    for (std::size_t n = 1; n < attempts && sets_.size() < most; ++n) {
      ParameterNumbers set = values_, moved;
      std::size_t k = 0;
      for (const auto& [name, places] : changes_)
        set[name] = moved[name] = beside(values_[name], 7 * n + 13 * ++k);
      const auto changed = read_with(moved);
      if (!changed) continue;
      const DescriptionBytes bytes = bytes_without_formula_texts(*changed);
      if (difference(base_, bytes).kind != Difference::Kind::numbers) continue;
      sets_.push_back(set);
      numbers_.push_back(bytes);
    }
    if (sets_.size() < most) return false;
    sets_.push_back(values_);
    numbers_.push_back(base_);
    return true;
  }

  /// The expressions with the values of what is fixed.
  std::vector<CandidateExpression> candidates() const {
    ParameterNumbers constant = values_;
    for (const auto& [name, places] : changes_) constant.erase(name);
    std::set<std::string> texts;
    for (const std::string& text : read_.numbers())
      texts.insert(expression_text(with_values(parse_expression(text), constant)));
    std::vector<CandidateExpression> out;
    for (const std::string& text : texts)
      if (auto c = candidate(text, sets_); c && !c->formula->references.empty())
        out.push_back(std::move(*c));
    return out;
  }

  /// False: a parameter was fixed, so that what was found no longer holds.
  bool match() {
    matches_.clear();
    if (changes_.empty()) return true;
    if (!take_sets()) {
      const std::string name = changes_.begin()->first;
      fix(name, "together with others more than numbers follows from it");
      return false;
    }
    Places places;
    for (const auto& [name, of_one] : changes_) places.insert(of_one.begin(), of_one.end());
    for (const DescriptionBytes& n : numbers_) places.merge(difference(base_, n).places);
    const std::vector<CandidateExpression> expressions = candidates();
    for (const std::size_t place : places) {
      std::vector<double> y;
      for (const DescriptionBytes& n : numbers_) y.push_back(number_at(n, place));
      if (const auto m = matched_number(expressions, y, sets_)) {
        matches_[place] = *m;
        continue;
      }
      return unexplained(place);
    }
    return true;
  }

  bool unexplained(std::size_t place) {
    std::vector<std::string> names;
    for (const auto& [name, of_one] : changes_)
      if (of_one.contains(place)) names.push_back(name);
    if (names.empty()) names.push_back(changes_.begin()->first);
    for (const std::string& name : names) {
      const auto changed = read_with({{name, beside_[name]}});
      std::optional<std::pair<double, double>> pair;
      if (changed)
        pair.emplace(number_at(base_, place),
                     number_at(bytes_without_formula_texts(*changed), place));
      fix(name, "a number of " + (changed ? changed_entity(given_, *changed, pair) : "the model") +
                    " is computed from it and is none of its expressions");
    }
    return false;
  }

  /// Far from the present value, where readers may do something else.
  bool verify() {
    for (const auto& [name, places] : changes_) {
      const double v = values_[name];
      for (const double far : {0.0, 1.0, 2.0, std::round(v), -v, 10.0 * v, 0.1 * v}) {
        const auto changed = far == v ? std::nullopt : read_with({{name, far}});
        if (!changed || holds(name, far, bytes_without_formula_texts(*changed))) continue;
        fix(std::string(name), "with " + number_text(far) +
                                   " more than numbers follows from it in " +
                                   changed_entity(given_, *changed));
        return false;
      }
    }
    return true;
  }
  bool holds(const std::string& name, double value, const DescriptionBytes& there) const {
    const Difference d = difference(base_, there);
    if (d.kind != Difference::Kind::numbers) return false;
    ParameterNumbers set = values_;
    set[name] = value;
    const auto expected = [&](const MatchedNumber& m) {
      const auto c = candidate(m.text, {&set, 1});
      return c ? m.factor * c->values[0] : std::numeric_limits<double>::quiet_NaN();
    };
    for (const auto& [place, m] : matches_)
      if (expected(m) != number_at(there, place)) return false;
    return std::all_of(d.places.begin(), d.places.end(),
                       [&](std::size_t place) { return matches_.contains(place); });
  }

  TunableParameters result() const {
    TunableParameters out;
    for (const auto& [name, value] : read_.free()) {
      if (!changes_.contains(name)) continue;
      const auto words = read_.words().find(name);
      const ParameterWords said = words == read_.words().end() ? ParameterWords() : words->second;
      out.parameters.push_back({name, said.unit, said.about, value});
    }
    std::map<std::string, std::uint32_t> known;
    for (const auto& [place, m] : matches_) {
      const auto [it, fresh] = known.emplace(m.text, std::uint32_t(out.formulas.size()));
      if (fresh) out.formulas.push_back(parameter_formula(m.text));
      out.numbers.push_back({place, it->second, m.factor, number_at(base_, place)});
    }
    out.fixed = fixed_;
    for (const std::string& name : read_.following())
      out.fixed.push_back("parameter '" + name + "' follows from others");
    return out;
  }

  const ModelDescription& given_;
  const ExpressionsRead& read_;
  const DescriptionReader& reader_;
  const DescriptionBytes base_;
  ParameterNumbers values_;                ///< of all free parameters
  std::map<std::string, Places> changes_;  ///< of those that are not fixed
  std::map<std::string, double> beside_;
  std::vector<ParameterNumbers> sets_;
  std::vector<DescriptionBytes> numbers_;
  std::map<std::size_t, MatchedNumber> matches_;
  std::vector<std::string> fixed_;
};

}  // namespace

TunableParameters tunable_parameters(const ModelDescription& given, const ExpressionsRead& read,
                                     const DescriptionReader& reader) {
  return Search(given, read, reader).run();
}

}  // namespace floatframe
