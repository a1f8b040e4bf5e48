// Prescribed joint coordinates: revolute and prismatic, sine and table, with the joint in the tree,
// reversed, or cut, in both formulations.
#include <gtest/gtest.h>

#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/model/constraint_part.hpp"
#include "support/completed_run.hpp"
#include "support/descriptions.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

enum class Place { tree, reversed, cut };

using Parameters = std::tuple<JointType, bool, Place, Coordinates>;

class PrescribedMotion : public ::testing::TestWithParam<Parameters> {};

TimeFunction motion(bool table) {
  TimeFunction f;
  if (table) {
    f.pieces = table_function({{0.0, 0.1}, {0.1, 0.3}, {0.2, -0.2}, {0.3, 0.0}},
                              Interpolation::cubic, Beyond::hold);
  } else {
    f.pieces = PiecewisePolynomial::polynomial({0.2, 1.0});
    f.sines = {{.amplitude = 0.4, .frequency = 3.0, .phase = 0.7}};
  }
  return f;
}

TEST_P(PrescribedMotion, CoordinateFollowsTheFunction) {
  const auto [type, table, place, coordinates] = GetParam();
  RandomSystem s(31);
  s.add_body("base", 0);
  s.add_body("arm", 2);
  s.add_body("tail", 0);
  const bool reversed = place == Place::reversed;
  s.add_joint("hang", JointType::spherical, ground_name, 0, "base", 0);
  JointDescription& drive =
      s.add_joint("drive", type, reversed ? "arm" : "base", 1, reversed ? "base" : "arm", 2);
  drive.motion = motion(table);
  drive.cut = place == Place::cut;
  s.add_joint("ball", JointType::spherical, "arm", 3, "tail", 0);
  s.d.outputs = {make_output("q", OutputType::joint_position, "drive"),
                 make_output("v", OutputType::joint_velocity, "drive")};
  SimulationDescription& o = s.d.simulation;
  o.coordinates = coordinates;
  o.step = 1e-3;
  o.duration = 0.3;
  o.tolerance = 1e-9;
  o.position_tolerance = 1e-10;
  const Model m = build_model(s.d);
  const RunResult r = completed_run(m, o);
  EXPECT_LT(r.summary.max_position_violation, 1e-10);
  EXPECT_LT(r.summary.max_velocity_violation, 1e-8);
  ASSERT_EQ(r.table.rows(), 301u);
  const TimeFunction f = motion(table);
  for (std::size_t k = 0; k < r.table.rows(); ++k) {
    const PiecewisePolynomial::Value v = evaluate(f, r.table.at(k, 0));
    ASSERT_NEAR(r.table.at(k, 1), v.f, 1e-9) << "t = " << r.table.at(k, 0);
    ASSERT_NEAR(r.table.at(k, 2), v.df, 1e-7) << "t = " << r.table.at(k, 0);
  }
}

std::string case_name(const ::testing::TestParamInfo<Parameters>& c) {
  const char* places[] = {"tree", "reversed", "cut"};
  return std::string(joint_type_name(std::get<0>(c.param))) +
         (std::get<1>(c.param) ? "_table_" : "_sine_") +
         places[static_cast<int>(std::get<2>(c.param))] +
         (std::get<3>(c.param) == Coordinates::relative ? "_relative" : "_absolute");
}

INSTANTIATE_TEST_SUITE_P(
    Drives, PrescribedMotion,
    ::testing::Combine(::testing::Values(JointType::revolute, JointType::prismatic),
                       ::testing::Bool(),
                       ::testing::Values(Place::tree, Place::reversed, Place::cut),
                       ::testing::ValuesIn(both_coordinates)),
    case_name);

// A revolute drive goes on through several turns.
TEST(PrescribedRotation, SeveralTurns) {
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    RandomSystem s(32);
    s.add_body("wheel", 0);
    JointDescription& j = s.add_joint("axle", JointType::revolute, ground_name, 0, "wheel", 0);
    j.motion = TimeFunction{PiecewisePolynomial::polynomial({0.0, 40.0})};
    s.d.outputs = {make_output("angle", OutputType::joint_position, "axle")};
    s.d.simulation.coordinates = coordinates;
    s.d.simulation.duration = 0.5;
    const RunResult r = completed_run(s.d);
    EXPECT_NEAR(r.table.at(r.table.rows() - 1, 1), 20.0, 1e-9);
  }
}

}  // namespace
}  // namespace floatframe::test
