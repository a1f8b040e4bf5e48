#pragma once
// Stiffness and damping of a bearing over the spin W of its shaft against its housing about e_3:
// rows of W [rad/s], k11, k12, k21, k22 [N/m], c11, c12, c21, c22 [N s/m] along e_1, e_2, which add
// to the constant matrices. Linear between rows, constant outside. If all speeds are at least 0,
// the table is valid for both senses: at -W the bearing is its mirror image, with cross terms of
// opposite sign (as for a film whose load acts along e_1 or e_2).
//
// Layout in Force::numbers, after the values common to all bearings: the number of rows, then for
// each W the eight entries and the tangent of the step at that speed, T (36), k (6), c (6).
#include <algorithm>
#include <cstddef>

#include "floatframe/model/model.hpp"

namespace floatframe {

inline constexpr std::size_t bearing_numbers = 123, bearing_row = 57;
/// Offsets: matrices by columns; row_*: from the beginning of a row of the table.
namespace bearing_at {
inline constexpr int K = 0, C = 36, d0 = 72, T = 75, k = 111, c = 117;
inline constexpr int row_T = 9, row_k = 45, row_c = 51;
}  // namespace bearing_at

inline Eigen::Map<const Mat6> bearing_matrix(const Force& f, int at) noexcept {
  return Eigen::Map<const Mat6>(f.numbers.data() + at);
}

/// The corner of K and C at a spin, and their derivatives in it.
struct BearingCorner {
  Eigen::Matrix2d K, C, dK, dC;
  std::size_t nearest = 0;  ///< row

  /// `rows`: n of them, n >= 1.
  BearingCorner(const double* rows, std::size_t n, double spin) noexcept {
    const bool both = rows[0] >= 0.0, mirrored = both && spin < 0.0;
    const double W = mirrored ? -spin : spin;
    const auto speed = [&](std::size_t i) { return rows[i * bearing_row]; };
    std::size_t i = 0;  // of the interval
    while (i + 2 < n && W > speed(i + 1)) ++i;
    const std::size_t j = std::min(i + 1, n - 1);
    const double width = speed(j) - speed(i);
    const double part = width > 0.0 ? (W - speed(i)) / width : 0.0;
    const bool inside = part > 0.0 && part < 1.0;
    const double s = std::clamp(part, 0.0, 1.0);
    nearest = s > 0.5 ? j : i;
    for (int k = 0; k < 4; ++k) {
      const int r = k / 2, c = k % 2;
      const double sign = mirrored && r != c ? -1.0 : 1.0;
      const double* const a = rows + i * bearing_row + 1 + k;
      const double* const b = rows + j * bearing_row + 1 + k;
      const double slope = (inside ? sign : 0.0) * (mirrored ? -1.0 : 1.0);
      K(r, c) = sign * (a[0] + s * (b[0] - a[0]));
      C(r, c) = sign * (a[4] + s * (b[4] - a[4]));
      dK(r, c) = inside ? slope * (b[0] - a[0]) / width : 0.0;
      dC(r, c) = inside ? slope * (b[4] - a[4]) / width : 0.0;
    }
  }
};

/// K and C at a spin.
struct BearingLaw {
  Mat6 K, C;
  Eigen::Matrix2d dK, dC;  ///< of the corner, in the spin
  int T = bearing_at::T, k = bearing_at::k,
      c = bearing_at::c;  ///< position of the rows of the step

  BearingLaw(const Force& f, double spin) noexcept
      : K(bearing_matrix(f, bearing_at::K)), C(bearing_matrix(f, bearing_at::C)) {
    dK.setZero();
    dC.setZero();
    if (f.numbers.size() == bearing_numbers) return;
    const double* const rows = f.numbers.data() + bearing_numbers + 1;
    const BearingCorner corner(rows, static_cast<std::size_t>(rows[-1]), spin);
    K.topLeftCorner<2, 2>() += corner.K;
    C.topLeftCorner<2, 2>() += corner.C;
    dK = corner.dK;
    dC = corner.dC;
    const int row = static_cast<int>(bearing_numbers + 1 + corner.nearest * bearing_row);
    T = row + bearing_at::row_T;
    k = row + bearing_at::row_k;
    c = row + bearing_at::row_c;
  }
};

/// The table of the mirrored bearing, whose shaft spins in the opposite sense.
inline MatX mirrored_bearing_table(const MatX& rows) {
  if (rows.rows() == 0 || rows(0, 0) >= 0.0) return rows;
  MatX out = rows.colwise().reverse();
  for (const int column : {0, 2, 3, 6, 7}) out.col(column) = -out.col(column);
  return out;
}

}  // namespace floatframe
