#include "floatframe/start/small_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "floatframe/core/memory_room.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/start/element_tangents.hpp"
#include "floatframe/start/linearization.hpp"
#include "floatframe/start/mass_scale.hpp"
#include "floatframe/start/overflow.hpp"

namespace floatframe {
namespace {

/// Difference between angular velocities and rates of rotation vectors, (2). Moves `f`.
MatX connection(Formulation& f, const State& s) {
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

}  // namespace

VecX motion_steps(const Model& model, const VecX& scale) {
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

SmallMotions small_motions(Formulation& f, const State& s) {
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
  const ElementTangents elements(f, s, steps);
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
  require_laws(f, s.t);
  m.K = elements.K + along.columns.topRows(nv);
  m.G = along.columns.middleRows(nv, nc);
  m.H = along.columns.bottomRows(nc);
  m.C = elements.C + rates.columns.topRows(nv);
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
