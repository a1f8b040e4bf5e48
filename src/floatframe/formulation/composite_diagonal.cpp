#include "floatframe/formulation/composite_diagonal.hpp"

#include <cassert>

namespace floatframe {

VecX composite_diagonal(const TreeKinematics& tree,
                        const std::function<const MatX&(int body)>& inertia) {
  const std::size_t n = tree.bodies().size();
  std::vector<Mat6> composite(n, Mat6::Zero());
  VecX diagonal = VecX::Zero(tree.velocity_count());
  const std::vector<int>& order = tree.order();
  for (auto at = order.rbegin(); at != order.rend(); ++at) {
    const int i = *at;
    const TreeBody& b = tree.body(i);
    const MatX& M = inertia(i);
    assert(M.rows() == 6 + b.nm && M.cols() == 6 + b.nm);
    Mat6& C = composite[static_cast<std::size_t>(i)];  // of its children so far
    C += M.topLeftCorner<6, 6>();
    for (int k = 0; k < b.nj; ++k) diagonal[b.iv + k] = b.own.col(k).dot(C * b.own.col(k));
    const auto own_twist = [](const TreeBody& of, int k) {
      return of.moves_M ? Vec6(of.own.col(of.nj + k)) : Vec6(Vec6::Zero());
    };
    for (int k = 0; k < b.nm; ++k) {
      const Vec6 z = own_twist(b, k);
      diagonal[b.iy + k] += M(6 + k, 6 + k) + 2.0 * z.dot(M.block<6, 1>(0, 6 + k)) +
                            z.dot(M.topLeftCorner<6, 6>() * z);
    }
    if (b.parent < 0) continue;
    const TreeBody& p = tree.body(b.parent);
    for (int k = 0; k < p.nm; ++k) {
      Vec6 z = own_twist(p, k);
      if (b.parent_moves_F) z += b.of_parent.col(k);
      diagonal[p.iy + k] += z.dot(C * z);
    }
    composite[static_cast<std::size_t>(b.parent)] += C;
  }
  return diagonal;
}

}  // namespace floatframe
