// Parts of Abaqus decks that have several instances, and parts that have none: what stands in a
// scope, once more in another one or not at all.
#include <algorithm>
#include <limits>
#include <type_traits>

#include "floatframe/decks/abaqus/abaqus_handlers.hpp"

namespace floatframe {
namespace {

/// References of a thing into another scope.
class ScopeChange {
 public:
  ScopeChange(AbaqusScope from, AbaqusScope to) : from_(from), to_(to) {}

  void operator()(AbaqusScope& scope) const {
    if (scope == from_) scope = to_;
  }
  void operator()(AbaqusReference& r) const { (*this)(r.scope); }
  void operator()(AbaqusThing& thing) const { (*this)(thing.where); }
  void operator()(AbaqusOrientation& o) const { (*this)(o.scope); }
  void operator()(AbaqusSet& set) const { each(set.items); }
  void operator()(AbaqusSurface& surface) const { each(surface.items); }
  void operator()(AbaqusEquation& e) const { each(e.terms); }
  void operator()(AbaqusTie& t) const {
    (*this)(t.where);
    (*this)(t.master);
  }
  void operator()(AbaqusTransform& t) const {
    (*this)(t.scope);
    (*this)(t.where);
  }
  void operator()(AbaqusSpider& s) const {
    (*this)(s.where);
    if (s.surface) (*this)(*s.surface);
    if (s.rotation) (*this)(*s.rotation);
    each(s.nodes);
    each(s.elements);
  }

 private:
  template <class List>
  void each(List& list) const {
    for (auto& item : list) (*this)(item);
  }

  AbaqusScope from_, to_;
};

AbaqusScope scope_of(const AbaqusThing& thing) { return thing.where.scope; }
AbaqusScope scope_of(const AbaqusTransform& t) { return t.scope; }
AbaqusScope scope_of(const AbaqusEquation& e) { return e.terms.front().where.scope; }

/// Calls `use` with each list of things that belong to a scope and its place in AbaqusSizes.
template <typename Content, typename Use>
void each_list(Content& c, Use use) {
  const auto all = [&](auto&... lists) {
    std::size_t place = 2;
    (use(lists, place++), ...);
  };
  all(c.sections, c.masses, c.spiders, c.equations, c.supports, c.ties, c.springs, c.transforms,
      c.thicknesses, c.nonstructural, c.pre_tensions);
}

/// Entries of a scope; the keys begin with it.
template <typename Map>
auto entries_of(Map& map, AbaqusScope scope) {
  using Second = decltype(map.begin()->first.second);
  Second least{};
  if constexpr (std::is_same_v<Second, int>) least = std::numeric_limits<int>::min();
  const auto begin = map.lower_bound({scope, least});
  auto end = begin;
  while (end != map.end() && end->first.first == scope) ++end;
  return std::pair{begin, end};
}

std::size_t weight(const AbaqusSet& set) { return set.items.size(); }
std::size_t weight(const AbaqusSurface& s) { return s.items.size(); }
std::size_t weight(const AbaqusOrientation&) { return 1; }
std::size_t weight(const AbaqusEquation& e) { return e.terms.size(); }
std::size_t weight(const AbaqusSpider& s) { return 1 + s.nodes.size() + s.elements.size(); }
std::size_t weight(const AbaqusSection& s) { return 1 + s.plies.size(); }
std::size_t weight(const AbaqusThing&) { return 1; }

template <class T>
void copy_numbered(AbaqusNumbered<T>& all, std::size_t begin, std::size_t end, AbaqusScope to) {
  for (std::size_t k = begin; k < end; ++k) {
    T copy = all[k];  // the numbers of an element's nodes are the same
    copy.scope = to;
    all.add(copy);
  }
}

template <typename Map>
void copy_names(Map& map, AbaqusScope from, AbaqusScope to, TextSource& source) {
  const ScopeChange change(from, to);
  std::vector<std::pair<typename Map::key_type, typename Map::mapped_type>> copies;
  const auto [begin, end] = entries_of(map, from);
  for (auto it = begin; it != end; ++it) {
    source.make(static_cast<std::int64_t>(weight(it->second)));
    copies.emplace_back(typename Map::key_type{to, it->first.second}, it->second);
  }
  for (auto& [key, value] : copies) {
    change(value);
    map.emplace(key, std::move(value));
  }
}

}  // namespace

AbaqusSizes abaqus_sizes(const AbaqusContent& c) {
  AbaqusSizes sizes{c.nodes.size(), c.elements.size()};
  each_list(c, [&](const auto& list, std::size_t place) { sizes[place] = list.size(); });
  return sizes;
}

void copy_abaqus_part(AbaqusContent& c, const AbaqusPart& part, AbaqusScope to,
                      TextSource& source) {
  const ScopeChange change(part.scope, to);
  source.make(static_cast<std::int64_t>(part.end[0] - part.begin[0] + part.end[1] - part.begin[1]));
  copy_numbered(c.nodes, part.begin[0], part.end[0], to);
  copy_numbered(c.elements, part.begin[1], part.end[1], to);
  copy_names(c.node_sets, part.scope, to, source);
  copy_names(c.element_sets, part.scope, to, source);
  copy_names(c.surfaces, part.scope, to, source);
  copy_names(c.orientations, part.scope, to, source);
  each_list(c, [&](auto& list, std::size_t place) {
    for (std::size_t k = part.begin[place]; k < part.end[place]; ++k) {
      if (scope_of(list[k]) != part.scope) continue;
      auto copy = list[k];
      source.make(static_cast<std::int64_t>(weight(copy)));
      change(copy);
      list.push_back(std::move(copy));
    }
  });
}

void remove_abaqus_scopes(AbaqusContent& c, const std::set<AbaqusScope>& scopes) {
  const auto gone = [&](AbaqusScope scope) { return scopes.contains(scope); };
  c.nodes.remove_if([&](const AbaqusNode& n) { return gone(n.scope); });
  c.elements.remove_if([&](const AbaqusElement& e) { return gone(e.scope); });
  const auto named = [&](const auto& entry) { return gone(entry.first.first); };
  std::erase_if(c.node_sets, named);
  std::erase_if(c.element_sets, named);
  std::erase_if(c.surfaces, named);
  std::erase_if(c.orientations, named);
  each_list(c, [&](auto& list, std::size_t) {
    std::erase_if(list, [&](const auto& thing) { return gone(scope_of(thing)); });
  });
}

}  // namespace floatframe
