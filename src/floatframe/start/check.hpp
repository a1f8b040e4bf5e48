#pragma once
// Counts of a model.
#include <string>
#include <vector>

#include "floatframe/formulation/counts.hpp"
#include "floatframe/loops/start_report.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

struct ModelCounts {
  int bodies = 0, flexible_bodies = 0, joints = 0, cut_joints = 0;
  CoordinateCounts relative, absolute;
  int degrees_of_freedom = 0;
  int redundant_constraints = 0;
  std::vector<std::string> cut_joint_names;
  StartReport start;
};

/// Coordinates and constraints of both formulations, found from the assembled model (rank by SVD).
ModelCounts check(const Model& model);

}  // namespace floatframe
