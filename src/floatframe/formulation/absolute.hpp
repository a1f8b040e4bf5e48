#pragma once
// Equations of motion in natural coordinates (paper section 6.1, theory section 10), composed of
//   AbsoluteKinematics  positions and velocities of bodies and markers, the bodies' own constraints
//   BodyTerms           M and Qv of each body, (25)-(45)
//   ElementSet            force elements
//   ConstraintSet       joints, rods and prescribed motions
//   AbsoluteTangent     the factorised tangent
//
// The residual is, body by body with gravity g taken off the acceleration of r0, M (a - g) - Qv +
// (0; K y + D ydot), less applied forces, plus Phi_q^T (lambda + alpha Phi).
#include <cassert>
#include <string>
#include <vector>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulation/absolute_tangent.hpp"
#include "floatframe/formulation/formulation.hpp"
#include "floatframe/formulation/relative.hpp"

namespace floatframe {

class AbsoluteFormulation final : public Formulation {
 public:
  /// The only allocating call. Throws InputError if a body lacks the data `method` needs.
  AbsoluteFormulation(const Model& model, InertiaMethod method);

  static constexpr Coordinates coordinates_of = Coordinates::absolute;
  Coordinates coordinates() const noexcept override { return coordinates_of; }
  const AbsoluteKinematics& kinematics() const noexcept { return kinematics_; }
  Ports ports(std::size_t element) const noexcept override;

  /// The same configuration and velocities as a relative state. Axes do not determine turns: the
  /// angles of joint springs are continued from those of the tree.
  void start_from(RelativeFormulation& tree, const VecX& tree_q, const VecX& tree_v, VecX& q,
                  VecX& v);

  // -- EquationsOfMotion

  /// Tuned with the Iltis benchmark.
  static constexpr double factorization_cost = 3.0;
  int velocities() const noexcept override { return kinematics_.size(); }
  int configurations() const noexcept override { return kinematics_.size(); }
  /// All markers are updated, also during steps.
  void stepping(bool on, bool accepted = true) noexcept override {
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
    const int pivot = tangent_.factorize({mass, damping, s, s * alpha, true}, slot);
    FLOATFRAME_DEBUG(calls_.factorise(slot, pivot < 0));
    return pivot;
  }
  int factorize_metric(double s, double penalty, int slot) noexcept override {
    assert(calls_.has_masses() && (slot == 0 || slot == 1));
    const int pivot = tangent_.factorize({1.0, 0.0, s, penalty, false}, slot);
    FLOATFRAME_DEBUG(calls_.factorise(slot, pivot < 0));
    return pivot;
  }
  double log_pivots(int slot) const noexcept override {
    assert(calls_.has_factors(slot));
    return tangent_.log_pivots(slot);
  }
  void solve(VecX& b, int slot = 0) noexcept override {
    assert(calls_.has_factors(slot));
    tangent_.solve(b, slot);
  }
  void solve(VecX& b, const VecX& phi, double penalty, VecX& mu, int slot) noexcept override {
    assert(calls_.has_factors(slot));
    tangent_.solve(b, phi, penalty, mu, slot);
  }
  void balance(VecX& lambda, VecX& r) noexcept override {
    assert(calls_.has(CallOrder::residual));
    tangent_.balance(lambda, r);
    constraint_set_.set_multipliers(lambda, 0.0);
  }
  /// The multipliers contain all reactions.
  void find_loads(const VecX&, const VecX& lambda, VecX& out) noexcept override;
  void constraint_rates(VecX& out) noexcept override;
  void constraint_accelerations(const VecX& a, VecX& out) noexcept override;
  void constraint_increments(const VecX& delta, VecX& out) noexcept override;
  void constraint_forces(const VecX& w, VecX& out) noexcept override;
  void add_wrenches(const std::vector<int>& markers, const std::vector<Wrench>& wrenches,
                    VecX& out) noexcept override;
  void retract(const VecX& q0, const VecX& x, VecX& q) const noexcept override {
    assert(q0.size() == velocities() && x.size() == velocities());
    q = q0 + x;
  }
  void settle(const VecX& q0, VecX& x) const noexcept override { kinematics_.settle(q0, x); }
  bool has_rotations(const VecX& q) const noexcept override { return kinematics_.has_rotations(q); }
  void advance(VecX& x, const VecX& delta) const noexcept override {
    assert(calls_.has(CallOrder::positions));
    kinematics_.advance(x, delta);
  }

  // -- Formulation

  void set_accelerations(const VecX& a) noexcept override {
    kinematics_.accelerations(a);
    FLOATFRAME_DEBUG(calls_.accelerate());
  }
  double kinetic_energy(const VecX& v) noexcept override;
  BodyCoordinates body_coordinates(int body) const override;
  std::string coordinate_owner(int i) const override { return kinematics_.coordinate_owner(i); }
  SparseRowMatrix constraint_rows() override;
  VecX mass_diagonal() const override;
  /// Dense mass matrix at the present configuration (load time, tests).
  MatX mass_matrix() const;

 private:
  void fill_poses(SystemMotion& motion) const noexcept override;
  void fill_accelerations(SystemMotion& motion) const noexcept override;
  double body_kinetic_energy(int body) const noexcept override;
  void fill_momenta(int body, BodyKinematics& x) const noexcept override;
  const BodyInertia& inertia(int body) const noexcept override { return terms_[body].inertia; }
  void add_constraint_forces(const VecX& w, VecX& out) const noexcept;

  AbsoluteKinematics kinematics_;
  std::vector<BodyTerms> terms_;
  AbsoluteTangent tangent_;
  VecX work_;  ///< of `residual`
};

}  // namespace floatframe
