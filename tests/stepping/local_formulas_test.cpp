// Formulas of actuators that are parts of the law of their element, against the same ones as
// elements of their own, which what they read of elsewhere makes them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/linear/linear_ports.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/coordinates.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A swinging arm, a slide on it and a strut to it; `more` is added to each formula.
std::string driven_arm(const std::string& more, const std::string& of_arm,
                       const std::string& edges) {
  return fmt::format(R"(
inputs: {{u: {{initial: 0.5}}}}
measures: {{turn: {{joint_position: arm}}, speed: {{joint_velocity: arm}}}}
bodies:
  arm: {{rigid: {{mass: 2, centre_of_mass: [0.3, 0, 0], inertia: [0.001, 0.06, 0.06]}}}}
  slide: {{rigid: {{mass: 1, centre_of_mass: [0.9, 0, 0], inertia: [0.01, 0.01, 0.01]}}}}
joints:
  arm: {{type: revolute, child: arm, at: [0, 0, 0], axis: y, velocity: 1}}
  slide: {{type: prismatic, parent: arm, child: slide, at: [0.6, 0, 0], axis: x}}
forces:
  motor: {{type: joint_spring, joint: arm, actuator: {{formula: '{1}{0}'}}}}
  drive: {{type: joint_spring, joint: slide, spring: 20,
          actuator: {{formula: '-300 * angle(slide) - 9 * rate(slide) * abs(u + t){0}'}}}}
  strut: {{type: spring_damper, from: {{body: ground, at: [0, 0, 0.7]}},
          to: {{body: arm, at: [0.5, 0, 0]}},
          actuator: {{formula: '90 * sin(length(strut)) + 4 * rate(strut){0}'}}}}
outputs: {{a: {{joint_position: arm}}, b: {{joint_position: slide}}, c: {{force: motor}},
          d: {{force: strut}}}}
simulation: {{step: 0.002, duration: 0.5, locate_edges: {2}}}
)",
                     more, of_arm, edges);
}
const char* const smooth = "-40 * turn - 3 * rate(arm) - speed + u^2";
const char* const limited = "clip(-40 * angle(arm) - 3 * speed, -4, 4) + u";
const char* const elsewhere = " + 0 * distance_to_post";

std::string driven_apart(const std::string& of_arm, const std::string& edges) {
  std::string text = driven_arm(elsewhere, of_arm, edges);
  const std::string measures = "measures: {";
  return text.replace(text.find(measures), measures.size(),
                      measures +
                          "distance_to_post: {distance: {from: {body: ground, at: [0, 0, 9]}, "
                          "to: {body: slide, at: [0.9, 0, 0]}}}, ");
}

TEST(LocalFormulas, ActAsElementsOfTheirOwn) {
  for (const Coordinates c : both_coordinates)
    for (const char* const of_arm : {smooth, limited})
      for (const char* const edges : {"false", "true"}) {
        const Model local = model_of(driven_arm("", of_arm, edges)),
                    outer = model_of(driven_apart(of_arm, edges));
        EXPECT_TRUE(local.links.empty());
        EXPECT_GE(outer.links.size(), 3u);
        SimulationDescription options = local.simulation;
        options.coordinates = c;
        const RunResult a = completed_run(local, options), b = completed_run(outer, options);
        ASSERT_EQ(a.table.data.size(), b.table.data.size());
        for (std::size_t k = 0; k < a.table.data.size(); ++k)
          EXPECT_NEAR(a.table.data[k], b.table.data[k], 1e-6) << k;
      }
}

// The law of a spring and a damper, written as a formula, takes the same steps.
TEST(LocalFormulas, AreASpringAndADamper) {
  std::string text = driven_arm("", "-40 * angle(arm) - 3 * rate(arm)", "false");
  const Model by_formula = model_of(text);
  const std::string actuator = "actuator: {formula: '-40 * angle(arm) - 3 * rate(arm)'}";
  const Model by_spring =
      model_of(text.replace(text.find(actuator), actuator.size(), "spring: 40, damper: 3"));
  const RunResult a = completed_run(by_formula, by_formula.simulation),
                  b = completed_run(by_spring, by_spring.simulation);
  for (std::size_t k = 0; k < a.table.data.size(); ++k)
    EXPECT_NEAR(a.table.data[k], b.table.data[k], 1e-10);
}

TEST(LocalFormulas, InLinearSystems) {
  const LinearModel local = linear_model(model_of(driven_arm("", smooth, "false"))),
                    outer = linear_model(model_of(driven_apart(smooth, "false")));
  EXPECT_LT((local.system.A - outer.system.A).norm(), 1e-9 * outer.system.A.norm());
  EXPECT_LT((local.B[0] - outer.B[0]).norm(), 1e-9 * outer.B[0].norm());
  EXPECT_GT(local.B[0].norm(), 0.5);
  EXPECT_LT((local.D[0] - outer.D[0]).norm(), 1e-8 * (1.0 + outer.D[0].norm()));
}

TEST(LocalFormulas, KeepTheirNames) {
  const Model undefined = model_of(driven_arm("", "1 / angle(arm)", "false"));
  const std::string why = sentences_of([&] { completed_run(undefined, undefined.simulation); });
  EXPECT_TRUE(contains(why, "formula 'motor/actuator': division by zero in '(1 / angle('arm'))'"))
      << why;
}

TEST(LocalFormulas, DoNotAllocate) {
  const Model model = model_of(driven_arm("", limited, "false"));
  Simulation s(model);
  s.step();
  const AllocationScope counter;
  for (int k = 0; k < 50; ++k) s.step();
  EXPECT_EQ(counter.count(), 0u);
}

}  // namespace
}  // namespace floatframe::test
