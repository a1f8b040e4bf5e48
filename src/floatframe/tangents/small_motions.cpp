#include "floatframe/tangents/small_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "floatframe/core/memory_room.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/tangents/element_tangents.hpp"
#include "floatframe/tangents/linearization.hpp"
#include "floatframe/tangents/mass_scale.hpp"
#include "floatframe/tangents/overflow.hpp"

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

namespace {

/// In the corner of a matrix of zeros.
MatX extended(const MatX& X, Eigen::Index rows, Eigen::Index columns) {
  MatX out = MatX::Zero(rows, columns);
  out.topLeftCorner(X.rows(), X.cols()) = X;
  return out;
}

/// Calls action(number, place): of each state among those of the system, and in State::z.
template <class Action>
void for_each_state(const Model& model, const Action& action) {
  Eigen::Index number = 0, place = 0;
  for (const Element& e : model.elements) {
    for (int i = 0; i < e.states; ++i) action(number++, place + i);
    place += e.states + e.kept;
  }
}

}  // namespace

VecX unknown_steps(const Model& model, const VecX& scale, const State& s) {
  VecX steps(scale.size() + state_count(model));
  steps.head(scale.size()) = motion_steps(model, scale);
  for_each_state(model, [&](Eigen::Index number, Eigen::Index place) {
    steps[scale.size() + number] = 1e-4 * std::max(1e-3, std::abs(s.z[place]));
  });
  return steps;
}

VecX state_residuals(const Formulation& f) {
  VecX out(state_count(f.model()));
  for_each_state(f.model(), [&](Eigen::Index number, Eigen::Index place) {
    out[number] = -f.element_states().rates()[place];
  });
  return out;
}

void move_states(const Model& model, const VecX& by, State& s) {
  for_each_state(model, [&](Eigen::Index number, Eigen::Index place) { s.z[place] += by[number]; });
}

SmallMotions small_motions(Formulation& f, const State& s) {
  SmallMotions m;
  m.states = state_count(f.model());
  const Eigen::Index nv = f.velocities(), nc = f.constraints(), n = nv + m.states;
  const VecX a = s.a.size() == nv ? s.a : VecX::Zero(nv);
  // Memory for these matrices, their columns before the split, and derived matrices.
  const double numbers = n * (14.0 * n + 6.0 * nc);
  if (const std::string complaint = memory_complaint(8.0 * numbers); !complaint.empty())
    throw RunError(
        ErrorCode::too_large,
        fmt::format("the linear system of {} coordinates and {} constraints {}{}", nv, nc,
                    complaint, nc > nv / 2 ? "; relative coordinates are fewer" : ""));
  m.scale = possible_masses(f, s);

  const VecX all_steps = unknown_steps(f.model(), m.scale, s), steps = all_steps.head(nv);
  dynamics_at(f, s);
  const double load = largest_load(f);
  const ElementTangents elements(f, s, steps);
  State moved = s;
  const auto terms = [&](const VecX& x, const VecX& v, const VecX& z) {
    VecX all(n + 2 * nc), part(nc), r(nv);
    f.retract(s.q, x, moved.q);
    moved.v = s.v + v;
    moved.z = s.z;
    move_states(f.model(), z, moved);
    dynamics_at(f, moved);
    f.residual(a, s.lambda, 0.0, r);
    all.head(nv) = r;
    all.segment(nv, m.states) = state_residuals(f);
    f.constraint_rates(part);
    all.segment(n, nc) = part;
    f.constraint_accelerations(a, part);
    all.tail(nc) = part;
    return all;
  };
  const VecX still = VecX::Zero(nv), constant = VecX::Zero(m.states);
  const PreciseDifferences along = precise_differences(
      steps, nv, [&](const VecX& x) { return terms(x, still, constant); }, "stiffness", load);
  const PreciseDifferences rates = precise_differences(
      10.0 * steps, nv, [&](const VecX& v) { return terms(still, v, constant); }, "damping", load);
  require_laws(f, s.t);
  m.K = elements.K + extended(along.columns.topRows(n), n, n);
  m.G = extended(along.columns.middleRows(n, nc), nc, n);
  m.H = extended(along.columns.bottomRows(nc), nc, n);
  m.C = elements.C + extended(rates.columns.topRows(n), n, n);
  m.D = extended(rates.columns.bottomRows(nc), nc, n);
  if (m.states > 0 && !elements.exact) {
    m.K.rightCols(m.states) = precise_differences(all_steps.tail(m.states), nv, [&](const VecX& z) {
                                return terms(still, still, z);
                              }).columns.topRows(n);
    m.C.bottomRightCorner(m.states, m.states).setIdentity();
  }
  m.kinks = along.kinks;
  for (const int j : rates.kinks)
    if (std::find(m.kinks.begin(), m.kinks.end(), j) == m.kinks.end()) m.kinks.push_back(j);
  m.Gamma = extended(connection(f, s), n, n);
  dynamics_at(f, s);
  VecX r(nv);
  f.residual(VecX::Zero(nv), s.lambda, 0.0, r);
  m.r.resize(n);
  m.r << r, state_residuals(f);
  m.J = extended(f.constraint_jacobian(), nc, n);
  m.M = extended(mass_matrix(f, test_accelerations(r, m.scale), r, s.lambda), n, n);
  return m;
}

}  // namespace floatframe
