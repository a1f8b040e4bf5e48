#include <fmt/format.h>
#include <fmt/ranges.h>

#include "floatframe/formats/deck_component.hpp"
#include "floatframe/formats/written/mesh_writers.hpp"

namespace floatframe {
namespace {

constexpr MeshFormat own_writers[] = {
    {"gmsh", "Gmsh mesh, format 4.1 (.msh)", ".msh", gmsh_mesh_file},
    {"vtu", "VTK unstructured grid, for ParaView (.vtu)", ".vtu", vtu_mesh},
};

}  // namespace

std::span<const MeshFormat> mesh_formats() {
  static const std::vector<MeshFormat> list = [] {
    std::vector<MeshFormat> all = deck_component().writers;
    all.insert(all.end(), std::begin(own_writers), std::end(own_writers));
    return all;
  }();
  return list;
}

const MeshFormat& mesh_format_of(const std::filesystem::path& file) {
  std::vector<std::string> known;
  for (const MeshFormat& format : mesh_formats()) {
    if (file.extension() == format.ending) return format;
    known.emplace_back(format.description);
  }
  throw InputError(
      ErrorCode::wrong_file, {file.string(), 0, 0},
      fmt::format("found the ending '{}', expected one of: {}{}", file.extension().string(),
                  fmt::join(known, "; "), deck_component_missing()));
}

}  // namespace floatframe
