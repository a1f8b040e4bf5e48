#pragma once
// The 16 inertia integrals of a finite-element body, element by element, paper equations (65)-(67).
// At every point the row z = [X_1  X_2  X_3  r_u  1] (X_i: row i of the mode shapes) is formed; the
// Gram matrix
//   G = int z^T z dm
// holds all integrals: S^ij, S^i, S, P_u, m_u and m are blocks of it.
//   isoparametric  linear elements, G = sum_e Z_e^T M_e Z_e with the scalar element mass: exact
//   hermite        beams with their cubic shape functions, five Gauss points along the axis: exact;
//                  with the section inertia the displacement of a section is
//                  u = u_0 + theta x (0, y, z), theta = (rx, -w', v')
// Point masses are included. SI units, body frame.
#include "floatframe/body/inertia_invariants.hpp"
#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// X: mode shapes, 3 or 6 rows per node (rotations are ignored), one column per mode; zero columns:
/// rigid body. Rotary inertia of point masses cannot be represented and is neglected.
InertiaInvariants invariants_isoparametric(const FeModel& model, const MatX& X);

/// X: mode shapes, 6 rows per node (3 if there are no beams).
InertiaInvariants invariants_hermite(const FeModel& model, const MatX& X, bool section_inertia);

/// Points with a scalar mass: p 3 x N, M_s N x N (symmetric, both halves stored), X 3N x nm
/// translations. G = Z^T M_s Z with Z = [X_1 X_2 X_3 r_u 1]: one sparse product and one dense one.
InertiaInvariants invariants_points(const Mat3X& p,
                                    const Eigen::SparseMatrix<double, Eigen::RowMajor>& M_s,
                                    const MatX& X);

/// The integrals for the modes X C: exact, without a mesh. C: nm x new modes.
InertiaInvariants combined(const InertiaInvariants& invariants, const MatX& C);

}  // namespace floatframe
