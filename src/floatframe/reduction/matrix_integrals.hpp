#pragma once
// The inertia integrals of a part given by matrices. Points of scalar mass (PointModel) have the
// mean of the three directions of its mass, so constants are added: with the rigid motions R and
// the modes X, [R X]^T M [R X] of the integrals is that of the matrix in all three blocks,
//   m, m_u, P_u     R^T M R
//   S, S^i          R^T M X: S is the upper half; the lower one is differences S^j_(k) - S^k_(j)
//   S^ii            X^T M X: the deviation of the mass of direction i from the mean goes to S^ii, a
//                   third of the remainder to each
// These are the mass matrix without deformation. The dependence of its rotary part on deformation
// (S^i, S^ij otherwise) does not follow from a matrix.
#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/fe/fe_system.hpp"

namespace floatframe {

/// R: n x 6; X: n x nm, the shapes of `integrals`.
void match_mass_matrix(const FeSystem& system, const MatX& R, const MatX& X,
                       InertiaInvariants& integrals);

}  // namespace floatframe
