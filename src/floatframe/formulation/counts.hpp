#pragma once
// Numbers of coordinates and constraints of a formulation.

namespace floatframe {

struct CoordinateCounts {
  int rigid = 0, elastic = 0, total = 0, constraints = 0;
};

}  // namespace floatframe
