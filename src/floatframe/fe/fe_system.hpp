#pragma once
// Equations of a finite-element model with spiders and linear equations eliminated: u = T q, K =
// T^T K_e T, M = T^T M_e T. A node has three degrees of freedom, six if it belongs to a beam or
// T^T K_e T, M = T^T M_e T. A node has three degrees of freedom, six if it belongs to a beam or
// Dependent dofs have no row. Models given by matrices keep those matrices' dofs.
//   rigid spider  u_i = u_r + theta_r x (x_i - x_r)
//   mean spider   u_r, theta_r = weighted least squares of the u_i: six dofs of the nodes (chosen
//                 by pivoting) depend on q_r and the other dofs of the nodes
// Load time: allocates and throws InputError (a node that depends twice, an RBE3 with collinear
// nodes, ...).
#include <vector>

#include "floatframe/fe/fe_model.hpp"
#include "floatframe/fe/integration.hpp"

namespace floatframe {

struct FeSystem {
  SparseMatrix K, M;       ///< n x n, symmetric, both halves stored
  std::vector<Dof> dofs;   ///< of each row, ordered by node, then axis
  std::vector<int> first;  ///< row of the node's ux; -1: dependent (even in part), or not used. A
                           ///< free node's dofs follow each other
  std::vector<int> begin;  ///< rows begin[k] .. begin[k + 1] - 1 are of node k; nodes + 1 long
  /// Translations of all nodes, 3 nodes() x n: u = T q.
  SparseRows T;
  /// Rotations of all nodes, 3 nodes() x n; rows of nodes without rotation are empty.
  SparseRows T_theta;

  int size() const noexcept { return static_cast<int>(dofs.size()); }
  /// Row of a dof; -1 if it has none.
  int row(int node, int axis) const noexcept;
};

FeSystem assemble(const FeModel& model, Integration integration = Integration::exact);

/// A point moves with a rotation: with theta of that rotation it has a displacement of second order
/// 1/2 theta x (theta x arm).
struct PointArm {
  int point = -1;
  int rotation = -1;  ///< rows 3 rotation .. 3 rotation + 2 of PointModel::rotations
  Vec3 arm = Vec3::Zero();
};

/// The model as points with a scalar mass, for the inertia integrals of paper equations (65)-(67):
/// the kinetic energy is 1/2 sum_kl M_s(k, l) v_k . v_l. Points are the nodes. A node whose
/// rotation carries mass (rotary inertia; matrices with rotational dofs) adds three points at p +
/// h e_x, p + h e_y, p + h e_z (h: about the size of the part) that move with it, which represents
/// its static moments and its inertia exactly. Elements whose mass differs between directions
/// (Hermite beams) are sums of stations (ElementKernel::mass_stations): each adds its centre and a
/// point on an arm for each of its second moments. So kinetic energy is that of the system.
/// Matrices of another program may differ between directions too; M_s is the mean of the
/// three there, and `anisotropy` is the resulting deviation.
struct PointModel {
  Mat3X p;                  ///< 3 x N positions
  SparseRows M_s;           ///< N x N
  SparseRows T;             ///< 3N x n: translations of the points from q
  double anisotropy = 0.0;  ///< largest deviation of a mass, relative to the largest mass
  bool rotary = false;      ///< do rotations carry mass

  // Displacements of second order.
  SparseRows rotations;        ///< 3r x n
  std::vector<PointArm> arms;  ///< ascending; a point that is fixed to several has several
  /// For points that also belong to solids, rods or membranes and are bent by these: a part of
  /// geometric stiffening.
  std::vector<PointArm> strained_arms;
  std::vector<PointArm> followers;  ///< of nodes that are fixed to other nodes (rigid_leaders)
};
/// Smaller values are rounding of numbers in files.
inline constexpr double least_anisotropy = 1e-9;

PointModel point_model(const FeModel& model, const FeSystem& system,
                       Integration integration = Integration::exact);

}  // namespace floatframe
