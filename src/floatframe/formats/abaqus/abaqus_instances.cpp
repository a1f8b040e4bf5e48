// Parts of Abaqus decks that have several instances, and parts that have none: what stands in a
// scope, once more in another one or not at all.
#include <algorithm>
#include <limits>

#include "floatframe/formats/abaqus/abaqus_content.hpp"

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
AbaqusScope scope_of(const AbaqusTie& t) { return t.slave.scope; }
AbaqusScope scope_of(const AbaqusTransform& t) { return t.scope; }
AbaqusScope scope_of(const AbaqusSpider& s) { return s.reference.scope; }
AbaqusScope scope_of(const AbaqusEquation& e) {
  return e.terms.empty() ? AbaqusScope::assembly : e.terms.front().nodes.scope;
}

/// Calls `use` with each list of things that belong to a scope.
template <typename Use>
void each_list(AbaqusContent& c, Use use) {
  use(c.sections);
  use(c.masses);
  use(c.spiders);
  use(c.equations);
  use(c.supports);
  use(c.ties);
  use(c.springs);
  use(c.transforms);
}

template <typename Map>
void copy_names(Map& map, AbaqusScope from, AbaqusScope to) {
  const ScopeChange change(from, to);
  std::vector<typename Map::value_type> copies;
  for (const auto& [key, value] : map)
    if (key.first == from) copies.emplace_back(typename Map::key_type{to, key.second}, value);
  for (auto& [key, value] : copies) {
    change(value);
    map.emplace(key, std::move(value));
  }
}

}  // namespace

void copy_abaqus_part(AbaqusContent& c, const AbaqusPart& part, AbaqusScope to) {
  const ScopeChange change(part.scope, to);
  for (std::size_t k = part.nodes; k < part.nodes_end; ++k) {
    AbaqusNode node = c.nodes[k];
    node.scope = to;
    c.node_of_label.emplace(AbaqusContent::label(to, node.id), static_cast<int>(c.nodes.size()));
    c.nodes.push_back(node);
  }
  for (std::size_t k = part.elements; k < part.elements_end; ++k) {
    AbaqusElement element = c.elements[k];  // the numbers of its nodes are the same
    element.scope = to;
    c.element_of_label.emplace(AbaqusContent::label(to, element.id),
                               static_cast<int>(c.elements.size()));
    c.elements.push_back(element);
  }
  copy_names(c.node_sets, part.scope, to);
  copy_names(c.element_sets, part.scope, to);
  copy_names(c.surfaces, part.scope, to);
  copy_names(c.orientations, part.scope, to);
  each_list(c, [&](auto& list) {
    const std::size_t count = list.size();
    for (std::size_t k = 0; k < count; ++k) {
      if (scope_of(list[k]) != part.scope) continue;
      auto copy = list[k];
      change(copy);
      list.push_back(std::move(copy));
    }
  });
}

void remove_abaqus_scope(AbaqusContent& c, AbaqusScope scope) {
  std::erase_if(c.nodes, [&](const AbaqusNode& n) { return n.scope == scope; });
  std::erase_if(c.elements, [&](const AbaqusElement& e) { return e.scope == scope; });
  c.node_of_label.clear();
  for (std::size_t k = 0; k < c.nodes.size(); ++k)
    c.node_of_label.emplace(AbaqusContent::label(c.nodes[k].scope, c.nodes[k].id),
                            static_cast<int>(k));
  c.element_of_label.clear();
  for (std::size_t k = 0; k < c.elements.size(); ++k)
    c.element_of_label.emplace(AbaqusContent::label(c.elements[k].scope, c.elements[k].id),
                               static_cast<int>(k));
  const auto named = [&](const auto& entry) { return entry.first.first == scope; };
  std::erase_if(c.node_sets, named);
  std::erase_if(c.element_sets, named);
  std::erase_if(c.surfaces, named);
  std::erase_if(c.orientations, named);
  each_list(c, [&](auto& list) {
    std::erase_if(list, [&](const auto& thing) { return scope_of(thing) == scope; });
  });
}

}  // namespace floatframe
