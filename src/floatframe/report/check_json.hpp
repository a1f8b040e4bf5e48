#pragma once
// What `floatframe check` finds as JSON: the counts, and the flexible bodies with their modes.
#include <string>

#include "floatframe/model/model.hpp"
#include "floatframe/simulation/results.hpp"

namespace floatframe {

std::string check_json(const ModelCounts& counts, const Model& model);

}  // namespace floatframe
