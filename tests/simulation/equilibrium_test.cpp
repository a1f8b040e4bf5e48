// Static equilibria far from the start: the search must go through states that are worse balanced
// than the start.
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/io/model_reader.hpp"
#include "floatframe/simulation/simulation.hpp"
#include "simulation/iltis.hpp"

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

}  // namespace
}  // namespace floatframe::test
