#pragma once
// Heights on a rectangular grid of x and y, which need not be equally spaced. In a cell z is the
// bicubic polynomial with the heights, slopes and mixed derivatives of its corners (Hermite):
//   smooth  slopes of the parabolas through three neighbours: C1, local
//   spline  slopes of cubic splines along x and y: C2
//   linear  bilinear: continuous only
// Outside it is that of the nearest place of the border (`hold`), or not a number (`refuse`).
#include <array>
#include <vector>

#include "floatframe/math/types.hpp"
#include "floatframe/roads/surface_point.hpp"

namespace floatframe {

enum class GridInterpolation { smooth, spline, linear };
inline constexpr const char* grid_interpolation_words[] = {"smooth", "spline", "linear"};
enum class GridOutside { hold, refuse };
inline constexpr const char* grid_outside_words[] = {"hold", "refuse"};

struct HeightGrid {
  std::vector<double> x, y;  ///< [m], ascending, at least two each
  GridInterpolation interpolation = GridInterpolation::smooth;
  GridOutside outside = GridOutside::hold;
  MatX z, zx, zy, zxy;  ///< [x][y]: [m], [-], [1/m]; without the first one none if linear
};

/// Heights [x][y] [m]. Throws InputError if x or y do not ascend or numbers do not fit.
HeightGrid height_grid(std::vector<double> x, std::vector<double> y, MatX z,
                       GridInterpolation interpolation, GridOutside outside);

/// Step time.
SurfacePoint grid_height(const HeightGrid& grid, double x, double y) noexcept;

}  // namespace floatframe
