// Static equilibrium in relative coordinates: Newton with the tangent of steps, at little more than
// the cost of a step; with a finite-difference tangent if that stalls, since the tangent of steps
// lacks the stiffness of gravity; then a downhill search.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/core/work_progress.hpp"
#include "floatframe/integrator/load_iteration.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/sampling.hpp"
#include "floatframe/start/statics_equations.hpp"

namespace floatframe {

namespace {

/// The best state of a search so far.
struct Best {
  VecX q, lambda, z;
  double size = std::numeric_limits<double>::infinity();
  double weight = 0.0;
  int stalled = 0;
  void offer(const VecX& at, const VecX& multipliers, const VecX& states,
             const StaticsEquations& there) {
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
void approach_by_tangent(RelativeFormulation& f, StaticsEquations& statics, VecX q, VecX lambda,
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
void approach(RelativeFormulation& f, StaticsEquations& statics, VecX q, VecX lambda,
              int& iterations, Best& best) {
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
void descend(RelativeFormulation& f, StaticsEquations& statics, VecX q, VecX lambda,
             int& iterations, Best& best) {
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
/// in the horizontal directions on which neither the equilibrium nor the constraints depend.
template <class Evaluate>
void keep_neutral_positions(RelativeFormulation& f, const VecX& start, VecX& q, double residual,
                            double weight, const Evaluate& evaluate) {
  constexpr double closed = 1e-10;  // [m]
  evaluate(q);
  const double gap = largest(f.constraint_values());
  for (const int i : f.tree().free_translations()) {
    VecX moved = q;
    moved[i] = start[i];
    if (largest(evaluate(moved)) < residual + 1e-10 * weight &&
        largest(f.constraint_values()) < gap + closed)
      q = moved;
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

namespace {

[[noreturn]] void throw_out_of_balance(const RelativeFormulation& f, const VecX& r,
                                       int iterations) {
  Eigen::Index worst = 0;
  if (r.size() == 0)
    throw RunError(ErrorCode::no_equilibrium, "no static equilibrium found: nothing can move");
  r.cwiseAbs().maxCoeff(&worst);
  throw RunError(
      ErrorCode::no_equilibrium,
      fmt::format("no static equilibrium found: after {} iterations {} is out of balance by "
                  "{:.3g} N (or N m)",
                  iterations, f.coordinate_owner(static_cast<int>(worst)), r[worst]));
}

/// Elements that have a branch to rest on are held to it, or free. True: there are some.
bool hold_resting_branches(RelativeFormulation& f, bool on) {
  bool some = false;
  const std::vector<Element>& elements = f.model().elements;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const std::int64_t branch = element_kind(elements[k].type).resting_branch;
    if (branch == free_branch) continue;
    f.hold_force_branch(k, on ? branch : free_branch);
    some = true;
  }
  return some;
}

Best search(RelativeFormulation& f, StaticsEquations& statics, const VecX& q, int& iterations) {
  const VecX lambda = VecX::Zero(f.constraints()), z = f.element_states().values();
  const auto begin = [&] {
    f.element_states().give(z);
    f.element_states().rest();
    return Best{q, lambda, z};
  };
  Best best = begin();
  approach_by_tangent(f, statics, q, lambda, iterations, best);
  if (!best.done()) {
    best = begin();
    statics.find_mass(q, lambda);
    approach(f, statics, q, lambda, iterations, best);
  }
  if (!best.accepted()) descend(f, statics, q, lambda, iterations, best);
  f.element_states().give(best.z);
  f.element_states().rest();
  return best;
}

/// Some tyre turns its wheel at rest, which nothing may hold.
bool turns_wheels(const Model& model) {
  return std::ranges::any_of(model.elements, [](const Element& e) {
    return e.states > 0 && element_kind(e.type).turns_wheels;
  });
}

/// From the equilibrium of free wheels to that of the whole forces, if something holds the wheels:
/// brakes, a slope. Else the wheels stay free; returns the torque that would roll them on, 0 if it
/// is round-off.
double hold_wheels(RelativeFormulation& f, StaticsEquations& statics, int& iterations, Best& best) {
  ElementStates& z = f.element_states();
  z.free_wheels(false);
  VecX lambda = best.lambda;
  statics.look(best.q, lambda);
  Best there{best.q, lambda, z.values()};
  there.offer(best.q, lambda, z.values(), statics);
  if (there.done()) return 0.0;
  const double left = there.accepted() ? 0.0 : largest(statics.r);
  if (best.q.size() + lambda.size() > few_unknowns) {
    approach_by_tangent(f, statics, best.q, lambda, iterations, there);
  } else {
    statics.find_mass(best.q, lambda);
    statics.linearise(best.q, lambda, false);
    if (statics.can_balance()) approach(f, statics, best.q, lambda, iterations, there);
  }
  if (there.accepted() && there.size < best.size + 1e-9 * there.weight) {
    best = there;
    return 0.0;
  }
  z.free_wheels(true);
  return left;
}

/// The loads of friction from reactions at q, as if everything were held there.
void begin_loads(RelativeFormulation& f, StaticsEquations& statics, const VecX& q,
                 LoadIteration& loads) {
  VecX lambda = VecX::Zero(f.constraints());
  const VecX r = statics.evaluate(q, lambda);
  if (lambda.size() > 0) {
    lambda = LeastNorm(MatX(f.constraint_jacobian().transpose())).solve(VecX(-r));
    statics.evaluate(q, lambda);
  }
  loads.begin();
  loads.iterate(f, VecX::Zero(f.velocities()), lambda);
}

/// The loads of an equilibrium and the equilibrium with these loads, in turn.
void follow_loads(RelativeFormulation& f, StaticsEquations& statics, LoadIteration& loads,
                  int& iterations, Best& best) {
  constexpr int most_rounds = 50;
  constexpr double enough = 1e-10, most_left = 1e-6;
  const VecX none = VecX::Zero(f.velocities());
  loads.begin();
  for (int round = 0; round < most_rounds && best.accepted(); ++round) {
    statics.evaluate(best.q, best.lambda);
    loads.iterate(f, none, best.lambda);
    best = search(f, statics, best.q, iterations);
    if (loads.change() < enough) return;
  }
  if (best.accepted() && loads.change() > most_left)
    throw RunError(ErrorCode::no_equilibrium,
                   "no static equilibrium found: the friction from reactions grows with itself: "
                   "the mechanism jams; make friction or the angles of pressure smaller");
}

}  // namespace

Equilibrium find_equilibrium(RelativeFormulation& f, VecX& q) {
  check_size(f);
  kinematics_at(f, 0.0, q, VecX::Zero(f.velocities()));
  f.begin_deflections();
  const RestingStates resting(f, true);
  const bool turning = turns_wheels(f.model());
  f.element_states().free_wheels(turning);
  Equilibrium e;
  e.lambda = VecX::Zero(f.constraints());
  StaticsEquations statics(f);
  const VecX first = statics.evaluate(q, e.lambda);
  require_laws(f, 0.0);
  check_magnitudes(first, [&](int i) { return f.coordinate_owner(i); });
  LoadIteration loads(f);
  if (loads.needed()) begin_loads(f, statics, q, loads);
  const VecX start_q = q, start_z = f.element_states().values();
  const bool held = hold_resting_branches(f, true);
  Best best = search(f, statics, q, e.iterations);
  if (held) {
    hold_resting_branches(f, false);
    statics.look(best.q, best.lambda);
    if (!best.accepted() || !(statics.size() < 1e-7 * statics.weight)) {
      f.element_states().give(statics.endless(start_z));
      best = search(f, statics, q, e.iterations);
    }
  }
  if (turning && best.accepted()) e.turning = hold_wheels(f, statics, e.iterations, best);
  if (loads.needed()) follow_loads(f, statics, loads, e.iterations, best);
  q = best.q;
  e.lambda = best.lambda;
  const auto evaluate = [&](const VecX& at) { return statics.evaluate(at, e.lambda); };
  e.residual = largest(evaluate(q));
  if (!statics.integrates())
    keep_neutral_positions(f, start_q, q, e.residual, best.weight, evaluate);
  f.element_states().rest();
  const VecX r = evaluate(q);
  e.residual = largest(r);
  f.start_element_states(StateStart::found);
  require_laws(f, 0.0);
  const int unsolved = f.element_states().unsolved();
  const int drifting = unsolved < 0 && !best.accepted() ? statics.drifting() : unsolved;
  if (drifting >= 0)
    throw RunError(ErrorCode::no_equilibrium,
                   fmt::format("no static equilibrium found: the states of {} do not come to rest",
                               element_name(f.model().elements[drifting])));
  if (!best.accepted()) throw_out_of_balance(f, r, e.iterations);
  return e;
}

std::vector<std::string> equilibrium_notes(RelativeFormulation& f, const Equilibrium& e) {
  const std::vector<Element>& elements = f.model().elements;
  std::vector<std::string> notes;
  if (e.turning > 0.0)
    notes.push_back(
        fmt::format("nothing holds the wheels: the equilibrium is without the torque about their "
                    "axes of aligning moments at camber, up to {:.3g} N m, which rolls them on",
                    e.turning));
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const std::int64_t branch = element_kind(elements[k].type).resting_branch;
    if (branch != free_branch && f.branch_side(k).next != branch)
      notes.push_back(element_name(elements[k]) +
                      " rests at a limit: what it measures may be away from its target");
    const auto& operands = elements[k].operands;
    if (std::any_of(operands.begin(), operands.end(),
                    [](const FormulaOperand& x) { return x.kind == FormulaOperand::Kind::sample; }))
      notes.push_back(element_name(elements[k]) +
                      " reads results of the end of a step, which are zero in the equilibrium");
    const char* left_out = element_kind(elements[k].type).left_out_at_rest;
    if (left_out && elements[k].states > 0 && *f.element_states().of(k) == 0.0)
      notes.push_back(element_name(elements[k]) + " is in the equilibrium without its " + left_out);
  }
  if (std::string held = held_samples_note(f.model()); !held.empty())
    notes.push_back(std::move(held));
  return notes;
}

}  // namespace floatframe
