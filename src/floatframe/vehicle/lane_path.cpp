#include "floatframe/vehicle/lane_path.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

constexpr double lane_begin = -20.0, station = 1.0;  // [m]
constexpr int held_stations = 2;                     // y = 0: it begins straight
constexpr int lane_passes = 8;

/// A y <= c.
struct LaneConditions {
  std::vector<VecX> rows;
  std::vector<double> limits;
  /// y_i + X y'_i - X l y''_i between two edges; `bend`: X l.
  void add(Eigen::Index i, Eigen::Index n, double X, double bend, double right, double left) {
    VecX row = VecX::Zero(n);
    const double slope = 0.5 * X / station, curvature = bend / (station * station);
    row[i] = 1.0 + 2.0 * curvature;
    row[i + 1] = slope - curvature;
    row[i - 1] = -slope - curvature;
    rows.push_back(row);
    limits.push_back(left);
    rows.push_back(-row);
    limits.push_back(-right);
  }
};

LaneConditions lane_conditions(const VehicleOutline& vehicle, double sideslip, double margin,
                               Eigen::Index n) {
  LaneConditions out;
  for (const LaneGate& gate : lane_gates(vehicle.width)) {
    const double keep =
        0.5 * vehicle.width + std::min(margin, 0.25 * (gate.left - gate.right - vehicle.width));
    for (Eigen::Index i = 1; i + 1 < n; ++i) {
      const double x = lane_begin + station * double(i);
      const double low = std::max(-vehicle.rear, gate.begin - x),
                   high = std::min(vehicle.front, gate.end - x);
      if (low > high) continue;
      for (const double X : {low, high})
        out.add(i, n, X, X * sideslip, gate.right + keep, gate.left - keep);
    }
  }
  return out;
}

/// (2)
VecX nonnegative_multipliers(const MatX& G, const VecX& c) {
  const Eigen::Index n = c.size();
  VecX lambda = VecX::Zero(n);
  std::vector<Eigen::Index> active;
  for (Eigen::Index pass = 0; pass < 10 * n; ++pass) {
    const VecX slope = G * lambda + c;  // of a condition: what is left of it
    Eigen::Index worst = 0;
    if (slope.minCoeff(&worst) > -1e-6) break;  // [m]
    active.push_back(worst);
    for (;;) {
      const VecX z = -ldlt_solve(G(active, active), c(active));
      double part = 1.0;  // of the way to z: as far as no multiplier is negative
      for (Eigen::Index k = 0; k < z.size(); ++k)
        if (const double now = lambda[active[k]]; z[k] <= 0.0)
          part = std::min(part, now > 0.0 ? now / (now - z[k]) : 0.0);
      for (Eigen::Index k = 0; k < z.size(); ++k)
        lambda[active[k]] += part * (z[k] - lambda[active[k]]);
      if (part == 1.0) break;
      const double least = 1e-14 * lambda.maxCoeff();
      std::erase_if(active, [&](Eigen::Index k) {
        if (lambda[k] > least) return false;
        lambda[k] = 0.0;
        return true;
      });
    }
  }
  return lambda;
}

}  // namespace

std::vector<PathPoint> lane_change_path(const VehicleOutline& vehicle, double sideslip,
                                        double margin) {
  const double end = lane_gates(vehicle.width).back().end + vehicle.front + vehicle.rear;
  const Eigen::Index n = 2 + Eigen::Index(std::ceil((end - lane_begin) / station));
  const LaneConditions conditions = lane_conditions(vehicle, sideslip, margin, n);
  const Eigen::Index m = std::ssize(conditions.rows), free = n - held_stations;
  MatX A(m, free);
  for (Eigen::Index k = 0; k < m; ++k) A.row(k) = conditions.rows[k].tail(free).transpose();
  const VecX c = Eigen::Map<const VecX>(conditions.limits.data(), m);
  MatX D = MatX::Zero(n - 2, n);
  for (Eigen::Index i = 0; i < n - 2; ++i) D.row(i).segment<3>(i) << 1.0, -2.0, 1.0;
  const MatX D_free = D.rightCols(free) / (station * station);
  VecX weight = VecX::Ones(n - 2), y = VecX::Zero(n);
  for (int pass = 0; pass < lane_passes; ++pass) {
    const MatX Q = D_free.transpose() * weight.asDiagonal() * D_free;
    const MatX QA = ldlt_solve(Q, A.transpose());
    y.tail(free) = -QA * nonnegative_multipliers(A * QA, c);
    const VecX bend = (D * y).cwiseAbs() / D.rows();
    // Half of the way each time; straight parts keep some weight.
    const double most = bend.maxCoeff();
    for (Eigen::Index i = 0; i < weight.size(); ++i)
      weight[i] = std::sqrt(weight[i] * std::max(bend[i] * bend[i] / (most * most), 1e-3));
  }
  std::vector<PathPoint> out;
  for (Eigen::Index i = 0; i < n; ++i) out.push_back({lane_begin + station * double(i), y[i]});
  return out;
}

}  // namespace floatframe
