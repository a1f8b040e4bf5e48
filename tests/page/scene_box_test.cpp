// What stands for a body without a surface: a box or a disc of its inertia within its points, or
// nothing; and the symbols of elements.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "floatframe/model_file/load_model.hpp"
#include "floatframe/page/scene_json.hpp"
#include "floatframe/page/scene_mesh.hpp"
#include "history/recorded_run.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

using Json = nlohmann::ordered_json;

/// The bodies of a model as a page has them, by their names.
std::map<std::string, Json> drawn_bodies(const Model& model) {
  PageBuffer buffer;
  std::map<std::string, Json> out;
  const Json scene = scene_json(model, SceneFrames(), buffer);
  for (const Json& b : scene["bodies"]) out[b["name"]] = b;
  return out;
}

Mat3 inertia_of_box(double m, const Vec3& edges) {
  Mat3 J = Mat3::Zero();
  for (int k = 0; k < 3; ++k) J(k, k) = m / 12.0 * (edges.squaredNorm() - edges[k] * edges[k]);
  return J;
}

TEST(SceneBox, HasTheInertiaOfTheBody) {
  FlexibleBody body;
  const Vec3 edges(0.3, 0.2, 0.1);
  const double m = 6.0;
  const Mat3 R = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  body.invariants =
      InertiaInvariants::rigid(m, Vec3(1, 2, 3), R * inertia_of_box(m, edges) * R.transpose());
  const SceneBox box = scene_box(body, {}, {.mass = m});
  EXPECT_FALSE(box.round);
  EXPECT_FALSE(box.dummy);
  EXPECT_LT((box.position - Vec3(1, 2, 3)).norm(), 1e-12);
  EXPECT_NEAR(box.axes.determinant(), 1.0, 1e-12);
  for (int k = 0; k < 3; ++k) {  // in some order
    int at = 0;
    (box.size.array() - edges[k]).abs().minCoeff(&at);
    EXPECT_NEAR(box.size[at], edges[k], 1e-9);
    EXPECT_NEAR(std::abs(Vec3(box.axes.col(at)).dot(R.col(k))), 1.0, 1e-9);
  }
}

TEST(SceneBox, OfTwoEqualMomentsIsACylinder) {
  for (const auto& [r, h] : {std::pair{0.2, 0.05}, std::pair{0.02, 0.6}}) {
    const double m = 3.0, across = m * (3.0 * r * r + h * h) / 12.0;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 J = Vec3::Constant(across);
      J[axis] = 0.5 * m * r * r;
      FlexibleBody body;
      body.invariants = InertiaInvariants::rigid(m, Vec3(1, 0, 0), J.asDiagonal());
      const SceneBox disc = scene_box(body, {}, {.mass = m});
      EXPECT_TRUE(disc.round);
      EXPECT_NEAR(disc.axes.determinant(), 1.0, 1e-12);
      EXPECT_NEAR(std::abs(disc.axes(axis, 2)), 1.0, 1e-12);
      EXPECT_LT((disc.size - Vec3(2 * r, 2 * r, h)).norm(), 1e-9);
      // Bearings on its axis leave its diameter; a pin beside it bounds that.
      const Vec3 c(1, 0, 0), along = 0.4 * h * Vec3::Unit(axis);
      const SceneBox held = scene_box(body, {c - along, c + along}, {.mass = m, .reach = 9.0});
      EXPECT_LT((held.size - Vec3(2 * r, 2 * r, 0.8 * h)).norm(), 1e-9);
      const Vec3 pin = c + 0.3 * r * Vec3::Unit((axis + 1) % 3);
      if (r > h) {
        EXPECT_NEAR(scene_box(body, {pin}, {.mass = m, .reach = 9.0}).size[0], 0.6 * r, 1e-9);
      }
    }
  }
}

TEST(SceneBox, IsNoLargerThanThePointsOfTheBody) {
  FlexibleBody body;
  const Vec3 edges(2.0, 1.2, 0.4), c(0, 0, 0.5);
  body.invariants = InertiaInvariants::rigid(800.0, c, inertia_of_box(800.0, edges));
  const SceneExtent extent{.mass = 800.0, .reach = 3.0};
  const auto largest = [&](const std::vector<Vec3>& points, const SceneExtent& of) {
    const SceneBox box = scene_box(body, points, of);
    // Its proportions stay.
    EXPECT_NEAR(box.size.minCoeff() / box.size.maxCoeff(), 0.2, 1e-9);
    return box.size.maxCoeff();
  };
  EXPECT_NEAR(largest({c + Vec3(1, 0.6, 0), c - Vec3(1, 0.6, 0)}, extent), 2.0, 1e-9);
  EXPECT_NEAR(largest({c + Vec3(0.5, 0, 0), c}, extent), 1.0, 1e-9);
  // At its centre, or without: the points of the model.
  EXPECT_NEAR(largest({c}, extent), 2.0, 1e-9);
  EXPECT_NEAR(largest({c}, {.mass = 800.0, .reach = 0.7}), 0.7, 1e-9);
  EXPECT_NEAR(largest({}, {.mass = 800.0}), 2.0, 1e-9);
}

TEST(SceneBox, IsAbsentForDummies) {
  const auto dummy = [](double mass, double moment, double all) {
    FlexibleBody body;
    body.invariants = InertiaInvariants::rigid(mass, Vec3::Zero(), moment * Mat3::Identity());
    return scene_box(body, {Vec3(0, 0, 0.2)}, {.mass = all}).dummy;
  };
  EXPECT_TRUE(dummy(0.0, 0.0, 300.0)) << "no mass";
  EXPECT_TRUE(dummy(1.0, 1.0, 340.0)) << "a cube of 2.4 m of 1 kg";
  EXPECT_TRUE(dummy(1e-5, 0.0, 340.0));
  EXPECT_FALSE(dummy(1.0, 1.0, 10.0)) << "a tenth of all";
  EXPECT_FALSE(dummy(1.0, 1e-3, 340.0)) << "a cube of 8 cm of steel";
  FlexibleBody link;
  link.invariants = InertiaInvariants::rigid(0.0, Vec3::Zero(), Mat3::Zero());
  const SceneBox held = scene_box(link, {Vec3(0, 0, 0), Vec3(2, 0, 1)}, {});
  EXPECT_LT((held.position - Vec3(1, 0, 0.5)).norm(), 1e-15);
  EXPECT_LT((held.size - Vec3(2, 0.1, 1)).norm(), 1e-15);
  EXPECT_EQ(scene_box(link, {}, {}).size, Vec3::Constant(0.05));
}

TEST(SceneBox, OfTheExamples) {
  auto car = drawn_bodies(load_model(FLOATFRAME_EXAMPLES "/quarter_car/quarter_car.yaml"));
  EXPECT_TRUE(car["carriage"]["shape"].is_null()) << "a dummy that carries";
  EXPECT_TRUE(car["wheel"]["shape"].is_null()) << "its tyre is drawn";
  EXPECT_EQ(car["body"]["shape"]["kind"], "box");
  const auto rotor = drawn_bodies(load_model(FLOATFRAME_EXAMPLES "/rotor/rotor.yaml"));
  const Json& disc = rotor.at("disc")["shape"];
  EXPECT_EQ(disc["kind"], "cylinder");
  // 12 kg, 0.3 kg m2 about its axis: m r^2 / 2.
  EXPECT_NEAR(disc["size"][0].get<double>(), 2.0 * std::sqrt(2.0 * 0.3 / 12.0), 1e-9);
  EXPECT_NEAR(disc["size"][2].get<double>(), std::sqrt(12.0 * 0.01 / 12.0), 1e-9);
}

TEST(SceneSymbols, AreThoseOfTheKinds) {
  const Model m = model_of(R"(
bodies:
  a: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
  b: {rigid: {mass: 1, centre_of_mass: [1, 0, 0], inertia: [1, 1, 1]}}
joints:
  one: {type: revolute, child: a, at: [0, 0, 0], axis: y}
  two: {type: revolute, child: b, at: [1, 0, 0], axis: y}
couplings:
  same: {type: mimic, joint: two, follows: one}
forces:
  soft: {type: bushing, from: {body: a, at: [0, 0, 0]}, to: {body: ground, at: [0, 0, 0]},
    spring_x: 10}
  race: {type: bearing, from: {body: ground, at: [1, 0, 0]}, to: {body: b, at: [1, 0, 0]},
    axis: y, axis_2: z, stiffness: [[1e5, 0], [0, 1e5]], damping: [[0, 0], [0, 0]]}
)");
  PageBuffer buffer;
  const Json scene = scene_json(m, SceneFrames(), buffer);
  std::map<std::string, Json> found;
  for (const Json& f : scene["forces"]) found[f["name"]] = f;
  EXPECT_EQ(found["soft"]["picture"], "bushing");
  EXPECT_EQ(found["race"]["picture"], "bearing");
  EXPECT_EQ(found["same"]["picture"], "coupling");
  // About the axis of its joint, which is y.
  EXPECT_NEAR(std::abs(found["same"]["axis"][1].get<double>()), 1.0, 1e-12);
}

}  // namespace
}  // namespace floatframe::test
