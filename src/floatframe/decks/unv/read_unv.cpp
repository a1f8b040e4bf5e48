#include "floatframe/decks/unv/read_unv.hpp"

#include <algorithm>
#include <unordered_set>

#include "floatframe/decks/rigid_arms.hpp"
#include "floatframe/decks/unv/unv_content.hpp"
#include "floatframe/formats/surface_thickness.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Builds the model from the content of the file.
class UnvBuild {
 public:
  UnvBuild(TextSource& in, UnvContent content, const FeReadOptions& options)
      : in_(in), c_(std::move(content)), thickness_(options.thicknesses) {
    if (options.material) {
      c_.model.materials.push_back(*options.material);
      c_.model.material_names.emplace_back();
      material_ = 0;
    }
  }

  FeModel model() {
    if (thickness_.any()) prepare_shells();
    elements();
    spiders();
    groups();
    notes();
    in_.throw_if_any();
    c_.model.files = in_.files();
    return std::move(c_.model);
  }

 private:
  template <class... Args>
  void note(fmt::format_string<Args...> text, Args&&... args) {
    in_.note(c_.model, {0, 0}, text, std::forward<Args>(args)...);
  }
  template <class... Args>
  void error(ErrorCode code, const UnvElement& e, fmt::format_string<Args...> text,
             Args&&... args) {
    in_.error(code, e.at, "element {} ({}) {}", e.id, e.type->name,
              fmt::format(text, std::forward<Args>(args)...));
  }

  /// The nodes of an element as indices, in the order of the file; false if there is an error,
  /// which is reported once.
  bool gather(const UnvElement& e, std::vector<int>& nodes) {
    if (invalid_.contains(e.first)) return false;
    if (look_up(e, nodes)) return true;
    invalid_.insert(e.first);
    return false;
  }

  bool look_up(const UnvElement& e, std::vector<int>& nodes) {
    nodes.clear();
    once_.clear();
    for (int k = 0; k < e.nodes; ++k) {
      const int id = c_.element_nodes[e.first + k];
      const auto it = c_.node_index.find(id);
      if (it == c_.node_index.end()) {
        error(ErrorCode::not_found, e, "has node {}, which is not in the file", id);
        return false;
      }
      if (!once_.insert(it->second).second) {
        error(ErrorCode::duplicate, e, "has node {} twice", id);
        return false;
      }
      nodes.push_back(it->second);
    }
    return true;
  }

  /// The faces of solids, and the groups of each element that may be a shell.
  void prepare_shells() {
    c_.model.shells = thickness_.sections();
    std::vector<int> nodes, ordered;
    for (const UnvElement& e : c_.elements) {
      if (!e.type->solid() || !gather(e, nodes)) continue;
      put_in_order(*e.type, nodes, ordered);
      thickness_.add_solid(*e.type->element, ordered);
    }
    for (const UnvGroup& group : c_.groups)
      for (const auto& [kind, number] : group.members)
        if (kind == 8) groups_of_[number].push_back(group.name);
  }

  static void put_in_order(const UnvType& type, const std::vector<int>& nodes,
                           std::vector<int>& ordered) {
    ordered.resize(nodes.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) ordered[k] = nodes[type.order[k]];
  }

  /// Its section; -1: a skin.
  int shell_section(const UnvElement& e, const std::vector<int>& nodes) {
    std::vector<int> ordered;
    put_in_order(*e.type, nodes, ordered);
    const std::size_t corners = nodes.size() % 3 == 0 ? 3 : 4;
    const auto groups = groups_of_.find(e.id);
    const SurfaceThickness::Choice choice =
        thickness_.choose(std::span(ordered).first(corners),
                          groups == groups_of_.end() ? std::vector<std::string>() : groups->second);
    if (!choice.error.empty()) error(ErrorCode::wrong_value, e, "{}", choice.error);
    return choice.section;
  }

  void thickness_errors() {
    std::set<std::string> known;
    for (const UnvGroup& group : c_.groups) known.insert(group.name);
    for (std::string& message : thickness_.not_found({known.begin(), known.end()}))
      in_.error(ErrorCode::wrong_value, {0, 0}, std::move(message));
  }

  void elements() {
    std::vector<int> nodes;
    std::set<int> materials;
    for (UnvElement& e : c_.elements) {
      if (e.type->use == UnvUse::refused) {
        in_.error(ErrorCode::unsupported, e.at,
                  "element {} is a {}, whose value is in a table of properties of the format, "
                  "which is not read; remove it and describe it in the model",
                  e.id, e.type->name);
        continue;
      }
      if (e.type->use == UnvUse::left) ++dampers_;
      if (e.type->use == UnvUse::rigid && gather(e, nodes)) join(e, nodes);
      int section = -1;
      if (thickness_.any() && e.type->shell() && gather(e, nodes))
        section = shell_section(e, nodes);
      if (!e.type->solid() && section < 0) {
        skins_ += e.type->use == UnvUse::mesh ? 1 : 0;
        continue;
      }
      if (section < 0 && !gather(e, nodes)) continue;
      FeElement element;
      element.type = *e.type->element;
      element.section = std::max(section, 0);
      for (std::size_t k = 0; k < nodes.size(); ++k) element.nodes[k] = nodes[e.type->order[k]];
      element.material = material_;
      element.id = e.id;
      element.source = e.at;
      e.index = static_cast<int>(c_.model.elements.size());
      c_.model.elements.push_back(std::move(element));
      materials.insert(e.material);
    }
    materials_ = materials.size();
    if (thickness_.any()) thickness_errors();
    if (c_.model.elements.empty() && in_.errors() == 0)
      in_.stop(
          ErrorCode::missing, {0, 0},
          "the file has {} elements and none of them is solid; a part needs tetrahedra, bricks or "
          "wedges, or shells to which a thickness is given (--thickness, key `thickness`)",
          c_.elements.size());
    for (const auto& [system, first] : c_.systems_used) {
      const auto known = c_.systems.find(system);
      if (known != c_.systems.end() ? known->second : system == 0 || system == 1) continue;
      in_.error(ErrorCode::unsupported, first.second,
                "node {} is in coordinate system {}, which is {}; only nodes in global rectangular "
                "coordinates are read",
                first.first, system,
                known == c_.systems.end() ? "not in the file" : "turned, moved or round");
    }
  }

  /// Rigid elements that share a node form one rigid body.
  void join(const UnvElement& e, const std::vector<int>& nodes) {
    if (nodes.size() < 2)
      return error(ErrorCode::wrong_count, e, "has one node, at least 2 are expected");
    for (const int node : nodes) {
      const auto [it, fresh] = joined_.try_emplace(node, node);
      if (fresh) in_order_.emplace_back(node, &e);
    }
    for (const int node : nodes) joined_[root(node)] = root(nodes[0]);
  }

  int root(int node) {
    while (joined_[node] != node) node = joined_[node] = joined_[joined_[node]];
    return node;
  }

  /// The reference is the first node of the first element of each.
  void spiders() {
    std::unordered_map<int, std::size_t> spider_of;
    for (const auto& [node, element] : in_order_) {
      const auto [it, fresh] = spider_of.try_emplace(root(node), c_.model.spiders.size());
      if (!fresh) {
        c_.model.spiders[it->second].nodes.push_back(node);
        continue;
      }
      add_rigid_spider(c_.model, node, fmt::format("{} {}", element->type->name, element->id),
                       element->at);
    }
  }

  void groups() {
    std::vector<int> nodes;
    std::map<int, int> others;
    for (const UnvGroup& group : c_.groups) {
      std::vector<int> node_set, element_set;
      for (const auto& [kind, number] : group.members) {
        if (kind != 7 && kind != 8) {
          ++others[kind];
          continue;
        }
        const auto node = c_.node_index.find(number);
        const auto element = c_.element_index.find(number);
        if (kind == 7 ? node == c_.node_index.end() : element == c_.element_index.end()) {
          in_.error(ErrorCode::not_found, group.at,
                    "group '{}' has {} {}, which is not in the file", group.name,
                    kind == 7 ? "node" : "element", number);
          continue;
        }
        if (kind == 7) {
          node_set.push_back(node->second);
          continue;
        }
        const UnvElement& e = c_.elements[element->second];
        if (e.index >= 0) element_set.push_back(e.index);
        if (!e.type->solid() && gather(e, nodes))
          node_set.insert(node_set.end(), nodes.begin(), nodes.end());
      }
      append(node_set, c_.model.node_sets, group.name);
      append(element_set, c_.model.element_sets, group.name);
    }
    for (auto* sets : {&c_.model.node_sets, &c_.model.element_sets})
      for (auto& [name, set] : *sets) {
        std::sort(set.begin(), set.end());
        set.erase(std::unique(set.begin(), set.end()), set.end());
      }
    for (const auto& [kind, count] : others)
      note("{} members of groups are neither nodes nor elements (kind {}) and are left out", count,
           kind);
  }

  static void append(const std::vector<int>& more, std::map<std::string, std::vector<int>>& sets,
                     const std::string& name) {
    if (more.empty()) return;
    std::vector<int>& set = sets[name];
    set.insert(set.end(), more.begin(), more.end());
  }

  void notes() {
    if (material_ < 0)
      note(
          "materials of the format are not read; give Young's modulus, Poisson's ratio and density "
          "with the file");
    else if (materials_ > 1)
      note(
          "the elements have {} different material numbers; all get the material given with the "
          "file",
          materials_);
    if (skins_ > 0)
      note(
          "{} shells, beams and rods are taken as skins and edges: they make node sets and have no "
          "stiffness and no mass",
          skins_);
    if (dampers_ > 0) note("{} dampers are ignored: the part has modal damping", dampers_);
    for (const int number : c_.passed_over) note("dataset {} is ignored", number);
  }

  TextSource& in_;
  UnvContent c_;
  int material_ = -1, skins_ = 0, dampers_ = 0;
  SurfaceThickness thickness_;
  std::unordered_map<int, std::vector<std::string>> groups_of_;  // of elements, by their numbers
  std::unordered_set<int> once_;
  std::unordered_set<std::size_t> invalid_;  // UnvElement::first
  std::unordered_map<int, int> joined_;      // union-find over the nodes of rigid elements
  std::vector<std::pair<int, const UnvElement*>>
      in_order_;  // each such node with its first element
  std::size_t materials_ = 0;
};

}  // namespace

bool looks_like_unv(std::string_view beginning) {
  const std::size_t first = beginning.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  beginning.remove_prefix(first);
  const std::size_t end = beginning.find('\n');
  if (end == std::string_view::npos || !is_unv_delimiter(beginning.substr(0, end))) return false;
  beginning.remove_prefix(end + 1);
  return parse_label(trimmed(beginning.substr(0, beginning.find('\n')))).has_value();
}

FeModel read_unv(TextSource& source, const FeReadOptions& options) {
  return UnvBuild(source, read_unv_content(source), options).model();
}

FeModel read_unv(const std::filesystem::path& file, const FeReadOptions& options) {
  TextSource source(file);
  return read_unv(source, options);
}

}  // namespace floatframe
