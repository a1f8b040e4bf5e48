// The same system at other scales of length: what has mass at one has mass at all, and starts
// alike.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A short bar hinged at its end. Its normal modes have a modal mass of 1 whatever the size.
const char* const flexible_bar = R"(
points: {a: [0, 0, 0], b: ["${s}", 0, 0]}
bodies:
  bar:
    position: a
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7800}
      bars: {bar: {from: a, to: b, elements: 4, section: {rectangle: ["${0.2*s}", "${0.3*s}"]}}}
      mass_model: hermite
      section_inertia: true
      clamped: [a]
      static_modes: [{point: b, dofs: [x, y, z]}]
      normal_modes: 3
joints: {hinge: {type: revolute, child: bar, at: a, axis: y}}
outputs: {z: {acceleration: {body: bar, at: b}, axis: z}}
simulation: {duration: 0}
)";

/// A four-bar whose coupler is the flexible bar.
const char* const four_bars = R"(
points: {a: [0, 0, 0], b: ["${0.3*s}", 0, "${0.4*s}"], c: ["${1.1*s}", 0, "${0.5*s}"],
    d: ["${0.9*s}", 0, 0]}
bodies:
  crank: {position: a, rigid: {mass: "${300*s*s*s}", centre_of_mass: ["${0.15*s}", 0, "${0.2*s}"],
      inertia: ["${6*s*s*s*s*s}", "${6*s*s*s*s*s}", "${6*s*s*s*s*s}"]}}
  coupler:
    position: b
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7800}
      bars: {bar: {from: b, to: c, elements: 4, section: {rectangle: ["${0.2*s}", "${0.3*s}"]}}}
      mass_model: hermite
      section_inertia: true
      clamped: [b]
      static_modes: [{point: c, dofs: [x, y, z]}]
      normal_modes: 3
  rocker: {position: d, rigid: {mass: "${300*s*s*s}", centre_of_mass: ["${s}", 0, "${0.25*s}"],
      inertia: ["${6*s*s*s*s*s}", "${6*s*s*s*s*s}", "${6*s*s*s*s*s}"]}}
joints:
  A: {type: revolute, child: crank, at: a, axis: y}
  B: {type: revolute, parent: crank, child: coupler, at: b, axis: y}
  C: {type: spherical, parent: coupler, child: rocker, at: c}
  D: {type: revolute, child: rocker, at: d, axis: y}
outputs:
  x: {acceleration: {body: coupler, at: c}, axis: x}
  z: {acceleration: {body: coupler, at: c}, axis: z}
simulation: {duration: 0}
)";

/// Accelerations at the start.
std::vector<double> scaled_start(const char* text, const std::string& scale, const Combination& c) {
  const Model model = model_of("parameters: {s: " + scale + "}" + text);
  const RunResult r = completed_run(model, c);
  std::vector<double> a;
  for (std::size_t k = 1; k < r.table.columns.size(); ++k) a.push_back(r.table.at(0, k));
  return a;
}

class Scales : public ::testing::TestWithParam<const char*> {};

TEST_P(Scales, StartAlike) {
  const std::vector<double> expected = scaled_start(GetParam(), "1", combinations[0]);
  for (const char* scale : {"1e-4", "1e-3", "1e-2", "1", "1e2", "1e3", "1e4"})
    for (const Combination& c : {combinations[0], combinations[2]}) {
      const std::vector<double> found = scaled_start(GetParam(), scale, c);
      ASSERT_EQ(found.size(), expected.size());
      double worst = 0.0;
      for (std::size_t k = 0; k < found.size(); ++k)
        worst = std::max(worst, std::abs(found[k] - expected[k]));
      EXPECT_LT(worst, 1e-5) << scale << ' ' << c.name();
      figure(std::string(scale) + " " + c.name() + ", difference of accelerations [m/s2]", worst);
    }
}

INSTANTIATE_TEST_SUITE_P(Lengths, Scales, ::testing::Values(flexible_bar, four_bars),
                         [](const auto& which) {
                           return std::string(which.index == 0 ? "bar" : "mechanism");
                         });

// A straight bar has no inertia about itself at any size.
TEST(Scales, OfABarThatSpinsFreely) {
  for (const char* scale : {"1e-4", "1e-2", "1", "1e2", "1e4"})
    for (const Combination& c : combinations) {
      const Model model = model_of(std::string("parameters: {s: ") + scale + "}" + R"(
points: {a: [0, 0, 0], b: ["${0.6*s}", "${0.3*s}", "${0.2*s}"]}
bodies:
  bar:
    position: a
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7800}
      bars: {bar: {from: a, to: b, elements: 4, section: {round: "${0.02*s}"}}}
      clamped: [a]
      static_modes: [{point: b, dofs: [y, z]}]
      normal_modes: 1
joints: {top: {type: spherical, child: bar, at: a}}
simulation: {duration: 0}
)");
      expect_in(message_of([&] { run_of(model, c); }),
                "the mass matrix is singular where nothing holds it: body 'bar' can move");
    }
}

}  // namespace
}  // namespace floatframe::test
