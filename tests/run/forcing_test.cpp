// What a model prescribes faster than the steps of a run see it is said.
#include "floatframe/run/forcing.hpp"

#include <gtest/gtest.h>

#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"
#include "support/coordinates.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

class Forcings : public testing::Test {
 protected:
  /// A body on a slide for 0.1 s in steps of 1 ms; `motion` and `magnitude` of a load.
  std::vector<RangeWarning> warnings(const std::string& motion, const std::string& magnitude,
                                     Coordinates coordinates = Coordinates::relative) {
    std::string text =
        "floatframe: 1\ngravity: [0, 0, 0]\n"
        "bodies: {p: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 2, 3]}}}\n"
        "joints: {j: {type: prismatic, child: p, at: [0, 0, 0], axis: x";
    text += motion.empty() ? "}}\n" : ", motion: {" + motion + "}}}\n";
    if (!magnitude.empty())
      text += "forces: {s: {type: force, body: p, direction: x, magnitude: {" + magnitude + "}}}\n";
    text += "simulation: {step: 0.001, duration: 0.1}\n";
    ModelDescription d = read_model(folder_.write("model.yaml", text));
    d.simulation.coordinates = coordinates;
    return run(build_model(d), d.simulation).summary.warnings;
  }
  static bool says(const std::vector<RangeWarning>& warnings, const std::string& words) {
    for (const RangeWarning& w : warnings)
      if (w.sentence.find(words) != std::string::npos) return true;
    return false;
  }

  TemporaryFolder folder_;
};

// 1000 Hz and 1 ms: the load is zero at every step, so nothing moves.
TEST_F(Forcings, SineThatTheStepTakesForAnother) {
  const std::string words =
      "the step of 0.001 s is too long for the load 's': its sine of 1000 Hz goes through 6.28 rad "
      "of phase in each step (limit 1 rad), 1 steps per period; take a step of at most 0.00016 s";
  for (const Coordinates c : both_coordinates)
    EXPECT_TRUE(says(warnings("", "sine: {amplitude: 1000, frequency: 1000}", c), words));
  for (const char* f : {"999", "1500", "400", "170"})
    EXPECT_TRUE(says(warnings("", std::string("sine: {amplitude: 1000, frequency: ") + f + "}"),
                     "is too long for the load 's'"))
        << f;
  EXPECT_TRUE(says(warnings("sine: {amplitude: 0.001, frequency: 1000}", ""),
                   "is too long for the motion of joint 'j'"));
  EXPECT_FALSE(
      says(warnings("", "sine: {amplitude: 1000, frequency: 100}"), "is too long for the load"));
  EXPECT_FALSE(
      says(warnings("", "sine: {amplitude: 0, frequency: 1000}"), "is too long for the load"));
}

TEST_F(Forcings, PulseBetweenTwoSteps) {
  // Of more corners than steps are divided at; those of a pulse of four are located.
  const std::vector<RangeWarning> w = warnings(
      "", "table: [[0, 0], [0.0502, 0], [0.0503, 10], [0.0504, 9], [0.0505, 3], [0.0506, 0]]");
  EXPECT_FALSE(
      says(warnings("", "table: [[0, 0], [0.0502, 0], [0.0503, 10], [0.0504, 10], [0.0506, 0]]"),
           "passes over values"));
  EXPECT_TRUE(says(warnings("interpolation: linear, table: [[0, 0], [0.0502, 0], [0.0503, 1], "
                            "[0.0504, 0]]",
                            ""),
                   "passes over values in the table of the motion of joint 'j'"));
  EXPECT_TRUE(says(w,
                   "the step of 0.001 s passes over values in the table of the load 's': it has 10 "
                   "at t = 0.0503 s but 0 and 0 at the ends of the step there"));
  EXPECT_TRUE(says(w, "take a step of at most 0.0001 s"));
}

// What is seen: jumps, pulses that last for steps, smooth tables with many entries per step,
// entries after the end.
TEST_F(Forcings, TablesThatStepsFollow) {
  EXPECT_FALSE(says(warnings("", "table: [[0, 0], [0.0502, 0], [0.05021, 10], [1, 10]]"),
                    "passes over values"));
  EXPECT_FALSE(
      says(warnings("", "table: [[0, 0], [0.0502, 0], [0.0503, 10], [0.0544, 10], [0.0545, 0]]"),
           "passes over values"));
  EXPECT_FALSE(says(warnings("", "table: [[0, 0], [0.2002, 0], [0.2003, 10], [0.2004, 0]]"),
                    "passes over values"));
  std::string smooth = "table: [[0, 0]";
  for (int k = 1; k < 1000; ++k) {
    const double t = 1e-4 * k;
    smooth += ", [" + std::to_string(t) + ", " + std::to_string(t * (0.1 - t)) + "]";
  }
  EXPECT_FALSE(says(warnings("", smooth + "]"), "passes over values"));
}

}  // namespace
}  // namespace floatframe::test
