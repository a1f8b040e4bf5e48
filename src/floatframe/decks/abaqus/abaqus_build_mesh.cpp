// Nodes, elements, masses and sets of an Abaqus deck in the model.
#include <algorithm>
#include <limits>
#include <unordered_set>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/number_sizes.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

/// Number of elements of a type, and location of the first.
struct Count {
  long number = 0;
  FeSource at;
  void add(const FeSource& source) {
    if (number++ == 0) at = source;
  }
};

/// The numbers of nodes or elements in the model: new ones if another instance or the assembly
/// uses them. Numbers of one scope are different, so only several scopes can share one.
class Renumbered {
 public:
  template <class T>
  Renumbered(AbaqusBuild& build, const char* what, const AbaqusNumbered<T>& all)
      : b_(build), what_(what) {
    for (const T& thing : all) free_ = std::max<std::int64_t>(free_, thing.id);
  }
  /// Null if there is no free one.
  std::optional<int> number(AbaqusScope scope, int old, const FeSource& at) {
    if (b_.content.parts.empty() || taken_.insert(old).second) return old;
    if (++free_ > std::numeric_limits<int>::max()) return std::nullopt;
    const int fresh = static_cast<int>(free_);
    Range& r = ranges_[scope];
    if (r.count++ == 0) r = {1, old, fresh, fresh, at};
    r.last = fresh;
    return fresh;
  }
  void note() {
    for (const auto& [scope, r] : ranges_) {
      const auto instance = b_.content.instances.find(scope);
      const std::string of = scope == AbaqusScope::assembly ? std::string("the assembly")
                             : instance == b_.content.instances.end()
                                 ? std::string("the part")
                                 : "instance " + shown(instance->second.name);
      if (r.count == 1)
        b_.note(r.at, "{} {} of {} has the number of another one: it becomes {} {}", what_, r.old,
                of, what_, r.first);
      else
        b_.note(r.at, "{} {}s of {} have numbers of others: they become {} to {}", r.count, what_,
                of, r.first, r.last);
    }
  }

 private:
  struct Range {
    long count = 0;
    int old = 0, first = 0, last = 0;
    FeSource at;
  };
  AbaqusBuild& b_;
  const char* what_;
  std::int64_t free_ = 0;
  std::unordered_set<int> taken_;
  std::map<AbaqusScope, Range> ranges_;
};

void build_masses(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  const std::vector<int> section_of = sections_of_elements(build, c.masses);
  for (std::size_t e = 0; e < c.elements.size(); ++e) {
    const AbaqusElement& element = c.elements[e];
    const bool rotary = element.type->family == Family::rotary;
    if (!rotary && element.type->family != Family::mass) continue;
    if (section_of[e] < 0) {
      build.error(element, ErrorCode::missing, " has no {}", rotary ? "*ROTARY INERTIA" : "*MASS");
      continue;
    }
    const AbaqusSection& section = c.masses[section_of[e]];
    const int node = build.node_of(element, 0);
    if (node < 0) continue;
    if (const std::string huge = huge_mass(section.mass, section.J); !huge.empty())
      build.error(section, ErrorCode::not_finite, " of {}: {}", abaqus_label(element), huge);
    const Mat3& R = c.placement(element.scope).R;
    build.model.masses.push_back({node, section.mass, R * section.J * R.transpose(),
                                  section.where.at,
                                  fmt::format("{} of {}", section.shown, abaqus_label(element))});
  }
}

}  // namespace

DeckDialect AbaqusBuild::dialect() const {
  if (content.options.dialect != DeckDialect::by_content) return content.options.dialect;
  if (clues.abaqus.has_value() == clues.calculix.has_value()) return DeckDialect::by_content;
  return clues.abaqus ? DeckDialect::abaqus : DeckDialect::calculix;
}

int AbaqusBuild::node_of(const AbaqusElement& element, int k) {
  const int node = content.node_of(element, k);
  if (node < 0)
    error(element, ErrorCode::not_found, ": node {} does not exist",
          content.element_nodes[element.first + k]);
  return node;
}

std::vector<int> AbaqusBuild::nodes_of_elements(const std::vector<int>& list) const {
  std::vector<int> result;
  std::unordered_set<int> known;
  for (const int e : list)
    for (int k = 0; k < content.elements[e].type->nodes; ++k)
      if (const int node = content.node_of(content.elements[e], k);
          node >= 0 && known.insert(node).second)
        result.push_back(node);
  return result;
}

void build_abaqus_nodes(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  FeModel& model = build.model;
  const bool several = c.instances.size() > 1;
  model.positions.reserve(c.nodes.size());
  model.node_ids.reserve(c.nodes.size());
  model.node_sources.reserve(c.nodes.size());
  Renumbered numbers(build, "node", c.nodes);
  for (const AbaqusNode& node : c.nodes) {
    model.positions.push_back(c.placement(node.scope).at(node.p));
    if (const std::string huge = huge_place(model.positions.back()); !huge.empty())
      build.source.error(ErrorCode::not_finite, node.at, "node {}{}: {}", c.prefix(node.scope),
                         node.id, huge);
    const std::optional<int> id = numbers.number(node.scope, node.id, node.at);
    if (!id)
      build.source.stop(ErrorCode::out_of_range, node.at,
                        "node {}{} has the number of another node, and there is no free one",
                        c.prefix(node.scope), node.id);
    model.node_ids.push_back(*id);
    model.node_sources.push_back(node.at);
    if (several)
      model.node_names.push_back(c.instances.contains(node.scope)
                                     ? fmt::format("{}{}", c.prefix(node.scope), node.id)
                                     : std::string());
  }
  numbers.note();
  build.source.throw_if_any();
}

namespace {

bool is_skin_without_section(Family family) noexcept {
  return family == Family::skin || family == Family::rod || family == Family::membrane;
}

/// Elements of one kind, for a note.
struct ElementCounts {
  std::map<const AbaqusType*, Count> skins, read_as;
  Count without_section, structural;
};

void note_elements(AbaqusBuild& build, const ElementCounts& counts) {
  if (counts.structural.number == 0)
    build.source.error(ErrorCode::missing, {0, 0}, "the deck has no element with stiffness");
  for (const auto& [type, count] : counts.skins)
    build.note(count.at,
               "{} elements of type {} have no section: skins of the mesh, ignored; their element "
               "sets are node sets",
               count.number, type->name);
  for (const auto& [type, count] : counts.read_as)
    build.note(count.at, "{} elements of type {} are read {}", count.number, type->name,
               type->remark);
}

void note_materials(AbaqusBuild& build, const ElementCounts& counts, bool mesh_only, bool given) {
  if (mesh_only && !given && counts.structural.number > 0)
    build.note(counts.structural.at, "the deck has no material");
  if (!mesh_only && given)
    build.note({0, 1}, "the deck has materials of its own; the one given is not used");
}

void no_section(AbaqusBuild& build, const AbaqusElement& element) {
  const Family family = element.type->family;
  build.error(element, ErrorCode::missing, " has no section: no *{} SECTION names a set with it",
              family == Family::solid   ? "SOLID"
              : family == Family::shell ? "SHELL"
                                        : "BEAM");
}

/// Null if one of its nodes is missing.
std::optional<FeElement> element_of(AbaqusBuild& build, const AbaqusElement& element,
                                    const AbaqusProperties& p) {
  FeElement result = p.like;
  result.type = element.type->type;
  result.id = element.id;
  result.source = element.at;
  for (int k = 0; k < element.type->nodes; ++k) {
    result.nodes[k] = build.node_of(element, k);
    if (result.nodes[k] < 0) return std::nullopt;
  }
  return result;
}

}  // namespace

void build_abaqus_elements(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  FeModel& model = build.model;
  const std::size_t before = build.source.errors();
  const std::vector<int> section_of = sections_of_elements(build, c.sections);
  const bool assigned = build.source.errors() == before;
  look_at_abaqus_beams(build, section_of);
  const std::vector<AbaqusProperties> properties = abaqus_properties(build);
  const bool mesh_only = c.sections.empty() && c.materials.empty();
  const std::optional<Material>& material = c.options.material;
  AbaqusProperties given;
  given.like.material = mesh_only && material ? 0 : -1;
  if (mesh_only && material) {
    model.materials.push_back(*material);
    model.material_names.emplace_back();
  }
  const bool has_shells =
      std::any_of(c.sections.begin(), c.sections.end(),
                  [](const AbaqusSection& s) { return s.family == Family::shell; });
  AbaqusNodalThickness thickness(build);
  ElementCounts counts;
  Renumbered numbers(build, "element", c.elements);
  std::unordered_set<int> without_area;
  for (std::size_t e = 0; e < c.elements.size(); ++e) {
    const AbaqusElement& element = c.elements[e];
    const AbaqusType& type = *element.type;
    const int section = section_of[e];
    // Shells are skins of a solid unless the deck has shells.
    const bool skin = section < 0 && (is_skin_without_section(type.family) ||
                                      (type.family == Family::shell && !has_shells));
    if (skin) counts.skins[&type].add(element.at);
    if (type.family == Family::spring) counts.structural.add(element.at);
    if (skin || is_abaqus_point(type.family)) continue;
    counts.structural.add(element.at);
    const bool material_given = mesh_only && type.family == Family::solid;
    if (section < 0 && !material_given) {
      if (counts.without_section.number == 0 && assigned) no_section(build, element);
      counts.without_section.add(element.at);
      continue;
    }
    if (type.family == Family::rod && !(c.sections[section].thickness > 0.0)) {
      if (without_area.insert(section).second)
        build.source.error(
            ErrorCode::incomplete, c.sections[section].where.at,
            "*SOLID SECTION names {}, which needs the area of its section in the line below",
            abaqus_label(element));
      continue;
    }
    if (type.remark != nullptr) counts.read_as[&type].add(element.at);
    auto result = element_of(build, element, section < 0 ? given : properties[section]);
    if (!result) continue;
    if (section >= 0) {
      orient_abaqus_element(build, c.sections[section], properties[section], *result);
      thickness.apply(c.sections[section], *result);
      move_abaqus_beam(build, c.sections[section], element, *result);
    }
    build.element_index[e] = static_cast<int>(model.elements.size());
    result->id = numbers.number(element.scope, result->id, element.at).value_or(result->id);
    if (c.instances.size() > 1 && c.instances.contains(element.scope))
      result->name =
          fmt::format("element {}{} ({})", c.prefix(element.scope), element.id, type.name);
    model.elements.push_back(*result);
  }
  report_abaqus_directions(build);
  thickness.notes();
  note_elements(build, counts);
  numbers.note();
  note_materials(build, counts, mesh_only, material.has_value());
  build_masses(build);
}

void build_abaqus_sets(AbaqusBuild& build, bool only_nodes) {
  const AbaqusContent& c = build.content;
  FeModel& model = build.model;
  for (const auto& [key, set] : c.node_sets) {
    const std::vector<int>& members = build.nodes.members(key);
    if (!set.internal) model.node_sets[abaqus_model_name(c, key, c.node_sets)] = members;
  }
  for (const auto& [key, set] : c.element_sets) {
    const std::vector<int>& members = build.elements.members(key);
    if (set.internal) continue;
    const std::string name = abaqus_model_name(c, key, c.element_sets);
    std::vector<int> list, skins;
    for (const int e : members) {
      const int index = build.element_index[e];
      const Family family = c.elements[e].type->family;
      if (index >= 0)
        list.push_back(index);
      else if (only_nodes || is_skin_without_section(family) || family == Family::shell)
        skins.push_back(e);
    }
    if (!skins.empty()) model.node_sets.emplace(name, build.nodes_of_elements(skins));
    if (!list.empty()) model.element_sets[name] = std::move(list);
  }
  for (const auto* resolver : {&build.nodes, &build.elements}) {
    if (resolver->gaps() == 0) continue;
    build.note(resolver->first_gap(), "{} numbers of GENERATE do not exist", resolver->gaps());
  }
}

}  // namespace floatframe
