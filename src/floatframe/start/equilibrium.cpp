// Static equilibrium in relative coordinates: Newton with the tangent of steps, at little more than
// the cost of a step; with a finite-difference tangent if that stalls, since the tangent of steps
// lacks the stiffness of gravity; then a downhill search.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "floatframe/core/work_progress.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/linearization.hpp"

namespace floatframe {

namespace {

/// Residual, tangent and constraints of the statics at q.
class Statics {
 public:
  explicit Statics(RelativeFormulation& f)
      : f_(f), own_weight_(std::max(1e-6, f.total_mass() * f.model().gravity.norm())) {
    at_.v = VecX::Zero(f.velocities());
    penalty_mass_ = default_penalty_mass(f.model(), Coordinates::relative);
  }

  VecX evaluate(const VecX& q, const VecX& lambda) {
    VecX out = residual_at(f_, 0.0, q, at_.v, lambda);
    drift = f_.element_states().drift();
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
    weight = acting();
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
    weight = acting();
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
    const Eigen::Index nv = r.size(), ni = std::ssize(integrals_), nc = phi.size() + ni;
    MatX T = MatX::Zero(nv + nc, nv + nc);
    T.topLeftCorner(nv, nv) = K + mu * mass_;
    T.block(0, nv, nv, phi.size()) = J.transpose();
    T.block(nv, 0, phi.size(), nv) = J;
    T.topRightCorner(nv, ni) = of_integrals_.topRows(nv);
    T.bottomRightCorner(ni, ni) = of_integrals_.bottomRows(ni);
    T.bottomLeftCorner(ni, nv) = drift_rows_;
    VecX b(nv + nc);
    b.head(nv) = -r;
    b.segment(nv, phi.size()) = -phi;
    for (Eigen::Index i = 0; i < ni; ++i) b[nv + phi.size() + i] = -drift[integrals_[i]];
    const VecX d = equilibration(T);
    const MatX Td = d.asDiagonal() * T * d.asDiagonal();
    const VecX scaled = d.cwiseProduct(b);
    VecX x = nv + nc <= 700 ? LeastNorm(Td, 1e-14).solve(scaled) : VecX(lu_solve(Td, scaled));
    x = d.cwiseProduct(x).eval();
    const double length = largest(x.head(nv));
    if (!std::isfinite(length)) return false;
    x *= length > 0.2 ? 0.2 / length : 1.0;
    dx = x.head(nv);
    dlambda = x.segment(nv, phi.size());
    change_ = VecX::Zero(drift.size());
    for (Eigen::Index i = 0; i < ni; ++i) change_[integrals_[i]] = x[nv + phi.size() + i];
    return true;
  }
  /// The change of integrals in the last `step`.
  void move_integrals() {
    if (integrates()) f_.element_states().move(change_);
  }

  VecX r, phi;
  VecX drift;  ///< rates of states without an equation at rest
  MatX J, K;
  double weight = 0.0;  ///< the largest acting force, the reference of the imbalance [N]

 private:
  /// Magnitude of the weight and the forces at the state of `f`.
  double acting() const {
    double most = own_weight_;
    for (std::size_t k = 0; k < f_.model().elements.size(); ++k)
      for (const Wrench& w : f_.effort(static_cast<int>(k)).wrench)
        most = std::max({most, w.F.norm(), w.T.norm()});
    return most;
  }

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
  double reach_of_drift(Eigen::Index i) const {
    return i < reach_of_drift_.size() ? reach_of_drift_[i] : 0.0;
  }

  RelativeFormulation& f_;
  std::vector<Eigen::Index> integrals_;  ///< their places among the states
  MatX of_integrals_, drift_rows_;       ///< d(r, drift)/d(integrals), d(drift)/dx
  VecX reach_of_drift_, change_;
  double own_weight_, penalty_mass_;
  State at_;  ///< at rest
  MatX mass_;
};

/// The best state of a search so far.
struct Best {
  VecX q, lambda, z;
  double size = std::numeric_limits<double>::infinity();
  double weight = 0.0;
  int stalled = 0;
  void offer(const VecX& at, const VecX& multipliers, const VecX& states, const Statics& there) {
    if (there.size() < size) {
      q = at;
      lambda = multipliers;
      z = states;
      size = there.size();
      weight = there.weight;
      stalled = 0;
    } else {
      ++stalled;
    }
  }
  bool done() const { return size < 1e-12 * weight || (size < 1e-9 * weight && stalled > 3); }
  bool accepted() const { return size < 1e-7 * weight; }
};

/// Above it finite differences take minutes: the tangent of steps is used even if it converges
/// slowly.
constexpr long few_unknowns = 1000;

/// Newton with the tangent of steps. Up to `few_unknowns` only while each iteration halves the
/// residual: this converges to the same equilibrium as the next search, which takes over
/// otherwise.
void approach_by_tangent(RelativeFormulation& f, Statics& statics, VecX q, VecX lambda,
                         int& iterations, Best& best) {
  double mu = 1.0, previous = std::numeric_limits<double>::infinity();  // as below
  VecX dx, dlambda, q1 = q;
  const bool large = q.size() + lambda.size() > few_unknowns;
  for (int k = 0; k < (large ? 1000 : 60); ++k, ++iterations) {
    tell_progress("equilibrium", large ? k / 1000.0 : k / 60.0);
    statics.look(q, lambda);
    const double size = statics.size();
    best.offer(q, lambda, f.element_states().values(), statics);
    if (best.done()) return;
    const bool halved = size < 0.5 * previous || size < 1e-9 * statics.weight;
    if (!halved && !large) return;
    if (k > 0) {  // the first residual lacks the constraint forces
      mu = !large || size < previous ? std::max(0.1 * mu, 1e-2) : std::min(10.0 * mu, 1e6);
      previous = size;
    }
    if (!statics.step_by_tangent(mu, dx, dlambda)) return;
    if (const double length = largest(dx); length > 0.2) {
      if (!large) return;
      dx *= 0.2 / length;
      dlambda *= 0.2 / length;
    }
    f.retract(q, dx, q1);
    q = q1;
    lambda += dlambda;
  }
}

/// Pseudo-transient Newton: fast close to the solution, and finds equilibria of any kind.
void approach(RelativeFormulation& f, Statics& statics, VecX q, VecX lambda, int& iterations,
              Best& best) {
  double mu = 1.0;  // [1/s2]: (mu M + K) x = -r
  double previous = std::numeric_limits<double>::infinity();
  VecX dx, dlambda, q1 = q;
  for (int k = 0; k < 200; ++k, ++iterations) {
    tell_progress("equilibrium", k / 200.0);
    statics.linearise(q, lambda, k == 0);
    const double size = statics.size();
    best.offer(q, lambda, f.element_states().values(), statics);
    if (best.done()) return;
    if (std::isfinite(previous))
      mu = size < previous ? std::max(mu * 0.1, 1e-2) : std::min(mu * 10.0, 1e6);
    previous = size;
    if (!statics.step(mu, dx, dlambda)) return;
    f.retract(q, dx, q1);
    statics.move_integrals();
    q = q1;
    lambda += dlambda;
  }
}

/// Downhill, for starts far from equilibrium, where the residual must grow before it vanishes: a
/// step is accepted if the forces did work along it, (g(q) + g(q + dx)).dx < 0 with g the residual
/// without multipliers; otherwise mu grows until the step follows -M^-1 g.
void descend(RelativeFormulation& f, Statics& statics, VecX q, VecX lambda, int& iterations,
             Best& best) {
  const VecX none = VecX::Zero(lambda.size());
  double mu = 1.0;
  VecX dx, dlambda, q1 = q, g;
  bool first = true, moved = true;
  double size = 0.0;
  for (int k = 0; k < 500; ++k, ++iterations) {
    tell_progress("equilibrium, downhill", k / 500.0);
    if (moved) {
      statics.linearise(q, lambda, first);
      first = false;
      size = statics.size();
      best.offer(q, lambda, f.element_states().values(), statics);
      if (best.done() || statics.integrates()) return;
      g = statics.evaluate(q, none);
    }
    if (!statics.step(mu, dx, dlambda)) return;
    f.retract(q, dx, q1);
    const VecX r1 = statics.evaluate(q1, lambda + dlambda);
    const double size1 = largest(r1) + 1e3 * statics.weight * largest(f.constraint_values());
    const VecX g1 = statics.evaluate(q1, none);
    const double start = g.dot(dx), work = 0.5 * (start + g1.dot(dx));
    // The closing of constraints and the last digits do not follow the work.
    const bool downhill = start < 0.0 && work < 0.0;
    const bool closer = size1 < 0.5 * size && size1 < 1e-3 * statics.weight;
    moved = downhill || closer;
    if (moved) {
      q = q1;
      lambda += dlambda;
      mu = std::max(mu * 0.2, 1e-9);
    } else {
      mu *= 10.0;
      if (mu > 1e12) return;
    }
  }
}

/// A vehicle on a road is in equilibrium at any position: free bodies are moved back to their start
/// in the horizontal directions on which the equilibrium does not depend.
template <class Evaluate>
void keep_neutral_positions(RelativeFormulation& f, const VecX& start, VecX& q, double residual,
                            double weight, const Evaluate& evaluate) {
  for (const int i : f.tree().free_translations()) {
    VecX moved = q;
    moved[i] = start[i];
    if (largest(evaluate(moved)) < residual + 1e-10 * weight) q = moved;
  }
}

/// The matrices of the search are dense: at this size they take 4 GB and hours.
constexpr long largest_equilibrium = 10'000;

void check_size(const RelativeFormulation& f) {
  const long nv = f.velocities(), nc = f.constraints();
  if (nv + nc > largest_equilibrium)
    throw RunError(ErrorCode::too_large,
                   fmt::format("the static equilibrium of the model '{}' is not computed: found {} "
                               "coordinates and {} constraints, expected at most {} together",
                               f.model().name, nv, nc, largest_equilibrium));
}

}  // namespace

Equilibrium find_equilibrium(RelativeFormulation& f, VecX& q) {
  check_size(f);
  const RestingStates resting(f, true);
  Equilibrium e;
  e.lambda = VecX::Zero(f.constraints());
  const VecX start_q = q;
  Statics statics(f);
  const VecX first = statics.evaluate(q, e.lambda);
  require_laws(f, 0.0);
  check_magnitudes(first, [&](int i) { return f.coordinate_owner(i); });
  Best best{q, e.lambda, f.element_states().values()};
  approach_by_tangent(f, statics, q, e.lambda, e.iterations, best);
  if (!best.done()) {
    best = {q, e.lambda, f.element_states().values()};
    statics.find_mass(q, e.lambda);
    approach(f, statics, q, e.lambda, e.iterations, best);
  }
  if (!best.accepted()) descend(f, statics, q, e.lambda, e.iterations, best);
  q = best.q;
  e.lambda = best.lambda;
  f.element_states().give(best.z);
  f.element_states().rest();
  const auto evaluate = [&](const VecX& at) { return statics.evaluate(at, e.lambda); };
  e.residual = largest(evaluate(q));
  if (!statics.integrates())
    keep_neutral_positions(f, start_q, q, e.residual, best.weight, evaluate);
  f.element_states().rest();
  const VecX r = evaluate(q);
  e.residual = largest(r);
  require_laws(f, 0.0);
  const int unsolved = f.element_states().unsolved();
  const int drifting = unsolved < 0 && !best.accepted() ? statics.drifting() : unsolved;
  if (drifting >= 0)
    throw RunError(ErrorCode::no_equilibrium,
                   fmt::format("no static equilibrium found: the states of {} do not come to rest",
                               element_name(f.model().elements[drifting])));
  if (!best.accepted()) {
    Eigen::Index worst = 0;
    if (r.size() == 0)
      throw RunError(ErrorCode::no_equilibrium, "no static equilibrium found: nothing can move");
    r.cwiseAbs().maxCoeff(&worst);
    throw RunError(
        ErrorCode::no_equilibrium,
        fmt::format("no static equilibrium found: after {} iterations {} is out of balance by "
                    "{:.3g} N (or N m)",
                    e.iterations, f.coordinate_owner(static_cast<int>(worst)), r[worst]));
  }
  return e;
}

}  // namespace floatframe
