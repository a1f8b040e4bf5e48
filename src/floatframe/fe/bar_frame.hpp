#pragma once
// A frame of straight bars, each divided into equal 2-node beams: the convenient way to make a beam
// model. Bars that share an end point share its node; a bar may also start at an inner node of an
// earlier bar. Nodes are numbered along the bars in their order; nodes are named after end
// points.
#include <string>
#include <utility>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

struct Bar {
  std::string name;
  std::string from, to;  ///< names of points
  std::string
      from_bar;  ///< if not empty, instead of `from`: start at a node of this earlier bar ...
  double from_fraction = 0.0;  ///< ... at this fraction of its length counted from its start
  int elements = 1;
  BeamSection section;
  Vec3 reference = Vec3::UnitZ();  ///< local y is in the plane of the bar and this vector
};

struct BarFrame {
  std::vector<std::pair<std::string, Vec3>> points;  ///< body frame [m]
  std::vector<Bar> bars;
  Material material;
  std::vector<std::pair<std::string, double>> masses;  ///< point masses by node name [kg]
};

/// Throws InputError with every error, naming bars and points. The result is validated.
FeModel build_bar_frame(const BarFrame& frame);

}  // namespace floatframe
