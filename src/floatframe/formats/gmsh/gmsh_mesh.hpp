#pragma once
// Content of a .msh file, before it is a model: nodes, elements of any type, physical groups.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/gmsh/gmsh_stream.hpp"

namespace floatframe {

/// By its number in the file.
struct GmshType {
  int number = 0;
  const char* name = "";
  int dimension = 0;
  int nodes = 0;
  std::optional<FeElementType> element;  ///< the corresponding solid or shell, if there is one
  std::array<int, 20> order{};  ///< of these: node k of the element is node order[k] of the file
};

/// Of a triangle or quadrilateral of any order.
int surface_corners(const GmshType& type) noexcept;

/// Null if the number is unknown.
const GmshType* gmsh_type(int number) noexcept;

struct GmshGroup {
  int dimension = 0, tag = 0;
  std::string name;
  GmshStream::Place at;
};

struct GmshNode {
  int id = 0;
  Vec3 p = Vec3::Zero();
  GmshStream::Place at;
};

struct GmshElement {
  const GmshType* type = nullptr;
  int id = 0;
  int groups = 0;         ///< in GmshMesh::group_lists
  std::size_t first = 0;  ///< its nodes in GmshMesh::element_nodes
  GmshStream::Place at;
};

struct GmshMesh {
  std::vector<GmshGroup> groups;  ///< those that have names
  std::vector<GmshNode> nodes;
  std::vector<GmshElement> elements;
  std::vector<int> element_nodes;             ///< numbers of nodes, in the order of the file
  std::vector<std::vector<int>> group_lists;  ///< tags of the groups of an element
  bool element_per_group = false;             ///< format 2: an element of two groups is there twice
  std::vector<std::string> passed_over;       ///< sections that are not used
};

/// Throws InputError at the first error: the rest cannot be interpreted.
GmshMesh parse_gmsh_mesh(GmshStream& in);

}  // namespace floatframe
