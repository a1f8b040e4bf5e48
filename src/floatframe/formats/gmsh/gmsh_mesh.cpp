// Sections of .msh files of versions 2 and 4.1.
#include "floatframe/formats/gmsh/gmsh_mesh.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr std::size_t largest_label = std::numeric_limits<int>::max();

class GmshParser {
 public:
  explicit GmshParser(GmshStream& in) : in_(in) {}

  GmshMesh parse() {
    format();
    std::string_view line;
    bool nodes = false, elements = false;
    while (true) {
      const GmshStream::Place at = in_.here();
      if (!in_.next_line(line)) break;
      if (line.empty()) continue;
      if (!line.starts_with('$'))
        in_.stop(ErrorCode::wrong_value, at, "found {}, expected a section such as $Nodes",
                 shown(line));
      const std::string section(line.substr(1));
      if (section == "PhysicalNames") {
        physical_names();
      } else if (section == "Entities" && version_4_) {
        entities();
      } else if (section == "Nodes" || section == "Elements") {
        bool& there = section == "Nodes" ? nodes : elements;
        if (std::exchange(there, true))
          in_.stop(ErrorCode::duplicate, at, "section ${} is in the file twice", section);
        if (section == "Nodes")
          version_4_ ? nodes_4() : nodes_2();
        else
          version_4_ ? elements_4() : elements_2();
      } else if (section == "Comments") {
        in_.end_section(at, section);
        continue;
      } else if (section == "PartitionedEntities") {
        in_.stop(ErrorCode::unsupported, at,
                 "the mesh is partitioned; save it in one part (Mesh.PartitionSplitMeshFiles = 0 "
                 "and no partitions)");
      } else {
        mesh_.passed_over.push_back(section);
        in_.end_section(at, section);
        continue;
      }
      in_.expect_end(section);
    }
    if (!nodes) in_.stop(ErrorCode::missing, "the file has no section $Nodes");
    if (!elements) in_.stop(ErrorCode::missing, "the file has no section $Elements");
    return std::move(mesh_);
  }

 private:
  using Place = GmshStream::Place;

  void format() {
    std::string_view line;
    Place at = in_.here();
    if (!in_.next_line(line) || line != "$MeshFormat")
      in_.stop(ErrorCode::wrong_file, at, "found {}, expected '$MeshFormat'", shown(line));
    at = in_.here();
    std::vector<std::string_view> fields;
    if (in_.next_line(line)) split_blanks(line, fields);
    if (fields.size() != 3)
      in_.stop(ErrorCode::wrong_value, at,
               "found {}, expected the version, 0 (ASCII) or 1 (binary) and the size of a number, "
               "as in '4.1 0 8'",
               shown(line));
    const auto version = parse_real(fields[0]);
    version_4_ = version == 4.1;
    mesh_.element_per_group = !version_4_;
    if (!version || (*version != 4.1 && !(*version >= 2.0 && *version <= 2.2)))
      in_.stop(ErrorCode::unsupported, at,
               "the version of the format is {}, expected 4.1 or 2.2 (Gmsh writes them with "
               "Mesh.MshFileVersion)",
               shown(fields[0]));
    if (fields[1] != "0" && fields[1] != "1")
      in_.stop(ErrorCode::out_of_range, at, "found {}, expected 0 (ASCII) or 1 (binary)",
               shown(fields[1]));
    if (fields[1] == "1") {
      if (fields[2] != "8")
        in_.stop(ErrorCode::unsupported, at, "numbers of {} bytes are not read, only of 8",
                 shown(fields[2]));
      in_.set_binary(false);
      const int one = in_.integer("the number 1 that shows the order of bytes");
      if (one == 0x01000000)
        in_.set_binary(true);
      else if (one != 1)
        in_.stop(ErrorCode::wrong_value,
                 "found {}, expected the number 1 that shows the order of bytes", one);
    }
    in_.expect_end("MeshFormat");
  }

  /// A whole number alone in a line, ASCII in all files.
  std::uint64_t count_line(const char* what, std::size_t numbers_each) {
    const Place at = in_.here();
    std::string_view line;
    const auto n = in_.next_line(line) ? parse_integer(line) : std::nullopt;
    if (!n || *n < 0)
      in_.stop(ErrorCode::wrong_value, at, "found {}, expected {}, a whole number from 0",
               shown(line), what);
    in_.check_count(at, static_cast<std::uint64_t>(*n), what, numbers_each);
    return static_cast<std::uint64_t>(*n);
  }

  void physical_names() {
    const auto n = count_line("the number of physical names", 1);
    for (std::uint64_t i = 0; i < n; ++i) {
      GmshGroup group;
      group.at = in_.here();
      std::string_view line;
      in_.next_line(line);
      const std::size_t open = line.find('"'), close = line.rfind('"');
      std::vector<std::string_view> fields;
      split_blanks(line.substr(0, open), fields);
      const auto dimension = fields.size() == 2 ? parse_integer(fields[0]) : std::nullopt;
      const auto tag = fields.size() == 2 ? parse_integer(fields[1]) : std::nullopt;
      if (!dimension || *dimension < 0 || *dimension > 3 || !tag || open == close)
        in_.stop(ErrorCode::wrong_value, group.at,
                 "found {}, expected dimension, number and name of a physical group, as in '2 1 "
                 "\"BORE\"'",
                 shown(line));
      group.dimension = *dimension;
      group.tag = *tag;
      group.name = std::string(line.substr(open + 1, close - open - 1));
      mesh_.groups.push_back(std::move(group));
    }
  }

  void entities() {
    std::uint64_t counts[4];
    const Place at = in_.here();
    for (auto& c : counts) c = in_.size("the number of points, curves, surfaces and volumes");
    for (int dimension = 0; dimension < 4; ++dimension) {
      in_.check_count(at, counts[dimension], "the number of geometric entities", 5);
      for (std::uint64_t i = 0; i < counts[dimension]; ++i) {
        const int tag = in_.integer("the number of a geometric entity");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in_.real("the size of an entity");
        std::vector<int> groups;
        const auto n = in_.count("the number of physical groups of an entity", 1);
        for (std::uint64_t k = 0; k < n; ++k)
          groups.push_back(std::abs(in_.integer("the number of a physical group") %
                                    std::numeric_limits<int>::max()));
        if (dimension > 0) {
          const auto bounds = in_.count("the number of bounding entities", 1);
          for (std::uint64_t k = 0; k < bounds; ++k) in_.integer("a bounding entity");
        }
        groups_of_entity_[{dimension, tag}] = group_list(std::move(groups));
      }
    }
  }

  /// Index of a list of groups; equal lists are stored once.
  int group_list(std::vector<int> groups) {
    const auto [it, fresh] =
        known_lists_.try_emplace(groups, static_cast<int>(mesh_.group_lists.size()));
    if (fresh) mesh_.group_lists.push_back(std::move(groups));
    return it->second;
  }

  int label(std::uint64_t value, const Place& at, const char* what) const {
    if (value < 1 || value > largest_label)
      in_.stop(ErrorCode::out_of_range, at, "{} is {}, expected 1 to {}", what, value,
               largest_label);
    return static_cast<int>(value);
  }

  Vec3 point() {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p(k) = in_.real("a coordinate");
    return p;
  }

  void nodes_4() {
    const auto blocks = in_.count("the number of blocks of nodes", 4);
    const Place at_total = in_.here();
    const auto total = in_.count("the number of nodes", 4);
    in_.size("the smallest node number");
    in_.size("the largest node number");
    mesh_.nodes.reserve(total);
    for (std::uint64_t b = 0; b < blocks; ++b) {
      const int dimension = in_.integer("the dimension of a block of nodes");
      in_.integer("the entity of a block of nodes");
      const int parametric = in_.integer("0 or 1 (parametric)");
      const auto n = in_.count("the number of nodes of a block", 4);
      const std::size_t first = mesh_.nodes.size();
      for (std::uint64_t i = 0; i < n; ++i) {
        GmshNode& node = mesh_.nodes.emplace_back();
        node.at = in_.here();
        node.id = label(in_.size("a node number"), node.at, "the number of a node");
      }
      for (std::size_t i = first; i < mesh_.nodes.size(); ++i) {
        mesh_.nodes[i].p = point();
        if (parametric == 0) continue;
        for (int k = 0; k < std::clamp(dimension, 0, 3); ++k) in_.real("a parameter of a node");
      }
    }
    if (mesh_.nodes.size() != total)
      in_.stop(ErrorCode::contradiction, at_total,
               "section $Nodes announces {} nodes, its blocks have {}", total, mesh_.nodes.size());
  }

  void nodes_2() {
    const auto n = count_line("the number of nodes", 4);
    mesh_.nodes.reserve(n);
    for (std::uint64_t i = 0; i < n; ++i) {
      GmshNode& node = mesh_.nodes.emplace_back();
      node.at = in_.here();
      node.id = label(in_.integer("a node number"), node.at, "the number of a node");
      node.p = point();
    }
  }

  int label(int value, const Place& at, const char* what) const {
    if (value < 1)
      in_.stop(ErrorCode::out_of_range, at, "{} is {}, expected 1 or more", what, value);
    return value;
  }

  const GmshType* type(int number, const Place& at) const {
    const GmshType* t = gmsh_type(number);
    if (t == nullptr)
      in_.stop(ErrorCode::unknown_key, at, "the element type {} is not known", number);
    return t;
  }

  void elements_4() {
    const auto blocks = in_.count("the number of blocks of elements", 4);
    const Place at_total = in_.here();
    const auto total = in_.count("the number of elements", 2);
    in_.size("the smallest element number");
    in_.size("the largest element number");
    mesh_.elements.reserve(total);
    const int none = group_list({});
    for (std::uint64_t b = 0; b < blocks; ++b) {
      const Place at = in_.here();
      const int dimension = in_.integer("the dimension of a block of elements");
      const int entity = in_.integer("the entity of a block of elements");
      const GmshType* t = type(in_.integer("a type of elements"), at);
      if (t->dimension != dimension)
        in_.stop(ErrorCode::wrong_value, at, "a block of dimension {} has elements of type {} ({})",
                 dimension, t->number, t->name);
      const auto n = in_.count("the number of elements of a block", t->nodes + 1);
      const auto it = groups_of_entity_.find({dimension, entity});
      for (std::uint64_t i = 0; i < n; ++i) {
        GmshElement element;
        element.type = t;
        element.groups = it == groups_of_entity_.end() ? none : it->second;
        element.at = in_.here();
        element.id = label(in_.size("an element number"), element.at, "the number of an element");
        add(element, &GmshStream::size);
      }
    }
    if (mesh_.elements.size() != total)
      in_.stop(ErrorCode::contradiction, at_total,
               "section $Elements announces {} elements, its blocks have {}", total,
               mesh_.elements.size());
  }

  void elements_2() {
    const auto total = count_line("the number of elements", 4);
    mesh_.elements.reserve(total);
    while (mesh_.elements.size() < total) {
      GmshElement element;
      element.at = in_.here();
      // ASCII: number, type, number of tags, tags, nodes. Binary: type, number of elements, number
      // of tags, then number, tags and nodes of each.
      const int id = in_.binary() ? 0 : in_.integer("an element number");
      element.type = type(in_.integer("a type of elements"), element.at);
      const int n = in_.binary() ? in_.integer("the number of elements of a block") : 1;
      const int tags = in_.integer("the number of tags");
      if (n < 1 || static_cast<std::uint64_t>(n) > total - mesh_.elements.size())
        in_.stop(ErrorCode::wrong_count, element.at, "a block has {} elements where {} are left", n,
                 total - mesh_.elements.size());
      if (tags < 0 || tags > 1000)
        in_.stop(ErrorCode::wrong_count, element.at, "an element with {} tags, expected 2", tags);
      for (int i = 0; i < n; ++i) {
        if (in_.binary()) element.at = in_.here();
        const int number = in_.binary() ? in_.integer("an element number") : id;
        element.id = label(number, element.at, "the number of an element");
        std::vector<int> groups;
        for (int k = 0; k < tags; ++k) {
          const int tag = in_.integer("a tag of an element");
          if (k == 0 && tag > 0) groups.push_back(tag);
        }
        element.groups = group_list(std::move(groups));
        add(element, &GmshStream::integer);
      }
    }
  }

  /// With the nodes that follow in the file.
  template <class Number>
  void add(GmshElement element, Number (GmshStream::*number)(const char*)) {
    element.first = mesh_.element_nodes.size();
    for (int k = 0; k < element.type->nodes; ++k) {
      const Place at = in_.here();
      mesh_.element_nodes.push_back(
          label((in_.*number)("a node of an element"), at, "the number of a node"));
    }
    mesh_.elements.push_back(element);
  }

  GmshStream& in_;
  GmshMesh mesh_;
  bool version_4_ = true;
  std::map<std::pair<int, int>, int> groups_of_entity_;
  std::map<std::vector<int>, int> known_lists_;
};

using E = FeElementType;

constexpr std::array<int, 20> same_order = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                            10, 11, 12, 13, 14, 15, 16, 17, 18, 19};

const GmshType gmsh_types[] = {
    {1, "2-node line", 1, 2, {}, {}},
    {2, "3-node triangle", 2, 3, E::tri3, same_order},
    {3, "4-node quadrilateral", 2, 4, E::quad4, same_order},
    {4, "4-node tetrahedron", 3, 4, E::tet4, same_order},
    {5, "8-node hexahedron", 3, 8, E::hex8, same_order},
    {6, "6-node wedge", 3, 6, E::wedge6, same_order},
    {7, "5-node pyramid", 3, 5, E::pyramid5, same_order},
    {8, "3-node line", 1, 3, {}, {}},
    {9, "6-node triangle", 2, 6, E::tri6, same_order},
    {10, "9-node quadrilateral", 2, 9, {}, {}},
    {11, "10-node tetrahedron", 3, 10, E::tet10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {12, "27-node hexahedron", 3, 27, {}, {}},
    {13, "18-node wedge", 3, 18, {}, {}},
    {14, "14-node pyramid", 3, 14, {}, {}},
    {15, "point", 0, 1, {}, {}},
    {16, "8-node quadrilateral", 2, 8, E::quad8, same_order},
    {17, "20-node hexahedron", 3, 20, E::hex20, {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                                 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
    {18, "15-node wedge", 3, 15, E::wedge15, {0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11}},
    {19, "13-node pyramid", 3, 13, E::pyramid13, {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12}},
    {20, "9-node triangle", 2, 9, {}, {}},
    {21, "10-node triangle", 2, 10, {}, {}},
    {26, "4-node line", 1, 4, {}, {}},
    {27, "5-node line", 1, 5, {}, {}},
    {29, "20-node tetrahedron", 3, 20, {}, {}},
    {30, "35-node tetrahedron", 3, 35, {}, {}},
    {36, "16-node quadrilateral", 2, 16, {}, {}},
    {92, "64-node hexahedron", 3, 64, {}, {}},
};

}  // namespace

GmshMesh parse_gmsh_mesh(GmshStream& in) { return GmshParser(in).parse(); }

int surface_corners(const GmshType& type) noexcept {
  return std::string_view(type.name).ends_with("triangle") ? 3 : 4;
}

const GmshType* gmsh_type(int number) noexcept {
  const auto* it = std::find_if(std::begin(gmsh_types), std::end(gmsh_types),
                                [number](const GmshType& t) { return t.number == number; });
  return it == std::end(gmsh_types) ? nullptr : it;
}

}  // namespace floatframe
