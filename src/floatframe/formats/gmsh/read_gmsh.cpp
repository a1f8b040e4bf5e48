#include "floatframe/formats/gmsh/read_gmsh.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "floatframe/formats/gmsh/gmsh_mesh.hpp"
#include "floatframe/formats/surface_thickness.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {
namespace {

class GmshModel {
 public:
  GmshModel(const GmshMesh& mesh, const GmshStream& in, const FeReadOptions& options,
            const std::string& name)
      : mesh_(mesh), in_(in), options_(options), thickness_(options.thicknesses) {
    model_.files.push_back(name);
  }

  FeModel build() {
    nodes();
    material();
    group_names();
    shells();
    elements();
    sets();
    for (const std::string& section : mesh_.passed_over) note("section ${} is ignored", section);
    if (!errors_.empty()) throw InputError(std::move(errors_));
    return std::move(model_);
  }

 private:
  using Place = GmshStream::Place;

  template <class... Args>
  void note(fmt::format_string<Args...> text, Args&&... args) {
    model_.notes.push_back(
        fmt::format("{}: {}", model_.files[0], fmt::format(text, std::forward<Args>(args)...)));
  }
  template <class... Args>
  void error(ErrorCode code, const Place& at, fmt::format_string<Args...> text, Args&&... args) {
    errors_.push_back(in_.error(code, at, fmt::format(text, std::forward<Args>(args)...)));
    if (errors_.size() >= TextSource::most_errors) throw InputError(std::move(errors_));
  }
  FeSource source(const Place& at) const { return {0, in_.binary() ? 0 : at.line}; }
  std::string where(const Place& at) const {
    return in_.binary() ? fmt::format("at byte {}", at.byte) : fmt::format("in line {}", at.line);
  }

  void nodes() {
    const std::size_t n = mesh_.nodes.size();
    model_.positions.reserve(n);
    model_.node_ids.reserve(n);
    model_.node_sources.reserve(n);
    index_.reserve(n);
    for (const GmshNode& node : mesh_.nodes) {
      const auto [it, fresh] = index_.try_emplace(node.id, model_.nodes());
      if (!fresh) {
        const GmshNode& first = mesh_.nodes[it->second];
        error(ErrorCode::duplicate, node.at, "node {} is in the file twice, first {}", node.id,
              where(first.at));
      }
      model_.positions.push_back(node.p);
      model_.node_ids.push_back(node.id);
      model_.node_sources.push_back(source(node.at));
    }
  }

  void material() {
    if (options_.material) {
      model_.materials.push_back(*options_.material);
      model_.material_names.emplace_back();
      material_ = 0;
    } else {
      note(
          "the format has no material; give Young's modulus, Poisson's ratio and density with the "
          "file");
    }
  }

  /// The element's nodes as indices, in the order of the file; false if there is an error, which is
  /// reported once.
  bool gather(const GmshElement& e, std::vector<int>& nodes) {
    if (invalid_.contains(e.first)) return false;
    nodes.clear();
    for (int k = 0; k < e.type->nodes; ++k) {
      const int id = mesh_.element_nodes[e.first + k];
      const auto it = index_.find(id);
      if (it == index_.end()) {
        error(ErrorCode::not_found, e.at, "element {} ({}) has node {}, which is not in the file",
              e.id, e.type->name, id);
        invalid_.insert(e.first);
        return false;
      }
      nodes.push_back(it->second);
    }
    return true;
  }

  /// Decides which surface elements are shells.
  void shells() {
    section_.assign(thickness_.any() ? mesh_.elements.size() : 0, -1);
    if (!thickness_.any()) return;
    model_.shells = thickness_.sections();
    std::vector<int> nodes, corners;
    for (const GmshElement& e : mesh_.elements) {
      if (e.type->dimension < 3 || !e.type->element || !gather(e, nodes)) continue;
      corners.resize(nodes.size());
      for (std::size_t k = 0; k < nodes.size(); ++k) corners[k] = nodes[e.type->order[k]];
      thickness_.add_solid(*e.type->element, corners);
    }
    std::map<int, std::vector<std::string>> names;  // of a list of groups
    int skins = 0;
    for (std::size_t i = 0; i < mesh_.elements.size(); ++i) {
      const GmshElement& e = mesh_.elements[i];
      if (e.type->dimension != 2 || !gather(e, nodes)) continue;
      const auto [list, fresh] = names.try_emplace(e.groups);
      if (fresh)
        for (const int tag : mesh_.group_lists[e.groups]) list->second.push_back(name_of(2, tag));
      const auto choice = thickness_.choose(
          std::span(nodes).first(static_cast<std::size_t>(surface_corners(*e.type))), list->second);
      if (!choice.error.empty())
        error(ErrorCode::wrong_value, e.at, "element {} {}", e.id, choice.error);
      section_[i] = choice.section;
      skins += choice.section < 0 ? 1 : 0;
    }
    if (skins > 0 && thickness_.others() < 0)
      note(
          "{} surface elements in no group with a thickness are skins: they make node sets and "
          "have no stiffness and no mass",
          skins);
    std::vector<std::string> known;
    for (const auto& [key, name] : names_)
      if (key.first == 2) known.push_back(name);
    for (std::string& message : thickness_.not_found(known))
      errors_.push_back({{model_.files[0], 0, 0}, ErrorCode::not_found, std::move(message)});
  }

  /// Solids, and surfaces with a thickness.
  bool is_part(std::size_t i) const {
    return mesh_.elements[i].type->dimension == 3 || (!section_.empty() && section_[i] >= 0);
  }

  void elements() {
    int dimension = -1;
    for (const GmshElement& e : mesh_.elements) dimension = std::max(dimension, e.type->dimension);
    if (dimension < 3 && !(dimension == 2 && thickness_.any())) {
      constexpr const char* what[] = {"no elements", "no solid elements, only points",
                                      "no solid elements, only lines",
                                      "no solid elements, only surfaces"};
      throw InputError(
          ErrorCode::missing, {model_.files[0], 0, 0},
          fmt::format("the mesh has {}; a part needs tetrahedra, hexahedra or wedges (in Gmsh: "
                      "mesh in 3D and give the volume a physical group), or surfaces to which a "
                      "thickness is given (--thickness, key `thickness`)",
                      what[dimension + 1]));
    }
    const bool repeats = mesh_.element_per_group && several_groups();
    std::map<int, std::pair<const GmshElement*, int>> unsupported;  // first of a type, number
    std::unordered_map<int, Place> seen;
    std::map<std::vector<int>, int> same_nodes;
    std::vector<int> nodes, key;
    element_index_.assign(mesh_.elements.size(), -1);
    int repeated = 0;
    for (std::size_t i = 0; i < mesh_.elements.size(); ++i) {
      const GmshElement& e = mesh_.elements[i];
      const auto [it, fresh] = seen.try_emplace(e.id, e.at);
      if (!fresh)
        error(ErrorCode::duplicate, e.at, "element {} is in the file twice, first {}", e.id,
              where(it->second));
      if (!is_part(i)) continue;
      if (!e.type->element) {
        auto& [first, number] = unsupported[e.type->number];
        if (number++ == 0) first = &e;
        continue;
      }
      if (!gather(e, nodes)) continue;
      key = nodes;
      std::sort(key.begin(), key.end());
      if (const auto twice = std::adjacent_find(key.begin(), key.end()); twice != key.end()) {
        error(ErrorCode::duplicate, e.at, "element {} ({}) has node {} twice", e.id, e.type->name,
              model_.node_ids[*twice]);
        continue;
      }
      if (repeats) {
        const auto [known, first] =
            same_nodes.try_emplace(key, static_cast<int>(model_.elements.size()));
        if (!first) {
          element_index_[i] = known->second;
          if (e.type->dimension == 2) same_section(e, i, model_.elements[known->second]);
          ++repeated;
          continue;
        }
      }
      element_index_[i] = static_cast<int>(model_.elements.size());
      FeElement element;
      element.type = *e.type->element;
      if (e.type->dimension == 2) element.section = section_[i];
      for (std::size_t k = 0; k < nodes.size(); ++k) element.nodes[k] = nodes[e.type->order[k]];
      element.material = material_;
      element.id = e.id;
      element.source = source(e.at);
      model_.elements.push_back(element);
    }
    for (const auto& [number, first] : unsupported) {
      const GmshElement& e = *first.first;
      error(ErrorCode::unsupported, e.at,
            "element {} is a {} (there are {}), which is not supported{}", e.id, e.type->name,
            first.second, advice(number));
    }
    if (repeated > 0)
      note("{} elements are in the file again for a second physical group and are taken once",
           repeated);
  }

  /// For a duplicate element: that of a named group counts.
  void same_section(const GmshElement& e, std::size_t i, FeElement& known) {
    const int others = thickness_.others();
    if (section_[i] == known.section || section_[i] == others) return;
    if (known.section != others)
      error(ErrorCode::contradiction, e.at,
            "element {} is there again, and different thicknesses are given to its groups", e.id);
    known.section = section_[i];
  }

  bool several_groups() const {
    int group = -1;
    for (std::size_t i = 0; i < mesh_.elements.size(); ++i) {
      const GmshElement& e = mesh_.elements[i];
      if (!is_part(i)) continue;
      if (group >= 0 && e.groups != group) return true;
      group = e.groups;
    }
    return false;
  }

  static const char* advice(int type) {
    // The types between them are those of second order, complete.
    return type >= 10 && type <= 14 ? "; save the mesh with Mesh.SecondOrderIncomplete = 1"
                                    : "; use elements of first or second order (Mesh.ElementOrder)";
  }

  void group_names() {
    for (const GmshGroup& group : mesh_.groups) {
      if (!names_.try_emplace({group.dimension, group.tag}, group.name).second)
        error(ErrorCode::duplicate, group.at,
              "physical group {} of dimension {} has a second name {}", group.tag, group.dimension,
              shown(group.name));
    }
  }

  const std::string& name_of(int dimension, int tag) {
    static const char* const kinds[] = {"point", "curve", "surface", "volume"};
    auto [it, fresh] = names_.try_emplace({dimension, tag});
    if (fresh) it->second = fmt::format("{} {}", kinds[dimension], tag);
    return it->second;
  }

  /// A few bytes can put all elements into many groups.
  void limit_members() {
    const std::size_t most = 10'000'000 + 100 * (mesh_.nodes.size() + mesh_.elements.size());
    std::size_t named = 0;
    for (const GmshElement& e : mesh_.elements) {
      named += mesh_.group_lists[e.groups].size() *
               (e.type->dimension < 3 ? static_cast<std::size_t>(e.type->nodes) : 1);
      if (named <= most) continue;
      error(ErrorCode::too_large, e.at,
            "the physical groups have more than {} members in all, too many for a mesh of {} nodes "
            "and {} elements",
            most, mesh_.nodes.size(), mesh_.elements.size());
      throw InputError(std::move(errors_));
    }
  }

  void sets() {
    limit_members();
    std::map<std::string, std::set<int>> members;  // of the node sets
    std::map<std::string, int> dimension_of;       // of the first group of a name
    std::set<std::pair<int, int>> used;
    std::vector<int> nodes;
    for (std::size_t i = 0; i < mesh_.elements.size(); ++i) {
      const GmshElement& e = mesh_.elements[i];
      const int dimension = e.type->dimension;
      const auto& groups = mesh_.group_lists[e.groups];
      if (groups.empty() || (is_part(i) && element_index_[i] < 0)) continue;
      if (dimension < 3 && !gather(e, nodes)) continue;
      for (const int tag : groups) {
        const std::string& name = name_of(dimension, tag);
        used.insert({dimension, tag});
        const auto [it, fresh] = dimension_of.try_emplace(name, dimension);
        if (!fresh && it->second != dimension && it->second >= 0) {
          note(
              "there are physical groups of several dimensions with the name '{}'; those below "
              "volumes make one node set",
              name);
          it->second = -1;
        }
        if (element_index_[i] >= 0) model_.element_sets[name].push_back(element_index_[i]);
        if (dimension == 3) continue;
        std::vector<int>& set = model_.node_sets[name];
        std::set<int>& known = members[name];
        for (const int node : nodes)
          if (known.insert(node).second) set.push_back(node);
      }
    }
    for (const GmshGroup& group : mesh_.groups) {
      if (used.count({group.dimension, group.tag}) == 0)
        note("physical group '{}' has no elements", group.name);
    }
  }

  const GmshMesh& mesh_;
  const GmshStream& in_;
  const FeReadOptions& options_;
  FeModel model_;
  std::vector<ErrorEntry> errors_;
  std::unordered_map<int, int> index_;  // of a node number
  std::vector<int> element_index_;      // in the model, of each element of the mesh
  std::map<std::pair<int, int>, std::string> names_;
  std::unordered_set<std::size_t> invalid_;  // GmshElement::first
  int material_ = -1;
  SurfaceThickness thickness_;
  std::vector<int> section_;  // of each element of the mesh that is a shell; empty: no thicknesses
};

}  // namespace

bool looks_like_gmsh(std::string_view beginning) {
  return trimmed(beginning.substr(0, beginning.find('\n'))) == "$MeshFormat";
}

FeModel parse_gmsh(std::string_view bytes, const std::string& name, const FeReadOptions& options) {
  GmshStream in(bytes, name);
  const GmshMesh mesh = parse_gmsh_mesh(in);
  return GmshModel(mesh, in, options, name).build();
}

FeModel read_gmsh(const std::filesystem::path& file, const FeReadOptions& options) {
  return parse_gmsh(read_whole_file(file), file.string(), options);
}

}  // namespace floatframe
