#pragma once
// Equations of motion in joint coordinates and modal amplitudes, semi-recursive (paper section 6.2,
// theory section 10), composed of
//   TreeKinematics   positions, velocities, accelerations of bodies; wrenches back to coordinates
//   BodyTerms        M and Qv of each body about the common origin, (46)-(63)
//   ElementSet         force elements
//   ConstraintSet    cut joints, rods and prescribed motions
//   ClusterTangent   the factorised tangent
//
// Residual: accelerations outwards, then per body, as wrenches about the evaluation origin and
// modal forces,
//   h_c = M (Zdot + Zdot_0; yddot) - Qv + (0; K y + D ydot) - forces + those of constraints    (1)
// and inwards to the coordinates (`TreeKinematics::project`). No dense mass matrix is formed.
#include <cassert>
#include <span>
#include <string>
#include <vector>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulation/cluster_tangent.hpp"
#include "floatframe/formulation/formulation.hpp"
#include "floatframe/formulation/tree_kinematics.hpp"

namespace floatframe {

class RelativeFormulation final : public Formulation {
 public:
  /// The only allocating call. Throws InputError if a body lacks the data `method` needs.
  RelativeFormulation(const Model& model, InertiaMethod method);

  static constexpr Coordinates coordinates_of = Coordinates::relative;
  Coordinates coordinates() const noexcept override { return coordinates_of; }
  const TreeKinematics& tree() const noexcept { return tree_; }
  Ports ports(std::size_t element) const noexcept override;

  /// Start values of the model in these coordinates (before loops are closed). Resets the turns of
  /// the springs on cut joints.
  void start(VecX& q, VecX& v) { start(model_, 0.0, q, v); }
  /// Those of another model that has the same bodies and joints, at time t.
  void start(const Model& values, double t, VecX& q, VecX& v);

  // -- EquationsOfMotion

  /// Tuned with the Iltis benchmark; a factorisation costs about 0.7 iterations.
  static constexpr double factorization_cost = 2.0;
  int velocities() const noexcept override { return tree_.velocity_count(); }
  int configurations() const noexcept override { return tree_.configuration_count(); }
  /// During a step, markers used by outputs only are not updated; after it they are those of the
  /// next `positions` and `velocities`.
  void stepping(bool on, bool accepted = true) noexcept override {
    tree_.stepping(on);
    element_set_.stepping(on, accepted);
  }
  void positions(double t, const VecX& q) noexcept override;
  void velocities(const VecX& v) noexcept override;
  void dynamics() noexcept override;
  void forces() noexcept override;
  void residual(const VecX& a, const VecX& lambda, double alpha, VecX& out) noexcept override;
  int factorize(double mass, double damping, double s, double alpha,
                int slot = 0) noexcept override {
    assert(calls_.has(CallOrder::residual) && (slot == 0 || slot == 1));
    const int pivot = tangent_.factorize(terms_, {mass, damping, s, s * alpha, true}, slot);
    FLOATFRAME_DEBUG(calls_.factorise(slot, pivot < 0));
    return pivot;
  }
  int factorize_metric(double s, double penalty, int slot) noexcept override {
    assert(calls_.has_masses() && (slot == 0 || slot == 1));
    const int pivot = tangent_.factorize(terms_, {1.0, 0.0, s, penalty, false}, slot);
    FLOATFRAME_DEBUG(calls_.factorise(slot, pivot < 0));
    return pivot;
  }
  double log_pivots(int slot) const noexcept override {
    assert(calls_.has_factors(slot));
    return tangent_.log_pivots(slot);
  }
  int negative_pivots(int slot) const noexcept {
    assert(calls_.has_factors(slot));
    return tangent_.negative_pivots(slot);
  }
  void solve(VecX& b, int slot = 0) noexcept override {
    assert(calls_.has_factors(slot));
    tangent_.solve(b, slot);
  }
  void solve(VecX& b, const VecX& phi, double penalty, VecX& mu, int slot) noexcept override {
    assert(calls_.has_factors(slot) && penalty >= 0.0);
    assert(phi.size() == constraints() && mu.size() == constraints());
    weights_ = -penalty * phi;
    tangent_.solve(b, weights_, mu, slot);
    mu += phi;
  }
  void balance(VecX&, VecX&) noexcept override {}
  void find_loads(const VecX& a, const VecX& lambda, VecX& out) noexcept override;
  void constraint_rates(VecX& out) noexcept override;
  void constraint_accelerations(const VecX& a, VecX& out) noexcept override;
  void constraint_increments(const VecX& delta, VecX& out) noexcept override;
  void constraint_forces(const VecX& w, VecX& out) noexcept override;
  void add_wrenches(const std::vector<int>& markers, const std::vector<Wrench>& wrenches,
                    VecX& out) noexcept override;
  bool has_rotations(const VecX& q) const noexcept override { return tree_.has_rotations(q); }
  void retract(const VecX& q0, const VecX& x, VecX& q) const noexcept override {
    tree_.retract(q0, x, q);
  }
  void settle(const VecX&, VecX&) const noexcept override {}
  void advance(VecX& x, const VecX& delta) const noexcept override {
    assert(calls_.has(CallOrder::positions));
    tree_.advance(x, delta);
  }

  // -- Formulation

  void set_accelerations(const VecX& a) noexcept override {
    assert(calls_.has(CallOrder::positions));
    tree_.accelerations(a);
    FLOATFRAME_DEBUG(calls_.accelerate());
  }
  double kinetic_energy(const VecX& v) noexcept override;
  BodyCoordinates body_coordinates(int body) const override;
  std::string coordinate_owner(int i) const override { return tree_.coordinate_owner(i); }
  SparseRowMatrix constraint_rows() override {
    assert(calls_.has(CallOrder::velocities));
    return tangent_.constraint_rows();
  }
  VecX mass_diagonal() const override;
  void add_tree_wrenches(Reactions& reactions) const noexcept override;

 private:
  void fill_poses(SystemMotion& motion) const noexcept override;
  void fill_accelerations(SystemMotion& motion) const noexcept override;
  double body_kinetic_energy(int body) const noexcept override;
  void fill_momenta(int body, BodyKinematics& x) const noexcept override;
  const BodyInertia& inertia(int body) const noexcept override { return terms_[body].inertia; }

  /// (1), about the evaluation origin, with the weights w of the constraints.
  void find_wrenches(const VecX& a, const VecX& w) noexcept;
  /// After `project`: of the parent on the child of a joint as described, about M.
  Wrench tree_wrench(int joint, const TreeBody& child) const noexcept;

  /// An angle of a tree joint that elements count: its place in those of `element_set_` and in q.
  struct TreeAngle {
    int slot, iq;
    double sign;  ///< -1: the child of the joint is the parent in the tree
    double value = 0.0;
  };
  void set_tree_angles() noexcept {
    for (const TreeAngle& a : tree_angles_) element_set_.set_angle(a.slot, a.value);
  }

  TreeKinematics tree_;
  ClusterTangent tangent_;
  std::vector<BodyTerms> terms_;
  std::vector<TreeAngle> tree_angles_;
  BodyVectors wrenches_;    ///< of the last residual or constraint forces
  BodyVectors increments_;  ///< motions of the bodies under an increment
  VecX weights_;            ///< of `solve`
  VecX projected_;          ///< of `add_wrenches` and `find_loads`
};

}  // namespace floatframe
