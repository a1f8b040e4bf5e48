#include "floatframe/parts/node_ways.hpp"

namespace floatframe {

std::span<const NodeWay> node_ways() {
  using By = NodeChoice::By;
  using V = NodeWayValue;
  static const std::vector<NodeWay> ways{
      {"set", By::set, {{"set", V::Name{&NodeChoice::set}}}, false},
      {"node", By::node, {{"node", V::Number{&NodeChoice::number}}}, false},
      {"nearest", By::nearest, {{"nearest", V::Point{&NodeChoice::point}}}, false},
      {"plane",
       By::plane,
       {{"point", V::Point{&NodeChoice::point}}, {"normal", V::Direction{&NodeChoice::axis}}},
       true},
      {"cylinder",
       By::cylinder,
       {{"point", V::Point{&NodeChoice::point}},
        {"axis", V::Direction{&NodeChoice::axis}},
        {"radius", V::Length{&NodeChoice::radius}},
        {"length", V::Length{&NodeChoice::length, false}}},
       true},
      {"sphere",
       By::sphere,
       {{"point", V::Point{&NodeChoice::point}}, {"radius", V::Length{&NodeChoice::radius}}},
       true}};
  return ways;
}

const NodeWay& node_way(NodeChoice::By by) {
  for (const NodeWay& way : node_ways())
    if (way.by == by) return way;
  return node_ways().front();
}

}  // namespace floatframe
