// How fast a mechanism can change: eigenvalues of its matrices at the start.
#include <Eigen/Dense>
#include <cmath>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/start/initial_state.hpp"
#include "support/random_mechanism.hpp"

namespace floatframe::test {

double fastest_rate(const Model& model, InertiaMethod method) {
  try {
    RelativeFormulation f(model, method);
    const State s = relative_start(f, model.simulation.start);
    const int nv = f.velocities(), nc = f.constraints();
    if (nv == 0) return 0.0;
    const VecX zero = VecX::Zero(nv), none = VecX::Zero(nc);
    VecX rest(nv), column(nv), q1 = s.q;
    const auto residual = [&](const VecX& q, const VecX& v, const VecX& a, VecX& out) {
      f.positions(0.0, q);
      f.velocities(v);
      f.dynamics();
      f.residual(a, none, 0.0, out);
    };
    residual(s.q, s.v, zero, rest);
    MatX M(nv, nv), K(nv, nv), C(nv, nv);
    for (int j = 0; j < nv; ++j) {
      residual(s.q, s.v, VecX::Unit(nv, j), column);
      M.col(j) = column - rest;
      residual(s.q, s.v + 1e-6 * VecX::Unit(nv, j), zero, column);
      C.col(j) = (column - rest) / 1e-6;
      f.retract(s.q, 1e-6 * VecX::Unit(nv, j), q1);
      residual(q1, s.v, zero, column);
      K.col(j) = (column - rest) / 1e-6;
    }
    f.positions(0.0, s.q);
    f.velocities(s.v);
    MatX N = MatX::Identity(nv, nv);
    if (nc > 0) N = f.constraint_jacobian().fullPivLu().kernel();
    const MatX Mr = N.transpose() * M * N;
    const Eigen::SelfAdjointEigenSolver<MatX> e(0.5 * (Mr + Mr.transpose()));
    const double top = e.eigenvalues().cwiseAbs().maxCoeff();
    // Motions without mass have no rate of their own.
    MatX W = N * e.eigenvectors();
    for (Eigen::Index k = 0; k < W.cols(); ++k) {
      const double mass = e.eigenvalues()[k];
      W.col(k) *= mass > 1e-7 * top ? 1.0 / std::sqrt(mass) : 0.0;
    }
    const MatX Kr = W.transpose() * K * W, Cr = W.transpose() * C * W;
    const MatX symmetric = 0.5 * (Kr + Kr.transpose());
    const double omega =
        std::sqrt(symmetric.selfadjointView<Eigen::Lower>().eigenvalues().cwiseAbs().maxCoeff());
    return std::max({omega, Cr.norm(), 2.0 * s.v.norm()});
  } catch (const std::exception&) {
    return 0.0;
  }
}

}  // namespace floatframe::test
