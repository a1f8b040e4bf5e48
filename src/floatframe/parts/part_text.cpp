#include "floatframe/parts/part_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/core/text_pieces.hpp"
#include "floatframe/core/utf8_text.hpp"
#include "floatframe/parts/node_ways.hpp"

namespace floatframe {
namespace {

constexpr const char* ways_text =
    "set:NAME, node:NUMBER, nearest:x,y,z, plane:x,y,z,normal=..., "
    "cylinder:x,y,z,axis=...,radius=... or sphere:x,y,z,radius=...";

/// One occurrence of --interface or --marker, split into its parts.
class PlaceArgument {
 public:
  PlaceArgument(std::string option, const std::string& given) : option_(std::move(option)) {
    const std::string text = utf8_text(given);  // as for file names
    const std::size_t equal = text.find('=');
    const std::size_t colon = text.find(':', equal == std::string::npos ? 0 : equal);
    if (equal == std::string::npos || equal == 0 || colon == std::string::npos)
      throw InputError(ErrorCode::wrong_value,
                       fmt::format("{}: found '{}', expected NAME=WAY:VALUE with one of {}",
                                   option_, text, ways_text));
    name = text.substr(0, equal);
    way_ = text.substr(equal + 1, colon - equal - 1);
    for (const std::string& piece : pieces_of(text.substr(colon + 1), ',')) {
      const std::size_t at = piece.find('=');
      if (pairs_.empty())
        pairs_.emplace_back(way_, piece);
      else if (at != std::string::npos)
        pairs_.emplace_back(piece.substr(0, at), piece.substr(at + 1));
      else if (piece == "residual")
        pairs_.emplace_back(piece, "");
      else
        pairs_.back().second += "," + piece;
    }
  }

  std::string name;

  /// Removes and returns the value of a key; nullopt if it is not given.
  std::optional<std::string> take(const std::string& key) {
    known_.push_back(key);
    std::optional<std::string> out;
    for (auto it = pairs_.begin(); it != pairs_.end();)
      if (it->first == key) {
        if (out) fail(ErrorCode::duplicate, fmt::format("found '{}' twice, expected it once", key));
        out = it->second;
        it = pairs_.erase(it);
      } else {
        ++it;
      }
    return out;
  }
  std::string need(const std::string& key) {
    auto value = take(key);
    if (!value) fail(ErrorCode::missing, fmt::format("'{}' is missing for a {}", key, way_));
    return *value;
  }
  double number(const std::string& key, const std::string& text, bool positive) const {
    const auto x = finite_number(text);
    if (!x || (positive && !(*x > 0.0)))
      fail(ErrorCode::out_of_range, fmt::format("{}: found '{}', expected a {}number", key, text,
                                                positive ? "positive " : ""));
    return *x;
  }
  Vec3 vector(const std::string& key, const std::string& text) const {
    const auto pieces = pieces_of(text, ',');
    if (pieces.size() != 3)
      fail(ErrorCode::wrong_count,
           fmt::format("{}: found '{}', expected three numbers x,y,z", key, text));
    Vec3 v;
    for (int i = 0; i < 3; ++i) v[i] = number(key, pieces[i], false);
    return v;
  }
  Vec3 direction(const std::string& key, const std::string& text) const {
    const bool minus = !text.empty() && text[0] == '-';
    const std::string axis = minus ? text.substr(1) : text;
    if (axis == "x" || axis == "y" || axis == "z")
      return (minus ? -1.0 : 1.0) * Vec3::Unit(axis[0] - 'x');
    const Vec3 v = vector(key, text);
    if (!(v.stableNorm() > 0.0))
      fail(ErrorCode::geometry, key + ": found a vector of length zero, expected a direction");
    return v.stableNormalized();
  }

  NodeChoice choice() {
    const auto ways = node_ways();
    const auto way =
        std::find_if(ways.begin(), ways.end(), [&](const NodeWay& w) { return w.word == way_; });
    if (way == ways.end()) {
      std::vector<std::string> names;
      for (const NodeWay& w : ways) names.emplace_back(w.word);
      fail(ErrorCode::not_found, fmt::format("unknown way '{}'{}; expected one of {}", way_,
                                             did_you_mean(way_, names), ways_text));
    }
    NodeChoice c;
    c.by = way->by;
    for (const NodeWayValue& value : way->values) {
      const bool first = &value == &way->values.front();
      const auto* length = std::get_if<NodeWayValue::Length>(&value.kind);
      const auto text =
          length && !length->required ? take(value.key) : need(first ? way_.c_str() : value.key);
      if (text) put(c, first ? way_ : value.key, value, *text);
    }
    if (way->by_distance)
      if (const auto t = take("tolerance")) c.tolerance = number("tolerance", *t, true);
    return c;
  }

  std::optional<Vec3> at() {
    const auto text = take("at");
    return text ? std::optional<Vec3>(vector("at", *text)) : std::nullopt;
  }

  void finish() const {
    if (pairs_.empty()) return;
    fail(ErrorCode::unknown_key, fmt::format("unknown option '{}'{}", pairs_.front().first,
                                             did_you_mean(pairs_.front().first, known_)));
  }

  [[noreturn]] void fail(ErrorCode code, const std::string& sentence) const {
    throw InputError(code, fmt::format("{} {}: {}", option_, name, sentence));
  }

 private:
  void put(NodeChoice& c, const std::string& key, const NodeWayValue& value,
           const std::string& text) const {
    using V = NodeWayValue;
    if (const auto* name = std::get_if<V::Name>(&value.kind)) {
      if (text.empty())
        fail(ErrorCode::missing, key + ": found nothing, expected the name of a " + key);
      c.*name->at = text;
    } else if (const auto* whole = std::get_if<V::Number>(&value.kind)) {
      const double x = number(key, text, true);
      if (x != std::floor(x) || x > 2147483647.0)
        fail(ErrorCode::out_of_range,
             fmt::format("{0}: found '{1}', expected the number of a {0}", key, text));
      c.*whole->at = static_cast<int>(x);
    } else if (const auto* point = std::get_if<V::Point>(&value.kind)) {
      c.*point->at = vector(key, text);
    } else if (const auto* axis = std::get_if<V::Direction>(&value.kind)) {
      c.*axis->at = direction(key, text);
    } else {
      c.*std::get<V::Length>(value.kind).at = number(key, text, true);
    }
  }

  std::string option_, way_;
  std::vector<std::pair<std::string, std::string>> pairs_;
  std::vector<std::string> known_;
};

unsigned dofs_mask(const PlaceArgument& argument, const std::string& text) {
  if (const auto mask = dofs_of(text)) return *mask;
  argument.fail(
      ErrorCode::wrong_value,
      fmt::format("dofs: found '{}', expected all, or directions such as xyz, x+z or xyz+rz",
                  text));
}

/// "xyz", "x+rz", "all"
std::string dofs_text(unsigned mask) {
  if ((mask & 63u) == 63u) return "all";
  std::string moves, turns;
  for (unsigned k = 0; k < 3; ++k) {
    if (mask & (1u << k)) moves += "xyz"[k];
    if (mask & (8u << k)) turns += "xyz"[k];
  }
  if (turns.empty()) return moves;
  return moves + (moves.empty() ? "r" : "+r") + turns;
}

std::string comma_text(const Vec3& v) { return fmt::format("{},{},{}", v.x(), v.y(), v.z()); }

std::string value_text(const NodeChoice& c, const NodeWayValue& value) {
  using V = NodeWayValue;
  if (const auto* name = std::get_if<V::Name>(&value.kind)) return c.*name->at;
  if (const auto* whole = std::get_if<V::Number>(&value.kind)) return std::to_string(c.*whole->at);
  if (const auto* point = std::get_if<V::Point>(&value.kind)) return comma_text(c.*point->at);
  if (const auto* axis = std::get_if<V::Direction>(&value.kind)) return comma_text(c.*axis->at);
  return fmt::format("{}", c.*std::get<V::Length>(value.kind).at);
}

/// "set:BUSH_F"
std::string place_text(const NodeChoice& c, const std::optional<Vec3>& at) {
  const NodeWay& way = node_way(c.by);
  std::string text = std::string(way.word) + ":" + value_text(c, way.values.front());
  for (std::size_t k = 1; k < way.values.size(); ++k) {
    const NodeWayValue& value = way.values[k];
    const auto* length = std::get_if<NodeWayValue::Length>(&value.kind);
    if (length && !length->required && !(c.*length->at > 0.0)) continue;
    text += std::string(",") + value.key + "=" + value_text(c, value);
  }
  if (way.by_distance && c.tolerance > 0.0) text += fmt::format(",tolerance={}", c.tolerance);
  return text + (at ? ",at=" + comma_text(*at) : "");
}

}  // namespace

std::optional<unsigned> dofs_of(const std::string& text) {
  if (text == "all") return 63u;
  unsigned mask = 0;
  for (std::string piece : pieces_of(text, '+')) {
    const unsigned shift = !piece.empty() && piece[0] == 'r' ? 3u : 0u;
    if (shift > 0) piece.erase(0, 1);
    if (piece.empty()) return std::nullopt;
    for (const char c : piece) {
      if (c < 'x' || c > 'z') return std::nullopt;
      mask |= 1u << (static_cast<unsigned>(c - 'x') + shift);
    }
  }
  return mask;
}

std::string interface_text(const InterfaceDescription& i) {
  return fmt::format("{}={}{}{}", i.name, place_text(i.choice, i.at),
                     i.kind == Spider::Kind::mean ? ",type=mean" : "",
                     i.mask == 63u ? "" : ",dofs=" + dofs_text(i.mask));
}

std::string marker_text(const MarkerDescription& m) {
  return fmt::format("{}={}{}", m.name, place_text(m.choice, m.at), m.residual ? ",residual" : "");
}

std::string material_text(const Material& m) {
  return fmt::format("{},{},{}", m.young, m.poisson, m.density);
}

std::string named_number_text(const std::string& name, double number) {
  return name.empty() ? fmt::format("{}", number) : fmt::format("{}={}", name, number);
}

std::string reference_text(const BodyReference& reference) {
  if (reference.kind == BodyReference::Kind::node) return "node:" + reference.node;
  return reference_words[index_of(reference.kind)];
}

InterfaceDescription interface_argument(const std::string& text) {
  PlaceArgument a("--interface", text);
  InterfaceDescription out;
  out.name = a.name;
  out.choice = a.choice();
  out.at = a.at();
  if (const auto type = a.take("type")) {
    const auto word = std::find(std::begin(tie_words), std::end(tie_words), *type);
    if (word == std::end(tie_words))
      a.fail(ErrorCode::wrong_value,
             fmt::format("type: found '{}', expected {}", *type, alternatives(tie_words)));
    out.kind = static_cast<Spider::Kind>(word - std::begin(tie_words));
  }
  if (const auto dofs = a.take("dofs")) out.mask = dofs_mask(a, *dofs);
  a.finish();
  return out;
}

MarkerDescription marker_argument(const std::string& text) {
  PlaceArgument a("--marker", text);
  MarkerDescription out;
  out.name = a.name;
  out.choice = a.choice();
  out.at = a.at();
  out.residual = a.take("residual").has_value();
  a.finish();
  return out;
}

Material material_argument(const std::string& text) {
  const auto pieces = pieces_of(text, ',');
  std::vector<double> x;
  for (const std::string& piece : pieces)
    if (const auto number = finite_number(piece)) x.push_back(*number);
  if (pieces.size() != 3 || x.size() != 3 || !(x[0] > 0.0) || !(x[1] > -1.0) || !(x[1] < 0.5) ||
      !(x[2] > 0.0))
    throw InputError(ErrorCode::wrong_value,
                     fmt::format("--material: found '{}', expected young,poisson,density in the "
                                 "units of the file, such as 210000,0.3,7.85e-9",
                                 text));
  return {x[0], x[1], x[2]};
}

namespace {

/// "number" or "NAME=number"; nullopt for any other text.
std::optional<std::pair<std::string, double>> named_number(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const bool named = equals != std::string::npos;
  const auto value = finite_number(named ? text.substr(equals + 1) : text);
  if (!value || equals == 0) return {};
  return std::pair{named ? text.substr(0, equals) : "", *value};
}

}  // namespace

std::pair<std::string, double> density_argument(const std::string& text) {
  const auto found = named_number(text);
  if (!found || found->second < 0.0)
    throw InputError(ErrorCode::wrong_value,
                     fmt::format("--density: found '{}', expected a density in the units of the "
                                 "file or MATERIAL=density, such as 7.85e-9 or STEEL=7.85e-9",
                                 text));
  return *found;
}

std::pair<std::string, double> thickness_argument(const std::string& text) {
  const auto found = named_number(text);
  if (!found || !(found->second > 0.0))
    throw InputError(ErrorCode::wrong_value,
                     fmt::format("--thickness: found '{}', expected a thickness above 0 in the "
                                 "units of the file or GROUP=thickness, such as 2 or RIBS=2",
                                 text));
  return *found;
}

BodyReference reference_argument(const std::string& text) {
  using Kind = BodyReference::Kind;
  const auto word = std::find(std::begin(reference_words), std::end(reference_words), text);
  if (word != std::end(reference_words))
    return {static_cast<Kind>(word - std::begin(reference_words)), ""};
  if (text.starts_with("node:") && text.size() > 5) return {Kind::node, text.substr(5)};
  throw InputError(ErrorCode::wrong_value,
                   fmt::format("--reference: found '{}', expected mean_axis, buckens or node:NAME "
                               "with the name of an interface{}",
                               text, did_you_mean(text, {reference_words[0], reference_words[1]})));
}

}  // namespace floatframe
