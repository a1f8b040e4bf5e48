#include "floatframe/apps/part_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "floatframe/core/suggest.hpp"

namespace floatframe {
namespace {

constexpr const char* ways_text =
    "set:NAME, node:NUMBER, nearest:x,y,z, plane:x,y,z,normal=..., "
    "cylinder:x,y,z,axis=...,radius=... or sphere:x,y,z,radius=...";

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> out{""};
  for (const char c : text)
    if (c == at)
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

/// One occurrence of --interface or --marker, taken apart.
class PlaceArgument {
 public:
  PlaceArgument(std::string option, const std::string& text) : option_(std::move(option)) {
    const std::size_t equal = text.find('=');
    const std::size_t colon = text.find(':', equal == std::string::npos ? 0 : equal);
    if (equal == std::string::npos || equal == 0 || colon == std::string::npos)
      throw InputError(fmt::format("{}: found '{}', expected NAME=WAY:VALUE with one of {}",
                                   option_, text, ways_text));
    name = text.substr(0, equal);
    way_ = text.substr(equal + 1, colon - equal - 1);
    for (const std::string& piece : split(text.substr(colon + 1), ',')) {
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

  /// The value of a key, which is then taken; nullopt if it is not there.
  std::optional<std::string> take(const std::string& key) {
    known_.push_back(key);
    std::optional<std::string> out;
    for (auto it = pairs_.begin(); it != pairs_.end();)
      if (it->first == key) {
        if (out) fail(fmt::format("found '{}' twice, expected it once", key));
        out = it->second;
        it = pairs_.erase(it);
      } else {
        ++it;
      }
    return out;
  }
  std::string need(const std::string& key) {
    auto value = take(key);
    if (!value) fail(fmt::format("'{}' is missing for a {}", key, way_));
    return *value;
  }
  double number(const std::string& key, const std::string& text, bool positive) const {
    char* end = nullptr;
    const double x = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(x) || (positive && !(x > 0.0)))
      fail(fmt::format("{}: found '{}', expected a {}number", key, text,
                       positive ? "positive " : ""));
    return x;
  }
  Vec3 vector(const std::string& key, const std::string& text) const {
    const auto pieces = split(text, ',');
    if (pieces.size() != 3)
      fail(fmt::format("{}: found '{}', expected three numbers x,y,z", key, text));
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
      fail(key + ": found a vector of length zero, expected a direction");
    return v.stableNormalized();
  }

  NodeChoice choice() {
    using By = NodeChoice::By;
    const std::vector<std::pair<std::string, By>> ways{
        {"set", By::set},     {"node", By::node},         {"nearest", By::nearest},
        {"plane", By::plane}, {"cylinder", By::cylinder}, {"sphere", By::sphere}};
    NodeChoice c;
    const auto it =
        std::find_if(ways.begin(), ways.end(), [&](const auto& w) { return w.first == way_; });
    if (it == ways.end()) {
      std::vector<std::string> names;
      for (const auto& w : ways) names.push_back(w.first);
      fail(fmt::format("unknown way '{}'{}; expected one of {}", way_, did_you_mean(way_, names),
                       ways_text));
    }
    c.by = it->second;
    const std::string value = need(way_);
    switch (c.by) {
      case By::set:
        if (value.empty()) fail("set: found nothing, expected the name of a set");
        c.set = value;
        break;
      case By::node: {
        const double x = number(way_, value, true);
        if (x != std::floor(x) || x > 2147483647.0)
          fail(fmt::format("node: found '{}', expected the number of a node", value));
        c.number = static_cast<int>(x);
        break;
      }
      case By::nearest:
        c.point = vector(way_, value);
        break;
      case By::plane:
        c.point = vector(way_, value);
        c.axis = direction("normal", need("normal"));
        break;
      case By::cylinder:
        c.point = vector(way_, value);
        c.axis = direction("axis", need("axis"));
        c.radius = number("radius", need("radius"), true);
        if (const auto length = take("length")) c.length = number("length", *length, true);
        break;
      case By::sphere:
        c.point = vector(way_, value);
        c.radius = number("radius", need("radius"), true);
        break;
    }
    if (c.by == By::plane || c.by == By::cylinder || c.by == By::sphere)
      if (const auto t = take("tolerance")) c.tolerance = number("tolerance", *t, true);
    return c;
  }

  std::optional<Vec3> at() {
    const auto text = take("at");
    return text ? std::optional<Vec3>(vector("at", *text)) : std::nullopt;
  }

  void finish() const {
    if (pairs_.empty()) return;
    fail(fmt::format("unknown option '{}'{}", pairs_.front().first,
                     did_you_mean(pairs_.front().first, known_)));
  }

  [[noreturn]] void fail(const std::string& sentence) const {
    throw InputError(fmt::format("{} {}: {}", option_, name, sentence));
  }

 private:
  std::string option_, way_;
  std::vector<std::pair<std::string, std::string>> pairs_;
  std::vector<std::string> known_;
};

/// "all", or pieces like xyz, rz, joined by +.
unsigned dofs_mask(const PlaceArgument& argument, const std::string& text) {
  if (text == "all") return 63u;
  unsigned mask = 0;
  for (std::string piece : split(text, '+')) {
    const unsigned shift = !piece.empty() && piece[0] == 'r' ? 3u : 0u;
    if (shift > 0) piece.erase(0, 1);
    bool good = !piece.empty();
    for (const char c : piece) {
      good = good && c >= 'x' && c <= 'z';
      if (good) mask |= 1u << (static_cast<unsigned>(c - 'x') + shift);
    }
    if (!good)
      argument.fail(
          fmt::format("dofs: found '{}', expected all, or directions such as xyz, x+z or "
                      "xyz+rz",
                      text));
  }
  return mask;
}

}  // namespace

InterfaceDescription interface_argument(const std::string& text) {
  PlaceArgument a("--interface", text);
  InterfaceDescription out;
  out.name = a.name;
  out.choice = a.choice();
  out.at = a.at();
  if (const auto type = a.take("type")) {
    if (*type != "rigid" && *type != "mean")
      a.fail(fmt::format("type: found '{}', expected rigid or mean", *type));
    out.kind = *type == "mean" ? Spider::Kind::mean : Spider::Kind::rigid;
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
  const auto pieces = split(text, ',');
  double x[3] = {};
  bool good = pieces.size() == 3;
  for (std::size_t k = 0; good && k < 3; ++k) {
    char* end = nullptr;
    x[k] = std::strtod(pieces[k].c_str(), &end);
    good = !pieces[k].empty() && *end == '\0' && std::isfinite(x[k]);
  }
  if (!good || !(x[0] > 0.0) || !(x[1] > -1.0) || !(x[1] < 0.5) || !(x[2] > 0.0))
    throw InputError(
        fmt::format("--material: found '{}', expected young,poisson,density in the "
                    "units of the file, such as 210000,0.3,7.85e-9",
                    text));
  return {x[0], x[1], x[2]};
}

BodyReference reference_argument(const std::string& text) {
  using Kind = BodyReference::Kind;
  if (text == "mean_axis") return {Kind::mean_axis, ""};
  if (text == "buckens") return {Kind::buckens, ""};
  if (text.starts_with("node:") && text.size() > 5) return {Kind::node, text.substr(5)};
  throw InputError(
      fmt::format("--reference: found '{}', expected mean_axis, buckens or node:NAME "
                  "with the name of an interface{}",
                  text, did_you_mean(text, {"mean_axis", "buckens"})));
}

}  // namespace floatframe
