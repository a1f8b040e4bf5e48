#pragma once
// Positions and velocities in natural coordinates (paper section 6.1): per body the origin r0 =
// p_WB, the axes A = [u v w] = R_WB and the modal amplitudes y, then massless outer points of
// flexible bodies, at the deformed nodes of joints and rods:
//   q_body = (r0, u, v, w, y, r_P1, r_P2, ...),   nq = 12 + nm + 3 np
//
// Constraints, rows scaled to lengths (l the body length, theory section 10):
//   of             rows      equation                                            number
//   a body         l (u.u - 1)/2, l (v.v - 1)/2, l (w.w - 1)/2 = 0               6       (1)
//                  l u.v, l u.w, l v.w = 0
//   outer points   r_P - (r0 + A (r_u + X y)) = 0                                3 each  (2)
//   joints, rods,  constraint parts between markers (constraint_set.hpp);        parts   (3)
//   motions        their positions are those of the outer points
// A need not be orthonormal during the Newton iteration. Torques and directions of markers act
// through the angular velocity
//   omega = 1/2 (u x udot + v x vdot + w x wdot),                                        (4)
// exact where (1) holds; so a torque T has the generalised force 1/2 T x u on u, and so on.
#include <cassert>
#include <string>
#include <vector>

#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/formulation/local_marker.hpp"

namespace floatframe {

struct AbsoluteBody {
  /// Axes of the rows (1): u.u, v.v, w.w, u.v, u.w, v.w.
  static constexpr int pair_a[6] = {0, 1, 2, 0, 0, 1}, pair_b[6] = {0, 1, 2, 1, 2, 2};
  // Fixed when it is built.
  int offset = 0;                 ///< first coordinate
  int nm = 0, points = 0;         ///< modes, outer points
  int row = 0;                    ///< first constraint row
  double length = 1.0;            ///< l [m]
  std::vector<int> point_marker;  ///< for each point its marker
  // Of the configuration, at first undeformed.
  Vec3 p_WB;                  ///< origin of the body frame, world axes [m]
  Mat3 A = Mat3::Identity();  ///< [u v w]: R_WB where (1) holds
  VecX y;                     ///< modal amplitudes
  // Of the velocities, at first at rest.
  Vec3 v_WB;                 ///< [m/s]
  Mat3 Adot = Mat3::Zero();  ///< [1/s]
  Vec3 w_WB;                 ///< (4), world axes [rad/s]
  VecX yd;                   ///< modal rates
  // First coordinates of an axis and of an outer point, first row of (2); their numbers.
  int axis(int c) const noexcept { return offset + 3 + 3 * c; }
  int point(int p) const noexcept { return offset + 12 + nm + 3 * p; }
  int point_row(int p) const noexcept { return row + 6 + 3 * p; }
  int size() const noexcept { return 12 + nm + 3 * points; }
  int rows() const noexcept { return 6 + 3 * points; }
};

/// A multiple of 256 bytes: addressed by an addition and a shift.
struct alignas(256) AbsoluteMarker : LocalMarker {
  MarkerState s;      ///< on the body, world axes
  MarkerState outer;  ///< the same at its outer point, if it has one
  int point = -1;     ///< first coordinate of its outer point, -1 if it has none
};

class AbsoluteKinematics {
 public:
  /// Outer points for these constraints, whose rows are numbered after those of the bodies.
  /// Allocates.
  AbsoluteKinematics(const Model& model, ConstraintSet& constraints);

  const Model& model() const noexcept { return model_; }
  int size() const noexcept { return size_; }
  /// Their coordinates and rows are consecutive.
  const std::vector<AbsoluteBody>& bodies() const noexcept { return bodies_; }
  const std::vector<AbsoluteMarker>& markers() const noexcept { return markers_; }
  /// The marker of an outer point.
  const AbsoluteMarker& point(const AbsoluteBody& b, int p) const noexcept {
    assert(p >= 0 && p < b.points);
    return markers_[b.point_marker[p]];
  }
  /// "mode 2 of body 'arm'", the owner of coordinate i. Load time.
  std::string coordinate_owner(int i) const;

  // Step time: noexcept, free of allocation. Each needs those before it at the same state.
  void positions(const VecX& q) noexcept;
  /// `phi`: its rows (1), (2) are set to their values.
  void velocities(const VecX& v, VecX& phi) noexcept;
  void accelerations(const VecX& a) noexcept {
    assert(a.size() == size_);
    a_ = a;
  }
  const VecX& accelerations() const noexcept { return a_; }
  /// Makes the axes of q0 + x orthonormal and moves the outer points to their bodies.
  void settle(const VecX& q0, VecX& x) const noexcept;
  /// The axes of its bodies are orthonormal.
  bool has_rotations(const VecX& q) const noexcept;
  /// From the present positions by increments that keep (1), (2): A rotates.
  void advance(VecX& x, const VecX& delta) const noexcept;

  // Rates, increments and accelerations of the rows (1), (2) of all bodies; and out += Phi_q^T w
  // of those of one body.
  void own_rates(VecX& out) const noexcept;
  void own_increments(const VecX& delta, VecX& out) const noexcept;
  void own_accelerations(VecX& out) const noexcept;
  void add_own_forces(const AbsoluteBody& b, const VecX& w, VecX& out) const noexcept;

  // Markers as the parts (3) use them: at their outer points.
  const MarkerState& constraint_state(int marker) const noexcept {
    const AbsoluteMarker& m = markers_[marker];
    return m.point >= 0 ? m.outer : m.s;
  }
  PointMotion increment_of(int marker, const VecX& delta) const noexcept;
  PointMotion acceleration_of(int marker) const noexcept;
  /// Of the material point of a marker on its body.
  Vec3 point_acceleration(int marker) const noexcept;
  /// out += J^T (force, torque) at a marker, or `through_point` at its outer point.
  void add_wrench(int marker, bool through_point, const Vec3& force, const Vec3& torque,
                  VecX& out) const noexcept;

 private:
  void place_outer_points(const ConstraintSet& constraints);
  template <bool stiffens>
  void positions_of(const VecX& q) noexcept;
  template <bool stiffens>
  void velocities_of(const VecX& v, VecX& phi) noexcept;
  template <bool stiffens>
  void settle_of(const VecX& q0, VecX& x) const noexcept;
  template <bool stiffens>
  void advance_of(VecX& x, const VecX& delta) const noexcept;
  Vec3 point_increment(const AbsoluteMarker& m, const VecX& delta) const noexcept;

  const Model& model_;
  std::vector<AbsoluteBody> bodies_;
  std::vector<AbsoluteMarker> markers_;
  std::vector<int> sliding_;  ///< markers that slide
  bool stiffens_ = false;     ///< a body has geometric stiffening
  int size_ = 0;
  VecX a_;
};

}  // namespace floatframe
