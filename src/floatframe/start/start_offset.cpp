#include "floatframe/start/start_offset.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "floatframe/core/suggest.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

/// Remaining offsets: three rows per body for the position and, if `turning`, three for the
/// orientation.
class OffsetGoal {
 public:
  OffsetGoal(RelativeFormulation& f, const std::map<std::string, StartOffset>& offsets) : f_(f) {
    const SystemMotion& motion = f.motion();
    for (const auto& [name, offset] : offsets) {
      Target t;
      t.body = -1;
      for (std::size_t i = 0; i < f.model().bodies.size(); ++i)
        if (f.model().bodies[i].name == name) t.body = static_cast<int>(i);
      if (t.body < 0) {
        std::vector<std::string> known;
        for (const Body& b : f.model().bodies) known.push_back(b.name);
        throw InputError(ErrorCode::not_found, "simulation.start.offset." + name +
                                                   ": unknown body '" + name + "'" +
                                                   did_you_mean(name, known));
      }
      t.position = motion.body(t.body).p_WB + offset.translation;
      t.rotation = rotation_exp(offset.rotation.value_or(Vec3::Zero())) * motion.body(t.body).R_WB;
      t.must_turn = offset.rotation.has_value();
      targets_.push_back(t);
    }
  }

  int rows(bool hold) const {
    int n = 0;
    for (const Target& t : targets_) n += hold || t.must_turn ? 6 : 3;
    return n;
  }
  /// At the present positions of f.
  VecX missing(bool hold) const {
    VecX out(rows(hold));
    Eigen::Index at = 0;
    const SystemMotion& motion = f_.motion();
    for (const Target& t : targets_) {
      out.segment<3>(at) = t.position - motion.body(t.body).p_WB;
      at += 3;
      if (!hold && !t.must_turn) continue;
      const Mat3 turn = t.rotation * motion.body(t.body).R_WB.transpose();
      out.segment<3>(at) = quaternion_log(Eigen::Quaterniond(turn));
      at += 3;
    }
    return out;
  }
  /// Velocities of the bodies for each velocity coordinate.
  MatX jacobian(bool hold) {
    MatX J(rows(hold), f_.velocities());
    for (int j = 0; j < f_.velocities(); ++j) {
      f_.velocities(VecX::Unit(f_.velocities(), j));
      Eigen::Index at = 0;
      const SystemMotion& motion = f_.motion();
      for (const Target& t : targets_) {
        J.block<3, 1>(at, j) = motion.body(t.body).v_WB;
        at += 3;
        if (!hold && !t.must_turn) continue;
        J.block<3, 1>(at, j) = motion.body(t.body).w_WB;
        at += 3;
      }
    }
    return J;
  }
  const std::string& first() const { return f_.model().bodies[targets_.front().body].name; }

 private:
  struct Target {
    int body = -1;
    Vec3 position = Vec3::Zero();
    Mat3 rotation = Mat3::Identity();
    bool must_turn = false;
  };
  RelativeFormulation& f_;
  std::vector<Target> targets_;
};

/// Least change of the rigid coordinates that moves the bodies to their positions with loops
/// closed. Returns the remaining error [m, rad].
double move_bodies(RelativeFormulation& f, OffsetGoal& goal, double t, bool hold, VecX& q) {
  const VecX rest = VecX::Zero(f.velocities());
  const int nc = f.constraints(), n = goal.rows(hold);
  VecX q1 = q;
  double left = 0.0;
  const std::vector<bool> elastic = f.tree().elastic_coordinates();
  for (int pass = 0; pass < 60; ++pass) {
    kinematics_at(f, t, q, rest);
    VecX b(nc + n);
    b << -f.constraint_values(), goal.missing(hold);
    left = b.lpNorm<Eigen::Infinity>();
    if (left < 1e-12) break;
    MatX J(nc + n, f.velocities());
    J.topRows(nc) = f.constraint_jacobian();
    J.bottomRows(n) = goal.jacobian(hold);
    for (int j = 0; j < f.velocities(); ++j)
      if (elastic[j]) J.col(j).setZero();
    VecX x = LeastNorm(J, 1e-9).solve(b);
    const double size = x.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size)) break;
    if (size > 0.2) x *= 0.2 / size;
    f.retract(q, x, q1);
    q = q1;
    if (size < 1e-15) break;
  }
  kinematics_at(f, t, q, rest);
  return left;
}

}  // namespace

void apply_offsets(RelativeFormulation& f, const std::map<std::string, StartOffset>& offsets,
                   double t, VecX& q) {
  kinematics_at(f, t, q, VecX::Zero(f.velocities()));
  OffsetGoal goal(f, offsets);
  const VecX from = q;
  // With its present orientation; a joint that prevents this rotates it.
  constexpr double met = 1e-9;
  if (move_bodies(f, goal, t, true, q) < met) return;
  q = from;
  const double left = move_bodies(f, goal, t, false, q);
  if (left < met) return;
  throw RunError(
      ErrorCode::not_assembled,
      fmt::format("the offset at the start is not possible: with loops closed body '{}'{} stays "
                  "{:.3g} (m or rad) away from its place; its joints do not let it move there",
                  goal.first(), offsets.size() > 1 ? " or another one" : "", left));
}

}  // namespace floatframe
