#pragma once
// The methods of selecting nodes of a part, once each: keyword, values and the members of
// NodeChoice that store them. Used by model files, the command line and the provenance:
//   model file     {node: 12}    {cylinder: {point: [0, 0, 0], axis: y, radius: 11}}
//   command line   node:12       cylinder:0,0,0,axis=y,radius=11
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "floatframe/fe/interface_selection.hpp"

namespace floatframe {

/// A value of a method. On the command line the first one follows the colon; in a model file a
/// method with a single value is that value and others are maps.
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
  /// True if nodes are selected by their distance from a surface, so that `tolerance` applies.
  bool by_distance;
};

std::span<const NodeWay> node_ways();
const NodeWay& node_way(NodeChoice::By by);

}  // namespace floatframe
