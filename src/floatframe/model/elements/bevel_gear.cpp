// Bevel gear: two wheels on axes that cross. With the ratio i = z_2 / z_1
//   q_1 + i q_2 = 0 of opposite, q_1 - i q_2 = 0 of the same sense,                             (1)
// one row (coupled_coordinates.hpp). Where both axes point from their crossing to the wheels, or
// both towards it, the pitch cones that roll on each other turn in opposite senses: with the
// generatrix u between e_1 and e_2, qdot_1 e_1 x u = qdot_2 e_2 x u. It exerts torques about the
// axes, also for worms and hypoid gears, and no force of teeth.
#include "floatframe/model/coupled_coordinates.hpp"
#include "floatframe/model/element_data.hpp"
#include "floatframe/model/strokes.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(bevel_gear)

namespace {

constexpr const char* bevel_gear_wheels[] = {"driver", "driven"};
constexpr ElementKey bevel_gear_keys[] = {
    coordinate_key("driver", "of the first wheel, the child of the joint",
                   described_by<&BevelGear::driver>),
    coordinate_key("driven", "of the second wheel", described_by<&BevelGear::driven>),
    {.name = "ratio",
     .kind = KeyKind::number,
     .about = "turns of the driver per turn of the driven wheel",
     .rule = positive_number(""),
     .fallback = no_number,
     .member = described_by<&BevelGear::ratio>},
    numbers_key("teeth", "instead of `ratio`, which is driven / driver", number_of_teeth,
                bevel_gear_wheels, described_by<&BevelGear::teeth>),
    {.name = "same_sense",
     .kind = KeyKind::flag,
     .about = "both angles grow together; without it one falls, as of wheels whose axes both point "
              "from the crossing outwards",
     .member = described_by<&BevelGear::same_sense>}};

void bevel_gear_validate(const ElementCheck& check) {
  validate_coordinates(check);
  validate_ratio(check);
}

bool bevel_gear_build(ElementBuild& build) {
  if (!connect_coupled(build, "driver") || !connect_coupled(build, "driven")) return false;
  const double sense = build.keys<BevelGear>().same_sense ? -1.0 : 1.0;
  build.element.data = std::make_shared<CoupledSum>(
      CoupledSum{{mirrored_sense(build, "driver"),
                  sense * mirrored_sense(build, "driven") * ratio_of(build)}});
  return true;
}

ElementExample bevel_gear_example(std::size_t, ExampleNumbers& numbers) {
  return coupled_example(BevelGear{.driver = {"a"}, .driven = {"b"}, .ratio = numbers(0.5, 3.0)}, 2,
                         numbers);
}

/// Wheels in the ratio: of what the axes cross only their joints say.
std::vector<Stroke> bevel_gear_strokes(const Model& model, const Element& element) {
  Strokes out(model, element);
  const double ratio = std::abs(data_of<CoupledSum>(element).factors[1]);
  const double r = 0.5 * out.size(out.child(0));
  out.wheels(0, std::min(r, r / ratio), 1, std::min(r, r * ratio));
  return out.take();
}

}  // namespace

constinit const ElementKind bevel_gear_element = {
    .about =
        "two wheels on axes that cross: bevel, hypoid and worm gears. A pure torque on each "
        "wheel about its axis, and on the housing; forces of teeth are not in it",
    .keys = bevel_gear_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(BevelGear()); },
    .validate = bevel_gear_validate,
    .build = bevel_gear_build,
    .rows = coupled_rows,
    .picture = picture_of_coupling,
    .strokes = bevel_gear_strokes,
    .regimes = holding_regimes};

constinit const ExampleMaker bevel_gear_examples = bevel_gear_example;

}  // namespace floatframe
