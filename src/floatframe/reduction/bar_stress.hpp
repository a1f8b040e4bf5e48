#pragma once
// Stress of a frame of bars (body/body_stress.hpp). The static answer to a load of the frame held
// by its body reference, minus the part represented by the modes,
//   r = w - X K_y^-1 X^T f,   w = K^-1 f at all degrees of freedom but the held ones
// adds its section forces to those of the modes: as in reduction/part_stress.hpp. Forces at
// interfaces are represented exactly by the constraint modes. Loads are those of the mass model:
// isoparametric masses load the nodes only.
#include <memory>
#include <vector>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/fe/fe_model.hpp"
#include "floatframe/reduction/reduction_options.hpp"

namespace floatframe {

/// X: modes, six rows per node; `held`: the rows held by the body reference, ascending; empty:
/// unknown, and without loads. Null for models that have elements other than beams, and for
/// frames of very many elements.
std::shared_ptr<const BodyStress> bar_stress(const FeModel& model, const MatX& X, const MatX& K_y,
                                             const std::vector<int>& held,
                                             const ReductionOptions& options);

}  // namespace floatframe
