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
  void operator()(AbaqusSet& set) const {
    for (AbaqusReference& r : set.items) (*this)(r);
  }
  void operator()(AbaqusSurface& surface) const {
    for (AbaqusSurface::Item& item : surface.items) (*this)(item.where);
  }
  void operator()(AbaqusOrientation& o) const { (*this)(o.scope); }
  void operator()(AbaqusSection& s) const { (*this)(s.elements); }
  void operator()(AbaqusSpring& s) const { (*this)(s.elements); }
  void operator()(AbaqusSupport& s) const { (*this)(s.nodes); }
  void operator()(AbaqusThickness& t) const { (*this)(t.nodes); }
  void operator()(AbaqusNonstructuralMass& m) const { (*this)(m.elements); }
  void operator()(AbaqusPreTension& p) const { (*this)(p.surface); }
  void operator()(AbaqusTie& t) const {
    (*this)(t.slave);
    (*this)(t.master);
  }
  void operator()(AbaqusTransform& t) const {
    (*this)(t.scope);
    (*this)(t.nodes);
  }
  void operator()(AbaqusEquation& e) const {
    for (AbaqusEquation::Term& term : e.terms) (*this)(term.nodes);
  }
  void operator()(AbaqusSpider& s) const {
    (*this)(s.reference);
    if (s.surface) (*this)(*s.surface);
    if (s.rotation) (*this)(*s.rotation);
    for (auto* list : {&s.nodes, &s.elements})
      for (AbaqusReference& r : *list) (*this)(r);
  }

 private:
  AbaqusScope from_, to_;
};

AbaqusScope scope_of(const AbaqusSection& s) { return s.elements.scope; }
AbaqusScope scope_of(const AbaqusSpring& s) { return s.elements.scope; }
AbaqusScope scope_of(const AbaqusSupport& s) { return s.nodes.scope; }
AbaqusScope scope_of(const AbaqusThickness& t) { return t.nodes.scope; }
AbaqusScope scope_of(const AbaqusNonstructuralMass& m) { return m.elements.scope; }
AbaqusScope scope_of(const AbaqusPreTension& p) { return p.surface.scope; }
AbaqusScope scope_of(const AbaqusTie& t) { return t.slave.scope; }
AbaqusScope scope_of(const AbaqusTransform& t) { return t.scope; }
AbaqusScope scope_of(const AbaqusSpider& s) { return s.reference.scope; }
AbaqusScope scope_of(const AbaqusEquation& e) {
  return e.terms.empty() ? AbaqusScope::assembly : e.terms.front().nodes.scope;
}

/// Calls `use` with each list of things that belong to a scope and its place in AbaqusSizes.
template <typename Content, typename Use>
void each_list(Content& c, Use use) {
  std::size_t place = 2;
  use(c.sections, place++);
  use(c.masses, place++);
  use(c.spiders, place++);
  use(c.equations, place++);
  use(c.supports, place++);
  use(c.ties, place++);
  use(c.springs, place++);
  use(c.transforms, place++);
  use(c.thicknesses, place++);
  use(c.nonstructural, place++);
  use(c.pre_tensions, place++);
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

std::int64_t weight(const AbaqusSet& set) { return static_cast<std::int64_t>(set.items.size()); }
std::int64_t weight(const AbaqusSurface& s) { return static_cast<std::int64_t>(s.items.size()); }
std::int64_t weight(const AbaqusOrientation&) { return 1; }
std::int64_t weight(const AbaqusEquation& e) { return static_cast<std::int64_t>(e.terms.size()); }
std::int64_t weight(const AbaqusSpider& s) {
  return static_cast<std::int64_t>(1 + s.nodes.size() + s.elements.size());
}
std::int64_t weight(const AbaqusSection& s) {
  return static_cast<std::int64_t>(1 + s.plies.size());
}
template <typename T>
std::int64_t weight(const T&) {
  return 1;
}

template <typename Map>
void copy_names(Map& map, AbaqusScope from, AbaqusScope to, TextSource& source) {
  const ScopeChange change(from, to);
  std::vector<std::pair<typename Map::key_type, typename Map::mapped_type>> copies;
  const auto [begin, end] = entries_of(map, from);
  for (auto it = begin; it != end; ++it) {
    source.make(weight(it->second));
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
  for (std::size_t k = part.begin[0]; k < part.end[0]; ++k) {
    AbaqusNode node = c.nodes[k];
    node.scope = to;
    c.node_of_label.emplace(AbaqusContent::label(to, node.id), static_cast<int>(c.nodes.size()));
    c.nodes.push_back(node);
  }
  for (std::size_t k = part.begin[1]; k < part.end[1]; ++k) {
    AbaqusElement element = c.elements[k];  // the numbers of its nodes are the same
    element.scope = to;
    c.element_of_label.emplace(AbaqusContent::label(to, element.id),
                               static_cast<int>(c.elements.size()));
    c.elements.push_back(element);
  }
  copy_names(c.node_sets, part.scope, to, source);
  copy_names(c.element_sets, part.scope, to, source);
  copy_names(c.surfaces, part.scope, to, source);
  copy_names(c.orientations, part.scope, to, source);
  each_list(c, [&](auto& list, std::size_t place) {
    for (std::size_t k = part.begin[place]; k < part.end[place]; ++k) {
      if (scope_of(list[k]) != part.scope) continue;
      auto copy = list[k];
      source.make(weight(copy));
      change(copy);
      list.push_back(std::move(copy));
    }
  });
}

void remove_abaqus_scopes(AbaqusContent& c, const std::set<AbaqusScope>& scopes) {
  const auto gone = [&](AbaqusScope scope) { return scopes.contains(scope); };
  std::erase_if(c.nodes, [&](const AbaqusNode& n) { return gone(n.scope); });
  std::erase_if(c.elements, [&](const AbaqusElement& e) { return gone(e.scope); });
  c.node_of_label.clear();
  for (std::size_t k = 0; k < c.nodes.size(); ++k)
    c.node_of_label.emplace(AbaqusContent::label(c.nodes[k].scope, c.nodes[k].id),
                            static_cast<int>(k));
  c.element_of_label.clear();
  for (std::size_t k = 0; k < c.elements.size(); ++k)
    c.element_of_label.emplace(AbaqusContent::label(c.elements[k].scope, c.elements[k].id),
                               static_cast<int>(k));
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
