// Closing loops: the least change of the start values that satisfies the constraints. The unknowns
// are the coordinates of the tree and, for each start value given for a joint outside of the tree,
// the change of that value: a value counts the same wherever the loop happens to be cut.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "floatframe/math/dense.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/linearization.hpp"
#include "floatframe/simulation/open_loops.hpp"
#include "floatframe/simulation/redundancy.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {

namespace {

using Given = TreeKinematics::Given;

/// Up to here dense linear algebra is as fast, which takes the rows in the best order.
constexpr int few_rows = 200;

/// Least weighted change x with J x = b.
VecX least_change(const SparseRowMatrix& J, const VecX& w, const VecX& b) {
  if (J.cols() == 0) return VecX();
  const VecX roots = w.cwiseSqrt();
  const SparseRowMatrix Jw = J * roots.asDiagonal();
  if (J.rows() > few_rows) return roots.cwiseProduct(IndependentRows(Jw, 1e-11).least_norm(b));
  return roots.cwiseProduct(LeastNorm(MatX(Jw), 1e-11).solve(b));
}

/// A start value given for a joint outside of the tree.
struct CutValue {
  int joint, component;
  double value;
  bool kept;
};

std::vector<CutValue> cut_values(const RelativeFormulation& f, bool rates) {
  std::vector<CutValue> values;
  std::vector<bool> in_tree(f.model().joints.size() + 1);
  for (std::size_t i = 0; i < f.model().bodies.size(); ++i)
    in_tree[f.tree().body(static_cast<int>(i)).joint + 1] = true;  // -1: of no joint
  for (std::size_t j = 0; j < f.model().joints.size(); ++j) {
    const Joint& joint = f.model().joints[j];
    if (in_tree[j + 1]) continue;
    const std::vector<double> given =
        rates ? joint.velocity : joint_coordinates_in_range(joint, joint.position);
    for (std::size_t k = 0; k < given.size(); ++k)
      values.push_back({static_cast<int>(j), static_cast<int>(k), given[k], joint.keep});
  }
  return values;
}

/// The equations of one level, positions or rates, in the unknowns [coordinates; changes of the
/// values of cut joints].
class Loops {
 public:
  Loops(RelativeFormulation& f, bool rates, bool keeps, double t, bool as_given)
      : f_(f),
        rates_(rates),
        keeps_(keeps),
        t_(t),
        given_(f.tree().given_coordinates(rates)),
        cut_(as_given ? cut_values(f, rates) : std::vector<CutValue>()),
        changes_(VecX::Zero(static_cast<Eigen::Index>(cut_.size()))) {}

  Eigen::Index rows() const { return f_.constraints() + changes_.size(); }
  void restart() { changes_.setZero(); }
  void change(const VecX& x) { changes_ += x.tail(changes_.size()); }

  /// Which unknowns may move at a stage: 0 rigid coordinates without a start value, 1 modal
  /// amplitudes too, 2 all but what is kept.
  VecX mobility(int stage) const {
    const Eigen::Index nv = f_.velocities();
    VecX w = VecX::Ones(nv + changes_.size());
    const std::vector<bool> elastic = f_.tree().elastic_coordinates();
    for (int i = 0; i < nv; ++i) {
      const Given given = given_[i];
      if (elastic[i]) w[i] = stage >= 1 ? 1e-4 : 0.0;
      if (given != Given::no) w[i] = stage >= 2 ? 1e-4 : 0.0;
      if (given == Given::kept && keeps_) w[i] = 0.0;
    }
    for (std::size_t k = 0; k < cut_.size(); ++k)
      w[nv + static_cast<Eigen::Index>(k)] = stage >= 2 && !(cut_[k].kept && keeps_) ? 1e-4 : 0.0;
    return w;
  }

  /// Residual at the present positions and velocities of the formulation.
  VecX residual() {
    VecX r(rows());
    if (rates_) {
      rate_.resize(f_.constraints());
      f_.constraint_rates(rate_);
      r.head(f_.constraints()) = rate_;
    } else {
      r.head(f_.constraints()) = f_.constraint_values();
    }
    r.tail(changes_.size()) = measured() - changes_;
    return r;
  }

  SparseRowMatrix jacobian(const VecX& q, const VecX& v) {
    const Eigen::Index nv = f_.velocities(), nc = f_.constraints(), n = changes_.size();
    if (n == 0) return f_.constraint_rows();
    MatX J = MatX::Zero(nc + n, nv + n);
    J.topLeftCorner(nc, nv) = f_.constraint_jacobian();
    J.bottomRightCorner(n, n).diagonal().setConstant(-1.0);
    VecX q1 = q;
    J.bottomLeftCorner(n, nv) = central_differences(nv, rates_ ? 1.0 : 1e-6, [&](const VecX& x) {
      if (!rates_) f_.retract(q, x, q1);
      f_.positions(t_, q1);
      f_.velocities(rates_ ? VecX(v + x) : v);
      return measured();
    });
    f_.positions(t_, q);
    f_.velocities(v);
    return J.sparseView();
  }

 private:
  /// Coordinates of the cut joints less their start values.
  VecX measured() const {
    VecX m(static_cast<Eigen::Index>(cut_.size()));
    for (std::size_t k = 0; k < cut_.size(); ++k) {
      const CutValue& c = cut_[k];
      const Joint& joint = f_.model().joints[c.joint];
      const MarkerState& F = f_.marker(joint.frame_F);
      const MarkerState& M = f_.marker(joint.frame_M);
      const double x = rates_ ? joint_velocity(joint, F, M, c.component)
                              : joint_position(joint, F, M, c.component, c.value);
      m[static_cast<Eigen::Index>(k)] = x - c.value;
    }
    return m;
  }

  RelativeFormulation& f_;
  bool rates_, keeps_;
  double t_;
  std::vector<Given> given_;
  std::vector<CutValue> cut_;
  VecX changes_, rate_;
};

/// Closes the positions; returns the largest violation left.
double close_positions(RelativeFormulation& f, VecX& q, const VecX& v, bool keeps, double t,
                       bool as_given) {
  Loops loops(f, false, keeps, t, as_given);
  if (loops.rows() == 0) return 0.0;
  const VecX q_start = q;
  VecX q1 = q;
  double violation = 0.0;
  for (int stage = 0; stage < 3; ++stage) {
    const VecX w = loops.mobility(stage);
    q = q_start;
    loops.restart();
    double before = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < 100; ++pass) {
      f.positions(t, q);
      f.velocities(v);
      const VecX r = loops.residual();
      violation = largest(r);
      // Where places are far from the origin rounding leaves more than the first limit.
      if (violation < 1e-14 || (violation < 1e-12 && violation > 0.5 * before)) break;
      before = violation;
      VecX x = least_change(loops.jacobian(q, v), w, -r);
      const double size = largest(x.head(f.velocities()));
      if (!std::isfinite(size)) break;
      if (size > 0.2) x *= 0.2 / size;
      f.retract(q, x.head(f.velocities()), q1);
      q = q1;
      loops.change(x);
      if (size < 1e-15) break;
    }
    if (violation < 1e-11) break;
  }
  f.positions(t, q);
  f.velocities(v);
  return largest(loops.residual());
}

/// Closes the velocities; returns the largest violation left.
double close_rates(RelativeFormulation& f, const VecX& q, VecX& v, bool keeps, double t) {
  Loops loops(f, true, keeps, t, true);
  if (loops.rows() == 0) return 0.0;
  const VecX v_start = v;
  double violation = 0.0;
  const auto residual = [&] {
    f.positions(t, q);
    f.velocities(v);
    const VecX r = loops.residual();
    violation = largest(r);
    return r;
  };
  for (int stage = 0; stage < 3; ++stage) {
    const VecX w = loops.mobility(stage);
    v = v_start;
    loops.restart();
    for (int pass = 0; pass < 5; ++pass) {
      const VecX r = residual();
      if (violation < 1e-13) break;
      const VecX x = least_change(loops.jacobian(q, v), w, -r);
      v += x.head(f.velocities());
      loops.change(x);
    }
    residual();
    if (violation < 1e-10 * (1.0 + largest(v))) break;
  }
  return violation;
}

/// "joint 'a' keeps its start values (keep: true)" of all joints that keep values of this level.
std::string keepers(const Model& model, bool rates) {
  std::vector<std::string> names;
  for (const Joint& j : model.joints)
    if (j.keep && !(rates ? j.velocity : j.position).empty()) names.push_back(j.name);
  if (names.empty()) return {};
  return named_text("joint", "joints", names) +
         (names.size() == 1 ? " keeps its start values" : " keep their start values") +
         " (keep: true)";
}

}  // namespace

void close_loops(RelativeFormulation& f, VecX& q, VecX& v, bool correct_positions, double t,
                 bool as_given) {
  const std::string kept_positions = keepers(f.model(), false),
                    kept_rates = keepers(f.model(), true);
  const VecX q_start = q, v_start = v;
  if (correct_positions) {
    constexpr double closed = 1e-10;
    double violation = close_positions(f, q, v, as_given, t, as_given);
    if (!(violation < closed) && as_given && !kept_positions.empty()) {
      q = q_start;
      if (close_positions(f, q, v, false, t, as_given) < closed)
        throw RunError(fmt::format(
            "the model cannot be assembled while {}: the loops stay open by {:.3g} m or rad at the "
            "start; they close if these values may move",
            kept_positions, violation));
    }
    if (!(violation < closed)) {
      throw RunError(fmt::format("the model cannot be assembled: {} at the start",
                                 f.constraints() > 0
                                     ? open_loops_text(f, f.constraint_values(), false)
                                     : fmt::format("a joint stays open by {:.3g} m", violation)));
    }
  }
  const auto closed = [&](double violation) { return violation < 1e-8 * (1.0 + largest(v)); };
  double violation = close_rates(f, q, v, true, t);
  if (closed(violation)) return;
  if (!kept_rates.empty()) {
    const double open = violation;
    v = v_start;
    violation = close_rates(f, q, v, false, t);
    if (closed(violation))
      throw RunError(fmt::format(
          "the start velocities do not fit while {}: the loops open at {:.3g} m/s or rad/s; they "
          "fit if these values may change",
          kept_rates, open));
  }
  VecX rate(f.constraints());
  f.constraint_rates(rate);
  throw RunError(fmt::format("the start velocities do not fit: {}",
                             f.constraints() > 0
                                 ? open_loops_text(f, rate, true)
                                 : fmt::format("a joint opens at {:.3g} m/s", violation)));
}

}  // namespace floatframe
