// Static equilibria far from the start: the search must go through states that are worse balanced
// than the start.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"
#include "support/descriptions.hpp"
#include "support/error_of.hpp"
#include "support/iltis.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

StaticsResult slider_crank(double angle) {
  return statics(build_model(read_model(FLOATFRAME_EXAMPLES "/slider_crank/slider_crank.yaml",
                                        {{"angle", std::to_string(angle)}})));
}

// The crank hangs down or, from starts near the top, stands in its unstable balance; either way
// the pin is a crank's length from the hinge, and half of the rod hangs from it (but for its sag).
TEST(Equilibrium, SliderCrankFromAnyAngle) {
  for (double angle = -3.1; angle < 3.2; angle += 0.2) {
    const StaticsResult s = slider_crank(angle);
    EXPECT_LT(s.residual, 1e-9) << angle;
    EXPECT_NEAR(std::abs(body_of(s, "rod").position.y()), 0.15, 1e-9) << angle;
    EXPECT_NEAR(joint_of(s, "crank_pin").force.y(), 0.5 * 9.81 * 0.0159043, 1e-5) << angle;
  }
}

TEST(Equilibrium, SliderCrankOfTheExampleHangsDown) {
  EXPECT_NEAR(body_of(slider_crank(M_PI / 4), "rod").position.y(), -0.15, 1e-9);
}

// Its matrices are dense: 800 MB each at this size.
TEST(Equilibrium, OfTooManyCoordinatesIsRefused) {
  ModelDescription d;
  d.name = "stones";
  for (int k = 0; k < 1667; ++k) {
    const std::string stone = "s" + std::to_string(k);
    d.bodies.push_back(make_body(stone, RigidDescription{1.0, Vec3::Zero(), Mat3::Identity()}));
    d.joints.push_back(make_joint("f" + std::to_string(k), JointType::free, "ground", stone));
  }
  const Model model = build_model(d);
  EXPECT_EQ(error_of([&] { statics(model); }), "too_large");
}

/// Displacement of the node of the first force.
Vec3 loaded_tip(const Model& model, const StaticsResult& s) {
  const FlexibleBody& body = *model.bodies[0].data;
  return body.nodes.at(model.markers.at(model.elements[0].markers.back()).node).X *
         s.bodies[0].amplitudes;
}

// Balance is measured against the forces that act: without weight, rounding of the elastic forces
// is all that is left of loads of any size.
TEST(Equilibrium, LoadsWithoutWeight) {
  const double bending = 2e11 * std::pow(0.02, 4) / 12.0;  // E I [N m2]
  for (const double load : {1e-3, 1.0, 37.0}) {
    ModelDescription d = description_of(R"(
gravity: [0, 0, 0]
points: {hub: [0, 0, 0], tip: [0.8, 0, 0]}
bodies:
  rod:
    flexible:
      material: {young: 2e11, poisson: 0.3, density: 7850}
      bars:
        bar: {from: hub, to: tip, elements: 8, section: {rectangle: [0.02, 0.02]}, reference: y}
      clamped: [hub]
      static_modes: [tip]
      normal_modes: 6
joints:
  hub: {type: weld, child: rod, at: hub}
forces:
  across: {type: force, body: rod, node: tip, direction: [0, 0.6, 0.8], magnitude: )" +
                                        std::to_string(load) + R"(}
  twist: {type: torque, body: rod, node: tip, direction: x, magnitude: )" +
                                        std::to_string(0.37 * load) + R"(}
)");
    const Model model = build_model(d);
    const StaticsResult s = statics(model);
    EXPECT_LT(s.iterations, 12) << load;
    EXPECT_LT(s.residual, 1e-11 * load) << load;
    const double sag = load * std::pow(0.8, 3) / (3.0 * bending),
                 across = loaded_tip(model, s).norm();
    const double second_order = 1e-9 + std::pow(sag / 0.8, 2);  // the ends turn, and their loads
    EXPECT_NEAR(across, sag, second_order * sag) << load;
    const double torque = load * std::hypot(0.8, 0.37);
    EXPECT_NEAR(joint_of(s, "hub").torque.norm(), torque, second_order * torque) << load;
  }
}

}  // namespace
}  // namespace floatframe::test
