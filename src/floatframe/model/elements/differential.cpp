// Differential: the mean of two shafts turns with the cage,
//   q_l + q_r - 2 q_c = 0                                                                      (1)
// with the senses of the axes: one row (coupled_coordinates.hpp). Both shafts feel the same torque,
// the cage minus their sum.
#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(differential)

namespace {

constexpr ElementKey differential_keys[] = {
    coordinate_key("left", "of a shaft, the child of the joint",
                   described_by<&DifferentialGear::left>),
    coordinate_key("right", "of the other shaft", described_by<&DifferentialGear::right>),
    coordinate_key("cage", "of what carries the bevel gears between both",
                   described_by<&DifferentialGear::cage>)};

bool differential_build(ElementBuild& build) {
  for (const char* key : {"left", "right", "cage"})
    if (!connect_coupled(build, key)) return false;
  const std::vector<double> senses = senses_of_axes(build, parallel_shafts);
  if (senses.empty()) return false;
  build.element.data = std::make_shared<CoupledSum>(CoupledSum{{1.0, senses[1], -2.0 * senses[2]}});
  return true;
}

ElementExample differential_example(std::size_t, ExampleNumbers& numbers) {
  return coupled_example(DifferentialGear{{"a"}, {"b"}, {"c"}}, 3, numbers);
}

/// Bevel gears on both shafts, and the cage about them.
std::vector<Stroke> differential_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  const double r = 0.25 * out.size(out.child(2));
  out.wheels(0, r, 1, r);
  out.wheel(out.child(2), out.axis(2), 2.0 * r, 48.0);
  return out.take();
}

}  // namespace

constinit const ElementKind differential_element = {
    .about =
        "two shafts whose mean turns with the cage: both are given the same torque. Axes may "
        "be up to a radian apart",
    .keys = differential_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(DifferentialGear()); },
    .validate = [](const ElementCheck& check) { validate_coordinates(check); },
    .build = differential_build,
    .rows = coupled_rows,
    .picture = picture_of_coupling,
    .strokes = differential_strokes,
    .regimes = holding_regimes};

constinit const ExampleMaker differential_examples = differential_example;

}  // namespace floatframe
