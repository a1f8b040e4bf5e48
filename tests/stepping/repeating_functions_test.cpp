// Functions of time that repeat, jump or are given by their integrals, in runs: what steps meet.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "floatframe/run/run.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "floatframe/stepping/time_corners.hpp"
#include "support/coordinates.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// 1 kg on a slide, for 1 s in steps of 10 ms.
Model sliding(const std::string& motion, const std::string& magnitude) {
  return model_of(R"(
gravity: [0, 0, 0]
bodies: {m: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}
joints: {p: {type: prismatic, child: m, at: [0, 0, 0], axis: x)" +
                  (motion.empty() ? "" : ", motion: " + motion) + R"(}}
forces: {a: {type: force, body: m, direction: x, magnitude: )" +
                  magnitude + R"(}}
outputs:
  x: {joint_position: p}
  v: {joint_velocity: p}
  a: {acceleration: m, axis: x}
simulation: {step: 0.01, duration: 1}
)");
}

// In closed form: a force that is constant between its jumps moves a free mass exactly.
TEST(RepeatingFunctions, ASquareWaveIsMetAtEveryJump) {
  const Model model = sliding("", "{steps: [[0, 1], [0.1533, -2]], period: 0.2717}");
  double x = 0.0, v = 0.0;
  long jumps = 0;
  for (double t = 0.0, force = 1.0; t < 1.0;) {
    const double cycle = std::floor(t / 0.2717 + 1e-9) * 0.2717;
    const double next = force > 0.0 ? cycle + 0.1533 : cycle + 0.2717;
    const double dt = std::min(next, 1.0) - t;
    x += v * dt + 0.5 * force * dt * dt;
    v += force * dt;
    t += dt;
    force = force > 0.0 ? -2.0 : 1.0;
    if (t < 1.0) ++jumps;
  }
  for (const Coordinates c : both_coordinates) {
    const RunResult r = run(model, with(model.simulation, c));
    EXPECT_EQ(r.summary.corners, jumps);
    EXPECT_NEAR(r.table.at(100, 1), x, 1e-10);
    EXPECT_NEAR(r.table.at(100, 2), v, 1e-10);
  }
}

TEST(RepeatingFunctions, AreDividedUpToALimitAndSaySo) {
  const Model model = sliding("", "{steps: [[0, 1], [0.15, -2]], period: 0.25}");
  const double forever = std::numeric_limits<double>::infinity();
  const TimeCorners some = time_corners(model, {.step = 0.01, .duration = 10.0});
  EXPECT_EQ(some.located.size(), 80u);
  EXPECT_TRUE(some.dense.empty());
  const TimeCorners all = time_corners(model, {.step = 0.01, .duration = forever});
  EXPECT_GT(all.located.size(), most_repeated_pieces - 5);
  ASSERT_EQ(all.dense.size(), 1u);
  EXPECT_NE(all.dense[0].find("the load 'a' repeats too often"), std::string::npos);
}

TEST(RepeatingFunctions, EndsOfAChirpAreCornersOfAMotion) {
  const std::string chirp =
      "{chirp: {amplitude: 0.1, from: 1, to: 3, duration: 0.4, start: 0.2031}}";
  EXPECT_TRUE(time_corners(sliding("", chirp), {.step = 0.01, .duration = 1.0}).located.empty());
  const TimeCorners c = time_corners(sliding(chirp, "0"), {.step = 0.01, .duration = 1.0});
  ASSERT_EQ(c.located.size(), 2u);
  EXPECT_EQ(c.located[0].from, 0.2031);
  EXPECT_NEAR(c.located[1].from, 0.6031, 1e-15);
}

// A trapezoid of velocity and the same by its acceleration.
TEST(RepeatingFunctions, MotionsByVelocityAndAcceleration) {
  for (const char* motion :
       {"{velocity: {table: [[0, 0], [0.2, 1], [0.6, 1], [0.8, 0]]}, start: 0.3}",
        "{acceleration: {steps: [[0, 5], [0.2, 0], [0.6, -5], [0.8, 0]]}, start: 0.3}"})
    for (const Coordinates c : both_coordinates) {
      const Model model = sliding(motion, "0");
      const RunResult r = run(model, with(model.simulation, c));
      const auto row = [&](std::size_t k, double x, double v) {
        EXPECT_NEAR(r.table.at(k, 1), x, 1e-9) << motion << k;
        EXPECT_NEAR(r.table.at(k, 2), v, 1e-9) << motion << k;
      };
      row(0, 0.3, 0.0);
      row(10, 0.325, 0.5);
      row(40, 0.6, 1.0);
      row(70, 0.875, 0.5);
      row(100, 0.9, 0.0);
      EXPECT_NEAR(r.table.at(10, 3), 5.0, 1e-6);
      EXPECT_NEAR(r.table.at(70, 3), -5.0, 1e-6);
    }
}

}  // namespace
}  // namespace floatframe::test
