// The list of elements at work.
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

namespace {

#define FLOATFRAME_KERNEL(name) &name##_kernel,
constexpr const ElementKernel* kernel_list[] = {FLOATFRAME_ELEMENTS(FLOATFRAME_KERNEL)};
#undef FLOATFRAME_KERNEL

}  // namespace

const ElementKernel& element_kernel(ElementType type) noexcept {
  return *kernel_list[index_of(type)];
}

std::span<const FaceNodes> element_faces(ElementType type) noexcept {
  return element_kernel(type).shape.faces;
}

int element_nodes(ElementType type) noexcept { return element_kernel(type).nodes; }

ElementInput gather(const FeModel& model, const Element& element, Integration integration) {
  ElementInput input;
  input.integration = integration;
  const ElementKernel& kernel = element_kernel(element.type);
  for (int a = 0; a < kernel.nodes; ++a) {
    input.p[a] = model.positions[element.nodes[a]];
  }
  input.material = model.materials[element.material];
  const std::size_t section = element.section;
  if (kernel.family == ElementFamily::beam) input.section = model.sections[section];
  if (kernel.family == ElementFamily::shell) input.shell = model.shells[section];
  input.reference = element.reference;
  input.mass_form = element.mass_form;
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
