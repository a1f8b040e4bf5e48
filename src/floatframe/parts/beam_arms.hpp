#pragma once
// Spiders that a reader made to hold ends of bars beside their nodes (offsets, pins): nobody
// thought of an interface there.
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// Of each spider: is it rigid, and was every node that follows made for a bar? Such a node stands
/// in the file where its bar does.
std::vector<char> beam_arms(const FeModel& model);

}  // namespace floatframe
