#pragma once
// Conditions on the integrals of any body, from any source:
//   m > 0,  P_u - m_u m_u^T / m >= 0,  S^ji = S^ij^T,  M_ff = S^11 + S^22 + S^33 >= 0,
//   M(0) = [m I, -skew(m_u), S; . , J, int r x X dm; . , . , M_ff] >= 0
// and K and D are symmetric, K > 0 (rigid motions are not among the modes), D >= 0. Semidefinite: a
// straight bar has no inertia about its axis, a mode may move no mass. Limits are relative to the
// body and allow for rounded numbers.
//
// Integrals over one distribution of mass satisfy more. With z = [X_1 X_2 X_3 r_u 1] at every
// point, their blocks are those of G = int z^T z dm >= 0, so also S^ii >= 0. Element masses that
// act on translations alone have this: G = Z^T M_s Z with M_s = (M_11 + M_22 + M_33) / 3, each
// share a diagonal block of a matrix >= 0. Masses on the rotations of nodes (beams, shells, point
// masses with inertia) do not: one M_s for the three directions must hold M_rr by P = tr(M_rr) / 2
// - M_rr and the mean of M_tt. A beam of the second moment I per length, whose slope w' carries the
// rotary inertia 6/5 - 2/5 + 1/5 = 1 by M_tt, M_tr and M_rr, has there
//   4/5 - 2/5 - 4/5 = -2/5 of int rho I f'^2 dx for a field f along its axis,
// positive only together with int rho A f^2 dx, which can be arbitrarily small for combinations of
// modes. In the kinetic energy at zero deformation, M(0), the cross directions add their rho I and
// the sum is positive.
#include <string>
#include <vector>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// One sentence about one quantity: {"P_u", "found ..., expected ..."}. Quantities are those of
/// docs/body-file.md: m, m_u, P_u, S, S1, S11, K, D.
struct InvariantError {
  std::string quantity, sentence;
};

/// Origin of the numbers.
enum class InvariantSource {
  integrals,  ///< integrals over one distribution of mass: all of G must be positive
  rotary,     ///< of elements whose nodes have rotary inertia: M(0) must be positive
  parameters  ///< of other origin: terms of second order may be estimates, stiffness may be missing
};

/// Sizes must be consistent (nothing is checked otherwise). Empty if all is well.
std::vector<InvariantError> check_invariants(const FlexibleBody& body, InvariantSource source);

}  // namespace floatframe
