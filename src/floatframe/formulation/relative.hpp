#pragma once
// Equations of motion in joint coordinates and modal amplitudes, semi-recursive (paper section 6.2,
// theory section 10), composed of
//   TreeKinematics   positions, velocities, accelerations of bodies; wrenches back to coordinates
//   BodyTerms        M and Qv of each body about the common origin, (46)-(63)
//   ForceSet         force elements
//   ConstraintSet    cut joints, rods and prescribed motions
//   ClusterTangent   the factorised tangent
//
// Residual: accelerations outwards, then per body, as wrenches about the evaluation origin and
// modal forces,
//   h_c = M (Zdot + Zdot_0; yddot) - Qv + (0; K y + D ydot) - forces + those of constraints    (1)
// and inwards to the coordinates (`TreeKinematics::project`). No dense mass matrix is formed.
#include <span>
#include <string>
#include <vector>

#include "floatframe/formulation/body_inertia.hpp"
#include "floatframe/formulation/cluster_tangent.hpp"
#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/formulation/counts.hpp"
#include "floatframe/formulation/force_set.hpp"
#include "floatframe/formulation/tree_kinematics.hpp"

namespace floatframe {

class RelativeFormulation {
 public:
  /// The only allocating call. Throws InputError if a body lacks the data `method` needs.
  RelativeFormulation(const Model& model, InertiaMethod method);
  RelativeFormulation(const RelativeFormulation&) = delete;
  RelativeFormulation& operator=(const RelativeFormulation&) = delete;

  const Model& model() const noexcept { return model_; }
  const TreeKinematics& tree() const noexcept { return tree_; }
  const ConstraintSet& constraint_set() const noexcept { return constraint_set_; }

  /// Values of `model().inputs`, constant until set again; at first their initial values.
  void set_inputs(std::span<const double> values) noexcept { force_set_.set_inputs(values); }
  std::span<const double> inputs() const noexcept { return force_set_.inputs(); }
  /// Angles of the joint springs at the last evaluation (a number for each force): they determine
  /// the turn of the next angle, so they are a part of the state that q does not contain.
  std::span<const double> spring_angles() const noexcept { return force_set_.angles(); }
  void set_spring_angles(std::span<const double> angles) noexcept { force_set_.set_angles(angles); }
  /// Held branches of the laws of forces, and the side of a force whose law has branches at the
  /// present positions and velocities (model/force_evaluation.hpp).
  std::span<const std::int64_t> force_branches() const noexcept { return force_set_.branches(); }
  void hold_force_branches(std::span<const std::int64_t> branches) noexcept {
    force_set_.hold_branches(branches);
  }
  void hold_force_branch(std::size_t force, std::int64_t branch) noexcept {
    force_set_.hold_branch(force, branch);
  }
  ForceSide force_side(std::size_t force) const noexcept;

  /// Start values of the model in these coordinates (before loops are closed). Resets the turns of
  /// the springs on cut joints.
  void start(VecX& q, VecX& v) { start(model_, 0.0, q, v); }
  /// Those of another model that has the same bodies and joints, at time t.
  void start(const Model& values, double t, VecX& q, VecX& v);

  // -- EquationsOfMotion

  /// Tuned with the Iltis benchmark; a factorisation costs about 0.7 iterations.
  static constexpr double factorization_cost = 2.0;
  int velocities() const noexcept { return tree_.velocity_count(); }
  int configurations() const noexcept { return tree_.configuration_count(); }
  int constraints() const noexcept { return constraint_set_.count(); }
  /// During a step, markers used by outputs only are not updated; after it they are those of the
  /// next `positions` and `velocities`.
  void stepping(bool on, bool accepted = true) noexcept {
    tree_.stepping(on);
    force_set_.stepping(on, accepted);
  }
  void positions(double t, const VecX& q) noexcept;
  void velocities(const VecX& v) noexcept;
  void dynamics() noexcept;
  void forces() noexcept;
  void residual(const VecX& a, const VecX& lambda, double alpha, VecX& out) noexcept;
  int factorize(double mass, double damping, double s, double alpha, int slot = 0) noexcept {
    return tangent_.factorize(terms_, {mass, damping, s, s * alpha, true}, slot);
  }
  int factorize_metric(double s, double penalty, int slot) noexcept {
    return tangent_.factorize(terms_, {1.0, 0.0, s, penalty, false}, slot);
  }
  double log_pivots(int slot) const noexcept { return tangent_.log_pivots(slot); }
  int negative_pivots(int slot) const noexcept { return tangent_.negative_pivots(slot); }
  void solve(VecX& b, int slot = 0) noexcept { tangent_.solve(b, slot); }
  void solve(VecX& b, const VecX& phi, double penalty, VecX& mu, int slot) noexcept {
    weights_ = -penalty * phi;
    tangent_.solve(b, weights_, mu, slot);
    mu += phi;
  }
  void balance(VecX&, VecX&) const noexcept {}
  const VecX& constraint_values() const noexcept { return constraint_set_.values(); }
  const VecX& own_frequencies_squared() const noexcept { return omega2_; }
  void constraint_rates(VecX& out) noexcept;
  void constraint_accelerations(const VecX& a, VecX& out) noexcept;
  void constraint_increments(const VecX& delta, VecX& out) noexcept;
  void constraint_forces(const VecX& w, VecX& out) noexcept;
  void retract(const VecX& q0, const VecX& x, VecX& q) const noexcept { tree_.retract(q0, x, q); }
  void settle(const VecX&, VecX&) const noexcept {}
  void advance(VecX& x, const VecX& delta) const noexcept { tree_.advance(x, delta); }

  // -- for outputs, energies and reports; positions of markers are from `origin`

  const MarkerState& marker(int index) const noexcept { return tree_.marker(index).s; }
  const Vec3& origin() const noexcept { return tree_.origin(); }
  const LocalMarker& local_marker(int index) const noexcept { return tree_.marker(index); }
  const ForceState& force(int index) const noexcept { return force_set_.state(index); }
  /// The accelerations that `marker_acceleration` uses (`residual` and `constraint_accelerations`
  /// set them too).
  void set_accelerations(const VecX& a) noexcept { tree_.accelerations(a); }
  Vec3 marker_acceleration(int index) const noexcept {
    return tree_.acceleration_in_world(index).linear;
  }
  Vec3 body_position(int i) const noexcept { return tree_.origin() + tree_.body(i).p_OB; }
  const Mat3& body_rotation(int i) const noexcept { return tree_.body(i).R_WB; }
  Vec3 body_angular_velocity(int i) const noexcept { return tree_.body(i).w_WB; }
  Vec3 body_velocity(int i) const noexcept;
  /// Of the body frame, world axes [m/s2, rad/s2].
  PointMotion body_acceleration(int i) const noexcept;
  double amplitude(const VecX& q, int i, int mode) const noexcept {
    return q[tree_.body(i).iyq + mode];
  }
  double amplitude_rate(const VecX& v, int i, int mode) const noexcept {
    return v[tree_.body(i).iy + mode];
  }
  /// At the present velocities, and of the accelerations that were set.
  double amplitude_rate(int i, int mode) const noexcept { return tree_.body(i).yd[mode]; }
  double amplitude_acceleration(int i, int mode) const noexcept { return tree_.body(i).ydd[mode]; }
  /// Of one body, after `dynamics` [J].
  double body_kinetic_energy(int i) const noexcept;
  double body_gravity_energy(int i) const noexcept;
  double body_elastic_energy(int i) const noexcept;
  /// Power dissipated by modal damping at these velocities [W].
  double modal_damping_power(const VecX& v) const noexcept;
  /// Power of prescribed motions with these multipliers, after `velocities` [W].
  double motion_power(const VecX& lambda) const noexcept {
    return constraint_set_.motion_power(lambda);
  }
  double kinetic_energy(const VecX& v) noexcept;
  double gravity_energy(const VecX& q) const noexcept;
  double elastic_energy(const VecX& q) const noexcept;
  /// Wrench of the parent on the child at a tree joint, about the joint's point on the child (after
  /// `residual`). Without the prescribed motion, whose wrench is given by its multiplier.
  void tree_joint_wrench(int joint, Vec3& force, Vec3& torque) const noexcept;
  double total_mass() const noexcept;
  /// "mode 2 of body 'arm'" or "joint 'hinge'", the owner of coordinate i.
  std::string coordinate_owner(int i) const { return tree_.coordinate_owner(i); }
  /// Phi_q, sparse and dense, load time only.
  SparseRowMatrix constraint_rows() { return tangent_.constraint_rows(); }
  MatX constraint_jacobian() { return MatX(constraint_rows()); }
  /// Of the mass matrix, after `dynamics`; load time.
  VecX mass_diagonal() const;
  CoordinateCounts counts() const;

 private:
  const Model& model_;
  TreeKinematics tree_;
  ConstraintSet constraint_set_;
  ForceSet force_set_;
  ClusterTangent tangent_;
  std::vector<BodyTerms> terms_;
  std::vector<int> spring_body_;  ///< of a spring on a tree joint: its child body, or -1
  BodyVectors wrenches_;          ///< of the last residual or constraint forces
  BodyVectors increments_;        ///< motions of the bodies under an increment
  double time_ = 0.0;
  VecX omega2_;
  VecX weights_;  ///< of `solve`
};

}  // namespace floatframe
