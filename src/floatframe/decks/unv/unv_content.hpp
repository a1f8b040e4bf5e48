#pragma once
// What a universal file says, before it is a model: nodes, elements of any type, groups.
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "floatframe/decks/unv/unv_types.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

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

/// Throws InputError at the first error of form: what follows it cannot be understood.
UnvContent read_unv_content(TextSource& in);

/// The line that begins and ends datasets.
bool is_unv_delimiter(std::string_view line);

}  // namespace floatframe
