#pragma once
// Equations of motion in natural coordinates (paper section 6.1): per body the origin r0, the axes
// u, v, w and the modal amplitudes, plus the zero-mass outer points of flexible bodies, where
// joints sit on deformed nodes.
//   q_body = (r0, u, v, w, y, r_P1, r_P2, ...)
// Constraints, rows scaled to lengths (l the body length):
//   orthonormality   l (u.u - 1)/2, l (v.v - 1)/2, l (w.w - 1)/2, l u.v, l u.w, l v.w          6 a
//   body outer points     r_P - (r0 + A (r_u + X y)) = 0 3 a point joints and rods  as constraint
//   parts between markers; positions through the outer points
// Rotations of markers act through omega = 1/2 sum u x udot (exact on the orthonormality manifold).
// The tangent is factorised by bodies (BlockLdlt): never one dense matrix.
#include <algorithm>
#include <cassert>
#include <span>
#include <vector>

#include "floatframe/formulation/body_inertia.hpp"
#include "floatframe/formulation/counts.hpp"
#include "floatframe/formulation/local_marker.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/math/block_ldlt.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/force_evaluation.hpp"

namespace floatframe {

class AbsoluteFormulation {
 public:
  AbsoluteFormulation(const Model& model, InertiaMethod method);

  int velocities() const noexcept { return nq_; }
  int configurations() const noexcept { return nq_; }
  int constraints() const noexcept { return nc_; }
  const Model& model() const noexcept { return model_; }

  /// Values of `model().inputs`, held until they are set again; at first their initial values.
  void set_inputs(std::span<const double> values) noexcept {
    assert(values.size() == inputs_.size());
    std::copy(values.begin(), values.end(), inputs_.begin());
  }
  std::span<const double> inputs() const noexcept { return inputs_; }

  /// As in relative.hpp.
  std::span<const double> spring_angles() const noexcept { return force_reference_; }
  void set_spring_angles(std::span<const double> angles) noexcept {
    assert(angles.size() == force_reference_.size());
    std::copy(angles.begin(), angles.end(), force_reference_.begin());
  }

  /// The same configuration and velocities as a relative state. Axes do not tell turns: the angles
  /// of joint springs go on from those of the tree.
  void start_from(RelativeFormulation& tree, const VecX& tree_q, const VecX& tree_v, VecX& q,
                  VecX& v);

  /// What a renewal must save, in iterations (tuned on the Iltis).
  static constexpr double factorization_cost = 3.0;

  /// As in relative.hpp; here all markers are kept up to date.
  void stepping(bool on, bool accepted = true) noexcept {
    if (on)
      std::copy(force_reference_.begin(), force_reference_.end(), kept_reference_.begin());
    else if (!accepted)
      std::copy(kept_reference_.begin(), kept_reference_.end(), force_reference_.begin());
  }

  // -- the integrator's view
  // ---------------------------------------------------------------------------------------
  void positions(double t, const VecX& q) noexcept;
  void velocities(const VecX& v) noexcept;
  void dynamics() noexcept;
  void forces() noexcept;
  void residual(const VecX& a, const VecX& lambda, double alpha, VecX& out) noexcept;
  /// As in relative.hpp: T = M mass + damping C + s (K + alpha Phi_q^T Phi_q), kept in a slot.
  int factorize(double mass, double damping, double s, double alpha, int slot = 0) noexcept {
    return eliminate(mass, damping, s, s * alpha, true, linearizations_[slot]);
  }
  /// M + s K + penalty Phi_q^T Phi_q without geometric stiffness.
  int factorize_metric(double s, double penalty, int slot) noexcept {
    return eliminate(1.0, 0.0, s, penalty, false, linearizations_[slot]);
  }
  void solve(VecX& b, int slot = 0) noexcept { linearizations_[slot].matrix.solve(b); }
  /// b := T^-1 (b + Phi_q^T w) and increments := Phi_q b, with the Phi_q of the factorisation.
  void solve(VecX& b, const VecX& w, VecX& increments, int slot) noexcept;
  const VecX& constraint_values() const noexcept { return phi_; }
  /// K_kk / M_kk of modal amplitudes, zero for rigid coordinates [1/s2].
  const VecX& own_frequencies_squared() const noexcept { return omega2_; }
  void constraint_rates(VecX& out) noexcept;
  void constraint_accelerations(const VecX& a, VecX& out) noexcept;
  void constraint_increments(const VecX& delta, VecX& out) noexcept;
  void constraint_forces(const VecX& w, VecX& out) noexcept;
  void retract(const VecX& q0, const VecX& x, VecX& q) const noexcept { q = q0 + x; }
  void advance(VecX& x, const VecX& delta) const noexcept { x += delta; }

  // -- outputs
  // -----------------------------------------------------------------------------------------------------
  const MarkerState& marker(int index) const noexcept { return markers_[index].s; }
  Vec3 origin() const noexcept { return Vec3::Zero(); }
  const ForceState& force(int index) const noexcept { return force_states_[index]; }
  void set_accelerations(const VecX& a) noexcept { a_ = a; }
  Vec3 marker_acceleration(int index) const noexcept;
  const Mat3& body_rotation(int i) const noexcept { return bodies_[i].A; }
  Vec3 body_angular_velocity(int i) const noexcept { return bodies_[i].w; }
  double amplitude(const VecX& q, int i, int mode) const noexcept {
    return q[bodies_[i].offset + 12 + mode];
  }
  Vec3 body_velocity(int i) const noexcept { return bodies_[i].r0_dot; }
  double amplitude_rate(const VecX& v, int i, int mode) const noexcept {
    return v[bodies_[i].offset + 12 + mode];
  }
  /// Power that modal damping takes out at these velocities [W].
  double modal_damping_power(const VecX& v) const noexcept;
  /// Power of prescribed motions with these multipliers, after `positions` [W].
  double motion_power(const VecX& lambda) const noexcept;
  double kinetic_energy(const VecX& v) noexcept;
  double gravity_energy(const VecX& q) const noexcept;
  double elastic_energy(const VecX& q) const noexcept;
  const std::vector<ConstraintPart>& parts() const noexcept { return parts_; }
  /// Row where a part starts (rows of bodies come first).
  int part_offset(std::size_t part) const noexcept { return part_offset_[part]; }
  std::string coordinate_owner(int i) const;
  MatX constraint_jacobian();
  CoordinateCounts counts() const;
  /// Dense mass matrix at the present configuration (load time, tests).
  MatX mass_matrix() const;
  /// Coordinates and own constraints of a body; those of all bodies follow each other.
  int body_size(int i) const noexcept { return body(i).size(); }
  int body_rows(int i) const noexcept { return 6 + 3 * body(i).points; }
  const MatX& body_mass(int i) const noexcept { return bodies_[i].M; }

 private:
  // Pairs of axes of the orthonormality rows: u.u, v.v, w.w, u.v, u.w, v.w.
  static constexpr int pair_a[6] = {0, 1, 2, 0, 0, 1};
  static constexpr int pair_b[6] = {0, 1, 2, 1, 2, 2};

  struct BodyData {
    int offset = 0, nm = 0, points = 0;
    int row = 0;  // first constraint row: 6 orthonormality, 3 a point
    double length = 1.0;
    std::vector<int> point_marker;
    Vec3 r0, r0_dot, w;
    Mat3 A, Adot;
    VecX y, yd;
    BodyInertia inertia;
    MatX M, J;
    VecX Qv, work;
    int size() const noexcept { return 12 + nm + 3 * points; }
  };
  struct MarkerData : LocalMarker {
    MarkerState s;   // on the body
    int point = -1;  // global index of its outer point, -1 if it has none
    Vec3 r_P, v_P;   // the outer point
  };
  struct Gradient {  // nonzero entries of a row over one body's block
    int body = -1, count = 0;
    std::vector<int> index;
    std::vector<double> value;
  };

  /// A factorised tangent and the rows of Phi_q it was made with.
  struct Linearization {
    BlockLdlt matrix;
    std::vector<int> row_start, column;
    std::vector<double> value;
  };

  MarkerState constraint_state(const MarkerData& m) const noexcept;
  void add_wrench(int marker, bool through_point, const Vec3& force, const Vec3& torque,
                  VecX& out) const noexcept;
  void gradient(int marker, bool through_point, const Vec3& force, const Vec3& torque,
                Gradient& g) const noexcept;
  void add_rank_one(BlockLdlt& matrix, const Gradient& a, const Gradient& b,
                    double weight) noexcept;
  int eliminate(double mass, double damping, double s, double penalty, bool geometric,
                Linearization& l) noexcept;
  void keep_row(Linearization& l, int row, const Gradient& a, const Gradient& b) noexcept;
  void add_part_forces(const VecX& w, VecX& out) const noexcept;
  void add_body_constraint_forces(const VecX& w, VecX& out) const noexcept;
  BodyData& body(int i) noexcept { return bodies_[i]; }
  const BodyData& body(int i) const noexcept { return bodies_[i]; }

  const Model& model_;
  std::vector<BodyData> bodies_;
  std::vector<MarkerData> markers_;
  std::vector<ConstraintPart> parts_;
  std::vector<int> part_offset_;
  std::vector<ConstraintRow> rows_;
  int part_rows_ = 0;  // first row of the parts
  std::vector<ForceState> force_states_;
  std::vector<double> force_reference_, kept_reference_, inputs_;  // as in relative.hpp
  Linearization linearizations_[2];
  Gradient ga_, gb_;
  int nq_ = 0, nc_ = 0;
  double time_ = 0.0;
  VecX omega2_, phi_, weights_, lambda_, a_;
};

}  // namespace floatframe
