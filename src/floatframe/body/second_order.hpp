#pragma once
// Displacements of second order in the modal amplitudes: the cause of stiffening by spin or load.
// A bar that bends pulls its end inwards; so does a body of any shape:
//   u(x) = X y + 1/2 sum_j e_j (y^T h_j(x) y),   h_j symmetric, body axes
// with the field u2 = 1/2 sum_j e_j y^T h_j y that relaxes the strains of second order of the
// deformation X y,
//   u2 = argmin of the strain energy of eps2(X y) + eps1(u2),  eps2 = 1/2 grad u^T grad u,
// u2 = 0 where the body reference holds the body. The remaining strain is orthogonal to all
// compatible ones, so the strain energy stays 1/2 y^T K y to fourth order: stress that modes carry
// is not counted twice. The work of a load f on u2 is that of its stress on eps2,
//   f . u2 = -int sigma(f) : eps2(X y) = -1/2 y^T K_sigma(f) y,
// with the stress stiffness K_sigma of the linear static solution under f. Straight bars: theory,
// section 8; there h_1 = -H, the foreshortening.
//
// The integrals continue S and Si of the inertia integrals: with
// S(y) = S + y^T S2, Si(y) = Si + y^T S2i the mass matrix is that of u to first order in y.
#include <array>
#include <vector>

#include "floatframe/math/types.hpp"

namespace floatframe {

/// The h of one node.
struct SecondOrderNode {
  int node = -1;              ///< in FlexibleBody::nodes
  std::array<MatX, 3> h;      ///< nm x nm: -K_sigma of a unit force along body axis j [1/m per ..]
  std::array<MatX, 3> theta;  ///< the same of a unit moment: rotation of second order [rad]
};

struct SecondOrder {
  std::array<MatX, 3> S2;                  ///< int h_j dm = -K_sigma of a load rho e_j
  std::array<std::array<MatX, 3>, 3> S2i;  ///< [i][j]: int r_ui h_j dm: of a load rho r_ui e_j
  std::vector<SecondOrderNode> nodes;      ///< ascending; nodes that are not here have none

  /// All zero, for nm modes, without nodes.
  static SecondOrder zero(int nm) {
    SecondOrder s;
    s.S2.fill(MatX::Zero(nm, nm));
    for (auto& row : s.S2i) row.fill(MatX::Zero(nm, nm));
    return s;
  }
};

/// Adds to S2i the second order 1/2 theta x (theta x r) of a rigid piece that rotates with modes
/// `theta` (3 x nm) about its centre of mass. P = int r r^T dm.
void add_turning(const Mat3& P, const Mat3X& theta, SecondOrder& out);

/// The same in the modes X C. C: nm x new modes.
SecondOrder combined(const SecondOrder& second_order, const MatX& C);
/// For the mirrored body: s holds the signs of the coordinates.
SecondOrder mirrored(const SecondOrder& second_order, const Vec3& s);

}  // namespace floatframe
