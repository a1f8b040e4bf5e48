#pragma once
// Equations of motion in natural coordinates (paper section 6.1): per body the origin r0 = p_WB,
// the axes A = [u v w] = R_WB and the modal amplitudes y, then massless outer points of flexible
// bodies, at the deformed nodes of joints and rods:
//   q_body = (r0, u, v, w, y, r_P1, r_P2, ...),   nq = 12 + nm + 3 np
//
// Constraints, rows scaled to lengths (l the body length, theory section 10):
//   of             rows      equation                                            number
//   a body         l (u.u - 1)/2, l (v.v - 1)/2, l (w.w - 1)/2 = 0               6       (1)
//                  l u.v, l u.w, l v.w = 0
//   outer points   r_P - (r0 + A (r_u + X y)) = 0                                3 each  (2)
//   joints, rods,  constraint parts between markers (constraint_set.hpp);        parts   (3)
//   motions        their positions are those of the outer points
//   A need not be orthonormal during the Newton iteration. Torques and directions of markers act
//   through
// exact where (1) holds; so a torque T has the generalised force 1/2 T x u on u, and so on.
//
// The residual is, body by body with M and Qv of (25)-(45) and gravity g taken off the acceleration
// of r0, M (a - g) - Qv + (0; K y + D ydot), less applied forces, plus Phi_q^T (lambda + alpha
// Phi).
// Linear systems. (1) and (2) are internal to a body: the motions
// that satisfy them are z = (delta r0, theta, delta y), world axes,
// with
//   delta u = theta x u, ..., delta r_P = delta r0 + theta x (r_P - r0) + J_P delta y,
//   x = B z,                                                                                  (5)
// so a tangent T acts as B^T T B, (6 + nm)^2 a body, without any penalty on (1) and (2):
// increments satisfy them exactly (`advance` rotates A by exp(theta)), and their multipliers
// balance the residual across B (`balance`). The rows (3) keep their multipliers mu, a saddle
// point,
//   [B^T T B  G^T; G  -1/penalty] [z; mu] = [B^T b; -Phi],  G = Phi_q B,                        (6)
// for the normal equations B^T T B + penalty G^T G square the condition of G: a chain of 256 links
// would have no digit left. (6) is factorised by bodies (BlockLdlt), mu of a joint with the body
// that is eliminated first; pivots are chosen only in bodies that are massless in some direction.
// The geometric stiffness in T is that of the multipliers of (1), (2), which is bilinear in A and
// y, of rods, and of joints of massless bodies: a force normal to a slide rotates with it, which
// moves a massless body by force over stiffness, for any step size.
#include <cassert>
#include <span>
#include <string>
#include <vector>

#include "floatframe/core/debug_only.hpp"
#include "floatframe/formulation/formulation.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/math/block_ldlt.hpp"
#include "floatframe/math/independent_rows.hpp"

namespace floatframe {

class AbsoluteFormulation final : public Formulation {
 public:
  /// The only allocating call. Throws InputError if a body lacks the data `method` needs.
  AbsoluteFormulation(const Model& model, InertiaMethod method);

  static constexpr Coordinates coordinates_of = Coordinates::absolute;
  Coordinates coordinates() const noexcept override { return coordinates_of; }
  ForceSide force_side(std::size_t force) const noexcept override;

  /// The same configuration and velocities as a relative state. Axes do not determine turns: the
  /// angles of joint springs are continued from those of the tree.
  void start_from(RelativeFormulation& tree, const VecX& tree_q, const VecX& tree_v, VecX& q,
                  VecX& v);

  // -- EquationsOfMotion

  /// Tuned with the Iltis benchmark.
  static constexpr double factorization_cost = 3.0;
  int velocities() const noexcept override { return nq_; }
  int configurations() const noexcept override { return nq_; }
  /// All markers are updated, also during steps.
  void stepping(bool on, bool accepted = true) noexcept override {
    force_set_.stepping(on, accepted);
  }
  void positions(double t, const VecX& q) noexcept override;
  void velocities(const VecX& v) noexcept override;
  void dynamics() noexcept override;
  void forces() noexcept override;
  void residual(const VecX& a, const VecX& lambda, double alpha, VecX& out) noexcept override;
  int factorize(double mass, double damping, double s, double alpha,
                int slot = 0) noexcept override {
    assert(calls_.has(CallOrder::residual) && (slot == 0 || slot == 1));
    const int pivot = eliminate({mass, damping, s, s * alpha, true}, factors_[slot]);
    FLOATFRAME_DEBUG(calls_.factorise(slot, pivot < 0));
    return pivot;
  }
  int factorize_metric(double s, double penalty, int slot) noexcept override {
    assert(calls_.has_masses() && (slot == 0 || slot == 1));
    const int pivot = eliminate({1.0, 0.0, s, penalty, false}, factors_[slot]);
    FLOATFRAME_DEBUG(calls_.factorise(slot, pivot < 0));
    return pivot;
  }
  double log_pivots(int slot) const noexcept override {
    assert(calls_.has_factors(slot));
    return factors_[slot].matrix.log_pivots();
  }
  void solve(VecX& b, int slot = 0) noexcept override;
  void solve(VecX& b, const VecX& phi, double penalty, VecX& mu, int slot) noexcept override;
  void balance(VecX& lambda, VecX& r) noexcept override;
  void constraint_rates(VecX& out) noexcept override;
  void constraint_accelerations(const VecX& a, VecX& out) noexcept override;
  void constraint_increments(const VecX& delta, VecX& out) noexcept override;
  void constraint_forces(const VecX& w, VecX& out) noexcept override;
  void retract(const VecX& q0, const VecX& x, VecX& q) const noexcept override {
    assert(q0.size() == nq_ && x.size() == nq_);
    q = q0 + x;
  }
  void settle(const VecX& q0, VecX& x) const noexcept override;
  /// From the present positions, with increments (5).
  void advance(VecX& x, const VecX& delta) const noexcept override;

  // -- Formulation

  void set_accelerations(const VecX& a) noexcept override {
    assert(a.size() == nq_);
    a_ = a;
    FLOATFRAME_DEBUG(calls_.accelerate());
  }
  double kinetic_energy(const VecX& v) noexcept override;
  BodyCoordinates body_coordinates(int body) const override;
  std::string coordinate_owner(int i) const override;
  CoordinateCounts counts() const override;
  SparseRowMatrix constraint_rows() override;
  VecX mass_diagonal() const override;
  /// Dense mass matrix at the present configuration (load time, tests).
  MatX mass_matrix() const;
  /// Coordinates and internal constraints of a body; those of all bodies are consecutive.
  int body_size(int i) const noexcept { return bodies_[i].size(); }
  int body_rows(int i) const noexcept { return bodies_[i].rows(); }

 private:
  // Pairs of axes of the rows (1): u.u, v.v, w.w, u.v, u.w, v.w.
  static constexpr int pair_a[6] = {0, 1, 2, 0, 0, 1};
  static constexpr int pair_b[6] = {0, 1, 2, 1, 2, 2};

  struct BodyData {
    // Fixed when the formulation is built.
    int offset = 0;                 ///< first coordinate: 12, then nm, then 3 for each point
    int nm = 0, points = 0;         ///< modes, outer points
    int row = 0;                    ///< first constraint row: 6 of (1), 3 for each point (2)
    double length = 1.0;            ///< l [m]
    std::vector<int> point_marker;  ///< for each point its marker
    // Of the configuration.
    Vec3 p_WB;  ///< origin of the body frame, world axes [m]
    Mat3 A;     ///< [u v w]: R_WB where (1) holds
    VecX y;     ///< modal amplitudes
    // Of the velocities.
    Vec3 v_WB;  ///< [m/s]
    Mat3 Adot;  ///< [1/s]
    Vec3 w_WB;  ///< (4), world axes [rad/s]
    VecX yd;    ///< modal rates
    // Terms of the equations of motion, 12 + nm.
    BodyInertia inertia;
    MatX M;
    VecX Qv, work;
    MatX K_G;  ///< of displacements of second order, only with them
    int size() const noexcept { return 12 + nm + 3 * points; }
    int rows() const noexcept { return 6 + 3 * points; }
  };
  /// A multiple of 256 bytes: addressed by an addition and a shift.
  struct alignas(256) MarkerData : LocalMarker {
    MarkerState s;   ///< on the body, world axes
    int point = -1;  ///< first coordinate of its outer point, -1 if it has none
    Vec3 r_P, v_P;   ///< position and velocity of the outer point, world axes
  };
  /// A generalised force on z of (5): the effect of a wrench at a marker on the body.
  struct Gradient {
    int body = -1;
    VecX z;
  };
  /// Positions of the multipliers of a part in (6).
  struct PartPlace {
    int home = -1;       ///< body that is eliminated first, -1: no body moves
    int at = 0;          ///< its first multiplier among the unknowns of that body
    bool turns = false;  ///< the rotation of its gradients is in T
  };
  /// T = mass M + damping C + s K, K with geometric stiffness or without, and the penalty of (6).
  struct TangentWeights {
    double mass, damping, s, penalty;
    bool geometric;
  };
  /// (6), factorised.
  struct Factors {
    BlockLdlt matrix;
    double penalty = 0.0;
  };

  void fill_poses(SystemMotion& motion) const noexcept override;
  void fill_accelerations(SystemMotion& motion) const noexcept override;
  double body_kinetic_energy(int body) const noexcept override;
  const BodyInertia& inertia(int body) const noexcept override { return bodies_[body].inertia; }
  Vec3 marker_acceleration(int index) const noexcept;

  // Load time.
  void place_outer_points();
  void number_coordinates(InertiaMethod method);
  bool lacks_mass(int i);
  void make_factors();
  // Step time. `stiffens`: of stiffens_.
  template <bool stiffens>
  void positions_of(const VecX& q) noexcept;
  template <bool stiffens>
  void velocities_of(const VecX& v) noexcept;
  template <bool stiffens>
  void settle_of(const VecX& q0, VecX& x) const noexcept;
  template <bool stiffens>
  void advance_of(VecX& x, const VecX& delta) const noexcept;
  const MarkerData& point(const BodyData& b, int p) const noexcept {
    assert(p >= 0 && p < b.points);
    return markers_[b.point_marker[p]];
  }
  /// A marker as used by constraints: at its outer point.
  MarkerState constraint_state(int marker) const noexcept;
  Vec3 point_increment(const MarkerData& m, const VecX& delta) const noexcept;
  PointMotion increment_of(int marker, const VecX& delta) const noexcept;
  PointMotion acceleration_of(int marker, const VecX& a) const noexcept;
  void add_wrench(int marker, bool through_point, const Vec3& force, const Vec3& torque,
                  VecX& out) const noexcept;
  void add_own_constraint_forces(const BodyData& b, const VecX& w, VecX& out) const noexcept;
  void add_all_constraint_forces(const VecX& w, VecX& out) const noexcept;
  void gradient(int marker, const Vec3& force, const Vec3& torque, Gradient& g) const noexcept;
  /// The gradients of a wrench on two markers into ga_ and gb_; one body is one gradient.
  void gradients(int a, int b, const WrenchRow& w) noexcept;
  void add_rank_one(BlockLdlt& matrix, double weight) noexcept;
  void add_curvature(int a, int b, const Mat12& K, BlockLdlt& matrix) noexcept;
  static void add_mass(const BodyData& b, double mass, const Mat3& stretch, MatX& f) noexcept;
  void assemble_body(const TangentWeights& t, int i, BlockLdlt& matrix) noexcept;
  void assemble_stiffening(const TangentWeights& t, BlockLdlt& matrix) noexcept;
  void assemble_forces(const TangentWeights& t, BlockLdlt& matrix) noexcept;
  void assemble_parts(const TangentWeights& t, BlockLdlt& matrix) noexcept;
  void assemble_row(const PartPlace& place, int r, BlockLdlt& matrix) noexcept;
  int eliminate(const TangentWeights& t, Factors& factors) noexcept;
  bool own_constraints_hold(const VecX& phi) const noexcept;
  void own_correction(const VecX& phi, VecX& p) const noexcept;
  void gather(const BodyData& b, const VecX& x, double* z) const noexcept;
  void spread(const BodyData& b, const double* z, VecX& x) const noexcept;

  std::vector<BodyData> bodies_;
  std::vector<MarkerData> markers_;
  std::vector<PartPlace> places_;  ///< of the constraint parts
  Factors factors_[2];
  Gradient ga_, gb_;
  MatX motions_[2], product_;  ///< of the markers of a part with z, transposed
  VecX unknowns_;              ///< of (6)
  VecX correction_, across_;   ///< increment that satisfies (1), (2); its part in (3)
  bool stiffens_ = false;      ///< a body has geometric stiffening
  bool second_order_ = false;  ///< a body has displacements of second order
  int nq_ = 0;
  VecX a_;  ///< of `set_accelerations`
};

}  // namespace floatframe
