// Belt: two pulleys on parallel axes with a belt or chain that neither slips nor stretches. With
// the sense s = 1 of axes that point in the same direction, else -1,
//   q_1 - s (r_2 / r_1) q_2 = 0,  crossed q_1 + s (r_2 / r_1) q_2 = 0:                          (1)
// one row (coupled_coordinates.hpp), whose force is the torque on the driver.
#include "floatframe/model/coupled_coordinates.hpp"

namespace floatframe {

FLOATFRAME_NO_LAW(belt)

namespace {

constexpr const char* belt_pulleys[] = {"driver", "driven"};
constexpr ElementKey belt_keys[] = {
    coordinate_key("driver", "of the first pulley, the child of the joint",
                   described_by<&BeltDrive::driver>),
    coordinate_key("driven", "of the second pulley", described_by<&BeltDrive::driven>),
    numbers_key("radii", "of the pulleys", positive_number("m"), belt_pulleys,
                described_by<&BeltDrive::radii>, true),
    {.name = "crossed",
     .kind = KeyKind::flag,
     .about = "the belt crosses itself: the pulleys turn in opposite senses",
     .member = described_by<&BeltDrive::crossed>}};

bool belt_build(ElementBuild& build) {
  if (!connect_coupled(build, "driver") || !connect_coupled(build, "driven")) return false;
  const std::vector<double> senses = senses_of_axes(build, parallel_wheels);
  if (senses.empty()) return false;
  const BeltDrive& keys = build.keys<BeltDrive>();
  const double sense = keys.crossed ? senses[1] : -senses[1];
  build.element.data =
      std::make_shared<CoupledSum>(CoupledSum{{1.0, sense * keys.radii(1) / keys.radii(0)}});
  return true;
}

ElementExample belt_example(std::size_t, ExampleNumbers& numbers) {
  BeltDrive belt;
  belt.radii = MatX{{numbers(0.1, 0.3), numbers(0.1, 0.3)}};
  return coupled_example(std::move(belt), 2, numbers);
}

}  // namespace

constinit const ElementKind belt_element = {
    .about =
        "a belt or chain on two pulleys with parallel axes, which does not slip. A pure "
        "torque on each pulley about its axis, and on the housing; the tension of the "
        "strands is not in it",
    .keys = belt_keys,
    .list = ElementList::couplings,
    .axis = ElementAxis::coordinate,
    .blank = [] { return ElementKeys(BeltDrive()); },
    .validate = [](const ElementCheck& check) { validate_coordinates(check); },
    .build = belt_build,
    .rows = coupled_rows,
    .regimes = holding_regimes,
    .example = belt_example};

}  // namespace floatframe
