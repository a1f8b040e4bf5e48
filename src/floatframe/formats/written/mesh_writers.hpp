#pragma once
// The formats, one source each.
#include "floatframe/formats/written/mesh_writer.hpp"

namespace floatframe {

WrittenMesh gmsh_mesh_file(const FeModel& model, const MeshWriteOptions& options);
WrittenMesh vtu_mesh(const FeModel& model, const MeshWriteOptions& options);

}  // namespace floatframe
