#pragma once
// From a description and the model built from it to a packed model.
#include <vector>

#include "floatframe/packed/packed_model.hpp"

namespace floatframe {

struct PackOptions {
  /// all: also what pictures, stress and hints need. steps: only what steps and outputs use.
  enum class Contents { all, steps } contents = Contents::all;
  /// Nodes that neither a marker, a path, a gauge nor a support uses are left out.
  bool drop_nodes = true;
};

/// The description with the reduced bodies of `model`, which `build_model` has made of it, without
/// what `options` leave out. Data of the projection method are kept if the model uses it.
ModelDescription with_reduced_bodies(const ModelDescription& description, const Model& model,
                                     const PackOptions& options = {});

/// The packed model. What it builds is compared with `model`: if a node that was left out made a
/// difference, all nodes are kept. InputError: a force law of a program, which has no bytes.
PackedModel packed(const ModelDescription& description, const Model& model,
                   const PackOptions& options = {});

}  // namespace floatframe
