#include "floatframe/roads/height_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/cubic_spline.hpp"

namespace floatframe {
namespace {

/// Slopes of a row of values at its points.
std::vector<double> grid_slopes(const std::vector<double>& x, const std::vector<double>& f,
                                GridInterpolation interpolation) {
  const std::size_t n = x.size();
  std::vector<double> m(n);
  if (interpolation == GridInterpolation::spline) {
    std::vector<TablePoint> points(n);
    for (std::size_t k = 0; k < n; ++k) points[k] = {x[k], f[k]};
    const PiecewisePolynomial spline = cubic_spline(points, SplineEnds::open);
    for (std::size_t k = 0; k < n; ++k) m[k] = spline(x[k]).df;
    return m;
  }
  const auto secant = [&](std::size_t k) { return (f[k + 1] - f[k]) / (x[k + 1] - x[k]); };
  m.front() = secant(0);
  m.back() = secant(n - 2);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double before = x[k] - x[k - 1], behind = x[k + 1] - x[k];
    m[k] = (behind * secant(k - 1) + before * secant(k)) / (before + behind);
  }
  return m;
}

/// Of each row (along y) or each column (along x).
MatX slopes_along(const MatX& z, const std::vector<double>& at, bool along_x,
                  GridInterpolation interpolation) {
  MatX out(z.rows(), z.cols());
  const Eigen::Index lines = along_x ? z.cols() : z.rows();
  std::vector<double> values(at.size());
  for (Eigen::Index line = 0; line < lines; ++line) {
    auto map = VecX::Map(values.data(), std::ssize(values));
    map = along_x ? VecX(z.col(line)) : VecX(z.row(line).transpose());
    const std::vector<double> m = grid_slopes(at, values, interpolation);
    const auto found = VecX::Map(m.data(), std::ssize(m));
    if (along_x)
      out.col(line) = found;
    else
      out.row(line) = found.transpose();
  }
  return out;
}

/// The weights of f_0, f_1, m_0, m_1 for the value, the slope and the second derivative.
struct HermiteWeights {
  std::array<std::array<double, 4>, 3> w;
  Eigen::Index k;  ///< the cell
  double rate;     ///< of the place within the grid
};

HermiteWeights hermite_weights(const std::vector<double>& x, double at, bool linear) noexcept {
  const double within = std::clamp(at, x.front(), x.back());
  const auto it = std::upper_bound(x.begin() + 1, x.end() - 1, within);
  HermiteWeights out;
  out.k = it - x.begin() - 1;
  out.rate = within == at ? 1.0 : 0.0;
  const double h = *it - *(it - 1), s = (within - *(it - 1)) / h, s2 = s * s, s3 = s2 * s;
  if (linear) {
    out.w = {{{1.0 - s, s, 0.0, 0.0}, {-1.0 / h, 1.0 / h, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}}};
    return out;
  }
  const double f = 3.0 * s2 - 2.0 * s3, df = 6.0 * (s - s2) / h, ddf = (6.0 - 12.0 * s) / (h * h);
  out.w = {{{1.0 - f, f, h * (s - 2.0 * s2 + s3), h * (s3 - s2)},
            {-df, df, 1.0 - 4.0 * s + 3.0 * s2, 3.0 * s2 - 2.0 * s},
            {-ddf, ddf, (6.0 * s - 4.0) / h, (6.0 * s - 2.0) / h}}};
  return out;
}

void check_axis(const std::vector<double>& x, const char* name) {
  if (x.size() < 2)
    throw InputError(ErrorCode::wrong_count, std::string("height grid: found ") +
                                                 std::to_string(x.size()) + " numbers of " + name +
                                                 ", expected at least 2");
  for (std::size_t k = 1; k < x.size(); ++k)
    if (!(x[k] > x[k - 1]) || !std::isfinite(x[k] - x[k - 1]))
      throw InputError(ErrorCode::wrong_value, std::string("height grid: found numbers of ") +
                                                   name +
                                                   " that do not ascend, expected ascending ones");
}

}  // namespace

HeightGrid height_grid(std::vector<double> x, std::vector<double> y, MatX z,
                       GridInterpolation interpolation, GridOutside outside) {
  check_axis(x, "x");
  check_axis(y, "y");
  if (z.rows() != std::ssize(x) || z.cols() != std::ssize(y))
    throw InputError(ErrorCode::wrong_count,
                     "height grid: found another number of heights than places, expected a row "
                     "for each x with one for each y");
  if (!z.allFinite())
    throw InputError(ErrorCode::not_finite,
                     "height grid: found a height that is not finite, expected numbers");
  HeightGrid out{std::move(x), std::move(y), interpolation, outside, std::move(z), {}, {}, {}};
  if (interpolation == GridInterpolation::linear) return out;
  out.zx = slopes_along(out.z, out.x, true, interpolation);
  out.zy = slopes_along(out.z, out.y, false, interpolation);
  out.zxy = slopes_along(out.zx, out.y, false, interpolation);
  return out;
}

SurfacePoint grid_height(const HeightGrid& grid, double x, double y) noexcept {
  const bool linear = grid.interpolation == GridInterpolation::linear;
  SurfacePoint out;
  const bool beyond =
      x < grid.x.front() || x > grid.x.back() || y < grid.y.front() || y > grid.y.back();
  if ((beyond && grid.outside == GridOutside::refuse) || !std::isfinite(x) || !std::isfinite(y)) {
    out.z = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  const HermiteWeights a = hermite_weights(grid.x, x, linear);
  const HermiteWeights b = hermite_weights(grid.y, y, linear);
  // z = sum_ij a_i b_j Z_ij with Z of heights, slopes and mixed derivatives of the corners.
  std::array<std::array<double, 4>, 4> Z{};
  for (Eigen::Index i = 0; i < 2; ++i)
    for (Eigen::Index j = 0; j < 2; ++j) {
      Z[i][j] = grid.z(a.k + i, b.k + j);
      if (linear) continue;
      Z[i + 2][j] = grid.zx(a.k + i, b.k + j);
      Z[i][j + 2] = grid.zy(a.k + i, b.k + j);
      Z[i + 2][j + 2] = grid.zxy(a.k + i, b.k + j);
    }
  const auto sum = [&](std::size_t m, std::size_t n) noexcept {
    double total = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) total += a.w[m][i] * b.w[n][j] * Z[i][j];
    return total;
  };
  out.z = sum(0, 0);
  out.zx = a.rate * sum(1, 0);
  out.zy = b.rate * sum(0, 1);
  out.zxx = a.rate * sum(2, 0);
  out.zxy = a.rate * b.rate * sum(1, 1);
  out.zyy = b.rate * sum(0, 2);
  return out;
}

}  // namespace floatframe
