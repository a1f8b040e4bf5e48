#pragma once
// Linear systems of the absolute formulation. The rows (1) and (2) of absolute_kinematics.hpp are
// internal to a body: the motions that satisfy them are z = (delta r0, theta, delta y), world axes,
// with
//   delta u = theta x u, ..., delta r_P = delta r0 + theta x (r_P - r0) + J_P delta y,
//   x = B z,                                                                                  (5)
// so a tangent T acts as B^T T B, (6 + nm)^2 a body, without any penalty on (1) and (2):
// increments satisfy them exactly, and their multipliers balance the residual across B (`balance`).
// The rows (3) of the parts keep their multipliers mu, a saddle point,
//   [B^T T B  G^T; G  -1/penalty] [z; mu] = [B^T b; -Phi],  G = Phi_q B,                        (6)
// for the normal equations B^T T B + penalty G^T G square the condition of G: a chain of 256 links
// would have no digit left. (6) is factorised by bodies (BlockLdlt), mu of a joint with the body
// that is eliminated first; pivots are chosen only in bodies that are massless in some direction.
// The geometric stiffness in T is that of the multipliers of (1), (2), which is bilinear in A and
// y, of rods, and of joints of massless bodies: a force normal to a slide rotates with it, which
// moves a massless body by force over stiffness, for any step size.
//
// With A orthonormal, (1) depends on the stretch part A E of delta A, E symmetric, and not on A x
// skew. So the rows (1) with values phi are satisfied by delta A = -1/2 A E with
//   E_kk = 2 phi_kk / l,  E_ab = phi_ab / l,                                                    (7)
// and multipliers of (1) balance the stretch of a residual R_A = [R_u R_v R_w]:
//   R_A + l A W,  W = -sym(A^T R_A) / l, has none.                                              (8)
#include <vector>

#include "floatframe/formulation/absolute_kinematics.hpp"
#include "floatframe/formulation/body_inertia.hpp"
#include "floatframe/formulation/element_set.hpp"
#include "floatframe/math/block_ldlt.hpp"

namespace floatframe {

class AbsoluteTangent {
 public:
  /// T = mass M + damping C + s K, K with geometric stiffness or without, and the penalty of (6).
  struct Weights {
    double mass, damping, s, penalty;
    bool geometric;
  };

  /// The references must outlive this, with constant addresses; `terms` are of the undeformed
  /// bodies now, of the last evaluation in steps. Allocates.
  AbsoluteTangent(const AbsoluteKinematics& kinematics, const ConstraintSet& constraints,
                  const ElementSet& forces, const std::vector<BodyTerms>& terms);

  // Step time: noexcept, free of allocation. EquationsOfMotion says what they return.
  int factorize(const Weights& t, int slot) noexcept;
  double log_pivots(int slot) const noexcept { return factors_[slot].log_pivots(); }
  void solve(VecX& b, int slot) noexcept;
  void solve(VecX& b, const VecX& phi, double penalty, VecX& mu, int slot) noexcept;
  void balance(VecX& lambda, VecX& r) const noexcept;

 private:
  /// A generalised force on z of (5): the effect of a wrench at a marker on the body.
  struct Gradient {
    int body = -1;
    VecX z;
  };
  /// Positions of the multipliers of a part in (6).
  struct PartPlace {
    /// Body that is eliminated first, -1: no body moves, or the part continues another.
    int home = -1;
    int at = 0;                ///< its first multiplier among the unknowns of that body
    bool turns = false;        ///< the rotation of its gradients is in T
    std::vector<int> markers;  ///< of its rows, those of parts that continue them included
  };

  bool lacks_mass(int body) const;
  void gradient(int marker, const Vec3& force, const Vec3& torque, Gradient& g) const noexcept;
  /// The gradients of wrenches on markers into gradients_; those of a body in the first one of it.
  void gradients(std::span<const int> markers, const Wrench* w) noexcept;
  /// Of a row between the two markers of a part: the same without loops.
  void gradients(const ConstraintPart& p, const WrenchRow& w) noexcept;
  /// Adds gradient i to that of the same body before it.
  void join_gradient(std::size_t i) noexcept;
  void add_rank_one(BlockLdlt& matrix, double weight) noexcept;
  void add_product(const Gradient& a, const Gradient& b, double weight, BlockLdlt& matrix) noexcept;
  void add_curvature(int a, int b, const Mat12& K, BlockLdlt& matrix) noexcept;
  void add_mass(int body, double mass, const Mat3& stretch, MatX& f) const noexcept;
  void assemble_body(const Weights& t, int i, BlockLdlt& matrix) const noexcept;
  void assemble_stiffening(const Weights& t, BlockLdlt& matrix) noexcept;
  void assemble_forces(const Weights& t, BlockLdlt& matrix) noexcept;
  void assemble_parts(const Weights& t, BlockLdlt& matrix) noexcept;
  void assemble_row(const PartPlace& place, int r, BlockLdlt& matrix) noexcept;
  bool own_constraints_hold(const VecX& phi) const noexcept;
  void own_correction(const VecX& phi, VecX& p) const noexcept;
  void gather(const AbsoluteBody& b, const VecX& x, double* z) const noexcept;
  void spread(const AbsoluteBody& b, const double* z, VecX& x) const noexcept;

  const Model& model_;
  const AbsoluteKinematics& kinematics_;
  const std::vector<AbsoluteBody>& bodies_;
  const std::vector<AbsoluteMarker>& markers_;
  const ConstraintSet& constraints_;
  const ElementSet& forces_;
  const std::vector<BodyTerms>& terms_;
  std::vector<PartPlace> places_;    ///< of the constraint parts
  BlockLdlt factors_[2];             ///< of (6)
  std::vector<Gradient> gradients_;  ///< of one row
  std::vector<Wrench> row_;          ///< of a part
  std::size_t gradient_count_ = 0;
  MatX motions_[2], product_;  ///< of the markers of a part with z, transposed
  VecX unknowns_;              ///< of (6)
  VecX correction_, across_;   ///< increment that satisfies (1), (2); its part in (3)
  std::vector<MatX> K_G_;      ///< of bodies with displacements of second order
  bool second_order_ = false;  ///< a body has them
};

}  // namespace floatframe
