#pragma once
// Stiffness and damping of a bearing over the spin W of its shaft against its housing about e_3:
// rows of W [rad/s], k11, k12, k21, k22 [N/m], c11, c12, c21, c22 [N s/m] along e_1, e_2, which add
// to the constant matrices. Linear between rows, constant outside. If all speeds are at least 0,
// the table is valid for both senses: at -W the bearing is its mirror image, with cross terms of
// opposite sign (as for a film whose load acts along e_1 or e_2).
#include <algorithm>
#include <cstddef>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// Rows of the step: directions t_r (columns) with weights k_r and c_r.
struct BearingRows {
  Mat6 T;
  Vec6 k, c;
};

struct BearingSpeed {
  double spin;
  Eigen::Matrix2d K, C;  ///< of the corner
  BearingRows rows;
};

struct BearingData {
  Mat6 K, C;
  Vec3 d0;  ///< displacements of the design configuration
  BearingRows rows;
  std::vector<BearingSpeed> speeds;
};

/// The corner of K and C at a spin, with their derivatives in it, and the rows of the step.
struct BearingCorner {
  Eigen::Matrix2d K = Eigen::Matrix2d::Zero(), C = K, dK = K, dC = K;
  const BearingRows* rows;

  BearingCorner(const BearingData& data, double spin) noexcept : rows(&data.rows) {
    const std::vector<BearingSpeed>& at = data.speeds;
    if (at.empty()) return;
    const bool both = at[0].spin >= 0.0, mirrored = both && spin < 0.0;
    const double W = mirrored ? -spin : spin;
    std::size_t i = 0;  // of the interval
    while (i + 2 < at.size() && W > at[i + 1].spin) ++i;
    const std::size_t j = std::min(i + 1, at.size() - 1);
    const double width = at[j].spin - at[i].spin;
    const double part = width > 0.0 ? (W - at[i].spin) / width : 0.0;
    const bool inside = part > 0.0 && part < 1.0;
    const double s = std::clamp(part, 0.0, 1.0);
    rows = &at[s > 0.5 ? j : i].rows;
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) {
        const double sign = mirrored && r != c ? -1.0 : 1.0;
        const double slope = (inside ? sign : 0.0) * (mirrored ? -1.0 : 1.0);
        const double rise_K = at[j].K(r, c) - at[i].K(r, c), rise_C = at[j].C(r, c) - at[i].C(r, c);
        K(r, c) = sign * (at[i].K(r, c) + s * rise_K);
        C(r, c) = sign * (at[i].C(r, c) + s * rise_C);
        dK(r, c) = inside ? slope * rise_K / width : 0.0;
        dC(r, c) = inside ? slope * rise_C / width : 0.0;
      }
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
