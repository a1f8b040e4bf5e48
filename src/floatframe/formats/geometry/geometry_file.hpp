#pragma once
// Surfaces drawn by other programs: STL (text and binary), OBJ, glTF (.gltf with its buffers,
// .glb).
// Only triangles are read; materials, colours, normals and textures are ignored. So a page that
// shows a run contains numbers that were checked here, not files.
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

namespace limits {
inline constexpr std::uint64_t geometry_bytes = std::uint64_t{64} << 20;  ///< of a file [byte]
inline constexpr std::size_t geometry_triangles = 500'000;
}  // namespace limits

/// In the units and axes of the file. Corners at the same place are one point; triangles without
/// area because two corners coincide are omitted.
struct TriangleGeometry {
  Mat3X positions;                            ///< finite
  std::vector<std::array<int, 3>> triangles;  ///< indices of points; at least one
  std::vector<std::filesystem::path> others;  ///< files referenced by this one, as they were read
};

/// Returns the bytes of a file named in a glTF file, next to it; throws InputError.
using GeometryLoader = std::function<std::string(const std::string& name)>;

/// Endings that are read: .stl, .obj, .gltf, .glb, in any case.
bool is_geometry_file(const std::filesystem::path& file);

/// Throws InputError, with the line where the file is text: missing, too large, of another format,
/// cut short or damaged, no triangles, coordinates that are not finite.
TriangleGeometry read_geometry(const std::filesystem::path& file);

/// The same for bytes in memory; the ending of `name` selects the format.
TriangleGeometry parse_geometry(std::string_view bytes, const std::string& name,
                                const GeometryLoader& loader = {});

}  // namespace floatframe
