#pragma once
// The ways of choosing nodes of a part, each once: its word, its values and where a NodeChoice
// keeps them. Model files, the command line and the provenance write a way as this list says:
//   model file     {node: 12}    {cylinder: {point: [0, 0, 0], axis: y, radius: 11}}
//   command line   node:12       cylinder:0,0,0,axis=y,radius=11
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "floatframe/fe/interface_selection.hpp"

namespace floatframe {

/// A value of a way. On the command line the first one stands after the colon; in a model file a
/// way of one value is that value and others are maps.
struct NodeWayValue {
  struct Name {
    std::string NodeChoice::*at;
  };
  struct Number {
    int NodeChoice::*at;
  };
  struct Point {
    Vec3 NodeChoice::*at;
  };
  struct Direction {
    Vec3 NodeChoice::*at;
  };
  /// Positive; 0 if it is optional and not given.
  struct Length {
    double NodeChoice::*at;
    bool required = true;
  };

  const char* key;
  std::variant<Name, Number, Point, Direction, Length> kind;
};

struct NodeWay {
  const char* word;
  NodeChoice::By by;
  std::vector<NodeWayValue> values;
  /// Whether nodes are taken by their distance from a surface, so that `tolerance` matters.
  bool by_distance;
};

std::span<const NodeWay> node_ways();
const NodeWay& node_way(NodeChoice::By by);

}  // namespace floatframe
