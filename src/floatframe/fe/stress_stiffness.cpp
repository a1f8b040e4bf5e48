#include "floatframe/fe/stress_stiffness.hpp"

#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {
namespace {

/// Points whose products are gathered for one dense product.
constexpr Eigen::Index batch = 48;

/// Products of the gradients g (rows 3 i + j: du_i/dx_j, one column a mode) of all pairs of modes,
/// six columns (xx, yy, zz, xy, yz, zx).
void products(const MatX& g, Eigen::Ref<MatX> P) {
  constexpr int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  const MatX rows = g.transpose();  // a mode's neighbours lie next to each other
  for (int c = 0; c < 6; ++c) {
    const int j = at[c][0], k = at[c][1];
    double* column = P.col(c).data();
    for (Eigen::Index a = 0; a < rows.rows(); ++a) {
      Eigen::Map<VecX> to(column, a + 1);
      to = rows(a, j) * rows.col(k).head(a + 1) + rows(a, 3 + j) * rows.col(3 + k).head(a + 1) +
           rows(a, 6 + j) * rows.col(6 + k).head(a + 1);
      if (j != k)
        to += rows(a, k) * rows.col(j).head(a + 1) + rows(a, 3 + k) * rows.col(3 + j).head(a + 1) +
              rows(a, 6 + k) * rows.col(6 + j).head(a + 1);
      column += a + 1;
    }
  }
}

}  // namespace

void element_displacements(const Element& e, const ElementKernel& kernel, const NodalShapes& shapes,
                           MatX& q) {
  const int d = kernel.dofs_per_node;
  q.resize(d * kernel.nodes, shapes.U.cols());
  for (int k = 0; k < kernel.nodes; ++k) {
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(e.nodes[k]);
    q.middleRows<3>(d * k) = shapes.U.middleRows<3>(row);
    if (d == 6) q.middleRows<3>(6 * k + 3) = shapes.Theta.middleRows<3>(row);
  }
}

MatX stress_stiffness(const FeModel& model, const NodalShapes& modes, const NodalShapes& cases,
                      Integration integration) {
  const Eigen::Index nm = modes.U.cols(), pairs = nm * (nm + 1) / 2, nc = cases.U.cols();
  MatX K = MatX::Zero(pairs, nc), P(pairs, 6 * batch), S(nc, 6 * batch);
  MatX q, w, g;
  std::vector<StressedPoint> points;
  Eigen::Index filled = 0;
  const auto flush = [&] {
    K.noalias() += P.leftCols(6 * filled) * S.leftCols(6 * filled).transpose();
    filled = 0;
  };
  for (const Element& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    kernel.stressed_points(gather(model, e, integration), points);
    element_displacements(e, kernel, modes, q);
    element_displacements(e, kernel, cases, w);
    for (const StressedPoint& point : points) {
      g.noalias() = point.gradient * q;
      products(g, P.middleCols(6 * filled, 6));
      S.middleCols(6 * filled, 6).noalias() = w.transpose() * point.stress.transpose();
      if (++filled == batch) flush();
    }
  }
  flush();
  return K;
}

MatX symmetric_of(const Eigen::Ref<const VecX>& packed) {
  Eigen::Index n = 0;
  while (n * (n + 1) / 2 < packed.size()) ++n;
  MatX out(n, n);
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) out(i, j) = out(j, i) = packed(k++);
  return out;
}

}  // namespace floatframe
