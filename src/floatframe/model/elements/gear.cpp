// Gear: two wheels on parallel axes mesh. With the ratio i = z_2 / z_1 (turns of the driver per
// turn of the driven wheel) and the sense s = 1 of axes that point in the same direction, else -1,
//   external     q_1 + s i q_2 = 0
//   internal     q_1 - s i q_2 = 0                                                             (1)
// one row (coupled_coordinates.hpp). It exerts torques about the axes and no force of teeth.
#include "floatframe/model/coupled_coordinates.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(gear)

namespace {

constexpr const char* gear_wheels[] = {"driver", "driven"};
constexpr ElementKey gear_keys[] = {
    coordinate_key("driver", "of the first wheel, the child of the joint",
                   described_by<&Gear::driver>),
    coordinate_key("driven", "of the second wheel", described_by<&Gear::driven>),
    {.name = "ratio",
     .kind = KeyKind::number,
     .about = "turns of the driver per turn of the driven wheel",
     .rule = positive_number(""),
     .fallback = no_number,
     .member = described_by<&Gear::ratio>},
    numbers_key("teeth", "instead of `ratio`, which is driven / driver", number_of_teeth,
                gear_wheels, described_by<&Gear::teeth>),
    {.name = "internal",
     .kind = KeyKind::flag,
     .about = "one wheel is a ring around the other: both turn in the same sense",
     .member = described_by<&Gear::internal>}};

void gear_validate(const ElementCheck& check) {
  validate_coordinates(check);
  validate_ratio(check);
}

bool gear_build(ElementBuild& build) {
  if (!connect_coupled(build, "driver") || !connect_coupled(build, "driven")) return false;
  const std::vector<double> senses = senses_of_axes(build, parallel_wheels);
  if (senses.empty()) return false;
  const double sense = build.keys<Gear>().internal ? -senses[1] : senses[1];
  build.element.data = std::make_shared<CoupledSum>(CoupledSum{{1.0, sense * ratio_of(build)}});
  return true;
}

ElementExample gear_example(std::size_t, ExampleNumbers& numbers) {
  return coupled_example(Gear{.driver = {"a"}, .driven = {"b"}, .ratio = numbers(0.5, 3.0)}, 2,
                         numbers);
}

}  // namespace

constinit const ElementKind gear_element = {
    .about =
        "two wheels on parallel axes that mesh: external gears turn in opposite senses. A "
        "pure torque on each wheel about its axis, and on the housing; forces of teeth are "
        "not in it",
    .keys = gear_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(Gear()); },
    .validate = gear_validate,
    .build = gear_build,
    .rows = coupled_rows,
    .regimes = holding_regimes,
    .example = gear_example};

}  // namespace floatframe
