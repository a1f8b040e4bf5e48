#pragma once
// A body for multibody simulation: invariants, modal stiffness and damping, and the modal rows
// of its nodes. Deformation of node k: p_BP = p + X y, R = exp(skew(X_theta y)). A rigid body is a
// body with zero modes. Everything is in the body frame B, SI units. Immutable once built and
// shared between bodies and threads.
#include <Eigen/SparseCore>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/body/second_order.hpp"

namespace floatframe {

struct ModalNode {
  std::string name;  ///< empty if the node has no name
  Vec3 p = Vec3::Zero();
  Mat3X X;        ///< 3 x nm, translation of the node per modal amplitude
  Mat3X X_theta;  ///< 3 x nm, rotation vector of the node per modal amplitude [rad]; zero for solid
                  ///< elements
};

/// Treatment of the finite-element mass in the inertia terms.
enum class MassModel {
  isoparametric,  ///< three rows per node, scalar mass of linear elements; projection and
                  ///< preprocessing
  six_dof,  ///< 6 dofs per node, consistent element mass, rotated blocks (12)-(15); projection only
  hermite   ///< exact integrals of the cubic Hermite beam; preprocessing only
};

/// Data of the projection method (12)-(15). Exactly one of the two groups is filled.
struct ProjectionData {
  Mat3X p;  ///< 3 x n undeformed node positions
  MatX X;   ///< 3n x nm modal translations
  /// isoparametric: scalar mass matrix, n x n, row major, both halves stored.
  Eigen::SparseMatrix<double, Eigen::RowMajor> M_s;
  /// six_dof: modal rotations 3n x nm and consistent mass, 6n x 6n (ux uy uz rx ry rz a node), body
  /// axes.
  MatX X_theta;
  Eigen::SparseMatrix<double, Eigen::RowMajor> M_6;
  /// Bars only, else empty: (3 nm) n x nm, rows nm (3 k + j) and on are h_j of node k
  /// (SecondOrder).
  MatX h;
  /// Points that rotate about another one, isoparametric only: with theta = rotation y that of the
  /// node both are fixed to, the point has a displacement of second order 1/2 theta x (theta x
  /// arm) (SecondOrder, `FlexibleBody::turning`). Ascending by point.
  struct TurningPoint {
    int point = -1;
    int rotation = -1;        ///< rows 3 rotation .. 3 rotation + 2 of `rotations`
    Vec3 arm = Vec3::Zero();  ///< body axes [m]
  };
  std::vector<TurningPoint> turning;
  MatX rotations;  ///< 3r x nm
  /// The twist of second order of beams: integrals that add to those of the points; null: none.
  std::shared_ptr<const SecondOrder> twist = nullptr;
  bool six_dof() const noexcept { return M_6.rows() > 0; }
  int nodes() const noexcept { return static_cast<int>(p.cols()); }
};

struct BodyShape;
struct BodyStress;

/// Mounting of a body: bit 0..5 of `mask` = ux..rz of a node, along the axes of the body.
struct InterfaceDofs {
  int node = -1;  ///< in FlexibleBody::nodes
  unsigned mask = 63u;
};

struct FlexibleBody {
  InertiaInvariants invariants;
  MatX K;                        ///< nm x nm modal stiffness, symmetric
  MatX D;                        ///< nm x nm modal damping, symmetric (zero by default)
  std::vector<ModalNode> nodes;  ///< FE nodes, in the order of the FE model; empty for a rigid body
  std::shared_ptr<const ProjectionData> projection;  ///< null: only preprocessing is possible
  MassModel mass_model = MassModel::isoparametric;
  /// Displacements of second order of masses fixed to nodes that rotate - sections, thicknesses,
  /// discs - and the twist of second order of beams, on the masses: always part of the inertia
  /// terms. No nodes; null: no rotating mass.
  std::shared_ptr<const SecondOrder> turning = nullptr;
  /// The others, for geometric stiffening: foreshortening, and the effect of loads on all of them.
  /// Without those in `turning`. null: unknown.
  std::shared_ptr<const SecondOrder> second_order = nullptr;

  // Information about the reduction for the user.
  VecX fixed_interface_frequencies;  ///< [Hz], of the dynamic modes kept
  /// Dynamic modes omitted that have the frequency of the last one kept; 0: none, or unknown.
  int equal_left_out = 0;
  std::vector<std::string> mode_names;

  /// Its appearance; null: unknown.
  std::shared_ptr<const BodyShape> shape = nullptr;
  /// Its stress; null: unknown.
  std::shared_ptr<const BodyStress> stress = nullptr;
  /// Supports in the modes of the mounted body; empty: unknown, or none.
  std::vector<InterfaceDofs> interfaces;

  int modes() const noexcept { return invariants.modes(); }
};

}  // namespace floatframe
