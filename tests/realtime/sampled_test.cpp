// Sampled controllers in real time, where steps are not divided: the same motion as that of a run;
// periods, offsets and delays that do not fit are refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "floatframe/realtime/realtime.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

Model sampled_model(const std::string& keys) {
  return model_of(R"(
gravity: [0, 0, 0]
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x, position: 0.3}}
forces: {motor: {type: joint_spring, joint: slide, actuator: {controller: b}}}
controllers:
  b: {type: pid, measured: {length: motor}, proportional: 60, derivative: 25, )" +
                  keys + R"(}
outputs: {x: {joint_position: slide}, u: {controller: b}}
simulation: {step: 0.01, duration: 1}
)");
}

RealTimeReport report_of(const Model& model, Coordinates c) {
  RealTimeOptions o;
  o.paced = false;
  return run_real_time(model, with(model.simulation, c), o, nullptr);
}

TEST(RealTimeSamples, MakeTheMotionOfARun) {
  const Model model = sampled_model("period: 0.03, offset: 0.01, delay: 0.02");
  for (const Coordinates c : both_coordinates) {
    const RealTimeReport r = report_of(model, c);
    const RunResult run = completed_run(model, with(model.simulation, c));
    EXPECT_EQ(r.status, "completed");
    ASSERT_EQ(r.outputs.size(), 2u);
    EXPECT_EQ(r.outputs[0], *(run.table.data.end() - 2));
    EXPECT_EQ(r.outputs[1], *(run.table.data.end() - 1));
  }
}

TEST(RealTimeSamples, MustFitTheSteps) {
  for (const char* keys : {"period: 0.015", "period: 0.03, offset: 0.005",
                           "period: 0.03, delay: 0.012", "period: 0.0100001"})
    EXPECT_EQ(error_of([&] { report_of(sampled_model(keys), Coordinates::relative); }),
              "out_of_range")
        << keys;
}

}  // namespace
}  // namespace floatframe::test
