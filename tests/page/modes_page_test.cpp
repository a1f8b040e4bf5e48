// What a page holds of vibrations: shapes of the linear system, which keep joints closed and whirl
// the way the model does.
#include "floatframe/page/modes_page.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "floatframe/linear/linear_ports.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

using Json = nlohmann::ordered_json;
using Complex = std::complex<double>;

std::vector<ShownMotion> shown_motions(const LinearSystem& system) {
  std::vector<ShownMotion> out;
  for (const LinearMode& m : linear_modes(system))
    out.push_back(
        {m, "vibration", static_cast<int>(out.size()) + 1, {{"one", 0.3}, {"two", 0.7}}, {}});
  return out;
}

/// A shape of the page: rows of motion k.
std::vector<Complex> page_shape(const PageBuffer& buffer, const Json& view, std::size_t k) {
  EXPECT_EQ(view["type"], "f32");
  std::size_t rows = 1;
  for (std::size_t i = 2; i < view["shape"].size(); ++i)
    rows *= view["shape"][i].get<std::size_t>();
  EXPECT_EQ(view["shape"][1], 2);
  std::vector<float> numbers(2 * rows);
  std::memcpy(numbers.data(),
              buffer.bytes().data() + view["offset"].get<std::size_t>() + 8 * rows * k, 8 * rows);
  std::vector<Complex> out;
  for (std::size_t i = 0; i < rows; ++i) out.emplace_back(numbers[i], numbers[rows + i]);
  return out;
}

Eigen::Vector3cd triple_of(const std::vector<Complex>& shape, std::size_t at) {
  return {shape[at], shape[at + 1], shape[at + 2]};
}

Eigen::Vector3cd turned_arm(const Eigen::Vector3cd& turn, const Vec3& arm) {
  return {turn.y() * arm.z() - turn.z() * arm.y(), turn.z() * arm.x() - turn.x() * arm.z(),
          turn.x() * arm.y() - turn.y() * arm.x()};
}

// A bar that bends and stands askew on a hinge, a block welded to its end.
const char* const bar_with_block = R"(
points: {a: [1, 2, 3], b: [1.6, 2, 2.2]}
bodies:
  bar:
    flexible:
      material: {young: 7e9, poisson: 0.3, density: 2700}
      bars: {b: {from: a, to: b, elements: 4, section: {round: 0.02}}}
      clamped: [a]
      static_modes: [{point: b, dofs: [x, y, rx, ry]}]
  block: {position: [1.7, 2, 2.2], rigid: {mass: 2, inertia: [0.1, 0.2, 0.3]}}
joints:
  hinge: {type: revolute, child: bar, at: a, axis: y}
  glue: {type: spherical, parent: bar, child: block, at: b}
forces:
  hold: {type: joint_spring, joint: hinge, spring: 100, damper: 5}
outputs:
  end: {position: {body: bar, at: b}}
  corner: {position: {body: block, at: [1.75, 2.1, 2.3]}}
simulation: {step: 0.001, duration: 0.02}
)";

/// What a shape moves a marker by: the displacement of its body, the turn times the arm, and what
/// the modes of the body add.
Eigen::Vector3cd moved_marker(const Model& model, const Marker& m,
                              const std::vector<Complex>& shape,
                              const std::vector<Complex>& amplitudes) {
  const auto b = static_cast<std::size_t>(m.body);
  const FlexibleBody& data = *model.bodies[b].data;
  const Mat3& R = model.bodies[b].X_WB.R;
  Vec3 arm = m.X_NM.p;
  Eigen::Vector3cd bend = Eigen::Vector3cd::Zero();
  if (m.node >= 0) {
    const ModalNode& node = data.nodes[m.node];
    arm += node.p;
    for (Eigen::Index j = 0; j < data.modes(); ++j)  // of the only body that has modes
      bend += Vec3(node.X.col(j) + Vec3(node.X_theta.col(j)).cross(m.X_NM.p)) *
              amplitudes[static_cast<std::size_t>(j)];
  }
  return triple_of(shape, 6 * b) + turned_arm(triple_of(shape, 6 * b + 3), R * arm) + R * bend;
}

TEST(ModesPage, HoldsTheShapesOfTheSystem) {
  const Model model = model_of(bar_with_block);
  const LinearSystem system = linear_system(model);
  const std::vector<ShownMotion> motions = shown_motions(system);
  PageBuffer buffer;
  const Json page = scene_vibrations(system, motions, buffer);
  ASSERT_EQ(page["list"].size(), motions.size());
  EXPECT_EQ(page["places"]["shape"].dump(),
            Json({motions.size(), 2, model.bodies.size(), 6}).dump());
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const Eigen::VectorXcd places = system.places_of * motions[k].mode.z;
    const Eigen::VectorXcd bends = system.bends_of * motions[k].mode.z;
    const auto shape = page_shape(buffer, page["places"], k);
    const auto amplitudes = page_shape(buffer, page["amplitudes"], k);
    ASSERT_EQ(static_cast<Eigen::Index>(shape.size()), places.size());
    ASSERT_EQ(static_cast<Eigen::Index>(amplitudes.size()), bends.size());
    for (std::size_t i = 0; i < shape.size(); ++i)
      EXPECT_LE(std::abs(shape[i] - places[static_cast<Eigen::Index>(i)]), 1e-7 * places.norm());
    for (std::size_t i = 0; i < amplitudes.size(); ++i)
      EXPECT_LE(std::abs(amplitudes[i] - bends[static_cast<Eigen::Index>(i)]), 1e-7 * bends.norm());
    EXPECT_EQ(page["list"][k]["frequency"], motions[k].mode.damped());
    EXPECT_EQ(page["list"][k]["damping"], motions[k].mode.damping());
    EXPECT_EQ(page["list"][k]["moves"].dump(), R"([["two",0.7],["one",0.3]])");
  }
}

// The hinge does not move, and where the block is held it moves as the end of the bar does: the
// turn of a body times the arm, and what its modes add.
TEST(ModesPage, ShapesKeepJointsClosed) {
  const Model model = model_of(bar_with_block);
  const LinearSystem system = linear_system(model);
  const std::vector<ShownMotion> motions = shown_motions(system);
  PageBuffer buffer;
  const Json page = scene_vibrations(system, motions, buffer);
  ASSERT_EQ(model.bodies[0].modes(), 4);
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const auto shape = page_shape(buffer, page["places"], k);
    const auto amplitudes = page_shape(buffer, page["amplitudes"], k);
    double size = 0.0;  // metres, and radians on arms of about a metre; floats have seven digits
    for (const Complex& x : shape) size = std::max(size, std::abs(x));
    const auto moved = [&](int marker) {
      return moved_marker(model, model.markers[marker], shape, amplitudes);
    };
    EXPECT_LT(moved(model.joints[0].frame_M).norm(), 5e-7 * size) << k;
    const Joint& glue = model.joints[1];
    EXPECT_LT((moved(glue.frame_M) - moved(glue.frame_F)).norm(), 5e-7 * size) << k;
  }
}

// Positions that a run would measure, differentiated by z, move as the shapes say.
TEST(ModesPage, ShapesMoveOutputs) {
  const Model model = model_of(bar_with_block);
  const LinearModel linear = linear_model(model);
  const LinearSystem system = linear_system(model);  // with the same states
  ASSERT_EQ(system.A, linear.system.A);
  const std::vector<ShownMotion> motions = shown_motions(system);
  PageBuffer buffer;
  const Json page = scene_vibrations(system, motions, buffer);
  ASSERT_EQ(linear.C.rows(), 6);
  Marker corner;
  corner.body = 1;
  corner.X_NM.p = {0.05, 0.1, 0.1};
  for (std::size_t k = 0; k < motions.size(); ++k) {
    const auto shape = page_shape(buffer, page["places"], k);
    const auto amplitudes = page_shape(buffer, page["amplitudes"], k);
    const Eigen::VectorXcd measured = linear.C * motions[k].mode.z;
    double size = 0.0;
    for (const Complex& x : shape) size = std::max(size, std::abs(x));
    const Marker& end = model.markers[model.joints[1].frame_F];
    EXPECT_LT((moved_marker(model, end, shape, amplitudes) - measured.head(3)).norm(), 1e-6 * size)
        << k;
    EXPECT_LT((moved_marker(model, corner, shape, amplitudes) - measured.tail(3)).norm(),
              1e-6 * size)
        << k;
    EXPECT_GT(measured.norm(), 1e-3 * size) << k;
  }
}

// A heavy top that sleeps upright wobbles the way it spins: x + i y goes with e^(i w t), w > 0, so
// that y = -i x.
TEST(ModesPage, WhirlsTheWayItSpins) {
  for (const double spin : {250.0, -250.0}) {
    const Model model = model_of(R"(
bodies: {top: {position: [0, 0, 0.04], rigid: {mass: 0.5, inertia: [8e-4, 8e-4, 3e-4]}}}
joints: {tip: {type: spherical, child: top, at: [0, 0, 0], velocity: [0, 0, )" +
                                 std::to_string(spin) + R"(]}}
simulation: {step: 0.001, duration: 1}
)");
    const LinearSystem system = linear_system(model);
    const std::vector<ShownMotion> motions = shown_motions(system);
    PageBuffer buffer;
    const Json page = scene_vibrations(system, motions, buffer);
    EXPECT_TRUE(page["amplitudes"].is_null());
    int whirls = 0;
    for (std::size_t k = 0; k < motions.size(); ++k) {
      if (motions[k].mode.lambda.imag() < 1.0) continue;
      const auto shape = page_shape(buffer, page["places"], k);
      const Complex expected = Complex(0.0, spin > 0.0 ? -1.0 : 1.0) * shape[0];
      EXPECT_LT(std::abs(shape[1] - expected), 1e-5 * std::abs(shape[0])) << k;
      // The tip stands: the origin moves as the turn says.
      EXPECT_LT((triple_of(shape, 0) - turned_arm(triple_of(shape, 3), {0, 0, 0.04})).norm(),
                1e-6 * std::abs(shape[0]));
      ++whirls;
    }
    EXPECT_EQ(whirls, 2);
  }
}

}  // namespace
}  // namespace floatframe::test
