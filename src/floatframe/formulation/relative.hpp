#pragma once
// Equations of motion in joint coordinates and modal amplitudes, semi-recursive (paper section 6.2,
// theory section 10).
//
// Tree of bodies from `find_topology`; body c hangs from marker F of its parent p by a joint, its
// own marker M moves with its own modes. Twists Z = (sdot, omega) are taken about one common point
// (the origin of this evaluation), with the material-point meaning of acceleration (theory section
// 6), so no transport matrices appear:
//   Z_c = Z_p + Phi_pc ydot_p + S_c [v_c; ydot_c],  S_c = [b_c, -Psi_c]
// Residual: forward recursion of accelerations, body terms (46)-(63), backward recursion. Tangent:
// composite inertia inside a *cluster*, Schur complement between clusters. A cluster is a set of
// bodies that loop constraints or two-body forces tie together; it hangs from one parent body p and
// its front holds [x_cluster | Z_p | y_p]. For a chain every body is a cluster and the elimination
// is the O(n) articulated-body recursion; for a vehicle every suspension is one.
//
// Geometric stiffness: point forces F at r that keep their direction give, for a coordinate i above
// j on the path,
//   d(Q_j)/dq_i = omega_i . (u_j x F),  u_j = v_j + omega_j x r,
// which sums over a subtree to s_i^T G s_j with G = [0 0; -skew(sum F), V - tr(V) I], V = sum r
// F^T: it rides along with the composite inertia. Without it stiff axial loads in light rods halve
// the speed of the Newton iteration.
//
// The evaluation origin is the first body's joint point at that evaluation: positions stay small
// numbers wherever the system is on the road.
#include <algorithm>
#include <cassert>
#include <memory>
#include <span>
#include <vector>

#include "floatframe/formulation/body_inertia.hpp"
#include "floatframe/formulation/counts.hpp"
#include "floatframe/formulation/local_marker.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/force_evaluation.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model/topology.hpp"

namespace floatframe {

class RelativeFormulation {
 public:
  /// The only allocating call. Throws InputError if a body lacks the data `method` needs.
  RelativeFormulation(const Model& model, InertiaMethod method);

  int velocities() const noexcept { return nv_; }
  int configurations() const noexcept { return nq_; }
  int constraints() const noexcept { return nc_; }
  const Model& model() const noexcept { return model_; }

  /// Values of `model().inputs`, held until they are set again; at first their initial values.
  void set_inputs(std::span<const double> values) noexcept {
    assert(values.size() == inputs_.size());
    std::copy(values.begin(), values.end(), inputs_.begin());
  }
  std::span<const double> inputs() const noexcept { return inputs_; }

  /// Angles of the joint springs at the last evaluation (a number for each force): they tell which
  /// turn the next angle belongs to, so they are a part of the state that q does not hold.
  std::span<const double> spring_angles() const noexcept { return force_reference_; }
  void set_spring_angles(std::span<const double> angles) noexcept {
    assert(angles.size() == force_reference_.size());
    std::copy(angles.begin(), angles.end(), force_reference_.begin());
  }
  const Topology& topology() const noexcept { return topology_; }

  /// Start values of the model in these coordinates (before loops are closed). Turns of the springs
  /// on cut joints are counted from here on.
  void start(VecX& q, VecX& v) { start(model_, 0.0, q, v); }
  /// Those of another model that has the same bodies and joints, at time t.
  void start(const Model& values, double t, VecX& q, VecX& v);
  /// How firmly the user gave the start value of a coordinate, or (`rates`) of its rate.
  enum class Given : char { no, yes, kept };
  std::vector<Given> given_coordinates(bool rates) const;

  /// What a renewal must save, in iterations (tuned on the Iltis; a factorisation takes about 0.7).
  static constexpr double factorization_cost = 2.0;

  /// While a step is made, markers that only outputs look at are left alone; after it they are
  /// those of the next `positions` and `velocities`. What the angles of springs turned by in a step
  /// that was not accepted is forgotten.
  void stepping(bool on, bool accepted = true) noexcept {
    stepping_ = on;
    if (on)
      std::copy(force_reference_.begin(), force_reference_.end(), kept_reference_.begin());
    else if (!accepted)
      std::copy(kept_reference_.begin(), kept_reference_.end(), force_reference_.begin());
  }

  // -- the integrator's view; all noexcept and free of allocation
  // ------------------------------------------------
  void positions(double t, const VecX& q) noexcept;
  void velocities(const VecX& v) noexcept;
  /// Body inertia terms and forces at the present positions and velocities.
  void dynamics() noexcept;
  /// The forces alone.
  void forces() noexcept;
  /// out = M a - Q + Phi_q^T (alpha Phi + lambda)
  void residual(const VecX& a, const VecX& lambda, double alpha, VecX& out) noexcept;
  /// Factorises T = M mass + damping C + s (K + alpha Phi_q^T Phi_q) at the present configuration,
  /// with the forces and multipliers of the last `residual`. Returns -1 or a coordinate with a
  /// vanishing pivot. Each slot keeps one factorisation together with the directions of motion it
  /// was made with, so it solves on when the configuration has moved.
  int factorize(double mass, double damping, double s, double alpha, int slot = 0) noexcept;
  /// Factorises M + s K + penalty Phi_q^T Phi_q with the modal stiffness and that of forces,
  /// without geometric stiffness: the metric of the projections.
  int factorize_metric(double s, double penalty, int slot) noexcept;
  /// b := T^-1 b
  void solve(VecX& b, int slot = 0) noexcept;
  /// b := T^-1 (b + Phi_q^T w) and increments := Phi_q b, with the Phi_q of the factorisation.
  void solve(VecX& b, const VecX& w, VecX& increments, int slot) noexcept;
  const VecX& constraint_values() const noexcept { return phi_; }
  /// K_kk / M_kk of modal amplitudes, zero for rigid coordinates [1/s2].
  const VecX& own_frequencies_squared() const noexcept { return omega2_; }
  void constraint_rates(VecX& out) noexcept;
  void constraint_accelerations(const VecX& a, VecX& out) noexcept;
  /// out = Phi_q delta at the present configuration.
  void constraint_increments(const VecX& delta, VecX& out) noexcept;
  /// out = Phi_q^T w
  void constraint_forces(const VecX& w, VecX& out) noexcept;
  void retract(const VecX& q0, const VecX& x, VecX& q) const noexcept;
  void advance(VecX& x, const VecX& delta) const noexcept;

  // -- what outputs, energies and other formulations want
  // ---------------------------------------------------------
  const MarkerState& marker(int index) const noexcept { return markers_[index].s; }
  const Vec3& origin() const noexcept { return origin_; }
  const ForceState& force(int index) const noexcept { return force_states_[index]; }
  /// The accelerations that `marker_acceleration` uses (`residual` and `constraint_accelerations`
  /// set them too).
  void set_accelerations(const VecX& a) noexcept { accelerations(a); }
  Vec3 marker_acceleration(int index) const noexcept;
  Vec3 body_position(int body) const noexcept;
  const Mat3& body_rotation(int body) const noexcept;
  Vec3 body_angular_velocity(int body) const noexcept;
  Vec3 body_velocity(int body) const noexcept;
  double amplitude(const VecX& q, int body, int mode) const noexcept;
  double amplitude_rate(const VecX& v, int body, int mode) const noexcept;
  /// Power that modal damping takes out at these velocities [W].
  double modal_damping_power(const VecX& v) const noexcept;
  /// Power of prescribed motions with these multipliers, after `positions` [W].
  double motion_power(const VecX& lambda) const noexcept;
  double kinetic_energy(const VecX& v) noexcept;
  double gravity_energy(const VecX& q) const noexcept;
  double elastic_energy(const VecX& q) const noexcept;
  /// Wrench that a tree joint's parent exerts on its child, about the joint point (after
  /// `residual`).
  void tree_joint_wrench(int joint, Vec3& force, Vec3& torque) const noexcept;
  int tree_body_of_joint(int joint) const noexcept;

  const std::vector<ConstraintPart>& parts() const noexcept { return parts_; }
  int part_offset(std::size_t part) const noexcept { return part_offset_[part]; }
  const ConstraintRow& constraint_row(int i) const noexcept { return rows_[i]; }
  bool is_elastic(int i) const noexcept;
  /// Indices into q of the translations of free joints to the ground.
  std::vector<int> free_translations() const;
  double total_mass() const noexcept;
  /// "body 'arm'" or "joint 'hinge'" that coordinate i belongs to.
  std::string coordinate_owner(int i) const;
  /// Dense Phi_q, load time only.
  MatX constraint_jacobian();
  CoordinateCounts counts() const;
  /// Multiplications of the elimination in one factorisation (without the assembly of the fronts).
  double elimination_work() const noexcept;

 private:
  struct BodyData {
    int parent = -1, joint = -1;
    JointType type = JointType::free;
    bool reversed = false;
    int frame_F = -1, frame_M = -1;
    JointDirections axes;
    int nj = 0, nm = 0, nm_parent = 0;
    int ordered = 0;      // joint coordinates that move those after them: all but rotation vectors
    int iq = 0, iyq = 0;  // configuration offsets of joint and modes
    int iv = 0, iy = 0;   // velocity offsets
    int cluster = -1;
    double angle =
        0.0;  // of a joint of one coordinate: it, in the sense of its own parent and child
    bool phi = false, psi = false, damped = false;
    JointMotion motion;
    Vec3 r0, w;
    Mat3 A;
    Vec6 Z, D, Zdot;
    // Z_c = Z_p + Phi ydot_p + S [v_joint; ydot_c]; the columns of the own modes are -Psi, zero
    // without `psi`.
    Mat6X S, Phi;
    BodyInertia inertia;
    MatX M, T;
    VecX Qv, h, y, yd, ydd;
    Mat6X MzPhi, U;
    Vec6 wrench;
    // Point forces on this body and, while the tangent is assembled, on its subtree, scaled by s,
    // for the geometric stiffness: sum F, sum r F^T, sum Jr x F.
    Vec3 G_force;
    Mat3 G_virial;
    Mat3X G_modal;
  };
  struct MarkerData : LocalMarker {
    MarkerState s;
  };
  struct PathEntry {
    enum class What { joint, own_modes, parent_modes, marker_modes } what;
    int body, marker;
    bool side_b;
    int front, count;  // position in the front of the cluster
  };
  struct Element {  // two-marker element (constraint part or force) inside a cluster, or one-body
                    // element
    int a = -1, b = -1;
    int cluster = -1;  // -1: one body against the ground, added to the body's own matrix
    int body = -1;
    std::vector<PathEntry> path;
    int first = 0, width = 0;  // the range of the front that the path touches, in whole lanes
    int gradient = 0;  // where its rows start in Linearization::gradients (constraint parts)
  };
  struct Cluster {
    std::vector<int> bodies;   // parents before children
    int parent = -1;           // body, -1: ground
    int offset = 0, size = 0;  // velocity coordinates
    int n = 0;                 // front size
    std::vector<int> parts;    // constraint parts whose elements lie in this cluster
    VecX original, work;
  };
  /// A factorised tangent with the directions of motion it was made with.
  struct Linearization {
    struct Directions {
      Mat6X S, Phi;
    };
    std::vector<Directions> bodies;
    std::vector<MatX> fronts;       // one a cluster
    std::vector<double> gradients;  // rows of Phi_q over the ranges of their elements
  };

  void build_bodies(InertiaMethod method);
  void build_clusters();
  void build_elements();
  void count_turns_from(const Model& values, double t);
  Element make_element(int a, int b);
  int mode_front(const Cluster& c, int body) const;
  void marker_world_position(MarkerData& m) noexcept;
  void marker_world_velocity(MarkerData& m) noexcept;
  void evaluate_constraints() noexcept;
  void project(VecX& out) noexcept;  // body vectors h -> coordinates; consumes h
  void add_wrench(int marker, const Vec3& force, const Vec3& torque) noexcept;  // h += J^T wrench
  void gather_geometric(double s) noexcept;
  void add_geometric(int marker, const Vec3& force) noexcept;
  void sum_rows(std::size_t part, const VecX& w, WrenchRow& sum) const noexcept;
  void accelerations(const VecX& a) noexcept;
  // Gradient of a row over the element's range of the front, and of the three components of r_b -
  // r_a.
  void fill_gradient(const Element& e, const WrenchRow& g, double* out) const noexcept;
  void fill_distance(const Element& e, double* out) const noexcept;
  void assemble_elements(double damping, double s, double penalty, bool geometric,
                         Linearization& l) noexcept;
  int eliminate(double mass, double damping, double s, double penalty, bool geometric,
                Linearization& l) noexcept;
  void assemble_cluster(Cluster& c, MatX& front) noexcept;
  void solve_with(Linearization& l, VecX& b, const VecX* w, VecX* increments) noexcept;
  void spread(const VecX& x) noexcept;  // coordinates -> h = [Z; y] of each body
  BodyData& body(int i) noexcept { return bodies_[i]; }
  const BodyData& body(int i) const noexcept { return bodies_[i]; }
  /// The six-row columns of a path entry that is not the marker's own.
  const double* directions(const PathEntry& p) const noexcept {
    const BodyData& b = body(p.body);
    if (p.what == PathEntry::What::parent_modes) return b.Phi.data();
    return b.S.data() + (p.what == PathEntry::What::own_modes ? 6 * b.nj : 0);
  }
  MarkerData& mark(int i) noexcept { return markers_[i]; }
  const MarkerData& mark(int i) const noexcept { return markers_[i]; }

  const Model& model_;
  Topology topology_;
  std::vector<BodyData> bodies_;
  std::vector<int> order_;  // parents before children
  std::vector<MarkerData> markers_;
  // Markers on each body, except its own frame_M: those that joints, rods and forces use, then
  // those that only outputs look at.
  struct UsedMarkers {
    std::vector<int> dynamic, all;
  };
  std::vector<UsedMarkers> used_markers_;
  bool stepping_ = false;
  std::vector<ConstraintPart> parts_;
  std::vector<int> part_offset_;
  std::vector<ConstraintRow> rows_;
  std::vector<Element> part_elements_, force_elements_;
  std::vector<ForceState> force_states_;
  // Angles of joint springs at the last evaluation, which pick the turn of the next, and those at
  // the beginning of the step.
  std::vector<double> force_reference_, kept_reference_, inputs_;
  std::vector<int>
      force_tree_body_;  // joint springs on tree joints: the body whose joint it is, else -1
  std::vector<Cluster> clusters_;
  Linearization linearizations_[2];
  std::vector<int> cluster_order_;
  int nq_ = 0, nv_ = 0, nc_ = 0;
  double time_ = 0.0;
  Vec3 origin_ = Vec3::Zero();
  VecX omega2_, phi_, weights_, lambda_, slots_;
};

}  // namespace floatframe
