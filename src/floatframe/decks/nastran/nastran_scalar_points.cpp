// Scalar points of Nastran bulk data (SPOINT, or named by CELAS3 and CELAS4): one degree of freedom
// without a position. In the model each one used by a spring or an equation is a separate node, of
// which the component ux is used, or rx if its springs are torsional. Springs condense it
// (fe/springs.hpp), or it depends on nodes by an equation; its position is only for display.
#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {

void NastranRanges::finish() {
  std::sort(ranges_.begin(), ranges_.end());
  std::vector<std::pair<int, int>> joined;
  for (const auto& [first, last] : ranges_) {
    if (!joined.empty() && first <= joined.back().second)
      joined.back().second = std::max(joined.back().second, last);
    else if (first <= last)
      joined.emplace_back(first, last);
  }
  ranges_ = std::move(joined);
}

bool NastranRanges::overlaps(int first, int last) const {
  const auto after = std::upper_bound(ranges_.begin(), ranges_.end(), last,
                                      [](int id, const auto& range) { return id < range.first; });
  return after != ranges_.begin() && std::prev(after)->second >= first;
}

namespace {

/// The springs and equations that tie scalar points together, with the first node among them.
class ScalarPointBuilder {
 public:
  ScalarPointBuilder(NastranBuild& build, std::map<int, NastranScalarPoint>& points)
      : b_(build), c_(build.content), points_(points) {}

  void build() {
    for (const NastranSpring& s : c_.springs) {
      if (s.card.starts_with("CBUSH")) continue;
      for (const int id : s.nodes)
        if (NastranScalarPoint* point = use(id, s.at)) point->sprung = true;
    }
    for (const NastranEquation& e : c_.equations)
      for (const NastranEquation::Term& t : e.terms) use(t.node, e.at);
    for (const NastranGrid& g : c_.grids)
      if (is_point(g.id))
        b_.source.error(
            ErrorCode::duplicate, g.at,
            "node {} is a scalar point as well (SPOINT, or by an element of scalar points)", g.id);
    springs();
    equations();
    for (auto& [id, point] : points_) {
      const Group& group = groups_[root(id)];
      point.axis = group.turns.value_or(false) ? 3 : 0;
      point.node = b_.model.nodes();
      b_.model.positions.push_back(b_.model.positions[std::max(group.node, 0)]);
      b_.model.node_ids.push_back(id);
      b_.model.node_sources.push_back(point.at);
      b_.turned.push_back(0);
    }
  }

 private:
  struct Group {
    std::optional<bool> turns;  ///< its springs end at rotations
    int node = -1;
  };

  bool is_point(int id) const { return id > 0 && c_.scalar_points.contains(id); }

  /// Null if it is no scalar point, or the ground.
  NastranScalarPoint* use(int id, const FeSource& at) {
    if (!is_point(id) || b_.scalars.held(id)) return nullptr;
    return &points_.try_emplace(id, NastranScalarPoint{.root = id, .at = at}).first->second;
  }

  int root(int id) {
    while (points_.at(id).root != id) {
      int& above = points_.at(id).root;
      id = above = points_.at(above).root;
    }
    return id;
  }

  void springs() {
    for (const NastranSpring& s : c_.springs)
      if (points_.contains(s.nodes[0]) && points_.contains(s.nodes[1]))
        points_.at(root(s.nodes[0])).root = root(s.nodes[1]);
    for (const NastranSpring& s : c_.springs)
      for (int end = 0; end < 2; ++end) {
        const int id = s.nodes[end], other = s.nodes[1 - end];
        const auto node = b_.node_of.find(other);
        if (!points_.contains(id) || node == b_.node_of.end() || s.components[1 - end] < 0)
          continue;
        Group& group = groups_[root(id)];
        const bool turns = s.components[1 - end] >= 3;
        if (group.node < 0) group.node = node->second;
        if (group.turns.value_or(turns) != turns)
          b_.error(ErrorCode::dependent, s,
                   "scalar point {} is tied to a rotation and to a displacement by springs; one of "
                   "them must be tied by MPC, which gives the lever",
                   id);
        group.turns = turns;
      }
  }

  /// If not determined by springs: equations of rotations only.
  void equations() {
    std::map<int, bool> turns;
    for (const NastranEquation& e : c_.equations) {
      bool any = false, all = true;
      int node = -1;
      for (const NastranEquation::Term& t : e.terms) {
        const auto it = b_.node_of.find(t.node);
        if (it == b_.node_of.end() || t.axis < 0) continue;
        if (node < 0) node = it->second;
        any = true;
        all = all && t.axis >= 3;
      }
      for (const NastranEquation::Term& t : e.terms) {
        if (!points_.contains(t.node) || !any) continue;
        Group& group = groups_[root(t.node)];
        if (group.node < 0) group.node = node;
        turns.try_emplace(root(t.node), true).first->second &= all;
      }
    }
    for (const auto& [id, value] : turns)
      if (!groups_[id].turns) groups_[id].turns = value;
  }

  NastranBuild& b_;
  const NastranContent& c_;
  std::map<int, NastranScalarPoint>& points_;
  std::map<int, Group> groups_;
};

}  // namespace

void NastranScalarPoints::build(NastranBuild& b) {
  std::set<int> there;
  for (const NastranSupport& s : b.content.supports) there.insert(s.set);
  // Without a case control all are in force.
  const bool all = !b.content.control.there ||
                   !b.content.scalar_points.overlaps(1, std::numeric_limits<int>::max());
  const std::set<int> selected =
      all ? there
          : selected_nastran_sets(b, b.content.control.spc, b.content.added_spc_sets, there, "SPC");
  for (const NastranSupport& s : b.content.supports)
    if (selected.contains(s.set)) held_.add(s.first, s.last);
  held_.finish();
  ScalarPointBuilder(b, points_).build();
}

const NastranScalarPoint* NastranScalarPoints::find(int id) const {
  const auto it = points_.find(id);
  return it == points_.end() ? nullptr : &it->second;
}

}  // namespace floatframe
