#pragma once
// A measured road: heights on a curved regular grid (ASAM OpenCRG 1.2), rows across a reference
// line and columns along it,
//   z(u, v) = grid(u, v) + line(u) + banking(u) v                                           (1)
// with the height of the line integrated from its slope. line and banking are linear between rows,
// the grid bilinear, as OpenCRG has it, or cubic, whose slope does not jump. In (1) u and v are
// those within the grid; outside each direction has a mode: none (no road: the height is not a
// number), zero (z = offset, also without line and banking), keep (the border goes on, plus the
// offset), repeat, reflect (back and forth). z(x, y) follows with the place beside the line, and
// its derivatives by the chain rule. Numbers are kept as the file has them, KRBI as floats, so that
// none is rounded and memory stays below the size of the file.
#include <string>
#include <vector>

#include "floatframe/roads/reference_line.hpp"
#include "floatframe/roads/surface_point.hpp"

namespace floatframe {

enum class CrgBorder { none, zero, keep, repeat, reflect };
inline constexpr const char* crg_border_words[] = {"none", "zero", "keep", "repeat", "reflect"};
enum class CrgInterpolation { linear, cubic };
inline constexpr const char* crg_interpolation_words[] = {"linear", "cubic"};

struct CrgEdge {
  CrgBorder mode = CrgBorder::keep;
  double offset = 0.0;  ///< [m]
};

/// Height above u and v and derivatives by them [m], [-], [1/m].
struct CrgHeight {
  double z = 0.0, zu = 0.0, zv = 0.0, zuu = 0.0, zuv = 0.0, zvv = 0.0;
  bool road = true;  ///< false: there is none
};

struct CrgRoad {
  ReferenceLine line;
  std::vector<double> v;       ///< of the columns, ascending [m]
  bool uniform = true;         ///< they are equally spaced
  std::vector<float> singles;  ///< heights, row by row; one of both is empty [m]
  std::vector<double> doubles;
  std::vector<double> line_heights;  ///< of each row; one: everywhere the same [m]
  std::vector<double> banking;       ///< the same [-]
  CrgEdge edge_u, edge_v;
  CrgInterpolation interpolation = CrgInterpolation::linear;
  std::vector<std::string> notes;  ///< what of the file has no effect, a sentence each

  std::size_t columns() const noexcept { return v.size(); }
  std::size_t rows() const noexcept {
    return (singles.empty() ? doubles.size() : singles.size()) / v.size();
  }
  double grid(std::size_t row, std::size_t column) const noexcept {
    const std::size_t k = row * v.size() + column;
    return singles.empty() ? doubles[k] : singles[k];
  }
};

/// Step time.
CrgHeight crg_height(const CrgRoad& road, double u, double v) noexcept;
/// Above x and y in the axes of the file; not a number where there is no road. Step time.
SurfacePoint crg_surface(const CrgRoad& road, double x, double y) noexcept;

/// Moved so that the reference line begins at the origin with the height 0 and heads along x.
void begin_at_origin(CrgRoad& road);

}  // namespace floatframe
