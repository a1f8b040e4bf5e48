#include "floatframe/decks/nastran/nastran_build.hpp"

namespace floatframe {

NastranNumbers::NastranNumbers(std::vector<std::pair<int, int>> number_and_index)
    : sorted_(std::move(number_and_index)) {
  std::sort(sorted_.begin(), sorted_.end());
}

bool NastranNumbers::append(int first, int last, std::vector<int>& indices) const {
  auto it = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{first, -1});
  const std::size_t before = indices.size();
  for (; it != sorted_.end() && it->first <= last; ++it) indices.push_back(it->second);
  return indices.size() > before;
}

std::set<int> selected_nastran_sets(NastranBuild& build,
                                    const std::vector<std::pair<int, FeSource>>& selected,
                                    const std::map<int, std::vector<int>>& added,
                                    const std::set<int>& there, const char* what) {
  std::set<int> sets;
  for (const auto& [id, at] : selected) {
    if (id != selected.front().first) {
      build.source.error(
          ErrorCode::exclusive, at,
          "the case control selects {} sets {} and {}; only one can be read, remove the other",
          what, selected.front().first, id);
      return sets;
    }
    const auto joined = added.find(id);
    if (joined == added.end()) {
      sets.insert(id);
    } else {
      if (there.contains(id))
        build.source.error(
            ErrorCode::exclusive, at,
            "the set {} is one of {} cards and one of {}ADD, expected only one of both", id, what,
            what);
      for (const int set : joined->second)
        if (!there.contains(set))
          build.source.error(ErrorCode::not_found, at,
                             "{}ADD {} joins set {}, which is not in the file", what, id, set);
      if (build.source.errors() > 0) return {};
      sets.insert(joined->second.begin(), joined->second.end());
    }
  }
  return sets;
}

void build_nastran_sets(NastranBuild& build, bool only_nodes) {
  const NastranContent& c = build.content;
  const NastranNumbers nodes({build.node_of.begin(), build.node_of.end()});
  std::vector<std::pair<int, int>> list;
  for (std::size_t e = 0; e < build.model.elements.size(); ++e)
    list.emplace_back(build.model.elements[e].id, static_cast<int>(e));
  const NastranNumbers elements(std::move(list));
  std::map<std::pair<bool, std::string>, std::unordered_set<int>> members_of;
  for (const NastranSet& set : c.sets) {
    if (set.elements && only_nodes) continue;
    const char* const what = set.elements ? "element" : "node";
    std::vector<int> members;
    bool complete = true;
    for (const auto& [first, last] : set.ranges) {
      const std::size_t before = members.size();
      const bool found = (set.elements ? elements : nodes).append(first, last, members);
      build.spend(members.size() - before, set.at);
      if (found || (!set.elements && c.scalar_points.overlaps(first, last))) continue;
      complete = false;
      if (!set.strict || first == 0) continue;
      build.source.error(
          ErrorCode::not_found, set.at,
          first == last
              ? fmt::format("set {} has {} {}, which is not in the file", set.id, what, first)
              : fmt::format("set {}: there is no {} from {} to {}", set.id, what, first, last));
    }
    if (!complete) continue;
    const auto name = c.names.sets.find(set.id);
    auto& sets = set.elements ? build.model.element_sets : build.model.node_sets;
    const std::string key =
        name == c.names.sets.end() ? fmt::format("SET {}", set.id) : name->second;
    // Each member once, in the order of the file; several cards of one set add up.
    std::vector<int>& known = sets[key];
    std::unordered_set<int>& there = members_of[{set.elements, key}];
    if (there.empty()) there.insert(known.begin(), known.end());
    for (const int m : members)
      if (there.insert(m).second) known.push_back(m);
  }
}

}  // namespace floatframe
