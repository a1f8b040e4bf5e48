// Nodes and elements that decks have generated: *NGEN between two nodes, *NFILL between two sets,
// *NCOPY with a shift, *ELGEN in rows and layers, *ELCOPY.
// Source: Abaqus Keywords Guide.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/decks/abaqus/abaqus_card.hpp"

namespace floatframe {
namespace {

constexpr int most_nested = 50;

/// Adds nodes and elements to the content, as if they were in the deck at a line.
class Generated {
 public:
  /// The sets that get them are those of two parameters, if they are there.
  Generated(AbaqusCard& card, std::string_view node_set, std::string_view element_set)
      : card_(card),
        content_(card.content),
        nodes_(card.set(card.content.node_sets, node_set)),
        elements_(card.set(card.content.element_sets, element_set)) {}

  /// The position of a node; null and an error if it is missing.
  std::optional<Vec3> place(int id) {
    const int found = content_.nodes.find(content_.scope, id);
    if (found >= 0) return content_.nodes[found].p;
    card_.error_in_line(ErrorCode::not_found, "node {} does not exist before this line", id);
    return std::nullopt;
  }

  /// A node that is there already must be at the same place.
  void node(std::int64_t id, const Vec3& p, double size) {
    if (!is_number(id, "node")) return;
    const int number = static_cast<int>(id);
    const int there = content_.nodes.add({number, content_.scope, p, card_.here()});
    if (there < 0 || (content_.nodes[there].p - p).norm() <= 1e-6 * size)
      return belongs(nodes_, number);
    card_.error_in_line(ErrorCode::duplicate, "node {} is there already at another place ({})",
                        number, card_.place(content_.nodes[there].at));
  }

  /// A copy of an element with other numbers.
  void element(const AbaqusElement& like, std::int64_t id, std::int64_t node_increment) {
    if (like.directed)
      return card_.error_in_line(
          ErrorCode::unsupported,
          "element {} has a node for its orientation, which copies do not have", like.id);
    if (!is_number(id, "element")) return;
    AbaqusElement element = like;
    element.id = static_cast<int>(id);
    element.first = content_.element_nodes.size();
    element.at = card_.here();
    if (!add_to_abaqus(card_, content_.elements, element, "element")) return;
    for (int k = 0; k < like.type->nodes; ++k) {
      const std::int64_t node = content_.element_nodes[like.first + k] + node_increment;
      content_.element_nodes.push_back(is_number(node, "node") ? static_cast<int>(node) : 0);
    }
    belongs(elements_, element.id);
  }

  void belongs_too(int element) { belongs(elements_, element); }

  const AbaqusElement* find_element(int id) {
    const int found = content_.elements.find(content_.scope, id);
    if (found >= 0) return &content_.elements[found];
    card_.error_in_line(ErrorCode::not_found, "element {} does not exist before this line", id);
    return nullptr;
  }

  /// Numbers of a set or of a single node or element; empty and an error if there are none.
  std::vector<int> numbers(std::string_view field, bool of_nodes) {
    std::vector<int> out;
    const AbaqusReference r = content_.reference(field, card_.here());
    append(r, of_nodes, out, 0);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    if (out.empty())
      card_.error_in_line(ErrorCode::missing, "{} has no members before this line",
                          content_.text(r, of_nodes ? "node" : "element"));
    return out;
  }

 private:
  void belongs(AbaqusSet* set, int number) {
    if (set == nullptr) return;
    // Consecutive numbers are one range.
    if (!set->items.empty()) {
      AbaqusReference& last = set->items.back();
      if (last.name < 0 && last.scope == content_.scope && last.step == 1 &&
          number == static_cast<std::int64_t>(last.last) + 1) {
        last.last = number;
        return;
      }
    }
    set->items.push_back({number, number, 1, -1, content_.scope, card_.here()});
  }

  bool is_number(std::int64_t id, std::string_view what) {
    if (id > 0 && id <= std::numeric_limits<int>::max()) return true;
    card_.error_in_line(ErrorCode::out_of_range, "{} {} would be made, expected a positive number",
                        what, id);
    return false;
  }

  void append(const AbaqusReference& r, bool of_nodes, std::vector<int>& out, int depth) {
    if (r.name >= 0) {
      const auto& sets = of_nodes ? content_.node_sets : content_.element_sets;
      const auto it = sets.find({r.scope, r.name});
      if (it == sets.end() || depth > most_nested) return;
      for (const AbaqusReference& item : it->second.items) {
        card_.source.make(1);  // nested sets may name the same numbers very often
        append(item, of_nodes, out, depth + 1);
      }
      return;
    }
    card_.source.make((r.last - static_cast<std::int64_t>(r.first)) / r.step);
    for (std::int64_t id = r.first; id <= r.last; id += r.step) {
      const int number = static_cast<int>(id);
      if ((of_nodes ? content_.nodes.find(r.scope, number)
                    : content_.elements.find(r.scope, number)) >= 0)
        out.push_back(number);
    }
  }

  AbaqusCard& card_;
  AbaqusContent& content_;
  AbaqusSet *nodes_, *elements_;
};

/// An arc about a centre from a to b, of less than half a turn.
struct ArcOfNodes {
  Vec3 centre, a, normal;
  double angle;
  Vec3 at(double t) const { return centre + Eigen::AngleAxisd(t * angle, normal) * (a - centre); }
};

/// Null and an error if the three points define none.
std::optional<ArcOfNodes> arc_of(AbaqusCard& card, const Vec3& centre, const Vec3& a,
                                 const Vec3& b) {
  const Vec3 ra = a - centre, rb = b - centre, n = ra.cross(rb);
  const double r = ra.norm(), angle = std::atan2(n.norm(), ra.dot(rb));
  if (std::abs(rb.norm() - r) > 1e-3 * r || !(r > 0.0))
    card.error_in_line(
        ErrorCode::geometry,
        "the ends are {:.6g} and {:.6g} from the centre of the arc, expected the same", r,
        rb.norm());
  else if (!(n.norm() > 1e-9 * r * r) || angle > 0.999 * std::numbers::pi)
    card.error_in_line(ErrorCode::unsupported,
                       "the arc is half a turn or has no length; arcs of less are read");
  else
    return ArcOfNodes{centre, a, n.normalized(), angle};
  return std::nullopt;
}

/// Centre of the arc of *NGEN: a node (field 4) or coordinates (fields 5 to 7).
std::optional<Vec3> arc_centre(AbaqusCard& card, Generated& out) {
  if (!card.field(3).empty()) {
    const int node = card.integer(card.field(3), "node");
    return card.misread() ? std::nullopt : out.place(node);
  }
  if (card.fields.size() >= 5) return card.vector(4, "centre of the arc");
  card.error_in_line(ErrorCode::incomplete,
                     "LINE=C needs the centre of the arc: a node or three coordinates");
  return std::nullopt;
}

/// One line of *NGEN.
void generate_between(AbaqusCard& card, Generated& out, bool round) {
  const int first = card.integer(card.field(0), "node"), last = card.integer(card.field(1), "node");
  const std::int64_t step = card.integer_or(2, 1, "increment");
  if (card.misread()) return;
  const std::int64_t span = static_cast<std::int64_t>(last) - first;
  const auto a = out.place(first), b = out.place(last);
  if (!a || !b) return;
  if (step == 0 || span % step != 0 || span / step < 1)
    return card.error_in_line(ErrorCode::contradiction,
                              "steps of {} do not lead from node {} to node {}", step, first, last);
  const std::int64_t count = span / step;
  card.source.make(count);
  std::optional<ArcOfNodes> arc;
  if (round) {
    const auto centre = arc_centre(card, out);
    if (centre && !card.misread()) arc = arc_of(card, *centre, *a, *b);
    if (!arc) return;
  }
  for (std::int64_t k = 0; k <= count; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(count);
    const Vec3 p = k == 0 ? *a : k == count ? *b : arc ? arc->at(t) : Vec3(*a + t * (*b - *a));
    out.node(first + k * step, p, (*b - *a).norm());
  }
}

/// One line of *NFILL.
void fill_between(AbaqusCard& card, Generated& out) {
  const int intervals = card.integer_or(2, 1, "number of intervals");
  const std::int64_t step = card.integer_or(3, 1, "increment");
  if (card.misread()) return;
  const std::vector<int> first = out.numbers(card.field(0), true),
                         last = out.numbers(card.field(1), true);
  if (first.empty() || last.empty()) return;
  if (first.size() != last.size())
    return card.error_in_line(ErrorCode::contradiction,
                              "the sides have {} and {} nodes, expected as many", first.size(),
                              last.size());
  if (intervals < 1)
    return card.error_in_line(ErrorCode::out_of_range, "{} intervals, expected at least 1",
                              intervals);
  card.source.make(static_cast<std::int64_t>(first.size()) * intervals);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto a = out.place(first[i]), b = out.place(last[i]);
    if (!a || !b) continue;
    const Vec3 d = *b - *a;
    for (int k = 0; k < intervals; ++k)
      out.node(first[i] + k * step, *a + d * (static_cast<double>(k) / intervals), d.norm());
    out.node(last[i], *b, d.norm());
  }
}

/// Shift, and two points of an axis with an angle, of *NCOPY; null and an error if the axis has
/// no length. At q: R (q + t - a) + a.
std::optional<AbaqusPlacement> read_shift(AbaqusCard& card) {
  AbaqusPlacement shift;
  if (card.next()) shift.t = card.vector(0, "shift");
  if (!card.next()) return shift;
  shift.a = card.vector(0, "axis and angle");
  const Vec3 axis = card.vector(3, "axis and angle") - shift.a;
  const double degrees = card.real_or(6, 0.0, "axis and angle");
  if (degrees == 0.0) return shift;
  if (!(axis.norm() > 0.0)) {
    card.error_in_line(ErrorCode::geometry, "the axis of the rotation has no length");
    return std::nullopt;
  }
  shift.R =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized()).toRotationMatrix();
  return shift;
}

/// One line of *ELGEN: in a row, rows, layers.
void generate_elements(AbaqusCard& card, Generated& out) {
  const int id = card.integer(card.field(0), "element");
  const AbaqusElement* const found = card.misread() ? nullptr : out.find_element(id);
  if (found == nullptr) return;
  const AbaqusElement master = *found;  // the list grows
  std::array<std::int64_t, 3> count{}, node{}, element{};
  bool valid = true;
  std::int64_t all = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    count[d] = card.integer_or(3 * d + 1, 1, "number of elements");
    node[d] = card.integer_or(3 * d + 2, 1, "increment of the nodes");
    element[d] = card.integer_or(3 * d + 3, 1, "increment of the elements");
    valid = valid && count[d] >= 1;
    all = valid ? std::min(all * count[d], 2 * TextSource::most_made) : all;
  }
  if (card.misread()) return;
  if (!valid)
    return card.error_in_line(ErrorCode::out_of_range,
                              "the numbers of elements of *ELGEN must be at least 1");
  card.source.make(all);
  out.belongs_too(master.id);
  for (std::int64_t l = 0; l < count[2]; ++l)
    for (std::int64_t r = 0; r < count[1]; ++r)
      for (std::int64_t k = 0; k < count[0]; ++k)
        if (k + r + l > 0)
          out.element(master, master.id + k * element[0] + r * element[1] + l * element[2],
                      k * node[0] + r * node[1] + l * node[2]);
}

}  // namespace

void read_abaqus_generated_nodes(AbaqusCard& card) {
  if (!card.is_one_of("SYSTEM", "R RC", "has SYSTEM={}, expected rectangular coordinates (RC)",
                      ErrorCode::wrong_count) ||
      !card.is_one_of("LINE", "C", "has LINE={}, expected C or none; parabolas are not read",
                      ErrorCode::wrong_count))
    return;
  const bool round = card.has("LINE");
  if (round && card.content.system)
    return card.error(ErrorCode::unsupported,
                      "has LINE=C while *SYSTEM holds: put *SYSTEM without lines before it");
  Generated out(card, "NSET", "");
  while (card.next()) {
    if (card.fields.size() >= 2)
      generate_between(card, out, round);
    else
      card.error_in_line(ErrorCode::incomplete,
                         "a line of *NGEN needs the numbers of its two ends");
  }
}

void read_abaqus_filled_nodes(AbaqusCard& card) {
  Generated out(card, "NSET", "");
  while (card.next()) {
    if (card.fields.size() >= 2)
      fill_between(card, out);
    else
      card.error_in_line(ErrorCode::incomplete, "a line of *NFILL needs the sets of its two sides");
  }
}

void read_abaqus_copied_nodes(AbaqusCard& card) {
  if (!card.has("SHIFT"))
    return card.error(ErrorCode::unsupported,
                      "has no SHIFT; reflected and projected copies are not read");
  card.allow_only("CHANGENUMBER OLDSET NEWSET SHIFT MULTIPLE");
  if (card.content.system)
    card.error(ErrorCode::unsupported,
               "shifts while *SYSTEM holds: put *SYSTEM without lines before it");
  const std::string_view change = card.required("CHANGE NUMBER"), old = card.required("OLD SET");
  if (change.empty() || old.empty()) return;
  const std::int64_t step = card.integer(change, "CHANGE NUMBER");
  const std::string_view multiple = card.value("MULTIPLE");
  const int times = multiple.empty() ? 1 : card.integer(multiple, "MULTIPLE");
  if (card.misread()) return;
  Generated out(card, "NEWSET", "");
  const std::vector<int> numbers = out.numbers(old, true);
  card.source.make(static_cast<std::int64_t>(numbers.size()) * std::max(times, 0));
  const std::optional<AbaqusPlacement> shift = read_shift(card);
  if (!shift) return;
  for (const int id : numbers) {
    const auto p = out.place(id);
    if (!p) continue;
    Vec3 q = *p;
    for (int k = 1; k <= times; ++k) {
      q = shift->at(q);
      out.node(id + k * step, q, q.norm() + p->norm());
    }
  }
}

void read_abaqus_generated_elements(AbaqusCard& card) {
  Generated out(card, "", "ELSET");
  while (card.next()) generate_elements(card, out);
}

void read_abaqus_copied_elements(AbaqusCard& card) {
  const std::string_view shift = card.required("ELEMENT SHIFT"), old = card.required("OLD SET"),
                         nodes = card.required("SHIFT NODES");
  if (shift.empty() || old.empty() || nodes.empty()) return;
  Generated out(card, "", "NEWSET");
  const std::int64_t step = card.integer(shift, "ELEMENT SHIFT"),
                     node_step = card.integer(nodes, "SHIFT NODES");
  if (card.misread()) return;
  const std::vector<int> numbers = out.numbers(old, false);
  card.source.make(static_cast<std::int64_t>(numbers.size()));
  for (const int id : numbers) {
    const AbaqusElement like = *out.find_element(id);
    out.element(like, id + step, node_step);
  }
}

}  // namespace floatframe
