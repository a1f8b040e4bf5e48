#pragma once
// The bytes of a .vtu file, an unstructured grid of VTK in XML with its numbers appended in
// memory layout (header_type UInt64, little-endian). Source: VTK File Formats, XML formats.
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

struct VtkArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<float>, std::vector<std::int32_t>> values;
};

struct VtkGrid {
  double time = 0.0;  ///< [s], field data TimeValue
  std::vector<double> points;
  std::vector<std::int32_t> connectivity, offsets;  ///< points of the cells, end of each
  std::vector<std::uint8_t> types;
  std::vector<VtkArray> point_data, cell_data;
  /// Field data: columns of texts.
  std::vector<std::pair<std::string, std::vector<std::string>>> texts;
};

namespace vtk_cell {
inline constexpr std::uint8_t vertex = 1, line = 3, triangle = 5;
}

std::string vtu_bytes(const VtkGrid& grid);

/// The index of a series: what ParaView opens. `files`: time [s] and name of each.
std::string pvd_text(const std::vector<std::pair<double, std::string>>& files);

}  // namespace floatframe
