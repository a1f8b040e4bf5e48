#pragma once
// First derivatives of all equations for small motions about a state, at rest or moving. With
// increments x of the configuration, q = q0 (+) x, at accelerations a and multipliers lambda,
//   M = dr/da,  C = dr/dv,  K = dr/dx           r = M a - Q + Phi_q^T lambda                    (1)
//   J = dPhi/dx = dPhidot/dv,  G = dPhidot/dx,  H = dPhiddot/dx,  D = dPhiddot/dv
//   d(dx)/dt = dv + Gamma dx                                                                    (2)
// K and C include d(M a - Q_v)/dq, dQ_v/dv and all of Phi_q^T lambda. Gamma is the difference
// between angular velocities and the rates of rotation vectors: with the composition of two
// increments, x * d = x + d + b(x, d) + ..., Gamma x = b(x, v) - b(v, x).
//
// Differences over steps h and h/2 on both sides, extrapolated: the error decreases with h^4. A
// force whose slope jumps within the steps is detected by second differences that decrease with h
// instead of h^2. Dense, allocates: load time only.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "floatframe/core/memory_room.hpp"
#include "floatframe/core/work_progress.hpp"
#include "floatframe/formulation/equations_of_motion.hpp"
#include "floatframe/simulation/linearization.hpp"
#include "floatframe/simulation/mass_scale.hpp"
#include "floatframe/simulation/run_error.hpp"

namespace floatframe {

struct SmallMotions {
  VecX scale;              ///< nv: mass that each coordinate could have (mass_scale.hpp)
  MatX M, C, K;            ///< nv x nv
  MatX J, G, H, D;         ///< nc x nv
  MatX Gamma;              ///< nv x nv
  VecX r;                  ///< nv, without accelerations
  std::vector<int> kinks;  ///< coordinates along which a force has no one slope
};

/// Columns dg/dx_j at 0, of a vector function g; steps: one for each x_j. `work`: name of the task
/// for progress reports.
struct PreciseDifferences {
  MatX columns;
  std::vector<int> kinks;  ///< columns whose first `watched` rows have no one slope
};

template <class Function>
PreciseDifferences precise_differences(const VecX& steps, Eigen::Index watched, const Function& g,
                                       const char* work = "") {
  const Eigen::Index n = steps.size();
  VecX x = VecX::Zero(n);
  const VecX middle = g(x);
  PreciseDifferences d;
  std::vector<double> bends;  // of the kinks
  d.columns.resize(middle.size(), n);
  for (Eigen::Index j = 0; j < n; ++j) {
    if (*work) tell_progress(work, 1.0 * j / n);
    VecX slope[2];
    double bend[2];
    for (int k = 0; k < 2; ++k) {
      const double h = k == 0 ? steps[j] : 0.5 * steps[j];
      x[j] = h;
      const VecX ahead = g(x);
      x[j] = -h;
      const VecX behind = g(x);
      slope[k] = (ahead - behind) / (2.0 * h);
      const VecX second = (ahead - middle + (behind - middle)) / h;
      bend[k] = watched > 0 ? second.head(watched).cwiseAbs().maxCoeff() : 0.0;
    }
    x[j] = 0.0;
    d.columns.col(j) = (4.0 * slope[1] - slope[0]) / 3.0;
    constexpr double smooth = 0.75, seen = 1e-4;  // smooth: a half; a corner: one
    const double size = watched > 0 ? slope[1].head(watched).cwiseAbs().maxCoeff() : 0.0;
    if (bend[1] > smooth * bend[0] && bend[1] > seen * size) {
      d.kinks.push_back(static_cast<int>(j));
      bends.push_back(bend[1]);
    }
  }
  // A value that is zero up to the round-off of balanced forces has no corner.
  const double least =
      watched > 0 && n > 0 ? 1e-10 * d.columns.topRows(watched).cwiseAbs().maxCoeff() : 0.0;
  for (std::size_t k = d.kinks.size(); k-- > 0;)
    if (!(bends[k] > least)) d.kinks.erase(d.kinks.begin() + static_cast<std::ptrdiff_t>(k));
  return d;
}

/// Difference between angular velocities and rates of rotation vectors, (2). Moves `f`.
inline MatX connection(Formulation& f, const State& s) {
  const Eigen::Index nv = f.velocities();
  MatX gamma = MatX::Zero(nv, nv);
  const double speed = nv > 0 ? s.v.lpNorm<Eigen::Infinity>() : 0.0;
  if (!(speed > 0.0)) return gamma;
  constexpr double size = 1e-2;
  const VecX d = size / speed * s.v;
  VecX q = s.q;
  const auto after = [&](VecX x, const VecX& more) {
    f.retract(s.q, x, q);
    f.positions(s.t, q);
    f.advance(x, more);
    return x;
  };
  const auto second = [&](const VecX& x, const VecX& more) {
    const auto at = [&](double k) {
      return VecX((after(k * x, k * more) + after(-k * x, -k * more)) / (2.0 * k * k));
    };
    return VecX((4.0 * at(0.5) - at(1.0)) / 3.0);
  };
  for (Eigen::Index j = 0; j < nv; ++j) {
    const VecX x = size * VecX::Unit(nv, j);
    gamma.col(j) = speed / (size * size) * (second(x, d) - second(d, x));
  }
  return gamma;
}

/// Steps of increments that move bodies by similar distances, 0.1 mm per metre, with the masses
/// that coordinates could have (mass_scale.hpp).
inline VecX motion_steps(const Model& model, const VecX& scale) {
  double length = 0.0, mass = 0.0;
  const auto bodies = static_cast<double>(model.bodies.size());
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    length += model.bodies[i].length / bodies;
    mass += possible_mass(model, i) / bodies;
  }
  VecX steps(scale.size());
  for (Eigen::Index j = 0; j < scale.size(); ++j)
    steps[j] = scale[j] > 0.0 ? std::min(1e-3, 1e-4 * length * std::sqrt(mass / scale[j])) : 1e-4;
  return steps;
}

/// At t, q, v, a, lambda of the state (a: empty counts as zero), where `f` is afterwards.
inline SmallMotions small_motions(Formulation& f, const State& s) {
  const Eigen::Index nv = f.velocities(), nc = f.constraints();
  const VecX a = s.a.size() == nv ? s.a : VecX::Zero(nv);
  // Memory for these matrices, their columns before the split, and derived matrices.
  const double numbers = nv * (14.0 * nv + 6.0 * nc);
  if (const std::string complaint = memory_complaint(8.0 * numbers); !complaint.empty())
    throw RunError(
        ErrorCode::too_large,
        fmt::format("the linear system of {} coordinates and {} constraints {}{}", nv, nc,
                    complaint, nc > nv / 2 ? "; relative coordinates are fewer" : ""));
  SmallMotions m;
  m.scale = possible_masses(f, s);

  const VecX steps = motion_steps(f.model(), m.scale);
  const auto terms = [&](const VecX& q, const VecX& v) {
    VecX all(nv + 2 * nc), part(nc), r(nv);
    kinematics_at(f, s.t, q, v);
    f.dynamics();
    f.residual(a, s.lambda, 0.0, r);
    all.head(nv) = r;
    f.constraint_rates(part);
    all.segment(nv, nc) = part;
    f.constraint_accelerations(a, part);
    all.tail(nc) = part;
    return all;
  };
  VecX q = s.q;
  const PreciseDifferences along = precise_differences(
      steps, nv,
      [&](const VecX& x) {
        f.retract(s.q, x, q);
        return terms(q, s.v);
      },
      "stiffness");
  const PreciseDifferences rates = precise_differences(
      10.0 * steps, nv, [&](const VecX& x) { return terms(s.q, VecX(s.v + x)); }, "damping");
  m.K = along.columns.topRows(nv);
  m.G = along.columns.middleRows(nv, nc);
  m.H = along.columns.bottomRows(nc);
  m.C = rates.columns.topRows(nv);
  m.D = rates.columns.bottomRows(nc);
  m.kinks = along.kinks;
  for (const int j : rates.kinks)
    if (std::find(m.kinks.begin(), m.kinks.end(), j) == m.kinks.end()) m.kinks.push_back(j);
  m.Gamma = connection(f, s);
  m.r = residual_at(f, s.t, s.q, s.v, s.lambda);
  m.J = f.constraint_jacobian();
  m.M = mass_matrix(f, test_accelerations(m.r, m.scale), m.r, s.lambda);
  return m;
}

}  // namespace floatframe
