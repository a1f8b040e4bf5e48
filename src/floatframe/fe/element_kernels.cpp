#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

std::span<const ElementKernel> element_kernels() {
  static const ElementKernel list[] = {beam2_kernel,  beam3_kernel, tri3_kernel,   quad4_kernel,
                                       tet4_kernel,   tet10_kernel, hex8_kernel,   hex8i_kernel,
                                       hex8r_kernel,  hex20_kernel, hex20r_kernel, wedge6_kernel,
                                       wedge15_kernel};
  return list;
}

const ElementKernel& element_kernel(ElementType type) {
  for (const ElementKernel& kernel : element_kernels()) {
    if (kernel.type == type) return kernel;
  }
  return element_kernels().front();
}

ElementInput gather(const FeModel& model, const Element& element, Integration integration) {
  ElementInput input;
  input.integration = integration;
  const ElementKernel& kernel = element_kernel(element.type);
  for (int a = 0; a < kernel.nodes; ++a) {
    input.p[a] = model.positions[element.nodes[a]];
  }
  input.material = model.materials[element.material];
  const std::size_t section = element.section;
  if (is_beam(element.type)) input.section = model.sections[section];
  if (is_shell(element.type)) input.shell = model.shells[section];
  input.reference = element.reference;
  return input;
}

Mat6 elasticity_matrix(const Material& material) {
  const double nu = material.poisson;
  const double c = material.young / ((1.0 + nu) * (1.0 - 2.0 * nu));
  Mat6 D = Mat6::Zero();
  D.topLeftCorner<3, 3>().setConstant(c * nu);
  for (int i = 0; i < 3; ++i) {
    D(i, i) = c * (1.0 - nu);
    D(3 + i, 3 + i) = material.shear();
  }
  return D;
}

}  // namespace floatframe
