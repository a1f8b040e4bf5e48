// What the reports of single analyses say: keys of their JSON, and values against the results.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/start/statics.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

using Json = nlohmann::json;

// Four bars in a plane and a spring: the loop is cut once, three of its constraints are redundant.
const char* const four_bar = R"(
bodies:
  left: {position: [0, 0, 0], rigid: {mass: 1, centre_of_mass: [0, 0, 0.5],
      inertia: [0.1, 0.1, 0.1]}}
  top: {position: [0, 0, 1], rigid: {mass: 1, centre_of_mass: [1, 0, 1], inertia: [0.1, 0.1, 0.1]}}
  right: {position: [2, 0, 0], rigid: {mass: 1, centre_of_mass: [2, 0, 0.5],
      inertia: [0.1, 0.1, 0.1]}}
joints:
  foot_left: {type: revolute, child: left, at: [0, 0, 0], axis: y}
  knee_left: {type: revolute, parent: left, child: top, at: [0, 0, 1], axis: y}
  foot_right: {type: revolute, child: right, at: [2, 0, 0], axis: y}
  knee_right: {type: revolute, parent: right, child: top, at: [2, 0, 1], axis: y}
forces:
  strut: {type: spring_damper, from: {body: ground, at: [0, 0, 0]}, to: {body: top,
      at: [2, 0, 1]}, spring: 1e5}
simulation: {step: 0.01, duration: 0.05}
)";

TEST(CheckJson, HasTheDocumentedKeys) {
  const Model model = model_of(four_bar);
  const auto json = Json::parse(check_analysis().run(model).json);
  EXPECT_EQ(json["bodies"], 3);
  EXPECT_EQ(json["flexible_bodies"], 0);
  EXPECT_EQ(json["joints"], 4);
  EXPECT_EQ(json["cut_joints"], 1);
  EXPECT_EQ(json["relative"].dump(), R"({"constraints":5,"elastic":0,"rigid":3,"total":3})");
  EXPECT_EQ(json["absolute"]["total"], 36);
  EXPECT_EQ(json["degrees_of_freedom"], 1);
  EXPECT_EQ(json["redundant_constraints"], 3);
  EXPECT_EQ(json["cut_joint_names"].size(), 1u);
  EXPECT_EQ(json["start"]["redundant"].size(), 3u);
  EXPECT_TRUE(json["flexible"].is_array());
}

// A bar on a hinge and a vertical rod at its end, which carries half of the weight.
TEST(StaticsReport, RodsFollowTheForces) {
  const Model model = model_of(R"(
bodies:
  bar: {rigid: {mass: 2, centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.2, 0.2]}}
joints:
  pin: {type: revolute, child: bar, at: [0, 0, 0], axis: y}
rods:
  tie: {from: {body: ground, at: [1, 0, 1]}, to: {body: bar, at: [1, 0, 0]}}
simulation: {step: 0.01, duration: 0.1}
)");
  const AnalysisReport report = statics_analysis().run(model);
  const auto json = Json::parse(report.json);
  ASSERT_EQ(json["forces"].size(), 1u);
  EXPECT_EQ(json["forces"][0]["type"], "rod");
  EXPECT_NEAR(json["forces"][0]["force"].get<double>(), 9.81, 1e-8);
  EXPECT_NE(report.text.find("tie"), std::string::npos);
  EXPECT_NE(report.text.find("9.8100  N"), std::string::npos) << report.text;
}

TEST(StaticsJson, ListsForcesJointsAndBodies) {
  const Model model = model_of(four_bar);
  const StaticsResult s = statics(model);
  const auto json = Json::parse(statics_analysis().run(model).json);
  EXPECT_EQ(json["iterations"], s.iterations);
  EXPECT_EQ(json["forces"][0]["name"], "strut");
  EXPECT_EQ(json["forces"][0]["type"], "spring_damper");
  EXPECT_EQ(json["forces"][0]["force"], s.forces[0].force);
  EXPECT_EQ(json["joints"][3]["torque"][1], s.joints[3].torque.y());
  EXPECT_EQ(json["bodies"][1]["position"][2], s.bodies[1].position.z());
  EXPECT_EQ(json["bodies"][0]["amplitudes"].dump(), "[]");
}

TEST(StaticsJson, MarksReactionsThatAreNotUnique) {
  const auto json = Json::parse(statics_analysis().run(model_of(four_bar)).json);
  EXPECT_EQ(json["redundant"].size(), 3u);
  for (const auto& joint : json["joints"]) {
    EXPECT_EQ(joint["unique"], false) << joint;
    // In the plane of the bars nothing is left open.
    EXPECT_EQ(joint["unique_force"].dump(), "[true,false,true]") << joint;
    EXPECT_EQ(joint["unique_torque"].dump(), "[false,true,false]") << joint;
  }
}

TEST(AdviceJson, HoldsTheRequest) {
  Analysis advise = advise_analysis();
  for (const Option& option : advise.options) {
    if (option.name == "--share") *std::get<double*>(option.target) = 0.02;
    if (option.name == "--repeat") *std::get<int*>(option.target) = 1;
  }
  const auto json = Json::parse(advise.run(model_of(four_bar)).json);
  EXPECT_EQ(json["step_s"], 0.01);
  EXPECT_EQ(json["thresholds"]["drop_share"], 0.02);
  EXPECT_EQ(json["thresholds"]["tolerance"], 0.01);
  EXPECT_EQ(json["modes"], 0);
  // Another command line begins with the defaults.
  for (const Option& option : advise_analysis().options)
    if (option.name == "--share") {
      EXPECT_EQ(*std::get<double*>(option.target), 0.001);
    }
}

}  // namespace
}  // namespace floatframe::test
