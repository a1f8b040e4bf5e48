// The bars of a flexible body: sections, points, branches; the nodes generated for them, and the
// check that they are connected.
#include <algorithm>
#include <cmath>

#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model_file/read_parts.hpp"

namespace floatframe {
namespace {

struct BarGeometry {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  int elements = 1;
  bool valid = false;
  std::size_t start = 0, inner = 0, end = 0;  ///< nodes: the first, the first inner one, the last
};

class BarReader {
 public:
  BarReader(const ModelInstance& self, FlexibleRead& out) : self_(self), out_(out) {}

  void read(YamlSection& section) {
    if (const auto bars = section.require("bars")) {
      const auto list = bars->named("a map of names to bars");
      if (bars->is_map() && list.empty()) bars->error(ErrorCode::missing, sentences::no_bars());
      for (const auto& [name, value] : list) bar(name, value);
    }
    out_.valid = valid_ && !geometry_.empty();
    if (out_.valid) connectivity();
  }

 private:
  FlexibleDescription& f() { return out_.description; }

  SectionDescription cross_section(const YamlValue& value) {
    const SectionDescription absent = SolidRound{1.0};
    auto s = value.section("a map with round, tube, rectangle, or area, Iy, Iz, J");
    if (!s) return absent;
    SectionDescription result = absent;
    if (const auto v = s->get("round"))
      result = SolidRound{v->number(rules::section_length).value_or(1.0)};
    if (const auto v = s->get("tube")) {
      const auto d = v->numbers(2, 2, rules::section_length, "outer and inner diameter [D, d] [m]");
      const auto complaint = d ? sentences::tube((*d)[0], (*d)[1]) : std::nullopt;
      v->complain(ErrorCode::out_of_range, complaint);
      if (d && !complaint) result = HollowRound{(*d)[0], (*d)[1]};
    }
    if (const auto v = s->get("rectangle")) {
      const auto d = v->numbers(2, 2, rules::section_length, "width and height [w, h] [m]");
      if (d) result = Rectangle{(*d)[0], (*d)[1]};
    }
    constexpr const char* constants[] = {"area", "Iy", "Iz", "J"};
    const auto is_given = [&](const char* key) { return s->has(key); };
    const bool explicit_form = std::any_of(std::begin(constants), std::end(constants), is_given);
    if (explicit_form) {
      SectionConstants c;
      c.A = s->required_number("area", rules::section_area, 1.0);
      c.Iy = s->required_number("Iy", rules::section_moment, 1.0);
      c.Iz = s->required_number("Iz", rules::section_moment, 1.0);
      c.J = s->required_number("J", rules::section_moment, 1.0);
      result = c;
    } else {
      for (const char* key : constants) s->get(key);
    }
    s->finish();
    const int forms = s->has("round") + s->has("tube") + s->has("rectangle") + explicit_form;
    if (forms != 1)
      s->error(ErrorCode::wrong_count,
               "found " + std::to_string(forms) +
                   " sections, expected one of round, tube, rectangle, or area, Iy, Iz, J");
    return result;
  }

  /// A point name of this file.
  std::optional<std::string> point_name(const YamlValue& value) {
    const auto name = value.text("the name of a point");
    if (!name) return std::nullopt;
    const auto p = self_.points.find(*name);
    if (p == self_.points.end()) {
      value.not_known("unknown point '" + *name + "'", *name,
                      [&] { return keys_of(self_.points); });
      return std::nullopt;
    }
    if (!p->second.allFinite()) return std::nullopt;
    f().points.emplace(*name, p->second);
    return name;
  }

  std::size_t node_at(const std::string& name, const Vec3& p) {
    const auto it = out_.named_nodes.find(name);
    if (it != out_.named_nodes.end()) return it->second;
    out_.nodes.push_back(p);
    return out_.named_nodes.emplace(name, out_.nodes.size() - 1).first->second;
  }

  void bar(const std::string& name, const YamlValue& value) {
    auto s = value.section("a bar with from, to, elements, section");
    if (!s) {
      valid_ = false;
      return;
    }
    BarDescription b;
    BarGeometry g;
    b.name = name;
    b.origin = s->origin();
    bool good = true;
    const auto elements = s->require("elements");
    b.elements = elements ? elements->integer(rules::elements).value_or(1) : 1;
    if (!self_.context.errors->take_of("elements in all bars", b.elements, limits::elements,
                                       elements ? elements->mark() : s->mark(), value.path())) {
      valid_ = false;
      return;
    }
    const auto from = s->require("from");
    if (from && from->is_map()) {
      good = branch(*from, b, g);
    } else {
      const auto p = from ? point_name(*from) : std::nullopt;
      good = p.has_value();
      if (p) {
        b.from = *p;
        g.from = f().points.at(*p);
        g.start = node_at(*p, g.from);
        graph(g.start);
      }
    }
    const auto to = s->require("to");
    const auto q = to ? point_name(*to) : std::nullopt;
    good = good && q;
    if (q) b.to = *q, g.to = f().points.at(*q);
    if (const auto v = s->require("section")) b.section = cross_section(*v);
    const auto reference = s->get("reference");
    auto direction = reference ? read_direction(*reference) : std::nullopt;
    if (direction) direction = direction->stableNormalized();
    s->finish();
    if (good) {
      const Vec3 axis = g.to - g.from;
      if (const auto complaint = sentences::bar_length(axis.norm())) {
        s->error(ErrorCode::out_of_range, *complaint);
        good = false;
      } else {
        b.reference = direction.value_or(
            sentences::parallel_to_bar(axis, Vec3::UnitZ()) ? Vec3::UnitX() : Vec3::UnitZ());
        if (direction)
          reference->complain(ErrorCode::geometry, sentences::bar_reference(axis, *direction));
      }
    }
    g.elements = b.elements;
    g.valid = good;
    if (good) {
      g.inner = out_.nodes.size();
      for (int k = 1; k < b.elements; ++k) {
        out_.nodes.push_back(g.from + (g.to - g.from) * k / b.elements);
        graph(out_.nodes.size() - 1);
      }
      g.end = node_at(b.to, g.to);
      graph(g.end);
      unite(g.start, g.end);
      for (int k = 1; k < b.elements; ++k) unite(g.start, g.inner + k - 1);
      if (f().bars.empty()) out_.first_point = g.from;
      links_.emplace_back(g.start, value);
    } else {
      valid_ = false;
    }
    geometry_[name] = g;
    f().bars.push_back(std::move(b));
  }

  /// from: {bar: name, at: fraction}
  bool branch(const YamlValue& value, BarDescription& b, BarGeometry& g) {
    auto s = value.section();
    const auto bar_value = s->require("bar");
    const auto at_value = s->require("at");
    s->finish();
    const auto name = bar_value ? bar_value->text("the name of an earlier bar") : std::nullopt;
    const double at = at_value ? at_value->number(rules::fraction).value_or(-1.0) : -1.0;
    if (!name) return false;
    const auto it = geometry_.find(*name);
    if (it == geometry_.end()) {
      const auto known = [&] { return keys_of(geometry_); };
      bar_value->error(
          ErrorCode::not_found,
          sentences::unknown_bar(*name, self_.context.errors->suggestion(*name, known)));
      return false;
    }
    if (at < 0.0 || !it->second.valid) return false;
    const BarGeometry& other = it->second;
    const double position = at * other.elements;
    const double nearest = std::round(position);
    if (std::abs(position - nearest) > 1e-6) {
      const double low = std::floor(position), high = std::ceil(position);
      at_value->error(ErrorCode::not_found, "found " + number_text(at) + ", but bar '" + *name +
                                                "' has " + std::to_string(other.elements) +
                                                " elements and no node there; the nearest are at " +
                                                fraction(low, other.elements) + " and " +
                                                fraction(high, other.elements));
      return false;
    }
    b.from_bar = *name;
    b.from_fraction = at;
    g.from = other.from + (other.to - other.from) * (nearest / other.elements);
    const int k = static_cast<int>(nearest);
    g.start = k == 0 ? other.start : k == other.elements ? other.end : other.inner + k - 1;
    return true;
  }

  static std::string fraction(double k, int n) {
    return number_text(k) + "/" + std::to_string(n) + " = " +
           number_text(std::round(k / n * 1e6) / 1e6);
  }

  // Groups of connected nodes.
  void graph(std::size_t node) {
    while (parent_.size() <= node) parent_.push_back(parent_.size());
  }
  std::size_t leader(std::size_t n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  void unite(std::size_t a, std::size_t b) {
    graph(std::max(a, b));
    parent_[leader(a)] = leader(b);
  }
  void connectivity() {
    for (const auto& [node, value] : links_)
      if (leader(node) != leader(links_.front().first)) {
        value.entity_error(ErrorCode::not_found,
                           sentences::bar_not_connected(f().bars.front().name));
        return;
      }
  }

  const ModelInstance& self_;
  FlexibleRead& out_;
  bool valid_ = true;
  std::map<std::string, BarGeometry> geometry_;
  std::vector<std::size_t> parent_;
  std::vector<std::pair<std::size_t, YamlValue>> links_;  // start node of each bar
};

}  // namespace

void read_bars(const ModelInstance& self, YamlSection& section, FlexibleRead& out) {
  BarReader(self, out).read(section);
}

}  // namespace floatframe
