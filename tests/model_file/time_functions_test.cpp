// Functions of time as they are written: several sines, chirps, steps, periods, motions by their
// velocity or acceleration; what is said of wrong ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

class TimeFunctionFiles : public testing::Test {
 protected:
  ModelDescription read(const std::string& motion, const std::string& load) {
    folder_.write("model.yaml",
                  "floatframe: 1\n"
                  "bodies: {a: {rigid: {mass: 1, inertia: [1, 1, 1]}, position: [0, 0, 0]}}\n"
                  "joints:\n"
                  "  j: {type: prismatic, child: a, at: [0, 0, 0], axis: z, motion: " +
                      motion +
                      "}\n"
                      "forces:\n"
                      "  f: {type: force, body: a, direction: x, magnitude: " +
                      load + "}\n");
    return read_model(folder_.file("model.yaml"));
  }
  TimeFunction motion(const std::string& text) { return *read(text, "0").joints.at(0).motion; }
  TimeFunction load(const std::string& text) {
    return std::get<AppliedForce>(read("0", text).forces.at(0).kind).magnitude;
  }
  std::string motion_errors(const std::string& text) {
    return folder_.without(test::error_of([&] { motion(text); }));
  }
  std::string load_errors(const std::string& text) {
    return folder_.without(test::error_of([&] { load(text); }));
  }

  test::TemporaryFolder folder_;
};

TEST_F(TimeFunctionFiles, SeveralSinesAndChirps) {
  const TimeFunction f = load(
      "{polynomial: [1], sine: [{amplitude: 2, frequency: 3}, {amplitude: 4, frequency: 5, phase: "
      "6}], chirp: {amplitude: 1, from: 0, to: 8, duration: 4, start: 2, phase: 0.5}}");
  ASSERT_EQ(f.sines.size(), 3u);
  EXPECT_EQ(f.sines[0].frequency, 3.0);
  EXPECT_EQ(f.sines[1].phase, 6.0);
  EXPECT_EQ(f.sines[2].rate, 2.0);
  EXPECT_EQ(f.sines[2].start, 2.0);
  const double w = 2.0 * std::numbers::pi;
  EXPECT_NEAR(evaluate(f, 3.0).f,
              1.0 + 2.0 * std::sin(9.0 * w) + 4.0 * std::sin(15.0 * w + 6.0) + std::sin(w + 0.5),
              1e-12);
  EXPECT_EQ(load_errors("{sine: [{amplitude: 2}, {frequency: 0, amplitude: 1}]}"),
            "model.yaml:6:62: forces.f.magnitude.sine[1]: missing\n"
            "model.yaml:6:90: forces.f.magnitude.sine[2].frequency: out_of_range");
  EXPECT_EQ(load_errors("{chirp: {amplitude: 1, from: -1, to: 3}}"),
            "model.yaml:6:55: forces.f.magnitude.chirp: missing\n"
            "model.yaml:6:83: forces.f.magnitude.chirp.from: out_of_range");
}

TEST_F(TimeFunctionFiles, StepsAndPeriods) {
  const TimeFunction steps = load("{steps: [[0.5, 3], [0.75, -1]], period: 1}");
  EXPECT_EQ(evaluate(steps, 0.6).f, 3.0);
  EXPECT_EQ(evaluate(steps, 7.8).f, -1.0);
  EXPECT_EQ(evaluate(load("{steps: [[0.5, 3]]}"), 0.4).f, 0.0);
  const TimeFunction saw = load("{table: [[0, 0], [2, 4]], periodic: true}");
  EXPECT_EQ(saw.period, 2.0);
  EXPECT_NEAR(evaluate(saw, 5.0).f, 2.0, 1e-14);
  EXPECT_EQ(load("{table: [[0, 0], [2, 4]], periodic: false}").period, 0.0);
  const TimeFunction wave = motion("{table: [[0, 0], [1, 4], [2, 0], [3, -4], [4, 0]], period: 4}");
  EXPECT_NEAR(evaluate(wave, 4.0).df, evaluate(wave, 3.999999).df, 1e-4);
  EXPECT_GT(evaluate(wave, 0.0).df, 1.0);
  EXPECT_EQ(load_errors("{table: [[0, 0], [2, 4]], period: 1}"),
            "model.yaml:6:88: forces.f.magnitude.period: contradiction");
  EXPECT_EQ(load_errors("{table: [[0, 0], [2, 4]], period: 0}"),
            "model.yaml:6:88: forces.f.magnitude.period: out_of_range");
  EXPECT_EQ(load_errors("{table: [[0, 0], [2, 4]], period: 2, periodic: true}"),
            "model.yaml:6:101: forces.f.magnitude.periodic: exclusive");
  EXPECT_EQ(load_errors("{steps: [[1, 0], [1, 4]]}"),
            "model.yaml:6:71: forces.f.magnitude.steps[2]: wrong_value");
  EXPECT_EQ(load_errors("{steps: []}"), "model.yaml:6:62: forces.f.magnitude.steps: wrong_value");
  EXPECT_EQ(motion_errors("{table: [[0, 0], [2, 4]], period: 2}"),
            "model.yaml:4:100: joints.j.motion.period: contradiction");
  EXPECT_EQ(motion_errors("{steps: [[0, 0], [2, 4]]}"),
            "model.yaml:4:74: joints.j.motion.steps: wrong_value");
}

TEST_F(TimeFunctionFiles, MotionsByVelocity) {
  const TimeFunction f = motion(
      "{velocity: {table: [[0, 0], [1, 2], [3, 2], [4, 0]], sine: {amplitude: 0.5, "
      "frequency: 3, phase: 0.4}}, start: 0.7}");
  EXPECT_NEAR(evaluate(f, 0.0).f, 0.7, 1e-15);
  const double w = 6.0 * std::numbers::pi;
  for (const double t : {0.25, 0.9, 2.0, 3.7, 5.0}) {
    const double trapezoid = t < 1.0   ? t * t
                             : t < 3.0 ? 1.0 + 2.0 * (t - 1.0)
                             : t < 4.0 ? 6.0 - (4.0 - t) * (4.0 - t)
                                       : 6.0;
    const double sine = 0.5 / w * (std::cos(0.4) - std::cos(w * t + 0.4));
    EXPECT_NEAR(evaluate(f, t).f, 0.7 + trapezoid + sine, 1e-13) << t;
  }
  EXPECT_NEAR(evaluate(motion("{velocity: 3}"), 2.0).f, 6.0, 1e-15);
}

TEST_F(TimeFunctionFiles, MotionsByAcceleration) {
  const TimeFunction f = motion(
      "{acceleration: {steps: [[0, 2], [1, -2], [2, 0]], sine: {amplitude: 5, frequency: 0.5}}, "
      "start: 1, velocity_at_start: -3}");
  const double w = std::numbers::pi;
  EXPECT_NEAR(evaluate(f, 0.0).f, 1.0, 1e-15);
  EXPECT_NEAR(evaluate(f, 0.0).df, -3.0, 1e-15);
  for (const double t : {0.25, 0.9, 1.6, 3.7}) {
    const double parabolas = t < 1.0 ? t * t : t < 2.0 ? 2.0 - (2.0 - t) * (2.0 - t) : 2.0;
    const double sine = 5.0 / w * t - 5.0 / (w * w) * std::sin(w * t);
    EXPECT_NEAR(evaluate(f, t).f, 1.0 - 3.0 * t + parabolas + sine, 1e-13) << t;
    EXPECT_NEAR(evaluate(f, t).ddf,
                (t < 1.0   ? 2.0
                 : t < 2.0 ? -2.0
                           : 0.0) +
                    5.0 * std::sin(w * t),
                1e-12);
  }
}

TEST_F(TimeFunctionFiles, WrongProfilesOfMotions) {
  EXPECT_EQ(motion_errors("{velocity: {steps: [[0, 1], [1, 0]]}}"),
            "model.yaml:4:85: joints.j.motion.velocity.steps: wrong_value");
  EXPECT_EQ(motion_errors("{velocity: {table: [[0, 1], [1, 0], [1, 2]]}}"),
            "model.yaml:4:102: wrong_value");
  EXPECT_EQ(motion_errors("{velocity: {table: [[0, 1], [1, 1]], period: 1}}"),
            "model.yaml:4:77: joints.j.motion.velocity: wrong_value");
  EXPECT_EQ(motion_errors("{velocity: {chirp: {amplitude: 1, from: 1, to: 2, duration: 1}}}"),
            "model.yaml:4:77: joints.j.motion.velocity: wrong_value");
  EXPECT_EQ(motion_errors("{velocity: 1, acceleration: 2}"),
            "model.yaml:4:94: joints.j.motion.acceleration: exclusive");
  EXPECT_EQ(motion_errors("{velocity: 1, velocity_at_start: 2}"),
            "model.yaml:4:80: joints.j.motion.velocity_at_start: unknown_key");
  EXPECT_EQ(motion_errors("{velocity: 1, sine: {amplitude: 1, frequency: 1}}"),
            "model.yaml:4:80: joints.j.motion.sine: unknown_key");
}

}  // namespace
}  // namespace floatframe
