#pragma once
// Positions, velocities and accelerations of a tree of bodies, from the ground to the leaves, and
// the transposed recursion for wrenches (theory section 10).
//
// Body c is attached to marker F of its parent p by a joint; its marker M moves with its modes.
// Frames: W world, O the evaluation origin (axes of W), B body, F and M the frames of a joint.
//
// Positions. The joint gives p_FM, R_FM; modes of both bodies move F and M on their bodies:
//   p_OM = p_OF + R_WF p_FM,        R_WM = R_WF R_FM
//   R_WB = R_WM R_BM^T,             p_OB = p_OM - R_WB p_BM
//
// Twists Z = (sdot, omega), (10), are taken about the one point O for all bodies: sdot is the
// velocity of the body's material point that passes through O, so no transport matrices appear:
//   Z_c = Z_p + Phi_pc ydot_p + b_c v_c - Psi_c ydot_c
//   b   = [nu + p_OM x eta; eta],   (nu; eta) a column of the joint's motion H in world axes
//   Phi = [Jr + p_OF x Jw; Jw] at F,   Psi = [Jr + p_OM x Jw; Jw] at M
// with Jr, Jw the velocity and angular velocity of a marker per modal rate.
//
// Accelerations follow the same recursion, Zdot, plus a bias Zdot_0: what remains when all
// coordinate accelerations are zero, in the material-point meaning (theory section 6),
//   sddot = a_M - alpha x p_OM - omega x (omega x p_OM) - 2 omega x chi - chidot
//   alpha = alpha_M - omega x zeta - zetadot
// with chi, zeta the velocity and angular velocity of M relative to its body and a_M, alpha_M those
// of M through the joint. The ground accelerates with -g, which is gravity for all bodies.
//
// Increments propagate outwards like twists (`spread`). Wrenches about O inwards (`project`):
//   h_p += h_c,  h_yp += Phi^T h_c,  h_yc -= Psi^T h_c,  and the joint's coordinates get b^T h_c.
//
// The origin O is the first body's joint point at that evaluation: positions stay small wherever
// the system is on the road.
#include <cassert>
#include <string>
#include <vector>

#include "floatframe/formulation/local_marker.hpp"
#include "floatframe/formulation/point_motion.hpp"
#include "floatframe/math/contracts.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/marker_state.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model/topology.hpp"

namespace floatframe {

/// Connection of a body in the tree: fixed when it is built.
struct TreeLink {
  int parent = -1, joint = -1;  ///< -1: the ground
  JointType type = JointType::free;
  bool reversed = false;           ///< the joint's described child is the parent in the tree
  int frame_F = -1, frame_M = -1;  ///< markers on the parent and on this body
  JointDirections axes;            ///< in the sense of the tree
  int nj = 0, nm = 0;              ///< coordinates of the joint, modes of the body
  int nm_parent = 0;               ///< modes of the parent
  int ordered = 0;  ///< joint coordinates that move those after them: all but rotation vectors
  bool parent_moves_F = false;  ///< modes of the parent move marker F: Phi is not zero
  bool moves_M = false;         ///< modes of the body move marker M: Psi is not zero
  int iq = 0, iyq = 0;          ///< first entries of joint and modes in the configuration q
  int iv = 0, iy = 0;           ///< the same in velocities v
};

/// Quantities that depend on the configuration.
struct TreePosition {
  JointMotion motion;  ///< p_FM, R_FM, H in axes of F; its bias depends on the velocities
  VecX y;              ///< modal amplitudes
  Vec3 p_OB;           ///< body frame from the evaluation origin, world axes [m]
  Mat3 R_WB;
  Mat6X own;        ///< 6 x (nj + nm): [b, -Psi], twists per unit of own coordinates, about O
  Mat6X of_parent;  ///< 6 x nm_parent: Phi, twists per unit of the parent's modes
};

/// Quantities that depend on the velocities, too.
struct TreeVelocity {
  VecX yd;      ///< modal rates
  Vec3 w_WB;    ///< angular velocity, world axes [rad/s]
  Vec6 Z;       ///< twist about O, world axes [m/s, rad/s]
  Vec6 Zdot_0;  ///< bias: acceleration without coordinate accelerations [m/s2, rad/s2]
};

/// Quantities that depend on the accelerations, too.
struct TreeAcceleration {
  VecX ydd;   ///< of the modal amplitudes
  Vec6 Zdot;  ///< without the bias [m/s2, rad/s2]
};

struct TreeBody : TreeLink, TreePosition, TreeVelocity, TreeAcceleration {
  /// Columns of `own` that can be nonzero.
  int moving() const noexcept { return moves_M ? nj + nm : nj; }
};

/// A multiple of 256 bytes: addressed by an addition and a shift.
struct alignas(256) TreeMarker : LocalMarker {
  MarkerState s;  ///< r from O; world axes
};

/// For each body 6 + nm numbers: twist about O and modal rates, or wrench about O and modal forces.
using BodyVectors = std::vector<VecX>;

class TreeKinematics {
 public:
  /// Bodies, joints and markers; coordinates are not yet numbered. Allocates.
  explicit TreeKinematics(const Model& model);
  /// Numbers the coordinates: body after body in this order, parents before children.
  void number_coordinates(const std::vector<int>& order);
  /// `needed[i]`: marker i is used by joints, rods or forces, not only by outputs.
  void need_markers(std::vector<char> needed);
  /// Zeros of the right sizes.
  BodyVectors body_vectors() const;

  const Model& model() const noexcept { return model_; }
  const Topology& topology() const noexcept { return topology_; }
  int velocity_count() const noexcept { return nv_; }
  int configuration_count() const noexcept { return nq_; }
  int body_count() const noexcept { return static_cast<int>(bodies_.size()); }
  const TreeBody& body(int i) const noexcept {
    assert(i >= 0 && i < body_count());
    return bodies_[i];
  }
  const std::vector<TreeBody>& bodies() const noexcept { return bodies_; }
  const TreeMarker& marker(int i) const noexcept {
    assert(is_index(i, markers_));
    return markers_[i];
  }
  /// Parents before children.
  const std::vector<int>& order() const noexcept { return order_; }
  /// p_WO of the last `positions`.
  const Vec3& origin() const noexcept { return p_WO_; }

  // Step time: noexcept, free of allocation. Each needs those before it at the same state.
  /// During steps, markers used by outputs only are not updated.
  void stepping(bool on) noexcept { stepping_ = on; }
  void positions(const VecX& q) noexcept {
    assert(q.size() == nq_);
    stiffens_ ? positions_of<true>(q) : positions_of<false>(q);
  }
  void velocities(const VecX& v) noexcept {
    assert(v.size() == nv_);
    stiffens_ ? velocities_of<true>(v) : velocities_of<false>(v);
  }
  void accelerations(const VecX& a) noexcept;
  /// q = q0 (+) x: rotation vectors act on quaternions.
  void retract(const VecX& q0, const VecX& x, VecX& q) const noexcept;
  /// Its quaternions have unit length.
  bool has_rotations(const VecX& q) const noexcept;
  /// x such that q0 (+) x = (q0 (+) x_old) (+) delta, in place.
  void advance(VecX& x, const VecX& delta) const noexcept;

  /// z = [Z; y] of each body under the increment x of the coordinates.
  void spread(const VecX& x, BodyVectors& z) const noexcept;
  /// Generalised forces of wrenches h on the bodies; h then contains the wrenches of the joints.
  void project(BodyVectors& h, VecX& out) const noexcept;
  /// h += J^T (force, torque) at a marker, world axes.
  void add_wrench(int marker, const Vec3& force, const Vec3& torque, BodyVectors& h) const noexcept;
  /// Of a marker under the increments of `spread`.
  PointMotion increment_of(int marker, const BodyVectors& z) const noexcept;
  /// Of a marker after `accelerations`, bias included; the ground has -g.
  PointMotion acceleration_of(int marker) const noexcept;
  /// The same with the ground at rest.
  PointMotion acceleration_in_world(int marker) const noexcept;

  // Load time.
  /// Start values of a model with the same bodies and joints, at time t, before loops are closed.
  void start(const Model& values, double t, VecX& q, VecX& v) const;
  /// Priority of the user's start value of a coordinate, or (`rates`) of its rate.
  enum class Given : char { no, yes, kept };
  std::vector<Given> given_coordinates(bool rates) const;
  /// The child body of this joint of the model, -1 if the joint is cut.
  int body_of_joint(int joint) const noexcept;
  /// Which velocity coordinates are modal amplitudes; load time.
  std::vector<bool> elastic_coordinates() const;
  /// Indices into q of the translations of free joints to the ground.
  std::vector<int> free_translations() const;
  /// "joint 'hinge'" or "mode 2 of body 'arm'", the owner of velocity coordinate i.
  std::string coordinate_owner(int i) const;

 private:
  void choose_origin(const VecX& q) noexcept;
  void place_ground_markers() noexcept;
  template <bool stiffens>
  void positions_of(const VecX& q) noexcept;
  template <bool stiffens>
  void velocities_of(const VecX& v) noexcept;
  template <bool stiffens>
  void place_body(TreeBody& b) noexcept;
  template <bool stiffens>
  void find_twist(TreeBody& b, const VecX& v) noexcept;
  void marker_position(TreeMarker& m) const noexcept;
  void marker_velocity(TreeMarker& m) const noexcept;
  void add_acceleration(int marker, PointMotion& x) const noexcept;
  bool moves_with_modes(int marker) const;

  const Model& model_;
  Topology topology_;
  std::vector<TreeBody> bodies_;
  std::vector<int> order_;
  std::vector<TreeMarker> markers_;
  /// Markers on each body, except its own frame_M: those of joints, rods and forces, and all.
  struct UsedMarkers {
    std::vector<int> dynamic, all;
  };
  std::vector<UsedMarkers> used_markers_;
  std::vector<int> sliding_;  ///< markers that slide
  bool stepping_ = false;
  bool stiffens_ = false;  ///< a marker has displacements of second order
  int nq_ = 0, nv_ = 0;
  Vec3 p_WO_ = Vec3::Zero();
};

}  // namespace floatframe
