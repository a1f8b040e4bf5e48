// Closing loops: from the drawn configuration along a path to the start values; small gaps by the
// least change of the coordinates.
#include "floatframe/loops/close_loops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "floatframe/core/plural.hpp"
#include "floatframe/loops/least_change.hpp"
#include "floatframe/loops/loop_path.hpp"
#include "floatframe/loops/redundancy.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/lift_checks.hpp"

namespace floatframe {

namespace {

using Given = TreeKinematics::Given;

/// Coordinates that may change at a stage: 0 rigid coordinates without a start value, 1 modal
/// amplitudes too, 2 all.
VecX mobility(const RelativeFormulation& f, int stage) {
  VecX w = VecX::Ones(f.velocities());
  const std::vector<bool> elastic = f.tree().elastic_coordinates();
  const std::vector<Given> given = f.tree().given_coordinates(false);
  for (int i = 0; i < f.velocities(); ++i) {
    double& weight = w[i];
    if (elastic[i]) weight = stage >= 1 ? 1e-4 : 0.0;
    if (given[i] != Given::no) weight = stage >= 2 ? 1e-4 : 0.0;
  }
  return w;
}

/// Closes positions with small gaps; returns the largest remaining violation.
double close_from(RelativeFormulation& f, VecX& q, const VecX& v, double t) {
  if (f.constraints() == 0) return 0.0;
  const VecX q_start = q;
  VecX q1 = q;
  double violation = 0.0;
  for (int stage = 0; stage < 3; ++stage) {
    const VecX w = mobility(f, stage);
    q = q_start;
    double before = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < 100; ++pass) {
      kinematics_at(f, t, q, v);
      const VecX r = f.constraint_values();
      violation = largest(r);
      // Far from the origin rounding exceeds the first limit.
      if (violation < 1e-14 || (violation < 1e-12 && violation > 0.5 * before)) break;
      before = violation;
      VecX x = least_change(f.constraint_rows(), w, -r);
      const double size = largest(x);
      if (!std::isfinite(size)) break;
      if (size > 0.2) x *= 0.2 / size;
      f.retract(q, x, q1);
      q = q1;
      if (size < 1e-15) break;
    }
    if (violation < 1e-11) break;
  }
  kinematics_at(f, t, q, v);
  return largest(f.constraint_values());
}

/// Why a cam has no lift at these positions; empty: all have one.
std::string lost_lift(RelativeFormulation& f, double t, const VecX& q) {
  if (!has_lift_formulas(f.model())) return {};
  kinematics_at(f, t, q, VecX::Zero(f.velocities()));
  for (std::size_t k = 0; k < f.model().elements.size(); ++k)
    if (std::string why = lift_complaint(f.ports(k), false); !why.empty()) return why;
  return {};
}

void require_lifts(RelativeFormulation& f, double t, const VecX& q, const char* where) {
  if (const std::string why = lost_lift(f, t, q); !why.empty())
    throw RunError(ErrorCode::not_assembled,
                   fmt::format("the model cannot be assembled: {}, {}", why, where));
}

/// Closes the positions with the start values of the model. Returns false, with q at the end of the
/// path, if they cannot be reached.
bool close_to_values(RelativeFormulation& f, LoopPath& path, VecX& q, bool keeps, double t) {
  if (path.starts_as_drawn() && path.closes(q)) return true;
  const VecX drawn = path.drawn(), given = q;
  const bool all_given = path.all_given(), from_drawn = lost_lift(f, t, drawn).empty();
  const std::vector<bool> elastic = f.tree().elastic_coordinates();
  const bool has_modes = std::find(elastic.begin(), elastic.end(), true) != elastic.end();
  if (all_given && path.closed(q) && path.upright(q)) return true;
  if (all_given && path.correct(q, LoopMoves::values, keeps) && path.near(given, q) &&
      path.upright(q))
    return true;
  for (const LoopMoves moves : {LoopMoves::joints, LoopMoves::modes, LoopMoves::values}) {
    if (moves == LoopMoves::modes && !has_modes) continue;
    if (moves == LoopMoves::values && !path.contradictory(from_drawn ? drawn : given)) break;
    if (from_drawn) {
      q = drawn;
      if (path.follow(q, moves, keeps)) return true;
      // A model that cannot be closed as drawn may close with the given values.
      if (path.drawn_closes()) continue;
    }
    q = given;
    if (path.correct(q, moves, keeps) && path.upright(q)) return true;
  }
  return false;
}

/// Closes the velocities; returns the largest remaining violation.
double close_rates(RelativeFormulation& f, const VecX& q, VecX& v, bool keeps, double t) {
  f.positions(t, q);
  LoopMembers members = loop_members(f);
  for (const ConstraintPart& p : f.constraint_set().parts()) {
    if (p.is_motion()) members.add(f.model(), p.owner.joint);
  }
  const std::vector<LoopValue> values = loop_values(f, members, true);
  VecX rates(f.constraints());
  const std::vector<char> counts(rates.size(), 1);
  const auto off = [&] {
    VecX r(std::ssize(values));
    Eigen::Index row = 0;
    for (const LoopValue& value : values) r[row++] = measured_rate(f, value) - value.given[0];
    return r;
  };
  const VecX v_start = v;
  double violation = 0.0;
  for (const LoopMoves moves : {LoopMoves::joints, LoopMoves::modes, LoopMoves::values}) {
    v = v_start;
    f.velocities(v);
    std::optional<LoopEquations> equations;  // rarely needed
    for (int pass = 0; pass < 3; ++pass) {
      f.constraint_rates(rates);
      violation = std::max(largest(rates), moves == LoopMoves::values ? 0.0 : largest(off()));
      if (violation < 1e-13 && (pass > 0 || moves != LoopMoves::values)) break;
      if (!equations) equations.emplace(f, members, values, moves, keeps);
      equations->evaluate(rates, counts, off(), v);
      const VecX d = equations->moved(v);
      v += equations->step(VecX::Zero(f.velocities()), &d).x;
      f.velocities(v);
    }
    f.constraint_rates(rates);
    violation = std::max(largest(rates), moves == LoopMoves::values ? 0.0 : largest(off()));
    if (violation < 1e-10 * (1.0 + largest(v))) break;
  }
  return largest(rates);
}

/// The part whose row has the largest magnitude.
std::size_t worst_part(const ConstraintSet& constraints, const VecX& r) {
  Eigen::Index row = 0;
  while (row < r.size() && std::isfinite(r[row])) ++row;  // that without a value
  if (row == r.size()) r.cwiseAbs().maxCoeff(&row);
  return constraints.part_of_row(static_cast<int>(row));
}

const char* unit_of(const Model& model, const ConstraintPart& part, bool rates) {
  if (part.motion && model.elements[part.owner.element].rotational) return rates ? "rad/s" : "rad";
  return rates ? "m/s" : "m";
}

/// Rows of coordinates are scaled.
double in_unit(const ConstraintPart& part, double x) {
  return std::abs(part.motion ? x / part.scale : x);
}

/// Contradicting constraints: with their Jacobian J the part e = (I - J J+) r of the residual r
/// cannot be changed by any coordinate. Its rows belong to constraints that contradict each other.
/// If all but row i are satisfied, row i has the residual e_i / (I - J J+)_ii.
std::string motions_text(RelativeFormulation& f, const VecX& residual, bool rates) {
  const ConstraintSet& constraints = f.constraint_set();
  const MatX J = f.constraint_jacobian();
  const LeastNorm solver(J, 1e-11);
  const auto out_of_reach = [&](const VecX& r) { return VecX(r - J * solver.solve(r)); };
  const VecX e = out_of_reach(residual);
  const double counts = 1e-6 * e.lpNorm<Eigen::Infinity>();
  std::vector<std::string> names;
  std::size_t worst = constraints.parts().size();
  double most = 0.0;
  for (std::size_t k = 0; k < constraints.parts().size(); ++k) {
    const double x = std::abs(e[constraints.offset(k)]);
    if (!constraints.parts()[k].is_motion() || !(x > counts)) continue;
    names.push_back(f.model().joints[constraints.parts()[k].owner.joint].name);
    if (x > (1.0 + 1e-6) * most) {  // of equal ones the first
      most = x;
      worst = k;
    }
  }
  // Positions prescribed by a motion may be unreachable for its loop: that loop stays open.
  if (names.empty() || (names.size() == 1 && !rates)) return {};
  const Eigen::Index row = constraints.offset(worst);
  const double own = out_of_reach(VecX::Unit(residual.size(), row))[row];
  const ConstraintPart& part = constraints.parts()[worst];
  return fmt::format("the prescribed {} of {} {}: {} is off by {:.3g} {} if {} met",
                     names.size() == 1 ? "motion" : "motions", named_text("joint", "joints", names),
                     names.size() == 1 ? "contradicts the constraints" : "contradict each other",
                     owner_name(f.model(), part.owner), in_unit(part, e[row] / own),
                     unit_of(f.model(), part, rates),
                     names.size() == 1 ? "the constraints are" : "the rest is");
}

/// At the present positions, where constraints have gaps of `residual` [m; rates: m/s] that no
/// change of the coordinates reduces: "joint 'd' has a gap of 0.3 m", or that prescribed motions
/// contradict each other or, for rates, the constraints.
std::string open_loops_text(RelativeFormulation& f, const VecX& residual, bool rates) {
  if (std::string text = residual.allFinite() ? motions_text(f, residual, rates) : "";
      !text.empty())
    return text;
  const ConstraintSet& constraints = f.constraint_set();
  const ConstraintPart& part = constraints.parts()[worst_part(constraints, residual)];
  if (!residual.allFinite()) return owner_name(f.model(), part.owner) + " has no value";
  return fmt::format(
      "{} {} {:.3g} {}", owner_name(f.model(), part.owner), rates ? "opens at" : "has a gap of",
      in_unit(part, residual.lpNorm<Eigen::Infinity>()), unit_of(f.model(), part, rates));
}

/// "joint 'a' keeps its start values (keep: true)" for all joints that keep values of this level.
std::string keepers(const Model& model, bool rates) {
  std::vector<std::string> names;
  for (const Joint& j : model.joints)
    if (j.keep && !(rates ? j.velocity : j.position).empty()) names.push_back(j.name);
  if (names.empty()) return {};
  return named_text("joint", "joints", names) +
         (names.size() == 1 ? " keeps its start values" : " keep their start values") +
         " (keep: true)";
}

/// " (0 degrees of freedom: ...)" for locked loops.
std::string locked_text(const Model& model) {
  std::string text;
  for (const LockedLoops& locked : model.hints.locked) text += " (" + locked.sentence + ")";
  return text;
}

}  // namespace

void close_loops(RelativeFormulation& f, VecX& q, VecX& v, bool correct_positions, double t,
                 bool as_given) {
  const std::string kept_positions = keepers(f.model(), false),
                    kept_rates = keepers(f.model(), true);
  const VecX q_start = q, v_start = v;
  if (correct_positions) {
    constexpr double closed = 1e-10;
    LoopPath path(f, t);
    if (as_given && path.any_loops() && !close_to_values(f, path, q, true, t)) {
      require_lifts(f, t, q_start, "with the start values");
      const std::string way =
          fmt::format("from the drawn configuration the start values are reached to {:.3g} %",
                      100.0 * path.reached());
      const VecX open = path.gap(q);
      const std::string gap =
          open.size() > 0 ? open_loops_text(f, open, false) : "start values contradict each other";
      if (!kept_positions.empty() && close_to_values(f, path, q = q_start, false, t))
        throw RunError(ErrorCode::not_assembled,
                       fmt::format("the model cannot be assembled while {}: {} at the start ({}); "
                                   "the loops close if these values may move",
                                   kept_positions, gap, way));
      require_lifts(f, t, path.drawn(), "as drawn");
      throw RunError(ErrorCode::not_assembled,
                     fmt::format("the model cannot be assembled: {} at the start ({}){}", gap, way,
                                 locked_text(f.model())));
    }
    const double violation = close_from(f, q, v, t);
    require_lifts(f, t, q, "at the start");
    if (!(violation < closed))
      throw RunError(ErrorCode::not_assembled,
                     fmt::format("the model cannot be assembled: {} at the start",
                                 open_loops_text(f, f.constraint_values(), false)));
  }
  const auto closed = [&](double violation) { return violation < 1e-8 * (1.0 + largest(v)); };
  double violation = close_rates(f, q, v, true, t);
  if (closed(violation)) return;
  if (!kept_rates.empty()) {
    const double open = violation;
    v = v_start;
    violation = close_rates(f, q, v, false, t);
    if (closed(violation))
      throw RunError(ErrorCode::not_assembled,
                     fmt::format("the start velocities do not fit while {}: the loops open at "
                                 "{:.3g} m/s or rad/s; they fit if these values may change",
                                 kept_rates, open));
  }
  VecX rate(f.constraints());
  f.constraint_rates(rate);
  throw RunError(ErrorCode::not_assembled,
                 fmt::format("the start velocities do not fit: {}{}",
                             open_loops_text(f, rate, true), locked_text(f.model())));
}

}  // namespace floatframe
