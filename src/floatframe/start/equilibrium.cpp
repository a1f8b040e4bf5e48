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
#include "floatframe/start/initial_state.hpp"
#include "floatframe/start/statics_equations.hpp"

namespace floatframe {

namespace {

/// The best state of a search so far.
struct Best {
  VecX q, lambda, z, push;
  double size = std::numeric_limits<double>::infinity();
  double weight = 0.0;
  double rolling = 0.0;  ///< what would roll the model on, if there was such a balance [N]
  int stalled = 0;
  void offer(const VecX& at, const VecX& multipliers, const VecX& states,
             const StaticsEquations& there) {
    if (there.size() < size) {
      q = at;
      lambda = multipliers;
      z = states;
      push = there.push;
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

/// Pseudo-transient Newton: fast close to the solution, and finds equilibria of any kind. It ends
/// where an imbalance below `stalled` times the largest load is not halved.
void approach(RelativeFormulation& f, StaticsEquations& statics, VecX q, VecX lambda,
              int& iterations, Best& best, double stalled = 0.0) {
  double mu = 1.0;  // [1/s2]: (mu M + K) x = -r
  double previous = std::numeric_limits<double>::infinity();
  VecX dx, dlambda, q1 = q;
  for (int k = 0; k < 200; ++k, ++iterations) {
    tell_progress("equilibrium", k / 200.0);
    statics.linearise(q, lambda, k == 0);
    const double size = statics.size();
    best.offer(q, lambda, f.element_states().values(), statics);
    if (best.done() || (size > 0.5 * previous && size < stalled * statics.weight)) return;
    if (std::isfinite(previous))
      mu = size < previous ? std::max(mu * 0.1, 1e-2) : std::min(mu * 10.0, 1e6);
    previous = size;
    if (!statics.step(mu, dx, dlambda)) return;
    f.retract(q, dx, q1);
    statics.move_others();
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

[[noreturn]] void throw_out_of_balance(const RelativeFormulation& f, const VecX& r, double rolling,
                                       int iterations) {
  Eigen::Index worst = 0;
  if (rolling > 0.0)
    throw RunError(
        ErrorCode::no_equilibrium,
        fmt::format("no static equilibrium found: nothing holds the wheels, {:.3g} N (or "
                    "N m) roll the model on",
                    rolling));
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

/// Some tyre may roll its vehicle on, which nothing may hold.
bool rolls(const Model& model) {
  return std::ranges::any_of(
      model.elements, [](const Element& e) { return e.states > 0 && element_kind(e.type).rolls; });
}

/// Parts of the largest load: what may roll a vehicle on in its equilibrium, and an imbalance that
/// is small enough to look for the directions along which nothing holds it.
constexpr double most_rolling = 1e-3, most_stalled = 0.2;

/// From the best place of a search, held along such directions. Without a balance that nearly needs
/// no holding `rolling` tells what it needs.
Best approach_held(RelativeFormulation& f, StaticsEquations& statics, const Best& from,
                   int& iterations) {
  f.element_states().give(from.z);
  f.element_states().rest();
  statics.hold_free(from.q, from.lambda);
  Best best{from.q, from.lambda, from.z, statics.push};
  if (statics.released()) approach(f, statics, from.q, from.lambda, iterations, best);
  const double rolling = best.accepted() ? statics.holding(best.push) : 0.0;
  if (best.accepted() && rolling < most_rolling * best.weight) return best;
  statics.let_go();
  Best none;
  none.rolling = rolling;
  return none;
}

/// Drawn far from its road a vehicle may be found as it stands on two wheels: if an equilibrium is
/// unstable, the one that lies downhill from the start, if there is one.
template <class Begin>
Best below(RelativeFormulation& f, StaticsEquations& statics, const Best& found, const Begin& begin,
           int& iterations) {
  f.element_states().give(found.z);
  f.element_states().rest();
  if (unstable_equilibrium(f, found.q, found.lambda).empty()) return found;
  Best lower = begin();
  const Best from = lower;
  descend(f, statics, from.q, from.lambda, iterations, lower);
  return lower.accepted() ? lower : found;
}

Best search(RelativeFormulation& f, StaticsEquations& statics, const VecX& q, int& iterations) {
  const VecX lambda = VecX::Zero(f.constraints()), z = f.element_states().values();
  const auto begin = [&] {
    f.element_states().give(z);
    f.element_states().rest();
    statics.push.setZero();
    return Best{q, lambda, z, statics.push};
  };
  statics.let_go();
  Best best = begin();
  approach_by_tangent(f, statics, q, lambda, iterations, best);
  if (!best.done()) {
    best = begin();
    statics.find_mass(q, lambda);
    const bool rolling = rolls(f.model());
    approach(f, statics, q, lambda, iterations, best, rolling ? most_stalled : 0.0);
    if (rolling && !best.done()) {
      best = approach_held(f, statics, best, iterations);
      if (!best.accepted()) {
        const double rolled = best.rolling;
        best = begin();
        best.rolling = rolled;
        approach(f, statics, q, lambda, iterations, best);
      }
    }
    if (rolling && best.accepted() && best.push.isZero(0.0))
      best = below(f, statics, best, begin, iterations);
  }
  if (!best.accepted()) descend(f, statics, q, lambda, iterations, best);
  f.element_states().give(best.z);
  f.element_states().rest();
  statics.push = best.push;
  return best;
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
  if (loads.needed()) follow_loads(f, statics, loads, e.iterations, best);
  q = best.q;
  e.lambda = best.lambda;
  e.rolling = statics.holding(best.push);
  if (e.rolling < 1e-7 * best.weight) e.rolling = 0.0;
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
  if (!best.accepted()) throw_out_of_balance(f, r, best.rolling, e.iterations);
  return e;
}

std::vector<std::string> equilibrium_notes(RelativeFormulation& f, const Equilibrium& e) {
  const std::vector<Element>& elements = f.model().elements;
  std::vector<std::string> notes;
  if (e.rolling > 0.0)
    notes.push_back(
        fmt::format("nothing holds the wheels: the equilibrium leaves out {:.3g} N (or N m) that "
                    "roll the model on, of bent tyres with toe or camber",
                    e.rolling));
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
