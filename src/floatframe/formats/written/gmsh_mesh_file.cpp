// A .msh file (MSH 4.1, ASCII): element sets, materials and node sets as physical groups. Elements
// of equal groups are one entity of Gmsh, since groups belong to entities there.
// Source: Gmsh reference manual, "MSH file format".
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "floatframe/core/plural.hpp"
#include "floatframe/formats/gmsh/gmsh_mesh.hpp"
#include "floatframe/formats/written/mesh_writers.hpp"
#include "floatframe/formats/written/written_numbers.hpp"

namespace floatframe {
namespace {

/// Place in the file of each node of the element; of solids as the table of the reader has it.
std::array<int, 20> file_order(FeElementType type, const GmshType& gmsh) {
  if (gmsh.element) return gmsh.order;
  std::array<int, 20> order{};
  std::iota(order.begin(), order.end(), 0);
  if (type == FeElementType::beam3) std::swap(order[1], order[2]);
  return order;
}

using Groups = std::vector<int>;  ///< tags of physical groups, ascending

/// Elements of one type and equal groups; `dimension` 0: nodes.
struct Entity {
  int dimension = 0;
  Groups groups;
  std::map<int, std::vector<int>> members;  ///< by the number of the type
};

struct PhysicalGroup {
  int dimension = 0;
  std::string name;
};

class GmshFile {
 public:
  explicit GmshFile(const FeModel& model) : model_(model) {
    numbers_ = written_numbers(model, notes_);
    collect_groups();
    collect_entities();
  }

  WrittenMesh written() {
    std::string text =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
        "$Comments\nWritten by Floatframe\n$EndComments\n";
    add_groups(text);
    add_entities(text);
    add_nodes(text);
    add_elements(text);
    renamed_.note(notes_);
    return {std::move(text), std::move(notes_)};
  }

 private:
  static int dimension_of(const FeElement& e) { return written_cell(e.type).dimension; }

  int new_group(int dimension, const std::string& name) {
    auto& used = used_names_[static_cast<std::size_t>(dimension)];
    groups_.push_back({dimension, written_name(name, false, used)});
    renamed_.add(name, groups_.back().name);
    return static_cast<int>(groups_.size());
  }

  /// A set with elements of several dimensions is a group in each.
  void collect_groups() {
    of_element_.resize(model_.elements.size());
    of_node_.resize(model_.positions.size());
    const auto add = [&](const std::string& name, const std::vector<int>& elements) {
      std::array<int, 4> tags{};
      for (const int e : elements) {
        const auto at = static_cast<std::size_t>(e);
        int& tag = tags[static_cast<std::size_t>(dimension_of(model_.elements[at]))];
        if (tag == 0) tag = new_group(dimension_of(model_.elements[at]), name);
        if (of_element_[at].empty() || of_element_[at].back() != tag)
          of_element_[at].push_back(tag);
      }
    };
    for (const auto& [name, elements] : model_.element_sets) add(name, elements);
    std::map<int, std::vector<int>> of_material;
    for (std::size_t e = 0; e < model_.elements.size(); ++e)
      of_material[model_.elements[e].material].push_back(static_cast<int>(e));
    for (const auto& [material, elements] : of_material)
      add(written_material(model_, material), elements);
    for (const auto& [name, nodes] : model_.node_sets) {
      if (nodes.empty()) continue;
      const int tag = new_group(0, name);
      for (const int n : nodes) {
        Groups& groups = of_node_[static_cast<std::size_t>(n)];
        if (groups.empty() || groups.back() != tag) groups.push_back(tag);
      }
    }
  }

  void collect_entities() {
    std::map<std::pair<int, Groups>, std::size_t> index;
    const auto entity = [&](int dimension, const Groups& groups) -> Entity& {
      const auto [it, fresh] = index.emplace(std::pair{dimension, groups}, entities_.size());
      if (fresh) entities_.push_back({dimension, groups, {}});
      return entities_[it->second];
    };
    for (std::size_t e = 0; e < model_.elements.size(); ++e) {
      const WrittenCell& cell = written_cell(model_.elements[e].type);
      entity(cell.dimension, of_element_[e]).members[cell.gmsh].push_back(static_cast<int>(e));
    }
    for (std::size_t n = 0; n < model_.positions.size(); ++n)
      if (!of_node_[n].empty())
        entity(0, of_node_[n]).members[point_type].push_back(static_cast<int>(n));
    std::stable_sort(entities_.begin(), entities_.end(),
                     [](const Entity& a, const Entity& b) { return a.dimension < b.dimension; });
    if (entities_.empty()) entities_.push_back({});
  }

  void add_groups(std::string& text) const {
    text += fmt::format("$PhysicalNames\n{}\n", groups_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g)
      text += fmt::format("{} {} \"{}\"\n", groups_[g].dimension, g + 1, groups_[g].name);
    text += "$EndPhysicalNames\n";
  }

  void add_entities(std::string& text) const {
    std::array<int, 4> counts{};
    for (const Entity& e : entities_) ++counts[static_cast<std::size_t>(e.dimension)];
    text += fmt::format("$Entities\n{} {} {} {}\n", counts[0], counts[1], counts[2], counts[3]);
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    if (!model_.positions.empty()) low = high = model_.positions.front();
    for (const Vec3& p : model_.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
    for (std::size_t i = 0; i < entities_.size(); ++i) {
      const Entity& e = entities_[i];
      text += fmt::format("{} {} {} {}", i + 1, low(0), low(1), low(2));
      if (e.dimension > 0) text += fmt::format(" {} {} {}", high(0), high(1), high(2));
      text += fmt::format(" {}", e.groups.size());
      for (const int g : e.groups) text += fmt::format(" {}", g);
      text += e.dimension > 0 ? " 0\n" : "\n";  // no bounding entities
    }
    text += "$EndEntities\n";
  }

  /// All of the last entity, which has the highest dimension.
  void add_nodes(std::string& text) const {
    const auto [first, last] = std::minmax_element(numbers_.node.begin(), numbers_.node.end());
    const std::size_t count = model_.positions.size();
    text += fmt::format("$Nodes\n1 {} {} {}\n{} {} 0 {}\n", count, count > 0 ? *first : 0,
                        count > 0 ? *last : 0, entities_.back().dimension, entities_.size(), count);
    for (const int n : numbers_.node) text += fmt::format("{}\n", n);
    for (const Vec3& p : model_.positions) text += fmt::format("{} {} {}\n", p(0), p(1), p(2));
    text += "$EndNodes\n";
  }

  void add_elements(std::string& text) const {
    std::size_t blocks = 0, count = 0;
    for (const Entity& e : entities_)
      for (const auto& [type, members] : e.members) ++blocks, count += members.size();
    int point = numbers_.last_element;
    const int last = point + static_cast<int>(count - model_.elements.size());
    text += fmt::format("$Elements\n{} {} 1 {}\n", blocks, count, last);
    for (std::size_t i = 0; i < entities_.size(); ++i)
      for (const auto& [type, members] : entities_[i].members) {
        text += fmt::format("{} {} {} {}\n", entities_[i].dimension, i + 1, type, members.size());
        for (const int m : members) {
          const auto at = static_cast<std::size_t>(m);
          if (type == point_type)
            text += fmt::format("{} {}\n", ++point, numbers_.node[at]);
          else
            add_element(text, at, *gmsh_type(type));
        }
      }
    text += "$EndElements\n";
  }

  void add_element(std::string& text, std::size_t at, const GmshType& type) const {
    const FeElement& e = model_.elements[at];
    const std::array<int, 20> order = file_order(e.type, type);
    std::array<int, 20> file{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(type.nodes); ++k)
      file[static_cast<std::size_t>(order[k])] =
          numbers_.node[static_cast<std::size_t>(e.nodes[k])];
    text += fmt::format("{}", numbers_.element[at]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(type.nodes); ++k)
      text += fmt::format(" {}", file[k]);
    text += '\n';
  }

  static constexpr int point_type = 15;
  const FeModel& model_;
  std::vector<std::string> notes_;
  WrittenNumbers numbers_;
  std::vector<PhysicalGroup> groups_;
  std::array<std::set<std::string>, 4> used_names_;
  RenamedNames renamed_;
  std::vector<Groups> of_element_, of_node_;
  std::vector<Entity> entities_;
};

}  // namespace

WrittenMesh gmsh_mesh_file(const FeModel& model, const MeshWriteOptions&) {
  WrittenMesh out = GmshFile(model).written();
  const auto leave_out = [&](std::size_t count, const char* what, const char* many = "") {
    if (count > 0)
      out.notes.push_back(fmt::format("{} left out: a mesh of Gmsh has no such thing",
                                      plural(static_cast<long>(count), what, many)));
  };
  leave_out(model.spiders.size(), "rigid or mean connection");
  leave_out(model.equations.size(), "equation");
  leave_out(model.masses.size(), "point mass", "point masses");
  leave_out(model.springs.size(), "spring");
  leave_out(model.surfaces.size(), "surface");
  if (!model.materials.empty())
    out.notes.push_back(
        "materials and sections are left out but for the names of materials, which are groups");
  return out;
}

}  // namespace floatframe
