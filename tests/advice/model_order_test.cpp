// Modes that a range of frequencies needs: estimates against what happens without one mode, and
// what is left of the Iltis.
#include "floatframe/advice/model_order.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

std::vector<double> vibrations_of(const Model& model) {
  std::vector<double> f;
  const auto modes = linear_modes(linear_system(model));
  for (const LinearMode& m : modes)
    if (m.lambda.imag() > 1e-6 * std::abs(modes.back().lambda)) f.push_back(m.frequency());
  return f;
}

// A mass on the end of a beam: bending needs one static mode of each plane, and the estimate of
// what happens to the lowest vibration without a mode bounds what does happen (Rayleigh).
TEST(ModelOrder, EstimatesBoundTheChangeOfTheLowestVibration) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
points: {hub: [0, 0, 0], tip: [1, 0, 0]}
bodies:
  beam:
    flexible:
      material: {young: 2.1e11, poisson: 0.3, density: 7800}
      bars: {b: {from: hub, to: tip, elements: 8, section: {rectangle: [0.02, 0.03]}, reference: y}}
      clamped: [hub]
      static_modes: [{point: tip, dofs: [y, z, ry, rz]}]
      normal_modes: 6
  mass: {rigid: {mass: 3, centre_of_mass: tip, inertia: [0.1, 0.1, 0.1]}}
joints:
  wall: {type: weld, child: beam, at: hub}
  fix: {type: weld, parent: beam, child: mass, at: tip}
outputs: {tip: {position: {body: mass, at: tip}, axis: z}}
simulation: {step: 0.001, duration: 0.1}
)");
  const std::vector<double> full = vibrations_of(model);
  const int modes = model.bodies[0].modes();
  const ModelOrder lowest = model_order(model, {.below = 1.01 * full[0], .tolerance = 1e-9});
  ASSERT_EQ(lowest.full.size(), 1u);
  int judged = 0;
  for (int k = 0; k < modes; ++k) {
    std::vector<std::vector<int>> keep(2);
    for (int i = 0; i < modes; ++i)
      if (i != k) keep[0].push_back(i);
    const double change = vibrations_of(with_modes(model, keep))[0] / full[0] - 1.0;
    const double estimate = lowest.bodies[0].estimates[static_cast<std::size_t>(k)];
    EXPECT_GE(change, -1e-9) << k;
    if (estimate > 0.2) continue;  // another vibration is the lowest then
    // (1) is first order: w'^2 / w^2 <= 1 + 2 estimate + ..., and M loses the mode's part.
    EXPECT_LE(change, 1.2 * estimate + 1e-9) << k;
    judged += estimate > 1e-9 ? 1 : 0;
  }
  EXPECT_GE(judged, 2);

  const ModelOrder r = model_order(model, {.below = 1.2 * full[1], .tolerance = 0.01});
  EXPECT_EQ(r.full.size(), 2u);
  EXPECT_LE(r.change, 0.01);
  EXPECT_GT(r.needed, 1);
  EXPECT_LT(r.needed, modes);
  EXPECT_TRUE(r.ran);
}

TEST(ModelOrder, OfTheIltis) {
  const Model model =
      load_model(FLOATFRAME_EXAMPLES "/iltis/iltis.yaml", {{"speed", "0"}, {"duration", "0.2"}});
  const ModelOrder coarse = model_order(model, {.below = 50.0, .tolerance = 0.01});
  const ModelOrder fine = model_order(model, {.below = 50.0, .tolerance = 1e-4});
  EXPECT_EQ(coarse.full.size(), 11u);
  EXPECT_EQ(coarse.modes, 64);
  EXPECT_LT(coarse.needed, 20);
  EXPECT_GT(fine.needed, coarse.needed);
  EXPECT_LE(coarse.change, 0.01);
  EXPECT_LE(fine.change, 1e-4);
  // Left and right are alike.
  EXPECT_EQ(coarse.bodies[0].needed, coarse.bodies[3].needed);
  for (std::size_t k = 0; k < fine.full.size(); ++k)
    EXPECT_NEAR(fine.reduced[k], fine.full[k], 1e-4 * fine.full[k]);
  EXPECT_TRUE(coarse.warnings.empty()) << coarse.warnings.front();
}

TEST(ModelOrder, ReportsBodiesWithTooFewModes) {
  const Model model = load_model(FLOATFRAME_EXAMPLES "/flexible_pendulum/flexible_pendulum.yaml");
  const ModelOrder r = model_order(model, {.below = 60.0});
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_TRUE(contains(r.warnings[0], "normal modes up to 52.86 Hz only"));
  EXPECT_EQ(error_of([&] { model_order(model, {}); }), "out_of_range");
  EXPECT_EQ(error_of([&] { model_order(model, {.below = 1.0, .tolerance = 2.0}); }),
            "out_of_range");
}

}  // namespace
}  // namespace floatframe::test
