#include "floatframe/tangents/linearization.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/tangents/element_tangents.hpp"
#include "floatframe/tangents/overflow.hpp"

namespace floatframe {

VecX equilibration(const MatX& A) {
  VecX scale(A.rows());
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    const double size = A.row(i).cwiseAbs().maxCoeff();
    scale[i] = size > 0.0 ? 1.0 / std::sqrt(size) : 1.0;
  }
  return scale;
}

VecX residual_at(Formulation& f, double t, const VecX& q, const VecX& v, const VecX& lambda) {
  VecX r(f.velocities());
  kinematics_at(f, t, q, v);
  f.dynamics();
  f.residual(VecX::Zero(f.velocities()), lambda, 0.0, r);
  return r;
}

double largest_load(const Formulation& f) {
  const Model& model = f.model();
  double mass = 0.0;
  for (const Body& b : model.bodies) mass += b.data->invariants.m;
  double load = std::max(1e-6, mass * model.gravity.norm());
  for (int k = 0; k < std::ssize(model.elements); ++k)
    for (const Wrench& w : f.effort(k).wrench) load = std::max({load, w.F.norm(), w.T.norm()});
  return load;
}

VecX mass_times(Formulation& f, const VecX& d, double size, const VecX& r0, const VecX& lambda) {
  VecX r(f.velocities());
  f.residual(size * d, lambda, 0.0, r);
  return (r - r0) / size;
}

MatX mass_matrix(Formulation& f, const VecX& sizes, const VecX& r0, const VecX& lambda) {
  const int nv = f.velocities();
  MatX M(nv, nv);
  for (int j = 0; j < nv; ++j) M.col(j) = mass_times(f, VecX::Unit(nv, j), sizes[j], r0, lambda);
  return M;
}

MatX stiffness_matrix(Formulation& f, const State& s) {
  constexpr double step = 1e-6;  // [m, rad, amplitudes]
  const ElementTangents elements(f, s, VecX::Constant(f.velocities(), step));
  VecX q = s.q;
  const MatX rest = central_differences(f.velocities(), step, [&](const VecX& x) {
    f.retract(s.q, x, q);
    return residual_at(f, s.t, q, s.v, s.lambda);
  });
  require_laws(f, s.t);
  return elements.at_rest(s, step) + rest;
}

}  // namespace floatframe
