// Parts and instances of an Abaqus deck. Each instance has the numbers and names of its part, the
// assembly has separate ones; it refers to an instance by INSTANCE.NAME and INSTANCE.12. The
// content of the scope of a part is copied for each further instance, and omitted for a part
// without instances.
#include <algorithm>
#include <numbers>
#include <set>

#include "floatframe/core/suggest.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// A name without an instance is looked up in all of them.
constexpr std::size_t most_instances = 2000;

/// Copies the references of an item into another scope.
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

/// Calls `use` with each list of items that belong to a scope and its index in AbaqusSizes.
template <typename Content, typename Use>
void each_list(Content& c, Use use) {
  const auto all = [&](auto&... lists) {
    std::size_t place = 2;
    (use(lists, place++), ...);
  };
  all(c.sections, c.masses, c.spiders, c.equations, c.supports, c.ties, c.springs, c.transforms,
      c.thicknesses, c.nonstructural, c.pre_tensions);
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

/// Copies the names of a scope into another one; the keys begin with it.
template <typename Map>
void copy_names(Map& map, AbaqusScope from, AbaqusScope to, TextSource& source) {
  const ScopeChange change(from, to);
  std::vector<std::pair<typename Map::key_type, typename Map::mapped_type>> copies;
  for (auto it = map.lower_bound({from, {}}); it != map.end() && it->first.first == from; ++it) {
    source.make(static_cast<std::int64_t>(weight(it->second)));
    copies.emplace_back(typename Map::key_type{to, it->first.second}, it->second);
  }
  for (auto& [key, value] : copies) {
    change(value);
    map.emplace(key, std::move(value));
  }
}

AbaqusSizes abaqus_sizes(const AbaqusContent& c) {
  AbaqusSizes sizes{c.nodes.size(), c.elements.size()};
  each_list(c, [&](const auto& list, std::size_t place) { sizes[place] = list.size(); });
  return sizes;
}

/// Copies the content of a part for an instance of it. Throws if instances need too much memory.
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

void open_block(AbaqusCard& card) {
  card.content.open.push_back({card.name, card.word("NAME"), card.at});
}

void close_last(AbaqusContent& content, TextSource& source, const std::string& where) {
  const AbaqusOpenBlock block = std::move(content.open.back());
  content.open.pop_back();
  source.error(ErrorCode::missing, block.at, "*{} {} has no end, expected *END {} {}",
               block.keyword, shown(block.name), block.keyword, where);
}

/// Open blocks inside it have no end; an error if it has not begun.
void close_block(AbaqusCard& card) {
  std::vector<AbaqusOpenBlock>& open = card.content.open;
  const std::string begin = card.name.substr(3);  // "ENDPART"
  if (std::none_of(open.begin(), open.end(),
                   [&](const AbaqusOpenBlock& b) { return b.keyword == begin; }))
    return card.error(ErrorCode::incomplete, "ends no *{}, expected one before it", begin);
  while (open.back().keyword != begin)
    close_last(card.content, card.source, "before " + card.shown);
  open.pop_back();
}

void enter_scope(AbaqusContent& content, AbaqusScope scope) {
  content.scope = scope;
  content.system.reset();
}

AbaqusScope new_scope(AbaqusContent& content) { return static_cast<AbaqusScope>(content.scopes++); }

void read_placement(AbaqusCard& card, AbaqusPlacement& place) {
  if (card.next()) place.t = card.vector(0, "translation of the instance");
  if (!card.next()) return;
  if (card.field(6).empty())
    return card.error_in_line(ErrorCode::wrong_count,
                              "the rotation of the instance has {} numbers, expected seven: two "
                              "points of the axis and the angle",
                              std::min<std::size_t>(card.fields.size(), 6));
  constexpr const char* axis_name = "axis of the instance's rotation";
  place.a = card.vector(0, axis_name);
  const Vec3 axis = card.vector(3, axis_name) - place.a;
  const double degrees = card.real_or(6, 0.0, "angle of the instance's rotation");
  if (card.misread()) return;
  if (!(axis.stableNorm() > 0.0) || !std::isfinite(axis.stableNorm()))
    return card.error_in_line(ErrorCode::geometry,
                              "the two points of the axis of the instance's rotation are one");
  place.R = Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.stableNormalized())
                .toRotationMatrix();
}

/// The part of an instance; throws where an instance is not allowed.
AbaqusPart& part_of_instance(AbaqusCard& card, const std::string& name, const std::string& part) {
  AbaqusContent& content = card.content;
  const auto it = content.parts.find(part);
  if (it == content.parts.end())
    card.source.stop(ErrorCode::not_found, card.at,
                     "*INSTANCE {} is of the part {}, which does not exist{}", shown(name),
                     shown(part), did_you_mean(part, keys_of(content.parts)));
  if (content.scope_of_instance.contains(name))
    card.source.stop(ErrorCode::duplicate, card.at, "*INSTANCE {} is there already", shown(name));
  if (content.instances.size() == most_instances)
    card.source.stop(ErrorCode::too_large, card.at, "the deck has more than {} instances",
                     most_instances);
  if (it->second.used && it->second.grown && it->second.is_meshed())
    card.source.stop(ErrorCode::unsupported, card.at,
                     "*INSTANCE {} is a second one of the part {}, whose first one has nodes or "
                     "elements of its own; give each a part",
                     shown(name), shown(part));
  return it->second;
}

}  // namespace

void close_abaqus_blocks(AbaqusContent& content, TextSource& source, const std::string& where) {
  while (!content.open.empty()) close_last(content, source, where);
}

void read_abaqus_part(AbaqusCard& card) {
  AbaqusContent& content = card.content;
  close_abaqus_blocks(content, card.source, "before the next *PART");
  open_block(card);
  const std::string name = abaqus_name(card.required("NAME"));
  AbaqusPart part;
  part.at = card.at;
  part.scope = content.parts.empty() ? AbaqusScope::part : new_scope(content);
  part.begin = part.end = abaqus_sizes(content);
  content.part = name.empty() ? "?" : name;
  const auto [it, fresh] = content.parts.emplace(content.part, part);
  if (!fresh)
    card.source.stop(ErrorCode::duplicate, card.at, "*PART {} is there already ({})", shown(name),
                     card.place(it->second.at));
  enter_scope(content, part.scope);
}

void read_abaqus_assembly(AbaqusCard& card) {
  close_abaqus_blocks(card.content, card.source, "before *ASSEMBLY");
  open_block(card);
  enter_scope(card.content, AbaqusScope::assembly);
}

void read_abaqus_instance(AbaqusCard& card) {
  AbaqusContent& content = card.content;
  while (!content.open.empty() && content.open.back().keyword != "ASSEMBLY")
    close_last(content, card.source, "before the next *INSTANCE");
  open_block(card);
  const std::string name = abaqus_name(card.required("NAME"));
  AbaqusInstance instance;
  instance.name = name.empty() ? "?" : name;
  instance.part = abaqus_name(card.required("PART"));
  AbaqusPart& part = part_of_instance(card, name, instance.part);
  const AbaqusScope scope = part.used ? new_scope(content) : part.scope;
  if (part.used && part.is_meshed()) copy_abaqus_part(content, part, scope, card.source);
  part.used = true;
  read_placement(card, instance.place);
  instance.begin = abaqus_sizes(content);
  content.scope_of_instance.emplace(instance.name, scope);
  content.instances.emplace(scope, std::move(instance));
  content.scope = scope;
}

/// *END PART, *END INSTANCE, *END ASSEMBLY.
void read_abaqus_end(AbaqusCard& card) {
  AbaqusContent& content = card.content;
  close_block(card);
  if (const auto it = content.parts.find(content.part);
      card.name == "ENDPART" && it != content.parts.end())
    it->second.end = abaqus_sizes(content);
  if (const auto it = content.instances.find(content.scope);
      card.name == "ENDINSTANCE" && it != content.instances.end()) {
    AbaqusPart& part = content.parts.at(it->second.part);
    part.grown = part.grown || it->second.begin[0] < content.nodes.size() ||
                 it->second.begin[1] < content.elements.size();
  }
  enter_scope(content, AbaqusScope::assembly);
}

void finish_abaqus_assembly(AbaqusContent& content, TextSource& source) {
  close_abaqus_blocks(content, source, "before the end of the deck");
  if (content.parts.size() > 1 && content.instances.empty())
    source.error(ErrorCode::missing, std::next(content.parts.begin())->second.at,
                 "the deck has {} parts and no instance of any (*INSTANCE)", content.parts.size());
  if (content.instances.empty()) return;
  std::set<AbaqusScope> unused;
  for (const auto& [name, part] : content.parts) {
    if (part.used) continue;
    content.note(source.mark(part.at),
                 fmt::format("part {} has no instance and is left out", shown(name)));
    unused.insert(part.scope);
  }
  if (!unused.empty()) remove_abaqus_scopes(content, unused);
}

}  // namespace floatframe
