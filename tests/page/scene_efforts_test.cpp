// What elements exert at the frames of a scene, beside the formulas of their laws.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>

#include "floatframe/history/state_history.hpp"
#include "floatframe/page/scene_json.hpp"
#include "history/recorded_run.hpp"

namespace floatframe::test {
namespace {

/// A turning arm with a pulse, a following force and a torque at it, and a leg to the ground.
const std::string pushed_arm = R"(
points: {o: [0, 0, 0], b: [1, 0, 0]}
bodies:
  arm: {rigid: {mass: 1, centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.08, 0.08]}}
joints:
  hinge: {type: revolute, child: arm, at: o, axis: y, position: 0.2}
forces:
  push:
    {type: force, body: arm, at: b, direction: [0, 0, 2],
     magnitude: {table: [[0, 0], [0.1, 0], [0.15, 20], [0.2, 0], [1, 0]]}}
  thrust: {type: force, body: arm, at: b, direction: x, magnitude: 3, follows: true}
  twist: {type: torque, body: arm, at: b, direction: y, magnitude: -0.5}
  leg:
    {type: spring_damper, from: {body: ground, at: [1, 0, -1]}, to: {body: arm, at: b},
     spring: {linear: {stiffness: 500, free: 1}}, damper: 5}
outputs: {tip: {position: {body: arm, at: b}}}
simulation: {step: 0.005, duration: 0.3}
)";

struct Replayed {
  Model model;
  SceneFrames frames;
  PageBuffer buffer;
  nlohmann::ordered_json scene;
};

void replay(const std::string& text, Replayed& out,
            const std::function<void(SimulationDescription&)>& change = {}) {
  out.model = model_of(text);
  SimulationDescription o = out.model.simulation;
  if (change) change(o);
  const TemporaryFolder folder;
  const Recorded r = recorded_run(out.model, o, folder.file("x.ffr"));
  const StateHistory states(r.path);
  out.frames = scene_frames(out.model, states);
  add_replayed_values(out.model, states, o, out.frames);
  out.scene = scene_json(out.model, out.frames, out.buffer);
}

/// A number as the page holds it.
double page_number(const Replayed& r, std::size_t frame, std::size_t column) {
  const auto& data = r.scene["efforts"]["data"];
  const auto columns = data["shape"][1].get<std::size_t>();
  if (column >= columns) return r.scene["efforts"]["constants"][column - columns].get<double>();
  float x = 0.0F;
  std::memcpy(&x,
              r.buffer.bytes().data() + data["offset"].get<std::size_t>() +
                  (frame * columns + column) * sizeof x,
              sizeof x);
  return x;
}

Vec6 page_wrench(const Replayed& r, std::size_t force, std::size_t frame) {
  Vec6 out;
  for (int k = 0; k < 6; ++k)
    out[k] =
        page_number(r, frame, r.scene["forces"][force]["wrench"]["columns"][k].get<std::size_t>());
  return out;
}

TEST(SceneEfforts, AreThoseOfTheLawsAtEachFrame) {
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    Replayed r;
    replay(pushed_arm, r, [&](SimulationDescription& o) { o.coordinates = coordinates; });
    ASSERT_EQ(r.frames.time.size(), 61u);
    EXPECT_EQ(r.scene["efforts"]["data"]["type"], "f32");
    const auto& joint = r.scene["joints"][0]["values"];
    ASSERT_EQ(joint.size(), 2u);
    EXPECT_EQ(joint[0]["unit"], "rad");
    EXPECT_EQ(joint[1]["unit"], "rad/s");
    double largest = 0.0;
    for (std::size_t f = 0; f < r.frames.time.size(); ++f) {
      const double t = r.frames.time[f];
      const double angle = page_number(r, f, joint[0]["column"].get<std::size_t>());
      const double rate = page_number(r, f, joint[1]["column"].get<std::size_t>());
      const Vec3 tip(std::cos(angle), 0.0, -std::sin(angle));
      const double pulse = 2.0 * 20.0 * std::max(0.0, 1.0 - std::abs(t - 0.15) / 0.05);
      EXPECT_NEAR((page_wrench(r, 0, f).head<3>() - Vec3(0, 0, pulse)).norm(), 0.0, 1e-5);
      EXPECT_NEAR((page_wrench(r, 1, f).head<3>() - 3.0 * tip).norm(), 0.0, 1e-6) << "follows";
      Vec6 twist = Vec6::Zero();
      twist[4] = -0.5;
      EXPECT_NEAR((page_wrench(r, 2, f) - twist).norm(), 0.0, 1e-6);
      // Of the leg on the arm: -(k (s - 1) + c sdot) along it.
      const Vec3 leg = tip - Vec3(1, 0, -1);
      const Vec3 velocity = rate * Vec3(-std::sin(angle), 0.0, -std::cos(angle));
      const double s = leg.norm(), tension = 500.0 * (s - 1.0) + 5.0 * velocity.dot(leg) / s;
      EXPECT_NEAR((page_wrench(r, 3, f).head<3>() + tension * leg / s).norm(), 0.0, 2e-4);
      const auto& values = r.scene["forces"][3]["values"];
      ASSERT_EQ(values.size(), 3u);
      EXPECT_EQ(values[0]["unit"], "N");
      EXPECT_NEAR(page_number(r, f, values[0]["column"].get<std::size_t>()), tension, 2e-4);
      EXPECT_NEAR(page_number(r, f, values[1]["column"].get<std::size_t>()), s, 1e-6);
      largest = std::max(largest, std::abs(tension));
    }
    EXPECT_GT(largest, 1.0) << "the leg is at work";
    // The end on the arm, not the one on the ground.
    const auto at = r.scene["forces"][3]["wrench"]["at"].get<std::size_t>();
    EXPECT_EQ(r.scene["points"][at]["body"], 0);
  }
}

TEST(SceneEfforts, ConstantColumnsAreNumbersOfThePage) {
  Replayed r;
  replay(pushed_arm, r);
  const auto columns = r.scene["efforts"]["data"]["shape"][1].get<std::size_t>();
  const std::size_t constants = r.scene["efforts"]["constants"].size();
  EXPECT_EQ(columns + constants, r.frames.efforts.constant.size());
  // Of the torque all but its magnitude, which stands twice, is zero.
  for (const auto& column : r.scene["forces"][2]["wrench"]["columns"])
    EXPECT_GE(column.get<std::size_t>(), columns);
}

TEST(SceneEfforts, AngleOfAJointCountsTurns) {
  Replayed r;
  replay(recorded_machine + std::string("outputs: {a: {joint_position: drive}}\n"), r);
  const auto& drive = r.scene["joints"][0]["values"][0];
  for (std::size_t f = 0; f < r.frames.time.size(); ++f)
    EXPECT_NEAR(page_number(r, f, drive["column"].get<std::size_t>()),
                0.3 + 40.0 * r.frames.time[f], 1e-5);
  EXPECT_TRUE(r.scene["joints"][4]["values"].empty()) << "a free joint";
}

TEST(SceneEfforts, AreLeftOutIfStatesOfBodiesAre) {
  Replayed r;
  replay(recorded_machine + std::string("outputs: {a: {joint_position: drive}}\n"), r,
         [](SimulationDescription& o) { o.record.bodies = {"beam"}; });
  EXPECT_TRUE(r.scene["efforts"].is_null());
  for (const auto& force : r.scene["forces"]) EXPECT_TRUE(force["wrench"].is_null());
}

}  // namespace
}  // namespace floatframe::test
