// Applied force: direction x (magnitude(t) + input). A direction that follows the body rotates with
// it; a fixed one has no tangent.
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

namespace {

template <class S>
void force_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  out.force = in.signal(0).f;
  out.wrench[0].F = load_of(in, in.template keys<AppliedForce>());
}

}  // namespace

FLOATFRAME_LAW(force)

namespace {

constexpr auto keys_of_force = load_keys<AppliedForce>(ElementAxis::along);

bool force_build(ElementBuild& b) { return b.connect("body", b.flag("follows")); }

Picture force_picture(const Element& element) {
  return picture_of_load(element, Picture::Symbol::force, std::get<AppliedForce>(*element.keys));
}

constexpr ElementRegime force_regimes[] = {
    {.name = "fixed", .conservative = false},
    {.name = "following",
     .rows_leave_out = "the turning of the load with its body",
     .conservative = false}};

ElementExample force_example(std::size_t regime, ExampleNumbers& numbers) {
  return example_load<AppliedForce>(regime == 1, numbers);
}

}  // namespace

constinit const ElementKind force_element = {.about = "force on a point of a body",
                                             .keys = keys_of_force,
                                             .energy = EnergyCategory::loads,
                                             .measured = false,
                                             .blank = [] { return ElementKeys(AppliedForce()); },
                                             .build = force_build,
                                             .dual = force_law<Dual>,
                                             .picture = force_picture,
                                             .regimes = force_regimes};

constinit const ExampleMaker force_examples = force_example;

}  // namespace floatframe
