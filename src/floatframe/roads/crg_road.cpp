#include "floatframe/roads/crg_road.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "floatframe/roads/cubic_weights.hpp"

namespace floatframe {
namespace {

/// A coordinate within the grid and what it is multiplied by per change of the given one: 0, 1, -1.
struct Folded {
  double x = 0.0, rate = 1.0, offset = 0.0;
  bool none = false, zero = false;
};

Folded folded(const CrgEdge& edge, double x, double low, double high) noexcept {
  if (x >= low && x <= high) return {x, 1.0};
  const double length = high - low;
  switch (edge.mode) {
    case CrgBorder::zero:
      return {x < low ? low : high, 0.0, edge.offset, false, true};
    case CrgBorder::keep:
      return {x < low ? low : high, 0.0, edge.offset};
    case CrgBorder::repeat: {
      const double s = std::fmod(x - low, length);
      return {low + (s < 0.0 ? s + length : s), 1.0};
    }
    case CrgBorder::reflect: {
      const double s = std::fmod(std::abs(x - low), 2.0 * length);
      const double rate = x < low ? -1.0 : 1.0;
      if (s > length) return {low + 2.0 * length - s, -rate};
      return {low + s, rate};
    }
    default:  // and what is not a number
      return {low, 0.0, 0.0, true};
  }
}

/// The cell of a coordinate: its beginning, the part of its length, and the lengths about it.
struct Cell {
  std::size_t k = 0;
  double s = 0.0, before = 0.0, h = 1.0, behind = 0.0;
};

Cell uniform_cell(double x, double low, double h, std::size_t count) noexcept {
  const double t = std::max((x - low) / h, 0.0);
  Cell c;
  c.k = std::min(static_cast<std::size_t>(t), count - 2);
  c.s = std::min(t - c.k, 1.0);
  c.h = h;
  c.before = c.k > 0 ? h : 0.0;
  c.behind = c.k + 2 < count ? h : 0.0;
  return c;
}

Cell cell_of(const std::vector<double>& x, double at) noexcept {
  const auto it = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  Cell c;
  c.k = it - x.begin() - 1;
  c.h = x[c.k + 1] - x[c.k];
  c.s = std::clamp((at - x[c.k]) / c.h, 0.0, 1.0);
  c.before = c.k > 0 ? x[c.k] - x[c.k - 1] : 0.0;
  c.behind = c.k + 2 < x.size() ? x[c.k + 2] - x[c.k + 1] : 0.0;
  return c;
}

CrgHeight bilinear(const CrgRoad& road, const Cell& a, const Cell& b) noexcept {
  const double z00 = road.grid(a.k, b.k), z01 = road.grid(a.k, b.k + 1);
  const double z10 = road.grid(a.k + 1, b.k), z11 = road.grid(a.k + 1, b.k + 1);
  const double du = z10 - z00, dv = z01 - z00, duv = z11 - z10 - dv;
  CrgHeight out;
  out.z = z00 + a.s * du + b.s * dv + a.s * b.s * duv;
  out.zu = (du + b.s * duv) / a.h;
  out.zv = (dv + a.s * duv) / b.h;
  out.zuv = duv / (a.h * b.h);
  return out;
}

CrgHeight bicubic(const CrgRoad& road, const Cell& a, const Cell& b) noexcept {
  const CubicWeights wu = cubic_weights(a.s, a.before, a.h, a.behind);
  const CubicWeights wv = cubic_weights(b.s, b.before, b.h, b.behind);
  CrgHeight out;
  for (std::size_t i = 0; i < 4; ++i) {
    if ((i == 0 && a.before == 0.0) || (i == 3 && a.behind == 0.0)) continue;
    double f = 0.0, df = 0.0, ddf = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      if ((j == 0 && b.before == 0.0) || (j == 3 && b.behind == 0.0)) continue;
      const double z = road.grid(a.k + i - 1, b.k + j - 1);
      f += wv.f[j] * z;
      df += wv.df[j] * z;
      ddf += wv.ddf[j] * z;
    }
    out.z += wu.f[i] * f;
    out.zu += wu.df[i] * f;
    out.zuu += wu.ddf[i] * f;
    out.zv += wu.f[i] * df;
    out.zuv += wu.df[i] * df;
    out.zvv += wu.f[i] * ddf;
  }
  return out;
}

/// A value of each row, or one of all: linear between rows, and its slope.
std::array<double, 2> along(const std::vector<double>& values, const Cell& a) noexcept {
  if (values.size() < 2) return {values.empty() ? 0.0 : values[0], 0.0};
  const double rise = values[a.k + 1] - values[a.k];
  return {values[a.k] + a.s * rise, rise / a.h};
}

}  // namespace

CrgHeight crg_height(const CrgRoad& road, double u, double v) noexcept {
  assert(road.columns() > 1 && road.rows() > 1);
  const Folded fu = folded(road.edge_u, u, road.line.first(), road.line.last());
  const Folded fv = folded(road.edge_v, v, road.v.front(), road.v.back());
  CrgHeight out;
  if (fu.none || fv.none || !std::isfinite(u) || !std::isfinite(v)) {
    out.z = std::numeric_limits<double>::quiet_NaN();
    out.road = false;
    return out;
  }
  if (fu.zero || fv.zero) {
    out.z = fu.zero ? fu.offset : fv.offset;
    return out;
  }
  const Cell a = uniform_cell(fu.x, road.line.first(), road.line.step(), road.rows());
  const Cell b = road.uniform
                     ? uniform_cell(fv.x, road.v.front(), road.v[1] - road.v[0], road.columns())
                     : cell_of(road.v, fv.x);
  out = road.interpolation == CrgInterpolation::cubic ? bicubic(road, a, b) : bilinear(road, a, b);
  const auto [line, slope] = along(road.line_heights, a);
  const auto [bank, twist] = along(road.banking, a);
  out.z += line + bank * fv.x + fu.offset + fv.offset;  // (1)
  out.zu = (out.zu + slope + twist * fv.x) * fu.rate;
  out.zv = (out.zv + bank) * fv.rate;
  out.zuu *= fu.rate * fu.rate;
  out.zuv = (out.zuv + twist) * fu.rate * fv.rate;
  out.zvv *= fv.rate * fv.rate;
  return out;
}

SurfacePoint crg_surface(const CrgRoad& road, double x, double y) noexcept {
  const LinePlace p = road.line.at(x, y);
  const CrgHeight h = crg_height(road, p.u, p.v);
  SurfacePoint out;
  out.z = h.z;
  out.zx = h.zu * p.ux + h.zv * p.vx;
  out.zy = h.zu * p.uy + h.zv * p.vy;
  out.zxx = h.zuu * p.ux * p.ux + 2.0 * h.zuv * p.ux * p.vx + h.zvv * p.vx * p.vx + h.zu * p.uxx;
  out.zxy = h.zuu * p.ux * p.uy + h.zuv * (p.ux * p.vy + p.uy * p.vx) + h.zvv * p.vx * p.vy +
            h.zu * p.uxy;
  out.zyy = h.zuu * p.uy * p.uy + 2.0 * h.zuv * p.uy * p.vy + h.zvv * p.vy * p.vy + h.zu * p.uyy;
  return out;
}

void begin_at_origin(CrgRoad& road) {
  road.line.begin_at_origin();
  const double start = road.line_heights.empty() ? 0.0 : road.line_heights.front();
  for (double& z : road.line_heights) z -= start;
}

}  // namespace floatframe
