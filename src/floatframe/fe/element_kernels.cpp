// Access to the list of elements.
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"

namespace floatframe {

namespace {

#define FLOATFRAME_KERNEL(name) &name##_kernel,
constexpr const ElementKernel* kernel_list[] = {FLOATFRAME_FE_ELEMENTS(FLOATFRAME_KERNEL)};
#undef FLOATFRAME_KERNEL

}  // namespace

const ElementKernel& element_kernel(FeElementType type) noexcept {
  return *kernel_list[index_of(type)];
}

std::span<const FaceNodes> element_faces(FeElementType type) noexcept {
  return element_kernel(type).shape.faces;
}

int element_nodes(FeElementType type) noexcept { return element_kernel(type).nodes; }

ElementInput gather(const FeModel& model, const FeElement& element, Integration integration) {
  ElementInput input;
  input.integration = integration;
  const ElementKernel& kernel = element_kernel(element.type);
  for (int a = 0; a < kernel.nodes; ++a) {
    input.p[a] = model.positions[element.nodes[a]];
  }
  input.material = model.materials[element.material];
  const std::size_t section = element.section;
  if (kernel.family == ElementFamily::beam || kernel.family == ElementFamily::rod)
    input.section = model.sections[section];
  input.reference = element.reference;
  input.mass_form = element.mass_form;
  const Orientation* const orientation =
      element.orientation < 0 ? nullptr : &model.orientations[element.orientation];
  if (kernel.family == ElementFamily::solid) {
    if (orientation) input.orientation = *orientation;
    if (element.layup >= 0) input.plies = layup_plies(model.layups[element.layup], model.materials);
  }
  if (kernel.family == ElementFamily::panel) input.shell = model.shells[section];
  if (kernel.family == ElementFamily::shell || kernel.family == ElementFamily::membrane) {
    input.shell = model.shells[section];
    input.own_drilling = element.own_drilling;
    if (!is_plain(input.shell, input.material)) {
      input.layers = shell_layers(input.shell, input.material, model.materials);
      input.layers->axis = first_axis({input.p.data(), static_cast<std::size_t>(kernel.nodes)},
                                      orientation, element.angle);
    }
  }
  return input;
}

ShellLayers layers_of(const ElementInput& in) {
  return in.layers ? *in.layers : plain_layers(in.shell, in.material);
}

void expand_scalar_mass(const MatX& scalar, int d, MatX& out) {
  out = MatX::Zero(d * scalar.rows(), d * scalar.cols());
  for (int a = 0; a < scalar.rows(); ++a)
    for (int b = 0; b < scalar.cols(); ++b)
      out.block<3, 3>(d * a, d * b).diagonal().setConstant(scalar(a, b));
}

Mat6 elasticity_at(const ElementInput& in, const Vec3& p) {
  const Mat6 D = elasticity_matrix(in.material);
  if (!in.material.elasticity || !in.orientation) return D;
  return turned_elasticity(D, in.orientation->at(p));
}

}  // namespace floatframe
