#include "floatframe/body/second_order.hpp"

namespace floatframe {
namespace {

/// Calls `use(matrix, sign)` for each matrix and the sign it takes in a mirror.
template <class Use>
void each_matrix(SecondOrder& out, const Vec3& s, Use&& use) {
  const Vec3 axial = s.prod() * s;
  for (int j = 0; j < 3; ++j) {
    use(out.S2[j], s(j));
    for (int i = 0; i < 3; ++i) use(out.S2i[i][j], s(i) * s(j));
    for (SecondOrderNode& node : out.nodes) {
      use(node.h[j], s(j));
      use(node.theta[j], axial(j));
    }
  }
}

}  // namespace

void add_turning(const Mat3& P, const Mat3X& theta, SecondOrder& out) {
  // int r_i (theta x (theta x r))_j dm, P = int r r^T dm, of pairs of modes.
  const Mat3X Pt = P * theta;
  const MatX square = theta.transpose() * theta;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const MatX mixed = 0.5 * theta.row(j).transpose() * Pt.row(i);
      out.S2i[i][j] += mixed + mixed.transpose() - P(i, j) * square;
    }
  }
}

SecondOrder combined(const SecondOrder& second_order, const MatX& C) {
  SecondOrder out = second_order;
  each_matrix(out, Vec3::Ones(), [&](MatX& m, double) {
    const MatX right = m * C;
    m.noalias() = C.transpose() * right;
    m = (0.5 * (m + m.transpose())).eval();
  });
  return out;
}

SecondOrder mirrored(const SecondOrder& second_order, const Vec3& s) {
  SecondOrder out = second_order;
  each_matrix(out, s, [](MatX& m, double sign) { m *= sign; });
  return out;
}

}  // namespace floatframe
