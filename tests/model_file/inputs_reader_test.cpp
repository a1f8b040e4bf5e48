// Inputs in model files: names, limits, and every place they can be used at.
#include <gtest/gtest.h>

#include <cstring>

#include "floatframe/model_file/model_reader.hpp"
#include "support/completed_run.hpp"

namespace floatframe {
namespace {

const std::string file = FLOATFRAME_TEST_DATA "/good_models/inputs.yaml";

template <class T>
const T& force(const ModelDescription& d, const std::string& name) {
  for (const ElementDescription& f : d.forces)
    if (f.name == name) return std::get<T>(f.kind);
  throw std::runtime_error("no force " + name);
}

TEST(InputsInFiles, EveryKeyArrives) {
  const ModelDescription d = read_model(file);
  ASSERT_EQ(d.inputs.size(), 4u);  // `spare` is switched off
  EXPECT_EQ(d.inputs[0].name, "push");
  EXPECT_EQ(d.inputs[0].unit, "N");
  EXPECT_EQ(d.inputs[0].initial, 3.25);
  EXPECT_EQ(d.inputs[0].low, -50.0);
  EXPECT_EQ(d.inputs[0].high, 50.0);
  EXPECT_FALSE(d.inputs[0].clamp);
  EXPECT_TRUE(d.inputs[2].clamp);
  EXPECT_TRUE(build_model(d).inputs[2].clamp);
  EXPECT_EQ(d.inputs[3].unit, "rad/s");
  EXPECT_EQ(d.inputs[3].initial, 0.0);
  EXPECT_FALSE(d.inputs[3].low);
  EXPECT_EQ(force<AppliedForce>(d, "push").magnitude.input, "push");
  const auto& tie = force<SpringDamper>(d, "tie");
  EXPECT_EQ(tie.actuator->input, "pull");
  EXPECT_EQ(tie.actuator->sines.at(0).amplitude, 1.0);
  EXPECT_EQ(force<GuidedSpring>(d, "guide").actuator->input, "pull");
  const auto& motor = force<JointSpring>(d, "motor");
  EXPECT_EQ(motor.target->input, "angle");
  EXPECT_EQ(motor.target_rate->input, "speed");
  EXPECT_FALSE(motor.actuator);
  EXPECT_EQ(force<JointSpring>(d, "brake").actuator->input, "push");
}

TEST(InputsInFiles, RunKeepsTheInitialValueAsIfItWereConstant) {
  for (const auto coordinates : {Coordinates::relative, Coordinates::absolute}) {
    const auto table = [&](const char* external) {
      const ModelDescription d = read_model(file, {{"external", external}});
      const SimulationDescription s = test::with(d.simulation, coordinates);
      return test::completed_run(build_model(d), s).table;
    };
    const ResultTable a = table("true"), b = table("false");
    ASSERT_EQ(a.data.size(), b.data.size());
    EXPECT_EQ(std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(double)), 0);
    // The push moved the cart, the motor holds the arm near its target against its weight.
    EXPECT_GT(std::abs(a.at(a.rows() - 1, 1)), 1e-3);
    EXPECT_NEAR(a.at(a.rows() - 1, 2), 0.2, 0.1);
  }
}

}  // namespace
}  // namespace floatframe
