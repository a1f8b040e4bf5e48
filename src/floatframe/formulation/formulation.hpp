#pragma once
// A formulation as everything but the integrator sees it: the equations of motion
// (equations_of_motion.hpp) behind virtual functions, so that the start, linear systems, reactions,
// watches and recording are compiled once; and the motion of the system, which is the same in all
// coordinates. The integrator is a template over the classes that derive from it:
// these are final, so that steps call them directly.
#include <cassert>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "floatframe/formulation/body_inertia.hpp"
#include "floatframe/formulation/call_order.hpp"
#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/formulation/counts.hpp"
#include "floatframe/formulation/element_set.hpp"
#include "floatframe/formulation/load_readers.hpp"
#include "floatframe/formulation/local_marker.hpp"
#include "floatframe/formulation/signal_tangent.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/math/independent_rows.hpp"
#include "floatframe/model/system_motion.hpp"

namespace floatframe {

/// Places of a body's coordinates in the configuration q and the velocities v.
struct BodyCoordinates {
  int q = 0, q_count = 0, y = 0;   ///< the first one, their number, the first amplitude
  int v = 0, v_count = 0, yd = 0;  ///< the same in v
  int parent = -1;                 ///< the body whose motion they are relative to; -1: the ground
};

class Formulation {
 public:
  virtual ~Formulation() = default;
  Formulation(const Formulation&) = delete;
  Formulation& operator=(const Formulation&) = delete;

  virtual Coordinates coordinates() const noexcept = 0;
  const Model& model() const noexcept { return model_; }
  const ConstraintSet& constraint_set() const noexcept { return constraint_set_; }

  /// Values of `model().inputs`, constant until set again; at first their initial values.
  void set_inputs(std::span<const double> values) noexcept { element_set_.set_inputs(values); }
  std::span<const double> inputs() const noexcept { return element_set_.inputs(); }
  /// Moves them by these numbers, with efforts that are linear in them. Load time only: allocates.
  void change_inputs(const VecX& by) { element_set_.change_inputs(by); }
  /// Angles of the joint springs at the last evaluation, of those about an axis: they determine
  /// the turn of the next angle, so they are a part of the state that q does not contain.
  std::span<const double> spring_angles() const noexcept { return element_set_.angles(); }
  void set_spring_angles(std::span<const double> angles) noexcept {
    element_set_.set_angles(angles);
  }
  /// Held branches of the laws of forces, and the side of a force whose law has branches at the
  /// present positions and velocities (model/element_evaluation.hpp).
  std::span<const std::int64_t> force_branches() const noexcept { return element_set_.branches(); }
  void hold_force_branches(std::span<const std::int64_t> branches) noexcept {
    element_set_.hold_branches(branches);
  }
  void hold_force_branch(std::size_t force, std::int64_t branch) noexcept {
    element_set_.hold_branch(force, branch);
  }
  /// States of elements (model/element_evaluation.hpp): given at a state, or following the motion.
  ElementStates& element_states() noexcept { return element_set_.element_states(); }
  const ElementStates& element_states() const noexcept { return element_set_.element_states(); }
  /// Those that follow, alone, at the present positions and velocities.
  void solve_element_states() noexcept {
    element_set_.solve_states([this](std::size_t k) { return ports(k); });
  }
  /// At a start that gives none, or that has been found; and at the end of a step.
  void start_element_states(StateStart of) noexcept {
    element_set_.start_states([this](std::size_t k) { return ports(k); }, of);
  }
  /// At the start of a search for an equilibrium.
  void begin_deflections() noexcept {
    element_set_.begin_deflections([this](std::size_t k) { return ports(k); });
  }
  void change_kept_states() noexcept {
    for (const std::size_t k : element_states().elements())
      element_states().after_step(k, ports(k));
  }
  /// Of sampled elements with an instant within `width` of the present one (model/sampling.hpp).
  void sample_elements(double width) noexcept {
    element_set_.sample([this](std::size_t k) { return ports(k); }, width);
  }
  /// What an element acts on at the present positions and velocities.
  virtual Ports ports(std::size_t element) const noexcept = 0;
  /// Signals between elements at the present positions and velocities.
  void find_links() noexcept {
    element_set_.find_links([this](std::size_t k) { return ports(k); });
  }
  BranchSide branch_side(std::size_t element) noexcept {
    find_links();
    return floatframe::branch_side(ports(element));
  }
  /// See ElementSet.
  int undefined_element(double t) const noexcept { return element_set_.undefined(t); }
  /// By the function of an element, since the beginning of the last step.
  const ThrownByElement& thrown() const noexcept { return element_set_.thrown(); }
  /// While held, efforts stay those of the last evaluation: for derivatives without theirs.
  void hold_efforts(bool on) noexcept { element_set_.hold(on); }

  // -- EquationsOfMotion

  virtual int velocities() const noexcept = 0;
  virtual int configurations() const noexcept = 0;
  /// The rotations in the configuration numbers are rotations, to 1e-6.
  virtual bool has_rotations(const VecX& q) const noexcept = 0;
  int constraints() const noexcept { return constraint_set_.count(); }
  virtual void stepping(bool on, bool accepted = true) noexcept = 0;
  virtual void positions(double t, const VecX& q) noexcept = 0;
  virtual void velocities(const VecX& v) noexcept = 0;
  virtual void dynamics() noexcept = 0;
  virtual void forces() noexcept = 0;
  virtual void residual(const VecX& a, const VecX& lambda, double alpha, VecX& out) noexcept = 0;
  virtual int factorize(double mass, double damping, double s, double alpha,
                        int slot = 0) noexcept = 0;
  virtual int factorize_metric(double s, double penalty, int slot) noexcept = 0;
  virtual double log_pivots(int slot) const noexcept = 0;
  virtual void solve(VecX& b, int slot = 0) noexcept = 0;
  virtual void solve(VecX& b, const VecX& phi, double penalty, VecX& mu, int slot) noexcept = 0;
  virtual void balance(VecX& lambda, VecX& r) noexcept = 0;
  int load_count() const noexcept { return load_readers_.count(); }
  /// Their present values.
  void loads(VecX& out) const noexcept {
    for (int i = 0; i < load_count(); ++i) out[i] = element_set_.load(load_readers_.element(i));
  }
  virtual void find_loads(const VecX& a, const VecX& lambda, VecX& out) noexcept = 0;
  void set_loads(const VecX& loads) noexcept {
    assert(loads.size() == load_count());
    for (int i = 0; i < load_count(); ++i)
      element_set_.set_load(load_readers_.element(i), loads[i], ports(load_readers_.element(i)));
  }
  const LoadReaders& load_readers() const noexcept { return load_readers_; }
  const VecX& constraint_values() const noexcept {
    assert(calls_.has(CallOrder::velocities));
    return constraint_set_.values();
  }
  virtual void constraint_rates(VecX& out) noexcept = 0;
  virtual void constraint_accelerations(const VecX& a, VecX& out) noexcept = 0;
  virtual void constraint_increments(const VecX& delta, VecX& out) noexcept = 0;
  virtual void constraint_forces(const VecX& w, VecX& out) noexcept = 0;
  /// Adds the generalised forces of wrenches on these markers, at the present positions.
  virtual void add_wrenches(const std::vector<int>& markers, const std::vector<Wrench>& wrenches,
                            VecX& out) noexcept = 0;
  int signal_rank() const noexcept { return signal_tangent_.rank(); }
  void signal_tangent(double damping, double s, MatX& B, MatX& V) noexcept {
    signal_tangent_.find(*this, damping, s, B, V);
  }
  const VecX& own_frequencies_squared() const noexcept { return omega2_; }
  virtual void retract(const VecX& q0, const VecX& x, VecX& q) const noexcept = 0;
  virtual void settle(const VecX& q0, VecX& x) const noexcept = 0;
  virtual void advance(VecX& x, const VecX& delta) const noexcept = 0;

  // -- the motion, for everything that reads it

  /// The motion at the present positions, velocities and forces. Bodies and what is needed beyond
  /// them are filled by this call, so it is repeated after each move.
  const SystemMotion& motion(MotionNeeds needs = {},
                             const Reactions* reactions = nullptr) const noexcept;
  /// Of the motion, at hand without filling it.
  const MarkerState& marker(int i) const noexcept { return motion_.marker(i); }
  const Efforts& effort(int i) const noexcept { return motion_.effort(i); }
  /// The accelerations of `MotionNeeds::accelerations` (`residual` and `constraint_accelerations`
  /// set them too).
  virtual void set_accelerations(const VecX& a) noexcept = 0;
  const LocalMarker& local_marker(int i) const noexcept {
    assert(is_index(i, local_markers_));
    return *local_markers_[i];
  }
  /// At the present positions, of all bodies [J].
  virtual double kinetic_energy(const VecX& v) noexcept = 0;
  double gravity_energy() const noexcept;

  // -- structure; load time

  virtual BodyCoordinates body_coordinates(int body) const = 0;
  /// "mode 2 of body 'arm'" or "joint 'hinge'", the owner of coordinate i.
  virtual std::string coordinate_owner(int i) const = 0;
  CoordinateCounts counts() const;
  /// Phi_q at the present positions, sparse and dense.
  virtual SparseRowMatrix constraint_rows() = 0;
  MatX constraint_jacobian() { return MatX(constraint_rows()); }
  /// Of the mass matrix, after `dynamics`.
  virtual VecX mass_diagonal() const = 0;
  /// Adds the wrenches of tree joints, which have no multipliers, after `residual`: of the parent
  /// on the child, about the joint's point on the child, without that of a prescribed motion.
  virtual void add_tree_wrenches(Reactions&) const noexcept {}

 protected:
  /// With constraints for these joints and of all elements. Allocates.
  Formulation(const Model& model, const std::vector<int>& constrained_joints);
  /// Adds a view of a body, a marker; in the order of the model.
  void show_body(const Mat3& R_WB, const Vec3& w_WB, const VecX& y, const VecX& yd,
                 const double* ydd);
  void show_marker(const MarkerState& state, const LocalMarker& local);
  /// After all markers are shown.
  void connect_elements() { element_set_.connect(motion_.markers); }

  const Model& model_;
  ConstraintSet constraint_set_;
  ElementSet element_set_;
  LoadReaders load_readers_;
  [[no_unique_address]] CallOrder calls_;
  double time_ = 0.0;
  VecX omega2_;

 private:
  /// Positions and velocities of the bodies and the origin of the markers.
  virtual void fill_poses(SystemMotion& motion) const noexcept = 0;
  virtual void fill_accelerations(SystemMotion& motion) const noexcept = 0;
  /// After `dynamics`.
  virtual double body_kinetic_energy(int body) const noexcept = 0;
  /// Of `fill_poses`; the same.
  virtual void fill_momenta(int body, BodyKinematics& b) const noexcept = 0;
  virtual const BodyInertia& inertia(int body) const noexcept = 0;
  Vec3 first_moment(int body, const BodyKinematics& b) const noexcept;

  SignalTangent signal_tangent_;
  mutable SystemMotion motion_;  ///< filled when it is asked for
  std::vector<const LocalMarker*> local_markers_;
#ifndef NDEBUG  // the view of modal accelerations is moved to NaN unless it is asked for
  void view_modal_accelerations(bool asked) const noexcept;
  std::vector<const double*> modal_accelerations_;
  VecX not_asked_;
#endif
};

/// In these coordinates. Throws InputError if a body lacks the data `method` needs.
std::unique_ptr<Formulation> make_formulation(Coordinates coordinates, const Model& model,
                                              InertiaMethod method);

/// One evaluation of the system up to its velocities; for a state: at its t, q, v.
inline void kinematics_at(Formulation& f, double t, const VecX& q, const VecX& v) noexcept {
  f.positions(t, q);
  f.velocities(v);
}
template <class S>
void kinematics_at(Formulation& f, const S& state) noexcept {
  if constexpr (requires { state.z; })
    if (state.z.size() > 0) f.element_states().give(state.z);
  kinematics_at(f, state.t, state.q, state.v);
}
/// The same up to `dynamics`.
template <class S>
void dynamics_at(Formulation& f, const S& state) noexcept {
  kinematics_at(f, state);
  f.dynamics();
}

}  // namespace floatframe
