// Slides without mass on the tips of two flexible arms, tied to each other and to the ground by
// springs: a force across a slide moves it by force over stiffness, however short the step, and
// the amplitudes of torsion have no inertia either. What follows from positions alone must not be
// guessed from accelerations, which the trapezoidal rule turns over in each step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

struct Slides {
  double stiffness, free;  ///< of the spring between the slides [N/m], [m]
  double hung, hung_free;  ///< of the one to the ground
  double damper;           ///< of the slides [N s/m]
  double step;             ///< [s]
  double mass = 0.0;       ///< of each slide [kg]
};

std::string arm(const char* name, char from, char to) {
  return fmt::format(
      "  {}:\n    flexible:\n"
      "      material: {{young: 7e10, poisson: 0.3, density: 2700}}\n"
      "      bars: {{bar: {{from: {}, to: {}, elements: 8, section: {{round: 0.02}}, reference: "
      "z}}}}\n"
      "      clamped: [{}]\n"
      "      static_modes: [{{point: {}, dofs: [x, y, z, rx, ry, rz]}}]\n"
      "      normal_modes: 0\n      damping: 0.02\n",
      name, from, to, from, to);
}

std::string slides_text(const Slides& p) {
  std::string text =
      "points: {A: [0, 0, 0], B: [1, 0, 0], C: [0, 0.5, 0], D: [1, 0.5, 0]}\nbodies:\n" +
      arm("arm_1", 'A', 'B') + arm("arm_2", 'C', 'D');
  for (int k = 1; k <= 2; ++k)
    text += fmt::format(
        "  slide_{}: {{rigid: {{mass: {}, centre_of_mass: [1, {}, 0], inertia: [{}, {}, {}]}}}}\n",
        k, p.mass, k == 1 ? 0.1 : 0.6, 1e-3 * p.mass, 1e-3 * p.mass, 1e-3 * p.mass);
  text +=
      "joints:\n"
      "  h_1: {type: revolute, parent: ground, child: arm_1, at: [0, 0, 0], axis: y}\n"
      "  h_2: {type: revolute, parent: ground, child: arm_2, at: [0, 0.5, 0], axis: y}\n"
      "  s_1: {type: prismatic, parent: arm_1, child: slide_1, at: [1, 0, 0], axis: x}\n"
      "  s_2: {type: prismatic, parent: arm_2, child: slide_2, at: [1, 0.5, 0], axis: x}\n"
      "forces:\n"
      "  a_1: {type: joint_spring, joint: h_1, spring: 4.053e4, damper: 100}\n"
      "  a_2: {type: joint_spring, joint: h_2, spring: 1.97e5, damper: 100}\n";
  text += fmt::format(
      "  g_1: {{type: joint_spring, joint: s_1, spring: 463.5, damper: {}}}\n"
      "  g_2: {{type: joint_spring, joint: s_2, spring: 7247, damper: {}}}\n",
      p.damper, p.damper);
  text += fmt::format(
      "  hang: {{type: spring_damper, from: {{body: ground, at: [1, 0.6, 0.5]}}, to: {{body: "
      "slide_2, "
      "at: [1, 0.6, 0]}}, spring: {{linear: {{stiffness: {}, free: {}}}}}}}\n"
      "  tie: {{type: spring_damper, from: {{body: slide_1, at: [1, 0.1, 0]}}, to: {{body: "
      "slide_2, at: "
      "[1, 0.6, 0.1]}}, spring: {{linear: {{stiffness: {}, free: {}}}}}}}\n",
      p.hung, p.hung_free, p.stiffness, p.free);
  return text +
         "outputs:\n"
         "  slide_1: {position: {body: slide_1, at: [1, 0.1, 0]}}\n"
         "  slide_2: {position: {body: slide_2, at: [1, 0.6, 0]}}\n";
}

RunResult run_slides(const Slides& p, Coordinates coordinates) {
  const Model model = model_of(slides_text(p));
  const SimulationDescription o = with(model.simulation, coordinates, p.step, 2.0);
  const RunResult r = completed_run(model, o);
  EXPECT_EQ(r.summary.substeps, 0);
  std::printf("[ figure ] massless slides, %g kg, step %g, %s: %.2f iterations a step\n", p.mass,
              p.step, coordinates == Coordinates::relative ? "relative" : "absolute",
              static_cast<double>(r.summary.iterations) / static_cast<double>(r.summary.steps));
  return r;
}

double largest_difference(const RunResult& a, const RunResult& b) {
  EXPECT_EQ(a.table.rows(), b.table.rows());
  double worst = 0.0;
  for (std::size_t row = 0; row < std::min(a.table.rows(), b.table.rows()); ++row)
    for (std::size_t k = 1; k <= 6; ++k)
      worst = std::max(worst, std::abs(a.table.at(row, k) - b.table.at(row, k)));
  return worst;
}

TEST(MasslessSlides, NeedNoHalvedStep) {
  for (const Slides& p : {Slides{235.2, 0.4968, 45.85, 0.45, 500.0, 1e-3},
                          Slides{2352.0, 0.4968, 458.5, 0.45, 100.0, 2e-3}}) {
    const RunResult a = run_slides(p, Coordinates::absolute);
    const RunResult r = run_slides(p, Coordinates::relative);
    EXPECT_LT(largest_difference(a, r), p.step * 0.1);
    EXPECT_LT(a.summary.iterations, 8 * a.summary.steps);
  }
}

TEST(MasslessSlides, StepsDoNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const Model model = model_of(slides_text({235.2, 0.4968, 45.85, 0.45, 500.0, 1e-3}));
  Simulation s(model, {.step = 1e-3, .coordinates = Coordinates::absolute});
  const AllocationScope scope;
  for (int k = 0; k < 50; ++k) EXPECT_TRUE(s.step());
  EXPECT_EQ(scope.count(), 0u);
}

TEST(MasslessSlides, MoveAsThoseOfAGram) {
  Slides p{235.2, 0.50976, 45.85, 0.45, 1000.0, 1e-3};
  const RunResult massless = run_slides(p, Coordinates::absolute);
  p.mass = 1e-3;
  const RunResult gram = run_slides(p, Coordinates::absolute);
  const double difference = largest_difference(massless, gram);
  std::printf("[ figure ] massless slides against those of a gram [m] %.2g\n", difference);
  EXPECT_LT(difference, 1e-4);
}

// A leg of spring and damper holds a link without mass at one point of a universal joint: where
// that point goes along the sphere of constant length nothing decides, but the lever that carries
// it must not notice. Accelerations of the link in the first guess threw it round and round.
TEST(MasslessLink, IsNotThrownByItsFirstGuess) {
  const Model model = model_of(
      "bodies:\n"
      "  lever: {rigid: {mass: 0.9, centre_of_mass: [0.05, 0, -0.3], inertia: [0.02, 0.02, "
      "0.01]}}\n"
      "  link: {rigid: {mass: 0, centre_of_mass: [0, 0, -0.5]}}\n"
      "joints:\n"
      "  hinge: {type: revolute, parent: ground, child: lever, at: [0, 0, 0], axis: y}\n"
      "  cross: {type: universal, parent: lever, child: link, at: [0, 0, -0.5], axis: x, axis_2: "
      "y}\n"
      "forces:\n"
      "  leg: {type: spring_damper, from: {body: ground, at: [0.1, 0.05, -0.9]}, to: {body: link, "
      "at: [0.2, 0.1, -0.6]}, spring: {linear: {stiffness: 20, free: 0.2}}, damper: 0.5}\n"
      "outputs:\n"
      "  lever: {position: {body: lever, at: [0, 0, -0.5]}}\n");
  for (const double step : {4e-3, 1e-3, 2.5e-4}) {
    SimulationDescription o = model.simulation;
    o.step = step;
    o.duration = 1.0;
    RunResult runs[2];
    for (const Coordinates c : both_coordinates) {
      o.coordinates = c;
      RunResult& r = runs[c == Coordinates::relative ? 0 : 1];
      r = completed_run(model, o);
      EXPECT_LT(r.summary.substeps, 50);
      EXPECT_LT(r.summary.iterations, 8 * r.summary.steps);
    }
    double difference = 0.0;
    for (std::size_t row = 0; row < std::min(runs[0].table.rows(), runs[1].table.rows()); ++row)
      for (std::size_t k = 1; k <= 3; ++k)
        difference =
            std::max(difference, std::abs(runs[0].table.at(row, k) - runs[1].table.at(row, k)));
    std::printf("[ figure ] massless link, step %g: difference of the lever [m] %.2g\n", step,
                difference);
    EXPECT_LT(difference, step);
  }
}

}  // namespace
}  // namespace floatframe::test
