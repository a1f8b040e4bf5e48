// Applied torque: direction x (magnitude(t) + input). A direction that follows the body rotates
// with it: dT = dpi x T, which is antisymmetric: the rows omit no symmetric term. A fixed direction
// has no tangent.
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

namespace {

template <class S>
void torque_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  out.force = in.signal(0).f;
  out.wrench[0].T = load_of(in, in.template keys<AppliedTorque>());
}

}  // namespace

FLOATFRAME_LAW(torque)

namespace {

constexpr auto torque_keys = load_keys<AppliedTorque>(ElementAxis::about);

bool torque_build(ElementBuild& b) { return b.connect("body", true); }

Picture torque_picture(const Element& element) {
  return picture_of_load(element, Picture::Symbol::torque, std::get<AppliedTorque>(*element.keys));
}

constexpr ElementRegime torque_regimes[] = {{.name = "fixed", .conservative = false},
                                            {.name = "following", .conservative = false}};

ElementExample torque_example(std::size_t regime, ExampleNumbers& numbers) {
  return example_load<AppliedTorque>(regime == 1, numbers);
}

}  // namespace

constinit const ElementKind torque_element = {.about = "torque on a body",
                                              .keys = torque_keys,
                                              .energy = EnergyCategory::loads,
                                              .axis = ElementAxis::about,
                                              .measured = false,
                                              .blank = [] { return ElementKeys(AppliedTorque()); },
                                              .build = torque_build,
                                              .dual = torque_law<Dual>,
                                              .picture = torque_picture,
                                              .regimes = torque_regimes};

constinit const ExampleMaker torque_examples = torque_example;

}  // namespace floatframe
