#pragma once
// `build_model` with what it takes from finite elements and their reduction given by the caller: a
// program whose bodies are reduced already needs neither (packed_model.hpp).
#include <functional>
#include <memory>

#include "floatframe/model/model.hpp"

namespace floatframe {

/// The reduced body of a frame of bars, after it is mirrored. Adds errors, with the marks of the
/// body, and returns null if it cannot be built. `stiffens`: with geometric stiffening.
using ReduceBody = std::function<std::shared_ptr<const FlexibleBody>(const BodyDescription& body,
                                                                     bool stiffens, ErrorList&)>;
/// Hints at a description without errors and the model built from it.
using FindHints = std::function<ModelHints(const ModelDescription&, const Model&)>;

/// As `build_model` of one description (model.hpp).
Model build_model(const ModelDescription& description, const ReduceBody& reduce,
                  const FindHints& find_hints);

}  // namespace floatframe
