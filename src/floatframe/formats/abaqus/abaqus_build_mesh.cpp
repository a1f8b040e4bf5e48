// Nodes, elements, masses and sets of an Abaqus deck in the model.
#include <fmt/format.h>

#include <algorithm>

#include "floatframe/formats/abaqus/abaqus_build.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

constexpr int most_renumbered = 20;  // of a kind

/// How many elements of a type there are, and where the first stands.
struct Count {
  long number = 0;
  FeSource at;
  void add(const FeSource& source) {
    if (number++ == 0) at = source;
  }
};

void build_masses(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  const std::vector<int> section_of = sections_of_elements(build, c.masses);
  for (std::size_t e = 0; e < c.elements.size(); ++e) {
    const AbaqusElement& element = c.elements[e];
    const bool rotary = element.type->family == Family::rotary;
    if (!rotary && element.type->family != Family::mass) continue;
    if (section_of[e] < 0) {
      build.source.error(element.at, fmt::format("{} has no {}", abaqus_label(element),
                                                 rotary ? "*ROTARY INERTIA" : "*MASS"));
      continue;
    }
    const AbaqusSection& section = c.masses[section_of[e]];
    const auto node =
        c.node_of_label.find(AbaqusContent::label(element.scope, c.element_nodes[element.first]));
    if (node == c.node_of_label.end()) {
      build.source.error(element.at,
                         fmt::format("{}: node {} does not exist", abaqus_label(element),
                                     c.element_nodes[element.first]));
      continue;
    }
    const Mat3& R = c.placement.R;
    build.model.masses.push_back({node->second, section.mass, R * section.J * R.transpose()});
  }
}

}  // namespace

void AbaqusBuild::note(const FeSource& at, const std::string& text) {
  const SourceMark m = source.mark(at);
  model.notes.push_back(fmt::format("{}:{}: {}", m.file, m.line, text));
}

std::vector<int> AbaqusBuild::nodes_of_elements(const std::vector<int>& list) {
  std::vector<int> result;
  list_of_node_.resize(content.nodes.size(), 0);
  ++node_list_;
  for (const int e : list) {
    const AbaqusElement& element = content.elements[e];
    for (int k = 0; k < element.type->nodes; ++k) {
      const auto it = content.node_of_label.find(
          AbaqusContent::label(element.scope, content.element_nodes[element.first + k]));
      if (it == content.node_of_label.end()) continue;
      int& last = list_of_node_[it->second];
      if (last == node_list_) continue;
      last = node_list_;
      result.push_back(it->second);
    }
  }
  return result;
}

void build_abaqus_nodes(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  FeModel& model = build.model;
  const AbaqusPlacement& place = c.placement;
  int free_number = 0, renumbered = 0;
  for (const AbaqusNode& node : c.nodes) free_number = std::max(free_number, node.id);
  model.positions.reserve(c.nodes.size());
  model.node_ids.reserve(c.nodes.size());
  model.node_sources.reserve(c.nodes.size());
  for (const AbaqusNode& node : c.nodes) {
    const bool in_part = node.scope == AbaqusScope::part;
    model.positions.push_back(in_part && !c.instance.empty()
                                  ? Vec3(place.R * (node.p + place.t - place.a) + place.a)
                                  : node.p);
    int id = node.id;
    if (!in_part && c.node_of_label.contains(AbaqusContent::label(AbaqusScope::part, id))) {
      if (free_number == std::numeric_limits<int>::max()) {
        build.source.error(node.at, fmt::format("node {} of the assembly has the number of a node "
                                                "of the part",
                                                id));
      } else {
        id = ++free_number;
        if (++renumbered <= most_renumbered) {
          build.note(node.at, fmt::format("node {} of the assembly has the number of a node of the "
                                          "part: it becomes node {}",
                                          node.id, id));
        }
      }
    }
    model.node_ids.push_back(id);
    model.node_sources.push_back(node.at);
  }
  if (renumbered > most_renumbered) {
    build.note({0, 0},
               fmt::format("{} more nodes of the assembly have numbers of nodes of the part "
                           "and become others",
                           renumbered - most_renumbered));
  }
}

namespace {

/// Elements of one kind, for a note.
struct ElementCounts {
  std::map<const AbaqusType*, Count> skins, read_as;
  Count without_section, structural;
};

void note_elements(AbaqusBuild& build, const ElementCounts& counts) {
  if (counts.structural.number == 0) {
    build.source.error({0, 0}, "the deck has no element with stiffness");
  }
  for (const auto& [type, count] : counts.skins) {
    build.note(count.at, fmt::format("{} elements of type {} have no section: skins of the mesh, "
                                     "passed over; their element sets are node sets",
                                     count.number, type->name));
  }
  for (const auto& [type, count] : counts.read_as) {
    build.note(count.at, fmt::format("{} elements of type {} are read {}", count.number, type->name,
                                     type->remark));
  }
}

void no_section(AbaqusBuild& build, const AbaqusElement& element) {
  const Family family = element.type->family;
  build.source.error(
      element.at,
      fmt::format("{} has no section: no *{} SECTION names a set with it", abaqus_label(element),
                  family == Family::solid   ? "SOLID"
                  : family == Family::shell ? "SHELL"
                                            : "BEAM"));
}

/// Nothing if one of its nodes is not there.
std::optional<Element> element_of(AbaqusBuild& build, const AbaqusElement& element,
                                  const AbaqusProperties& p) {
  const AbaqusContent& c = build.content;
  Element result;
  result.type = element.type->type;
  result.material = p.material;
  result.section = p.section;
  result.reference = p.reference;
  result.id = element.id;
  result.source = element.at;
  for (int k = 0; k < element.type->nodes; ++k) {
    const int id = c.element_nodes[element.first + k];
    const auto it = c.node_of_label.find(AbaqusContent::label(element.scope, id));
    if (it == c.node_of_label.end()) {
      build.source.error(element.at,
                         fmt::format("{}: node {} does not exist", abaqus_label(element), id));
      return std::nullopt;
    }
    result.nodes[k] = it->second;
  }
  return result;
}

}  // namespace

void build_abaqus_elements(AbaqusBuild& build, const FeReadOptions& options) {
  const AbaqusContent& c = build.content;
  FeModel& model = build.model;
  const std::size_t before = build.source.errors();
  const std::vector<int> section_of = sections_of_elements(build, c.sections);
  const bool assigned = build.source.errors() == before;
  look_at_abaqus_beams(build, section_of);
  const std::vector<AbaqusProperties> properties = abaqus_properties(build);
  const bool mesh_only = c.sections.empty() && c.materials.empty();
  AbaqusProperties given;
  if (mesh_only && options.material) {
    model.materials.push_back(*options.material);
    model.material_names.emplace_back();
    given.material = 0;
  }
  const bool has_shells =
      std::any_of(c.sections.begin(), c.sections.end(),
                  [](const AbaqusSection& s) { return s.family == Family::shell; });
  ElementCounts counts;
  for (std::size_t e = 0; e < c.elements.size(); ++e) {
    const AbaqusElement& element = c.elements[e];
    const AbaqusType& type = *element.type;
    const int section = section_of[e];
    // Shells are skins of a solid unless the deck has shells.
    const bool skin = section < 0 && (type.family == Family::skin || type.family == Family::rod ||
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
      build.source.error(c.sections[section].at,
                         fmt::format("*SOLID SECTION names {}, which needs the area of its section "
                                     "in the line below",
                                     abaqus_label(element)));
      continue;
    }
    if (type.remark != nullptr) counts.read_as[&type].add(element.at);
    auto result = element_of(build, element, section < 0 ? given : properties[section]);
    if (!result) continue;
    if (section >= 0)
      orient_abaqus_element(build, c.sections[section], properties[section], *result);
    build.element_index[e] = static_cast<int>(model.elements.size());
    model.elements.push_back(*result);
  }
  note_elements(build, counts);
  if (mesh_only && !options.material && counts.structural.number > 0) {
    build.note(counts.structural.at, "the deck has no material");
  }
  if (!mesh_only && options.material) {
    build.note({0, 1}, "the deck has materials of its own; the one given is not used");
  }
  build_masses(build);
}

void build_abaqus_sets(AbaqusBuild& build, bool only_nodes) {
  const AbaqusContent& c = build.content;
  FeModel& model = build.model;
  const auto name_of = [&](const AbaqusContent::Key& key, const auto& sets) {
    const std::string& name = c.names[key.second];
    const bool twice =
        key.first == AbaqusScope::part && sets.contains({AbaqusScope::assembly, key.second});
    return twice ? c.instance + "." + name : name;
  };
  for (const auto& [key, set] : c.node_sets) {
    const std::vector<int>& members = build.nodes.members(key);
    if (!set.internal) model.node_sets[name_of(key, c.node_sets)] = members;
  }
  for (const auto& [key, set] : c.element_sets) {
    const std::vector<int>& members = build.elements.members(key);
    if (set.internal) continue;
    const std::string name = name_of(key, c.element_sets);
    std::vector<int> list, skins;
    for (const int e : members) {
      const int index = build.element_index[e];
      const Family family = c.elements[e].type->family;
      if (index >= 0) {
        list.push_back(index);
      } else if (only_nodes || family == Family::skin || family == Family::shell ||
                 family == Family::rod) {
        skins.push_back(e);
      }
    }
    if (!skins.empty()) model.node_sets.emplace(name, build.nodes_of_elements(skins));
    if (!list.empty()) model.element_sets[name] = std::move(list);
  }
  for (const auto* resolver : {&build.nodes, &build.elements}) {
    if (resolver->gaps() == 0) continue;
    build.note(resolver->first_gap(),
               fmt::format("{} numbers of GENERATE do not exist", resolver->gaps()));
  }
}

}  // namespace floatframe
