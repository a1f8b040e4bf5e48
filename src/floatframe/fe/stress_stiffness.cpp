#include "floatframe/fe/stress_stiffness.hpp"

#include <optional>
#include <utility>

#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

void element_displacements(const FeElement& e, const ElementKernel& kernel,
                           const NodalShapes& shapes, MatX& q) {
  const int d = kernel.dofs_per_node;
  q.resize(d * kernel.nodes, shapes.U.cols());
  for (int k = 0; k < kernel.nodes; ++k) {
    const Eigen::Index row = 3 * static_cast<Eigen::Index>(e.nodes[k]);
    q.middleRows<3>(d * k) = shapes.U.middleRows<3>(row);
    if (d == 6) q.middleRows<3>(6 * k + 3) = shapes.Theta.middleRows<3>(row);
  }
}

StressStiffness shares_of_stress_stiffness(const FeModel& model, const NodalShapes& modes,
                                           const NodalShapes& cases, Integration integration) {
  const Eigen::Index nm = modes.U.cols(), nc = cases.U.cols();
  PairProducts direct(nm, nc);
  std::optional<PairProducts> twist;  // taken only where there are beams
  MatX q, w, g, stress;
  std::vector<StressedPoint> points;
  for (const FeElement& e : model.elements) {
    const ElementKernel& kernel = element_kernel(e.type);
    kernel.stressed_points(gather(model, e, integration), points);
    element_displacements(e, kernel, modes, q);
    element_displacements(e, kernel, cases, w);
    for (const StressedPoint& point : points) {
      if (point.twist && !twist) twist.emplace(nm, nc);
      g.noalias() = point.gradient * q;
      stress.noalias() = point.stress * w;
      (point.twist ? *twist : direct).add(g, stress);
    }
  }
  StressStiffness out;
  out.direct = direct.take();
  if (twist) out.twist = twist->take();
  return out;
}

MatX stress_stiffness(const FeModel& model, const NodalShapes& modes, const NodalShapes& cases,
                      Integration integration) {
  StressStiffness shares = shares_of_stress_stiffness(model, modes, cases, integration);
  if (shares.twist.size() > 0) shares.direct += shares.twist;
  return std::move(shares.direct);
}

}  // namespace floatframe
