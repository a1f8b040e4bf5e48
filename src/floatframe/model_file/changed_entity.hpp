#pragma once
// What of a description differs from another one of the same structure, for messages.
#include <optional>
#include <string>
#include <utility>

#include "floatframe/description/description.hpp"

namespace floatframe {

/// "the joint 'pin'": the first entity in which they differ; with `numbers`, in which the first one
/// of these stands in `a` and the second one in its place in `b`. "the model" for all else.
std::string changed_entity(const ModelDescription& a, const ModelDescription& b,
                           const std::optional<std::pair<double, double>>& numbers = {});

}  // namespace floatframe
