#pragma once
// The equations of a static equilibrium: balance, constraints, and integrals at rest; of vehicles
// on free wheels, held along the directions along which they roll.
#include <algorithm>
#include <cmath>
#include <vector>

#include "floatframe/math/dense.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/tangents/linearization.hpp"

namespace floatframe {

/// Residual, tangent and constraints of the statics at q.
class StaticsEquations {
 public:
  explicit StaticsEquations(RelativeFormulation& f) : f_(f) {
    at_.v = VecX::Zero(f.velocities());
    let_go();
    penalty_mass_ = default_penalty_mass(f.model(), Coordinates::relative);
  }

  VecX evaluate(const VecX& q, const VecX& lambda) {
    VecX out = residual_at(f_, 0.0, q, at_.v, lambda);
    drift = f_.element_states().drift();
    if (released()) out += free_ * push;
    return out;
  }
  void find_mass(const VecX& q, const VecX& lambda) {
    const VecX rest = evaluate(q, lambda);
    mass_ = mass_matrix(f_, VecX::Ones(f_.velocities()), rest, lambda);
  }
  /// Evaluates the model at its present state: r, phi.
  void look(const VecX& q, const VecX& lambda) {
    r = evaluate(q, lambda);
    phi = f_.constraint_values();
    weight = largest_load(f_);
  }
  /// The same with J and K. `first`: least-squares multipliers instead of the given ones.
  void linearise(const VecX& q, VecX& lambda, bool first) {
    r = evaluate(q, lambda);
    J = f_.constraint_jacobian();
    phi = f_.constraint_values();
    if (first && phi.size() > 0) {
      lambda = LeastNorm(J.transpose()).solve(VecX(-r));
      r = evaluate(q, lambda);
    }
    weight = largest_load(f_);
    at_.q = q;
    at_.lambda = lambda;
    K = stiffness_matrix(f_, at_);
    find_integrals(q, lambda);
  }
  /// Imbalance and gaps at the state of `linearise`, and what integrals see.
  double size() const {
    double left = largest(r) + 1e3 * weight * largest(phi);
    for (Eigen::Index i = 0; i < drift.size(); ++i)
      if (drift[i] != 0.0) left += 1e3 * weight * std::abs(drift[i]) / reach_of_drift(i);
    return left;
  }
  /// The element whose state drifts most; -1: none does.
  int drifting() const {
    Eigen::Index worst = 0;
    if (drift.size() == 0 || drift.cwiseAbs().maxCoeff(&worst) == 0.0) return -1;
    int k = 0;
    for (Eigen::Index before = 0; const Element& e : f_.model().elements) {
      before += e.states + e.kept;
      if (worst < before) break;
      ++k;
    }
    return k;
  }
  /// z after a time without end: states that drift wherever the system is reach their limits.
  VecX endless(VecX z) const {
    constexpr double time = 1e9;  // [s]
    for (Eigen::Index i = 0; i < reach_of_drift_.size(); ++i)
      if (reach_of_drift_[i] == 0.0) z[i] += time * drift[i];
    return z;
  }
  /// States that come to rest only where the system is at a certain place.
  bool integrates() const { return !integrals_.empty(); }
  /// As `step`, with the tangent of steps at the state of `look`.
  bool step_by_tangent(double mu, VecX& dx, VecX& dlambda) {
    constexpr double s = 1e-4;  // [s2], as in steps of some 10 ms
    if (f_.factorize(mu * s, 0.0, s, penalty_mass_ / s) >= 0) return false;
    dx = -s * r;
    dlambda.resize(phi.size());
    f_.solve(dx, phi, penalty_mass_, dlambda, 0);
    dlambda *= penalty_mass_ / s;
    return std::isfinite(largest(dx));
  }
  /// Solves (mu M + K) dx + K_i di + J^T dlambda = -r, J dx = -phi, D dx + D_i di = -drift, i the
  /// integrals; at most 0.2 in any coordinate. False if the solution is not finite.
  bool step(double mu, VecX& dx, VecX& dlambda) {
    const Eigen::Index nv = r.size();
    VecX x = solve(mu);
    const double length = largest(x.head(nv));
    if (!std::isfinite(length)) return false;
    x *= length > longest ? longest / length : 1.0;
    dx = x.head(nv);
    dlambda = x.segment(nv, phi.size());
    change_ = VecX::Zero(drift.size());
    for (Eigen::Index i = 0; i < std::ssize(integrals_); ++i)
      change_[integrals_[i]] = x[nv + phi.size() + i];
    push_change_ = x.tail(push.size());
    return true;
  }
  /// The change of integrals and pushes in the last `step`.
  void move_others() {
    if (integrates()) f_.element_states().move(change_);
    push += push_change_;
  }
  /// At q: what moves along the directions X with K X = s M X, |s| below `least_hold`, is not
  /// looked for. There may be no equilibrium along them, or one far away: a vehicle on free wheels
  /// with toe and camber. The model is held there by P = M X, with unknown pushes, so that
  ///   r + P push = 0,  P^T dx = 0
  void hold_free(const VecX& q, VecX lambda) {
    constexpr double least_hold = 1e-2, shift = 1e-3;  // [1/s2]
    constexpr Eigen::Index most = 300;                 // general eigenvalues take a second
    let_go();
    const Eigen::Index nv = f_.velocities();
    if (nv > most) return;
    linearise(q, lambda, true);
    const Eigen::Index nc = phi.size();
    MatX T = MatX::Zero(nv + nc, nv + nc), b = MatX::Zero(nv + nc, nv);
    T.topLeftCorner(nv, nv) = K + shift * mass_;
    T.topRightCorner(nv, nc) = J.transpose();
    T.bottomLeftCorner(nc, nv) = J;
    b.topRows(nv) = mass_;
    const VecX d = equilibration(T);
    const LeastNorm factors(d.asDiagonal() * T * d.asDiagonal(), 1e-14);
    const MatX softness = (d.asDiagonal() * factors.solve(MatX(d.asDiagonal() * b))).topRows(nv);
    const GeneralEigen e = general_eigen(softness);
    for (Eigen::Index k = 0; e.found && k < e.values.size(); ++k) {
      if (e.values[k].imag() < 0.0 || std::abs(e.values[k]) * (least_hold + shift) < 1.0) continue;
      add_free(mass_ * e.vectors.col(k).real());
      if (e.values[k].imag() > 0.0) add_free(mass_ * e.vectors.col(k).imag());
    }
    push = VecX::Zero(free_.cols());
  }
  void let_go() {
    free_.resize(f_.velocities(), 0);
    push.resize(0);
    push_change_.resize(0);
  }
  bool released() const { return push.size() > 0; }
  /// What holds the model along such directions [N] or [N m].
  double holding(const VecX& pushes) const {
    return pushes.size() > 0 ? largest(VecX(free_ * pushes)) : 0.0;
  }

  VecX r, phi;
  VecX push;   ///< `hold_free`
  VecX drift;  ///< rates of states without an equation at rest
  MatX J, K;
  double weight = 0.0;  ///< the largest acting force, the reference of the imbalance [N]

 private:
  /// Columns and rows of the states that keep their values but see the coordinates.
  void find_integrals(const VecX& q, const VecX& lambda) {
    const ElementStates& z = f_.element_states();
    const Eigen::Index nv = r.size();
    std::vector<Eigen::Index> held;
    evaluate(q, lambda);
    for (Eigen::Index i = 0; i < drift.size(); ++i)
      if (z.keeps_value(i)) held.push_back(i);
    integrals_.clear();
    of_integrals_.resize(nv, 0);
    drift_rows_.resize(0, nv);
    if (held.empty()) return;
    MatX rows(drift.size(), nv);
    VecX moved = q;
    for (Eigen::Index j = 0; j < nv; ++j) {
      constexpr double reach = 1e-5;
      const auto at = [&](double h) {
        f_.retract(q, h * VecX::Unit(nv, j), moved);
        evaluate(moved, lambda);
        return drift;
      };
      const VecX over = at(reach), under = at(-reach);
      rows.col(j) = (over - under) / (2.0 * reach);
    }
    reach_of_drift_ = rows.cwiseAbs().rowwise().maxCoeff();
    for (const Eigen::Index i : held)
      if (reach_of_drift_[i] > 0.0) integrals_.push_back(i);
    const Eigen::Index ni = std::ssize(integrals_);
    of_integrals_.resize(nv + ni, ni);
    drift_rows_.resize(ni, nv);
    for (Eigen::Index i = 0; i < ni; ++i) {
      const Eigen::Index state = integrals_[i];
      const double h = 1e-3 * std::max(1e-3, std::abs(z.values()[state]));
      const auto at = [&](double by) {
        f_.element_states().move(by * VecX::Unit(drift.size(), state));
        VecX out(nv + ni);
        out.head(nv) = evaluate(q, lambda);
        for (Eigen::Index k = 0; k < ni; ++k) out[nv + k] = drift[integrals_[k]];
        f_.element_states().move(-by * VecX::Unit(drift.size(), state));
        return out;
      };
      const VecX over = at(h), under = at(-h);
      of_integrals_.col(i) = (over - under) / (2.0 * h);
      drift_rows_.row(i) = rows.row(state);
    }
    r = evaluate(q, lambda);
  }

  static constexpr double longest = 0.2;  ///< of a step, in any coordinate [m, rad]
  VecX solve(double mu) const {
    const Eigen::Index nv = r.size(), ni = std::ssize(integrals_), first = phi.size() + ni,
                       nf = push.size(), nc = first + nf;
    MatX T = MatX::Zero(nv + nc, nv + nc);
    T.topLeftCorner(nv, nv) = K + mu * mass_;
    T.block(0, nv, nv, phi.size()) = J.transpose();
    T.block(nv, 0, phi.size(), nv) = J;
    T.block(0, nv + phi.size(), nv, ni) = of_integrals_.topRows(nv);
    T.block(nv + phi.size(), nv + phi.size(), ni, ni) = of_integrals_.bottomRows(ni);
    T.block(nv + phi.size(), 0, ni, nv) = drift_rows_;
    T.topRightCorner(nv, nf) = free_;
    T.bottomLeftCorner(nf, nv) = free_.transpose();
    VecX b = VecX::Zero(nv + nc);
    b.head(nv) = -r;
    b.segment(nv, phi.size()) = -phi;
    for (Eigen::Index i = 0; i < ni; ++i) b[nv + phi.size() + i] = -drift[integrals_[i]];
    const VecX d = equilibration(T);
    const MatX Td = d.asDiagonal() * T * d.asDiagonal();
    const VecX scaled = d.cwiseProduct(b);
    const VecX x = nv + nc <= 700 ? LeastNorm(Td, 1e-14).solve(scaled) : VecX(lu_solve(Td, scaled));
    return d.cwiseProduct(x);
  }
  void add_free(const VecX& p) {
    const double size = largest(p);
    if (!(size > 0.0)) return;
    free_.conservativeResize(p.size(), free_.cols() + 1);
    free_.rightCols(1) = p / size;
  }
  double reach_of_drift(Eigen::Index i) const {
    return i < reach_of_drift_.size() ? reach_of_drift_[i] : 0.0;
  }

  RelativeFormulation& f_;
  std::vector<Eigen::Index> integrals_;  ///< their places among the states
  MatX of_integrals_, drift_rows_;       ///< d(r, drift)/d(integrals), d(drift)/dx
  VecX reach_of_drift_, change_, push_change_;
  MatX free_;  ///< P of `hold_free`, columns of the size 1
  double penalty_mass_;
  State at_;  ///< at rest
  MatX mass_;
};

}  // namespace floatframe
