#pragma once
// First derivatives of all equations for small motions about a state, at rest or moving. With
// increments x of the configuration, q = q0 (+) x, at accelerations a and multipliers lambda,
//   M = dr/da,  C = dr/dv,  K = dr/dx           r = M a - Q + Phi_q^T lambda                    (1)
//   J = dPhi/dx = dPhidot/dv,  G = dPhidot/dx,  H = dPhiddot/dx,  D = dPhiddot/dv
//   d(dx)/dt = dv + Gamma dx                                                                    (2)
// K and C include d(M a - Q_v)/dq, dQ_v/dv and all of Phi_q^T lambda. Gamma is the difference
// between angular velocities and the rates of rotation vectors: with the composition of two
// increments, x * d = x + d + b(x, d) + ..., Gamma x = b(x, v) - b(v, x).
// Behind the coordinates are the ns states z of elements, with zdot - f(x, v, z) = 0 as equations:
// unknowns of first order, with rows and columns of C and K but not of M, and columns of zero in J.
//
// Efforts of elements are exact (element_tangents.hpp), the rest differences over steps h and h/2
// on both sides, extrapolated: the error decreases with h^4. Near an edge of the law of an element
// all of it is differences: a force whose slope jumps within the steps is detected by second
// differences that decrease with h instead of h^2. Dense, allocates: load time only.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "floatframe/core/work_progress.hpp"
#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/step.hpp"

namespace floatframe {

struct SmallMotions {
  int states = 0;          ///< ns; n = nv + ns
  VecX scale;              ///< nv: mass that each coordinate could have (mass_scale.hpp)
  MatX M, C, K;            ///< n x n
  MatX J, G, H, D;         ///< nc x n
  MatX Gamma;              ///< n x n
  VecX r;                  ///< n, without accelerations
  std::vector<int> kinks;  ///< coordinates along which a force has no one slope
};

/// Columns dg/dx_j at 0, of a vector function g; steps: one for each x_j. `work`: name of the task
/// for progress reports. `load`: the largest of the terms whose sums g are; their round-off is no
/// corner.
struct PreciseDifferences {
  MatX columns;
  std::vector<int> kinks;  ///< columns whose first `watched` rows have no one slope
};

template <class Function>
PreciseDifferences precise_differences(const VecX& steps, Eigen::Index watched, const Function& g,
                                       const char* work = "", double load = 0.0) {
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
    const double rounding = 1e-13 * load / steps[j];
    if (bend[1] > smooth * bend[0] && bend[1] > std::max(seen * size, rounding)) {
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

/// Steps of increments that move bodies by similar distances, 0.1 mm per metre, with the masses
/// that coordinates could have (mass_scale.hpp).
VecX motion_steps(const Model& model, const VecX& scale);
/// The same, and behind them steps of the states of elements: their size or that of a unit.
VecX unknown_steps(const Model& model, const VecX& scale, const State& s);

/// The residuals of the states of elements, zdot - f with zdot = 0, at the last evaluation; and the
/// state with those numbers moved.
VecX state_residuals(const Formulation& f);
void move_states(const Model& model, const VecX& by, State& s);

/// At t, q, v, a, lambda of the state (a: empty counts as zero), where `f` is afterwards.
SmallMotions small_motions(Formulation& f, const State& s);

}  // namespace floatframe
