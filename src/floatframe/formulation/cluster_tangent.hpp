#pragma once
// The tangent of a tree, factorised by clusters (theory section 10):
//   T = mass M + damping C + s (K + geometric stiffness) + penalty Phi_q^T Phi_q               (1)
// Each cluster has a front, a dense symmetric matrix over [x | Z_p | y_p]: its coordinates, twist
// and amplitudes of its parent body p. Leaves to root, for each body c of the cluster with its (6 +
// nm)^2 matrix T_c = [Mz N^T; N Y], which contains its inertia, stiffness, forces against the
// ground and the contributions of its children, and its directions S = [b, -Psi]
// (`TreePosition::own`):
//   U       = Mz S + [0, N^T]             wrench due to a unit of each coordinate              (2)
//   own     S^T U + [0, N^T]^T S + [0, Y]   onto the diagonal of the front                     (3)
//   above   U^T S_d, U^T Phi_d, U         with the coordinates of each body d on the way to p,
//                                         with modes of parents, with (Z_p, y_p)               (4)
//   parent  Mz, Mz Phi, Phi^T Mz Phi      into T_p: composite inertia                          (5)
// Elements of the cluster add w g g^T. Then LDL^T eliminates x, and the Schur complement of the
// front at (Z_p, y_p) is added to T_p. For a chain this is the articulated-body recursion, O(n).
//
// Geometric stiffness: point forces F at r with constant direction give, for a coordinate i above j
// on the path,
//   d(Q_j)/dq_i = omega_i . (u_j x F),  u_j = v_j + omega_j x r,                               (6)
// which sums over a subtree to s_i^T G s_j with the twists s of the coordinates and
//   G = [0 0; -skew(sum F), V - tr(V) I],  V = sum r F^T:                                      (7)
// it is accumulated with the composite inertia, in U. Modes give columns sum Jr x F. Forces are
// those of force elements and multipliers. Without it large axial loads in light rods halve the
// speed of convergence of the Newton iteration.
#include <vector>

#include "floatframe/formulation/body_inertia.hpp"
#include "floatframe/formulation/clusters.hpp"
#include "floatframe/formulation/constraint_set.hpp"
#include "floatframe/formulation/element_set.hpp"
#include "floatframe/formulation/tree_element.hpp"
#include "floatframe/formulation/tree_kinematics.hpp"
#include "floatframe/math/independent_rows.hpp"
#include "floatframe/math/profile_ldlt.hpp"

namespace floatframe {

class ClusterTangent {
 public:
  /// The factors of (1).
  struct Weights {
    double mass = 1.0, damping = 0.0, s = 0.0, penalty = 0.0;
    bool geometric = false;
  };

  /// The references must outlive this, with constant addresses and final numbering. Allocates.
  ClusterTangent(const TreeKinematics& tree, const ConstraintSet& constraints,
                 const ElementSet& forces, std::vector<Cluster> clusters);
  ClusterTangent(const ClusterTangent&) = delete;
  ClusterTangent& operator=(const ClusterTangent&) = delete;

  // Step time: noexcept, free of allocation.
  /// Factorises at the present positions with the body terms, force states and multipliers of the
  /// last evaluation. Returns -1, or a coordinate with a vanishing pivot. A slot keeps one
  /// factorisation with its directions of motion, so it remains valid for solutions after the
  /// configuration has moved.
  int factorize(const std::vector<BodyTerms>& terms, const Weights& weights, int slot) noexcept;
  /// Sum of the logarithms of the pivots.
  double log_pivots(int slot) const noexcept;
  /// The number of negative pivots, equal to that of negative eigenvalues of (1).
  int negative_pivots(int slot) const noexcept;
  /// b := T^-1 b
  void solve(VecX& b, int slot) noexcept { solve(b, nullptr, nullptr, slot); }
  /// b := T^-1 (b + Phi_q^T w), increments := Phi_q b with the Phi_q of the factorisation.
  void solve(VecX& b, const VecX& w, VecX& increments, int slot) noexcept {
    solve(b, &w, &increments, slot);
  }

  /// Phi_q at the present positions; load time.
  SparseRowMatrix constraint_rows();

 private:
  /// The matrices of a body while the fronts are assembled. World axes, about O.
  struct BodyTangent {
    const FlexibleBody* data = nullptr;
    MatX T;          ///< (6 + nm)^2: [Mz N^T; N Y]
    Mat6X U;         ///< (2), 6 x (nj + nm)
    Mat6X Mz_Phi;    ///< Mz Phi, 6 x nm_parent
    Vec3 G_force;    ///< sum F [N], of its subtree, times s
    Mat3 G_virial;   ///< V = sum r F^T [N m], times s
    Mat3 G_angular;  ///< V - tr(V) I
    Mat3X G_modal;   ///< sum Jr x F, 3 x nm, times s
    MatX K_G;        ///< of displacements of second order, only with them; times s
  };
  /// Scratch of a cluster.
  struct Front {
    std::vector<int> parts;  ///< constraint parts whose elements belong to this cluster
    VecX original, work;
    FrontProfile profile;  ///< of a mostly zero front
  };
  /// Directions of motion of a body.
  struct Directions {
    Mat6X own, of_parent;
  };
  struct Factors {
    std::vector<Directions> bodies;
    std::vector<MatX> fronts;       ///< one for each cluster
    std::vector<double> gradients;  ///< rows of Phi_q over the ranges of their elements
  };

  void make_elements();
  FrontProfile profile_of(std::size_t cluster) const;
  void clear_geometric() noexcept;
  void gather_geometric(double s) noexcept;
  void add_geometric(int marker, const Vec3& force) noexcept;
  void add_stiffening(const std::vector<BodyTerms>& terms, double s) noexcept;
  void load_bodies(const std::vector<BodyTerms>& terms, const Weights& w, Factors& f) noexcept;
  void assemble_forces(const Weights& w, Factors& f) noexcept;
  void assemble_own_row(const TreeElement& e, const Wrench* g, double weight) noexcept;
  void assemble_parts(const Weights& w, Factors& f) noexcept;
  void assemble_cluster(const Cluster& c, MatX& front) noexcept;
  void find_products(int i) noexcept;                                       // (2)
  void add_own(const Cluster& c, int i, MatX& front) noexcept;              // (3), (7)
  void add_couplings(const Cluster& c, int i, MatX& front) const noexcept;  // (4)
  void add_to_parent(const Cluster& c, int i, MatX& front) noexcept;        // (5)
  void hand_front_to_parent(const Cluster& c, const MatX& front) noexcept;
  void solve(VecX& x, const VecX* w, VecX* increments, int slot) noexcept;
  void add_part_loads(const Factors& f, std::size_t k, const VecX& w) noexcept;
  void gather_loads(const Factors& f, std::size_t k) noexcept;
  void part_increments(const Factors& f, std::size_t k, VecX& increments) const noexcept;
  void spread_increments(const Factors& f, std::size_t k) noexcept;

  const TreeKinematics& tree_;
  const ConstraintSet& constraints_;
  const ElementSet& forces_;
  std::vector<Cluster> clusters_;  ///< parents before children
  std::vector<Front> fronts_;
  std::vector<BodyTangent> bodies_;
  std::vector<TreeElement> part_elements_, force_elements_;
  Factors factors_[2];
  BodyVectors loads_, increments_;  ///< of `solve`: wrenches inwards, motions outwards
  VecX scratch_;                    ///< rows of an element
  std::vector<Wrench> row_;         ///< gradient of a constraint row
  bool second_order_ = false;       ///< a body has displacements of second order
};

}  // namespace floatframe
