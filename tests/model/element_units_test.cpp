// Units of the values of elements: each has its own, in columns and as `unit` of an output.
#include <gtest/gtest.h>

#include <set>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/model/rolling_values.hpp"
#include "model/table_in_document.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

TEST(ElementUnits, EveryValueHasItsOwn) {
  const std::set<std::string> known{"N", "N m", "m", "rad", "m/s", "rad/s", "-"};
  ExampleNumbers numbers(11);
  int several = 0;
  for (const ElementType type : element_types) {
    const ElementExample x = element_example(type, 0, numbers);
    const std::vector<ElementValue> values = values_of_element(*x.element.keys);
    EXPECT_EQ(values.size(), x.element.values.size());
    if (values.empty()) continue;
    ++several;
    EXPECT_STREQ(values[0].unit, element_output_unit(x.element, ElementQuantity::force))
        << element_type_name(type);
    for (int k = 0; k < std::ssize(values); ++k) {
      EXPECT_EQ(values[k].name, x.element.values[k]);
      EXPECT_STREQ(value_unit(x.element, k), values[k].unit);
      EXPECT_TRUE(known.contains(values[k].unit)) << values[k].name;
    }
  }
  EXPECT_GE(several, 6);
}

TEST(ElementUnits, OfRollingTyresAreThoseOfTheDocumentation) {
  const std::string head = "| `output` of a tyre that rolls | unit |\n|---|---|\n";
  std::string table = head;
  for (const ElementValue& value : rolling_values(LinearTyre()))
    table += "| `" + value.name + "` | " + value.unit + " |\n";
  EXPECT_EQ(table_in_document(head), table);
}

std::string with_output(const std::string& output) {
  return R"(
bodies: {w: {rigid: {mass: 300, centre_of_mass: [0, 0, 0.28], inertia: [1, 1, 1]}}}
joints: {w: {type: prismatic, child: w, at: [0, 0, 0.28], axis: x, velocity: 10}}
roads: {r: {profile: [[0, 0]]}}
forces:
  t: {type: linear_tyre, body: w, road: r, spinning: false, radius: 0.29, stiffness: 1.8e5,
    slip_stiffness: 6.0e4, cornering_stiffness: 4.5e4, relaxation_x: 0.2, relaxation_y: 0.4}
  air: {type: aerodynamic_load, body: w, area: 2, drag: 0.3}
outputs: {o: {)" +
         output + "}}\n";
}

TEST(ElementUnits, AreThoseOfTheColumns) {
  const struct {
    const char *output, *unit;
    double factor;
  } cases[] = {{"force: t", "N", 1},
               {"force: t, output: lateral_force", "N", 1},
               {"force: t, output: lateral_force, unit: kN", "kN", 1e-3},
               {"force: t, output: aligning_moment", "N m", 1},
               {"force: t, output: longitudinal_slip", "-", 1},
               {"force: t, output: slip_angle, unit: deg", "deg", degrees},
               {"force: t, output: camber", "rad", 1},
               {"force: t, output: deflection, unit: mm", "mm", 1e3},
               {"force: t, output: effective_radius", "m", 1},
               {"force: t, output: friction_use", "-", 1},
               {"force: air, output: lift", "N", 1}};
  for (const auto& c : cases) {
    const Model model = model_of(with_output(c.output));
    EXPECT_EQ(model.outputs[0].unit, c.unit) << c.output;
    EXPECT_DOUBLE_EQ(model.outputs[0].factor, c.factor) << c.output;
  }
}

}  // namespace
}  // namespace floatframe::test
