#pragma once
// What the integrals of any body satisfy, whoever made them. With z = [X_1 X_2 X_3 r_u 1] at every
// point, G = int z^T z dm is positive semidefinite; its blocks are the integrals. So
//   m > 0,  P_u - m_u m_u^T / m >= 0,  S^ji = S^ij^T,  S^ii >= 0,
//   M(0) = [m I, -skew(m_u), S; . , J, int r x X dm; . , . , M_ff] >= 0
// and K and D are symmetric, K > 0 (rigid motions are not among the modes), D >= 0. Semidefinite: a
// straight bar has no inertia about its axis, a mode may move no mass. Limits are relative to the
// body and leave room for rounded numbers.
#include <string>
#include <vector>

#include "floatframe/body/flexible_body.hpp"

namespace floatframe {

/// One sentence about one quantity: {"P_u", "found ..., expected ..."}. Quantities are those of
/// docs/body-file.md: m, m_u, P_u, S, S1, S11, K, D.
struct InvariantFault {
  std::string quantity, sentence;
};

/// Who made the numbers.
enum class InvariantSource {
  integrals,  ///< integrals over one distribution of mass: all of G must be positive
  parameters  ///< of other origin: terms of second order may be estimates, stiffness may be missing
};

/// Sizes must fit each other (nothing is checked if they do not). Empty if all is well.
std::vector<InvariantFault> check_invariants(const FlexibleBody& body, InvariantSource source);

}  // namespace floatframe
