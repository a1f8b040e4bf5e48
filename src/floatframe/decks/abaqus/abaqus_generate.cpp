// Nodes and elements that decks have generated: *NGEN between two nodes, *NFILL between two sets,
// *NCOPY with a shift, *ELGEN in rows and layers, *ELCOPY.
// Source: Abaqus Keywords Guide.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/decks/abaqus/abaqus_arc.hpp"
#include "floatframe/decks/abaqus/abaqus_handlers.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr int most_nested = 50;

/// Puts nodes and elements into the content, as if they stood in the deck at a line.
class Generated {
 public:
  Generated(AbaqusLines& lines, AbaqusContent& content, std::string_view nodes,
            std::string_view elements)
      : lines_(lines), content_(content) {
    if (!nodes.empty()) nodes_ = set(content.node_sets, nodes);
    if (!elements.empty()) elements_ = set(content.element_sets, elements);
  }

  /// The place of a node; nothing and an error if it is not there.
  std::optional<Vec3> place(int id) {
    const auto it = content_.node_of_label.find(AbaqusContent::label(content_.scope, id));
    if (it != content_.node_of_label.end()) return content_.nodes[it->second].p;
    lines_.source().error(ErrorCode::not_found, "node {} does not exist before this line", id);
    return std::nullopt;
  }

  /// A node that is there already must be at the same place.
  void node(std::int64_t id, const Vec3& p, double size) {
    if (!is_number(id, "node")) return;
    const int number = static_cast<int>(id);
    const auto [it, added] = content_.node_of_label.emplace(
        AbaqusContent::label(content_.scope, number), static_cast<int>(content_.nodes.size()));
    if (added) {
      content_.nodes.push_back({number, content_.scope, p, lines_.source().here()});
    } else if ((content_.nodes[it->second].p - p).norm() > 1e-6 * size) {
      const SourceMark first = lines_.source().mark(content_.nodes[it->second].at);
      lines_.source().error(ErrorCode::duplicate,
                            "node {} is there already at another place ({}:{})", number, first.file,
                            first.line);
      return;
    }
    belongs(nodes_, number);
  }

  /// An element like another one with other numbers.
  void element(const AbaqusElement& like, std::int64_t id, std::int64_t node_increment) {
    if (like.directed)
      return lines_.source().error(
          ErrorCode::unsupported,
          "element {} has a node for its orientation, which copies do not have", like.id);
    if (!is_number(id, "element")) return;
    const int number = static_cast<int>(id);
    const auto [it, added] = content_.element_of_label.emplace(
        AbaqusContent::label(content_.scope, number), static_cast<int>(content_.elements.size()));
    if (!added) {
      const SourceMark first = lines_.source().mark(content_.elements[it->second].at);
      lines_.source().error(ErrorCode::duplicate, "element {} is there already ({}:{})", number,
                            first.file, first.line);
      return;
    }
    AbaqusElement element = like;
    element.id = number;
    element.first = content_.element_nodes.size();
    element.at = lines_.source().here();
    for (int k = 0; k < like.type->nodes; ++k) {
      const std::int64_t node = content_.element_nodes[like.first + k] + node_increment;
      content_.element_nodes.push_back(is_number(node, "node") ? static_cast<int>(node) : 0);
    }
    content_.elements.push_back(element);
    belongs(elements_, number);
  }

  void belongs_too(int element) { belongs(elements_, element); }

  const AbaqusElement* find_element(int id) {
    const auto it = content_.element_of_label.find(AbaqusContent::label(content_.scope, id));
    if (it != content_.element_of_label.end()) return &content_.elements[it->second];
    lines_.source().error(ErrorCode::not_found, "element {} does not exist before this line", id);
    return nullptr;
  }

  /// Numbers of a set or of one node or element; nothing and an error if there are none.
  std::vector<int> numbers(std::string_view field, bool of_nodes) {
    std::vector<int> out;
    const AbaqusReference r = content_.reference(field, lines_.source().here());
    append(r, of_nodes, out, 0);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    if (out.empty())
      lines_.source().error(ErrorCode::missing, "{} has no members before this line",
                            content_.text(r, of_nodes ? "node" : "element"));
    return out;
  }

 private:
  AbaqusSet* set(std::map<AbaqusContent::Key, AbaqusSet>& sets, std::string_view name) {
    AbaqusSet& out = sets[{content_.scope, content_.intern(abaqus_name(name))}];
    if (out.at.line == 0) out.at = lines_.source().here();
    return &out;
  }

  void belongs(AbaqusSet* set, int number) {
    if (set == nullptr) return;
    // Numbers one after another are one range.
    if (!set->items.empty()) {
      AbaqusReference& last = set->items.back();
      if (last.name < 0 && last.scope == content_.scope && last.step == 1 &&
          number == static_cast<std::int64_t>(last.last) + 1) {
        last.last = number;
        return;
      }
    }
    set->items.push_back({number, number, 1, -1, content_.scope, lines_.source().here()});
  }

  bool is_number(std::int64_t id, std::string_view what) {
    if (id > 0 && id <= std::numeric_limits<int>::max()) return true;
    lines_.source().error(ErrorCode::out_of_range,
                          "{} {} would be made, expected a positive number", what, id);
    return false;
  }

  void append(const AbaqusReference& r, bool of_nodes, std::vector<int>& out, int depth) {
    if (r.name >= 0) {
      const auto& sets = of_nodes ? content_.node_sets : content_.element_sets;
      const auto it = sets.find({r.scope, r.name});
      if (it == sets.end() || depth > most_nested) return;
      for (const AbaqusReference& item : it->second.items) {
        lines_.source().make(1);  // sets of sets of sets may name the same ones very often
        append(item, of_nodes, out, depth + 1);
      }
      return;
    }
    const auto& known = of_nodes ? content_.node_of_label : content_.element_of_label;
    lines_.source().make((r.last - static_cast<std::int64_t>(r.first)) / r.step);
    for (std::int64_t id = r.first; id <= r.last; id += r.step)
      if (known.contains(AbaqusContent::label(r.scope, static_cast<int>(id))))
        out.push_back(static_cast<int>(id));
  }

  AbaqusLines& lines_;
  AbaqusContent& content_;
  AbaqusSet *nodes_ = nullptr, *elements_ = nullptr;
};

/// A whole number of a line; the default if the field is empty or missing.
int integer_or(AbaqusLines& lines, const std::vector<std::string_view>& fields, std::size_t index,
               int otherwise, std::string_view what) {
  if (index >= fields.size() || fields[index].empty()) return otherwise;
  return lines.integer(fields[index], what);
}

/// Centre of the arc of *NGEN: a node (field 4) or coordinates (fields 5 to 7).
std::optional<Vec3> arc_centre(AbaqusLines& lines, Generated& out,
                               const std::vector<std::string_view>& fields) {
  if (fields.size() > 3 && !fields[3].empty()) {
    const int node = lines.integer(fields[3], "node");
    return lines.misread() ? std::nullopt : out.place(node);
  }
  if (fields.size() < 5) {
    lines.source().error(ErrorCode::incomplete,
                         "LINE=C needs the centre of the arc: a node or three coordinates");
    return std::nullopt;
  }
  Vec3 centre = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    centre[static_cast<Eigen::Index>(k)] = lines.real_or(fields, k + 4, 0.0, "centre of the arc");
  return centre;
}

/// Whether a parameter has one of the values that are read.
bool is_one_of(AbaqusLines& lines, const AbaqusKeyword& keyword, std::string_view parameter,
               std::initializer_list<std::string_view> values, std::string_view expected) {
  const std::string_view found = keyword.value(parameter);
  if (found.empty() || std::any_of(values.begin(), values.end(),
                                   [&](std::string_view v) { return same_word(v, found); }))
    return true;
  lines.error(ErrorCode::wrong_count, keyword, "has {}={}, expected {}", parameter, shown(found),
              expected);
  lines.skip_data();
  return false;
}

}  // namespace

void read_abaqus_generated_nodes(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                 AbaqusContent& content) {
  lines.allow_only(keyword, {"NSET", "LINE", "SYSTEM"});
  if (!is_one_of(lines, keyword, "SYSTEM", {"R", "RC"}, "rectangular coordinates (RC)") ||
      !is_one_of(lines, keyword, "LINE", {"C"}, "C or none; parabolas are not read"))
    return;
  const bool round = keyword.has("LINE");
  if (round && content.system) {
    lines.error(ErrorCode::unsupported, keyword,
                "has LINE=C while *SYSTEM holds: put *SYSTEM without lines before it");
    return lines.skip_data();
  }
  Generated out(lines, content, keyword.value("NSET"), {});
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    if (fields.size() < 2) {
      lines.source().error(ErrorCode::incomplete,
                           "a line of *NGEN needs the numbers of its two ends");
      continue;
    }
    const int first = lines.integer(fields[0], "node"), last = lines.integer(fields[1], "node");
    const std::int64_t step = integer_or(lines, fields, 2, 1, "increment");
    if (lines.misread()) continue;
    const std::int64_t span = static_cast<std::int64_t>(last) - first;
    const auto a = out.place(first), b = out.place(last);
    if (!a || !b) continue;
    if (step == 0 || span % step != 0 || span / step < 1) {
      lines.source().error(ErrorCode::contradiction,
                           "steps of {} do not lead from node {} to node {}", step, first, last);
      continue;
    }
    const std::int64_t count = span / step;
    lines.source().make(count);
    std::optional<AbaqusArc> arc;
    if (round) {
      const auto centre = arc_centre(lines, out, fields);
      if (centre && !lines.misread()) arc = abaqus_arc(lines, *centre, *a, *b);
      if (!arc) continue;
    }
    for (std::int64_t k = 0; k <= count; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(count);
      const Vec3 p = k == 0 ? *a : k == count ? *b : arc ? arc->at(t) : Vec3(*a + t * (*b - *a));
      out.node(first + k * step, p, (*b - *a).norm());
    }
  }
}

void read_abaqus_filled_nodes(AbaqusLines& lines, const AbaqusKeyword& keyword,
                              AbaqusContent& content) {
  lines.allow_only(keyword, {"NSET"});
  Generated out(lines, content, keyword.value("NSET"), {});
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    if (fields.size() < 2) {
      lines.source().error(ErrorCode::incomplete,
                           "a line of *NFILL needs the sets of its two sides");
      continue;
    }
    const int intervals = integer_or(lines, fields, 2, 1, "number of intervals");
    const std::int64_t step = integer_or(lines, fields, 3, 1, "increment");
    if (lines.misread()) continue;
    const std::vector<int> first = out.numbers(fields[0], true),
                           last = out.numbers(fields[1], true);
    if (first.empty() || last.empty()) continue;
    if (first.size() != last.size()) {
      lines.source().error(ErrorCode::contradiction,
                           "the sides have {} and {} nodes, expected as many", first.size(),
                           last.size());
      continue;
    }
    if (intervals < 1) {
      lines.source().error(ErrorCode::out_of_range, "{} intervals, expected at least 1", intervals);
      continue;
    }
    lines.source().make(static_cast<std::int64_t>(first.size()) * intervals);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const auto a = out.place(first[i]), b = out.place(last[i]);
      if (!a || !b) continue;
      for (int k = 0; k < intervals; ++k)
        out.node(first[i] + k * step, *a + (*b - *a) * (static_cast<double>(k) / intervals),
                 (*b - *a).norm());
      out.node(last[i], *b, (*b - *a).norm());
    }
  }
}

void read_abaqus_copied_nodes(AbaqusLines& lines, const AbaqusKeyword& keyword,
                              AbaqusContent& content) {
  if (!keyword.has("SHIFT")) {
    lines.error(ErrorCode::unsupported, keyword,
                "has no SHIFT; reflected and projected copies are not read");
    return lines.skip_data();
  }
  lines.allow_only(keyword, {"CHANGENUMBER", "OLDSET", "NEWSET", "SHIFT", "MULTIPLE"});
  if (content.system)
    lines.error(ErrorCode::unsupported, keyword,
                "shifts while *SYSTEM holds: put *SYSTEM without lines before it");
  const std::string_view change = lines.required(keyword, "CHANGE NUMBER"),
                         old = lines.required(keyword, "OLD SET");
  if (change.empty() || old.empty()) return lines.skip_data();
  const std::int64_t step = lines.integer(change, "CHANGE NUMBER");
  const std::string_view multiple = keyword.value("MULTIPLE");
  const int times = multiple.empty() ? 1 : lines.integer(multiple, "MULTIPLE");
  if (lines.misread()) return lines.skip_data();
  Generated out(lines, content, keyword.value("NEWSET"), {});
  const std::vector<int> numbers = out.numbers(old, true);
  lines.source().make(static_cast<std::int64_t>(numbers.size()) * std::max(times, 0));
  Vec3 shift = Vec3::Zero(), a = Vec3::Zero(), b = Vec3::Zero();
  double degrees = 0.0;
  std::vector<std::string_view> fields;
  for (int line = 0; line < 2 && lines.next_fields(fields); ++line)
    for (std::size_t k = 0; k < (line == 0 ? 3u : 7u); ++k) {
      const double value = lines.real_or(fields, k, 0.0, line == 0 ? "shift" : "axis and angle");
      if (line == 0)
        shift[static_cast<Eigen::Index>(k)] = value;
      else if (k < 6)
        (k < 3 ? a : b)[static_cast<Eigen::Index>(k % 3)] = value;
      else
        degrees = value;
    }
  Mat3 R = Mat3::Identity();
  if (degrees != 0.0) {
    if (!((b - a).norm() > 0.0)) {
      lines.source().error(ErrorCode::geometry, "the axis of the rotation has no length");
      return lines.skip_data();
    }
    R = Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, (b - a).normalized())
            .toRotationMatrix();
  }
  for (const int id : numbers) {
    const auto p = out.place(id);
    if (!p) continue;
    Vec3 q = *p;
    for (int k = 1; k <= times; ++k) {
      q = R * (q + shift - a) + a;
      out.node(id + k * step, q, q.norm() + p->norm());
    }
  }
  lines.skip_data();
}

void read_abaqus_generated_elements(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                    AbaqusContent& content) {
  lines.allow_only(keyword, {"ELSET"});
  Generated out(lines, content, {}, keyword.value("ELSET"));
  std::vector<std::string_view> fields;
  while (lines.next_fields(fields)) {
    const int id = lines.integer(fields[0], "element");
    const AbaqusElement* const found = lines.misread() ? nullptr : out.find_element(id);
    if (found == nullptr) continue;
    const AbaqusElement master = *found;  // the list grows
    std::array<std::int64_t, 3> count{}, node{}, element{};
    bool valid = true;
    std::int64_t all = 1;
    for (std::size_t d = 0; d < 3; ++d) {  // in a row, rows, layers
      count[d] = integer_or(lines, fields, 3 * d + 1, 1, "number of elements");
      node[d] = integer_or(lines, fields, 3 * d + 2, 1, "increment of the nodes");
      element[d] = integer_or(lines, fields, 3 * d + 3, 1, "increment of the elements");
      valid = valid && count[d] >= 1;
      all = valid ? std::min(all * count[d], 2 * TextSource::most_made) : all;
    }
    if (lines.misread()) continue;
    if (!valid) {
      lines.source().error(ErrorCode::out_of_range,
                           "the numbers of elements of *ELGEN must be at least 1");
      continue;
    }
    lines.source().make(all);
    out.belongs_too(master.id);
    for (std::int64_t l = 0; l < count[2]; ++l)
      for (std::int64_t r = 0; r < count[1]; ++r)
        for (std::int64_t k = 0; k < count[0]; ++k)
          if (k + r + l > 0)
            out.element(master, master.id + k * element[0] + r * element[1] + l * element[2],
                        k * node[0] + r * node[1] + l * node[2]);
  }
}

void read_abaqus_copied_elements(AbaqusLines& lines, const AbaqusKeyword& keyword,
                                 AbaqusContent& content) {
  lines.allow_only(keyword, {"ELEMENTSHIFT", "OLDSET", "SHIFTNODES", "NEWSET"});
  const std::string_view shift = lines.required(keyword, "ELEMENT SHIFT"),
                         old = lines.required(keyword, "OLD SET"),
                         nodes = lines.required(keyword, "SHIFT NODES");
  lines.skip_data();
  if (shift.empty() || old.empty() || nodes.empty()) return;
  Generated out(lines, content, {}, keyword.value("NEWSET"));
  const std::int64_t step = lines.integer(shift, "ELEMENT SHIFT"),
                     node_step = lines.integer(nodes, "SHIFT NODES");
  if (lines.misread()) return;
  const std::vector<int> numbers = out.numbers(old, false);
  lines.source().make(static_cast<std::int64_t>(numbers.size()));
  for (const int id : numbers) {
    const AbaqusElement like = *out.find_element(id);
    out.element(like, id + step, node_step);
  }
}

}  // namespace floatframe
