#pragma once
// Content of a universal file, before it is a model: nodes, elements of any type, groups;
// finite elements by their descriptor number, and the order of their nodes.
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// Treatment of an element.
enum class UnvUse {
  mesh,    ///< a solid, or a skin or edge that defines node sets
  rigid,   ///< its nodes move as one rigid body
  left,    ///< neither stiffness nor mass: ignored
  refused  ///< has values in tables of the format that are not read
};

struct UnvType {
  int number = 0;
  const char* name = "";
  int nodes = 0;
  bool beam = false;  ///< a record of orientation and end sections comes first
  /// A solid, or the shell that it becomes if a thickness is given.
  std::optional<FeElementType> element;
  std::array<int, 20> order{};  ///< of these: node k is node order[k] of the file
  UnvUse use = UnvUse::mesh;

  bool solid() const noexcept;
  bool shell() const noexcept { return element && !solid(); }
};

/// Null if the number is unknown.
const UnvType* unv_type(int number) noexcept;

struct UnvElement {
  const UnvType* type = nullptr;
  int id = 0, material = 0;
  std::size_t first = 0;  ///< its nodes in UnvContent::element_nodes
  int nodes = 0;
  FeSource at;
  int index = -1;  ///< in the model
};

struct UnvGroup {
  std::string name;
  FeSource at;
  std::vector<std::pair<int, int>> members;  ///< kind, number
};

struct UnvContent {
  FeModel model;  ///< with the nodes
  std::unordered_map<int, int> node_index;
  std::unordered_map<int, std::size_t> element_index;
  std::vector<UnvElement> elements;
  std::vector<int> element_nodes;  ///< numbers
  std::vector<UnvGroup> groups;
  std::map<int, bool> systems;                           ///< are they the global one?
  std::map<int, std::pair<int, FeSource>> systems_used;  ///< with the first node
  std::set<int> passed_over;                             ///< datasets
};

/// Throws InputError at the first error of form: the rest cannot be interpreted.
UnvContent read_unv_content(TextSource& in);

/// The line that begins and ends datasets.
bool is_unv_delimiter(std::string_view line);

}  // namespace floatframe
