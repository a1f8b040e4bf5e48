#include "floatframe/fmu/fmu_units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floatframe {
namespace {

struct UnitSymbol {
  std::string_view name;
  FmuUnit unit;
  bool prefixes = false;  ///< k, M, m, ... may stand before it
};

constexpr double degree_in_rad = std::numbers::pi / 180.0;

// Exponents of kg, m, s, A, K, mol, cd, rad.
constexpr UnitSymbol unit_symbols[] = {
    {"kg", {{1}}},
    {"m", {{0, 1}}, true},
    {"s", {{0, 0, 1}}, true},
    {"A", {{0, 0, 0, 1}}, true},
    {"K", {{0, 0, 0, 0, 1}}, true},
    {"mol", {{0, 0, 0, 0, 0, 1}}, true},
    {"cd", {{0, 0, 0, 0, 0, 0, 1}}},
    {"rad", {{0, 0, 0, 0, 0, 0, 0, 1}}, true},
    {"1", {}},
    {"-", {}},
    {"%", {{}, 0.01}},
    {"N", {{1, 1, -2}}, true},
    {"Nm", {{1, 2, -2}}, true},
    {"Pa", {{1, -1, -2}}, true},
    {"J", {{1, 2, -2}}, true},
    {"W", {{1, 2, -3}}, true},
    {"Hz", {{0, 0, -1}}, true},
    {"V", {{1, 2, -3, -1}}, true},
    {"Ohm", {{1, 2, -3, -2}}, true},
    {"bar", {{1, -1, -2}, 1e5}, true},
    {"t", {{1}, 1e3}},
    {"min", {{0, 0, 1}, 60.0}},
    {"h", {{0, 0, 1}, 3600.0}},
    {"l", {{0, 3}, 1e-3}},
    {"deg", {{0, 0, 0, 0, 0, 0, 0, 1}, degree_in_rad}},
    {"°", {{0, 0, 0, 0, 0, 0, 0, 1}, degree_in_rad}},
    {"rev", {{0, 0, 0, 0, 0, 0, 0, 1}, 360.0 * degree_in_rad}},
    {"rpm", {{0, 0, -1, 0, 0, 0, 0, 1}, 6.0 * degree_in_rad}},
    {"mph", {{0, 1, -1}, 0.44704}},
    {"in", {{0, 1}, 0.0254}},
    {"ft", {{0, 1}, 0.3048}},
    {"lb", {{1}, 0.45359237}},
    {"lbf", {{1, 1, -2}, 4.4482216152605}},
};

struct UnitPrefix {
  std::string_view name;
  double factor;
};
constexpr UnitPrefix unit_prefixes[] = {{"G", 1e9},  {"M", 1e6},  {"k", 1e3},  {"h", 1e2},
                                        {"d", 1e-1}, {"c", 1e-2}, {"m", 1e-3}, {"u", 1e-6},
                                        {"µ", 1e-6}, {"μ", 1e-6}, {"n", 1e-9}};

std::optional<FmuUnit> unit_symbol(std::string_view name) {
  for (const UnitSymbol& s : unit_symbols)
    if (s.name == name) return s.unit;
  for (const UnitPrefix& p : unit_prefixes) {
    if (!name.starts_with(p.name)) continue;
    for (const UnitSymbol& s : unit_symbols)
      if (s.prefixes && s.name == name.substr(p.name.size())) {
        FmuUnit unit = s.unit;
        unit.factor *= p.factor;
        return unit;
      }
  }
  return std::nullopt;
}

void multiply(FmuUnit& unit, const FmuUnit& by, int power) {
  for (std::size_t k = 0; k < unit.exponents.size(); ++k)
    unit.exponents[k] += power * by.exponents[k];
  unit.factor *= std::pow(by.factor, power);
}

class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}
  std::optional<FmuUnit> parse() {
    skip_spaces();
    std::optional<FmuUnit> unit = product(0);
    return at_ == text_.size() ? unit : std::nullopt;
  }

 private:
  std::optional<FmuUnit> product(int depth) {
    std::optional<FmuUnit> out = factor(depth);
    bool divided = false;
    while (out) {
      const char sign = separator();
      if (sign == 0) break;
      if (sign == '*' && divided) return std::nullopt;  // "J/kg K"
      divided = divided || sign == '/';
      const std::optional<FmuUnit> next = factor(depth);
      if (!next) return std::nullopt;
      multiply(*out, *next, sign == '/' ? -1 : 1);
    }
    return out;
  }

  /// '/', '*', or 0 at the end of the product.
  char separator() {
    const std::size_t begin = at_;
    skip_spaces();
    if (at_ == text_.size() || text_[at_] == ')') return 0;
    const char c = text_[at_];
    if (c != '/' && c != '*' && c != '.') return at_ > begin ? '*' : '\0';
    ++at_;
    skip_spaces();
    return c == '/' ? '/' : '*';
  }

  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  std::optional<FmuUnit> factor(int depth) {
    std::optional<FmuUnit> unit;
    if (at_ < text_.size() && text_[at_] == '(') {
      if (depth > 8) return std::nullopt;
      ++at_;
      unit = product(depth + 1);
      if (!unit || at_ == text_.size() || text_[at_] != ')') return std::nullopt;
      ++at_;
      numeral_ = false;
    } else {
      unit = symbol();
    }
    if (!unit) return unit;
    FmuUnit out;
    multiply(out, *unit, exponent());
    const auto small = [](int e) { return std::abs(e) < 100; };
    if (!std::all_of(out.exponents.begin(), out.exponents.end(), small)) return std::nullopt;
    return out;
  }

  std::optional<FmuUnit> symbol() {
    const std::size_t end = std::min(text_.find_first_of(" */.()^0123456789-", at_), text_.size());
    std::size_t length = end - at_;
    numeral_ = length == 0;
    if (numeral_ && at_ < text_.size() && (text_[at_] == '1' || text_[at_] == '-')) length = 1;
    std::string_view name = text_.substr(at_, length);
    for (const auto& [sign, power] : powers_)
      if (name.size() > sign.size() && name.ends_with(sign)) name.remove_suffix(sign.size());
    const std::optional<FmuUnit> unit = unit_symbol(name);
    at_ += name.size();
    return unit;
  }

  int exponent() {
    if (numeral_) return 1;
    const std::string_view rest = text_.substr(at_);
    for (const auto& [sign, power] : powers_)
      if (rest.starts_with(sign)) {
        at_ += sign.size();
        return power;
      }
    std::size_t k = rest.starts_with('^') ? 1 : 0;
    const bool negative = k < rest.size() && rest[k] == '-';
    if (negative) ++k;
    if (k == rest.size() || rest[k] < '0' || rest[k] > '9') return 1;
    at_ += k + 1;
    return (negative ? -1 : 1) * (rest[k] - '0');
  }

  static constexpr std::array<std::pair<std::string_view, int>, 2> powers_{{{"²", 2}, {"³", 3}}};
  std::string_view text_;
  std::size_t at_ = 0;
  bool numeral_ = false;  ///< the last symbol is "1" or "-", which has no exponent
};

}  // namespace

std::optional<FmuUnit> fmu_unit(std::string_view text) {
  if (text.empty()) return std::nullopt;
  // A scale with an offset has no products.
  if (text == "degC" || text == "°C") return FmuUnit{{0, 0, 0, 0, 1}, 1.0, 273.15};
  return UnitParser(text).parse();
}

}  // namespace floatframe
