#pragma once
// Equations of a finite-element model with spiders and linear equations eliminated: u = T q, K =
// T^T K_e T, M = T^T M_e T. A node has three degrees of freedom, six if it belongs to a beam or
// shell, is the reference of a spider or carries a rotary inertia, none if nothing uses it.
// Dependent dofs have no row of their own. Models given by matrices keep those matrices' dofs.
//   rigid spider  u_i = u_r + theta_r x (x_i - x_r)
//   mean spider   u_r, theta_r = weighted least squares of the u_i: six dofs of the nodes (chosen
//                 by pivoting) depend on q_r and the other dofs of the nodes
// Load time: allocates and throws InputError (a node that depends twice, an RBE3 whose nodes lie on
// a line, ...).
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

/// The model as points with a scalar mass, for the inertia integrals of paper equations (65)-(67):
/// the kinetic energy is 1/2 sum_kl M_s(k, l) v_k . v_l. Points are the nodes; a node whose
/// rotation carries mass (rotary inertia; matrices with rotational dofs) adds three points at p +
/// h e_x, p + h e_y, p + h e_z (h: about the size of the part) that move with it, which represents
/// its static moments and its inertia exactly. For masses that are not isotropic (a matrix whose
/// xx, yy and zz parts differ; Hermite beams) M_s is made of the mean of the three directions, and
/// `anisotropy` says how far off that is.
struct PointModel {
  Mat3X p;                  ///< 3 x N positions
  SparseRows M_s;           ///< N x N
  SparseRows T;             ///< 3N x n: translations of the points from q
  double anisotropy = 0.0;  ///< largest deviation of a mass, relative to the largest mass
};
PointModel point_model(const FeModel& model, const FeSystem& system,
                       Integration integration = Integration::exact);

}  // namespace floatframe
