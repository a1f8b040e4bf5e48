#pragma once
// The writer of `convert`.
#include "floatframe/formats/written/mesh_writer.hpp"

namespace floatframe {

WrittenMesh calculix_deck(const FeModel& model, const MeshWriteOptions& options);

}  // namespace floatframe
