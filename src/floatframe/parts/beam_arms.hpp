#pragma once
// Spiders that a reader generated for ends of bars with offsets or pins: they are not interfaces
// intended by the user.
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// For each spider: true if it is rigid and all its dependent nodes were generated for a bar. Such
/// a node has the file position of its bar.
std::vector<char> beam_arms(const FeModel& model);

}  // namespace floatframe
