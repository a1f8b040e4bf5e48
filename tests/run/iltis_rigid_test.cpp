// The rigid Iltis of the road-vehicle benchmark: nominal forces, equilibrium, and the cosine bump
// with both tyre laws against step-converged independent models (tolerances of that table: 0.02 mm
// in the highest chassis position and 0.02 deg in pitch, 0.05 mm in the lowest position after the
// bump stop, 30 N in peak forces, and the last printed digit of the distance covered).
#include <gtest/gtest.h>

#include <numbers>

#include "floatframe/formulation/relative.hpp"
#include "support/figures.hpp"
#include "support/iltis.hpp"
#include "support/trajectory_models.hpp"

namespace floatframe::test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

TEST(IltisRigid, NominalForces) {
  const Model model = build_model(iltis({{"flexible", "false"}}));
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  VecX q, v;
  f.start(q, v);
  v.setZero();
  f.positions(0.0, q);
  f.velocities(v);
  f.forces();
  const auto nominal = [&](const std::string& name, double printed, int decimals) {
    for (std::size_t k = 0; k < model.elements.size(); ++k)
      if (model.elements[k].name == name)
        return expect_digits("nominal " + name + " [N]", f.effort(static_cast<int>(k)).force,
                             printed, decimals);
    ADD_FAILURE() << name;
  };
  for (const std::string side : {"left", "right"}) {
    nominal("front_" + side + ".leaf", -2728.86, 2);
    nominal("rear_" + side + ".leaf", -2728.86, 2);
    nominal("front_" + side + ".shock", -128.03, 2);
    nominal("rear_" + side + ".shock", -128.03, 2);
    nominal("front_" + side + ".tyre", 3829.50, 2);
    nominal("rear_" + side + ".tyre", 3593.52, 2);
  }
}

/// Axial force of a link [N], tension positive: what the chassis exerts on it at its hinge, along
/// its own line.
double guide_rod_axial(const StaticsResult& s, const std::string& corner, double side) {
  const StaticsBody& link = body_of(s, corner + ".link");
  const Vec3 rpy = link.roll_pitch_yaw;
  const Mat3 R =
      (Eigen::AngleAxisd(rpy[2], Vec3::UnitZ()) * Eigen::AngleAxisd(rpy[1], Vec3::UnitY()) *
       Eigen::AngleAxisd(rpy[0], Vec3::UnitX()))
          .toRotationMatrix();
  const Vec3 along = R * Vec3(0.0, side * (0.488 - 0.1585), -0.039 - 0.030).normalized();
  return -joint_of(s, corner + ".link_hinge").force.dot(along);
}

TEST(IltisRigid, Equilibrium) {
  const Model model = build_model(iltis({{"flexible", "false"}}));
  const StaticsResult s = statics(model);
  const StaticsBody& chassis = body_of(s, "chassis");
  const double dz_mm = 1e3 * (chassis.position.z() - 0.57);
  const double pitch_deg = chassis.roll_pitch_yaw[1] / degree;
  expect_digits("chassis dz [mm]", dz_mm, -7.083, 3);
  expect_digits("pitch [deg]", pitch_deg, 0.1465, 4);
  EXPECT_LT(s.residual, 1e-8);
  for (const std::string side : {"left", "right"}) {
    const double sign = side == "left" ? 1.0 : -1.0;
    const std::string front = "front_" + side, rear = "rear_" + side;
    expect_digits(front + ".tyre force [N]", force_of(s, front + ".tyre").force, 3831.31, 2);
    expect_digits(rear + ".tyre force [N]", force_of(s, rear + ".tyre").force, 3591.91, 2);
    expect_digits(front + ".shock force [N]", force_of(s, front + ".shock").force, -335.29, 2);
    expect_digits(rear + ".shock force [N]", force_of(s, rear + ".shock").force, -241.64, 2);
    expect_digits(front + ".leaf force [N]", force_of(s, front + ".leaf").force, -3068.62, 2);
    expect_digits(rear + ".leaf force [N]", force_of(s, rear + ".leaf").force, -2885.51, 2);
    expect_digits(front + ".shock length [m]", force_of(s, front + ".shock").length, 0.434874, 6);
    expect_digits(rear + ".shock length [m]", force_of(s, rear + ".shock").length, 0.437943, 6);
    expect_digits(front + ".leaf length [m]", force_of(s, front + ".leaf").length, 0.066538, 6);
    expect_digits(rear + ".leaf length [m]", force_of(s, rear + ".leaf").length, 0.071637, 6);
    expect_digits(front + ".rod force [N]", force_of(s, front + ".rod").force, -3.99, 2);
    expect_digits(rear + ".rod force [N]", force_of(s, rear + ".rod").force, 5.05, 2);
    expect_digits(front + ".link axial [N]", guide_rod_axial(s, front, sign), -1408.51, 2);
    expect_digits(rear + ".link axial [N]", guide_rod_axial(s, rear, sign), -1335.52, 2);
    expect_digits(front + ".arm angle [rad]", sign * body_of(s, front + ".arm").roll_pitch_yaw[0],
                  0.03033, 5);
    expect_digits(rear + ".arm angle [rad]", sign * body_of(s, rear + ".arm").roll_pitch_yaw[0],
                  0.01401, 5);
  }
}

TEST(IltisRigid, RampAndPlateauAgainstAnIndependentModel) {
  // Every 10 ms up to the first stair. The history was integrated with fixed steps of 0.5 ms and
  // printed to 0.01 mm; where a wheel meets a corner of the road the two differ by a part of a
  // step.
  const trajectories::Csv reference =
      trajectories::read_csv(std::string(FLOATFRAME_TEST_DATA) + "/trajectories/iltis_rigid.csv");
  const ModelDescription d = iltis({{"flexible", "false"}});
  const Model model = build_model(d);
  const RunResult r = completed_run(model, with(d.simulation, combinations[0], 5e-4, 3.7, 0.01));
  ASSERT_EQ(r.table.rows(), reference.rows.size());
  const auto worst = [&](const char* ours, const char* theirs, double scale) {
    const std::size_t k = column(r.table, ours), j = reference.column(theirs);
    double x = 0.0;
    for (std::size_t i = 0; i < r.table.rows(); ++i)
      x = std::max(x, std::abs(scale * r.table.at(i, k) - reference.rows[i][j]));
    return x;
  };
  const double chassis = worst("chassis.z", "z_chassis", 1.0);
  const double front = worst("front_left.wheel.z", "z_wheel_FL", 1.0);
  const double rear = worst("rear_left.wheel.z", "z_wheel_RL", 1.0);
  const double pitch = worst("chassis.pitch", "pitch_deg", 1.0 / degree);
  figure("ramp and plateau, chassis height [m]", chassis);
  figure("ramp and plateau, front wheel height [m]", front);
  figure("ramp and plateau, rear wheel height [m]", rear);
  figure("ramp and plateau, pitch [deg]", pitch);
  EXPECT_LT(chassis, 1e-4);
  EXPECT_LT(front, 2e-4);
  EXPECT_LT(rear, 2e-4);
  EXPECT_LT(pitch, 0.01);
}

struct Bump {
  const char *speed, *law;
  double duration;
  double dz_max, t_max, dz_min, t_min;  // [mm], [s]
  double pitch_max, pitch_min;          // [deg]
  double front_max, rear_max;           // [N]
  double x_end;                         // [m]
};

class IltisBump : public ::testing::TestWithParam<Bump> {};

TEST_P(IltisBump, StepConvergedExtremes) {
  const Bump& b = GetParam();
  const ModelDescription d =
      iltis({{"flexible", "false"}, {"road", "bump"}, {"speed", b.speed}, {"tyre_law", b.law}});
  const Model model = build_model(d);
  const std::string label = std::string(b.speed) + " m/s " + b.law + " ";
  for (const Coordinates coordinates : both_coordinates) {
    const Combination c{coordinates, InertiaMethod::preprocessing};
    const RunResult r = completed_run(model, with(d.simulation, c, 1e-4, b.duration));
    const ResultTable& t = r.table;
    const Extreme z_max = maximum(t, "chassis.z"), z_min = minimum(t, "chassis.z");
    const std::string name = label + c.name() + " ";
    figure(name + "dz max [mm]", 1e3 * (z_max.value - 0.57));
    figure(name + "at [s]", z_max.time);
    figure(name + "dz min [mm]", 1e3 * (z_min.value - 0.57));
    figure(name + "at [s]", z_min.time);
    figure(name + "pitch max [deg]", maximum(t, "chassis.pitch").value / degree);
    figure(name + "pitch min [deg]", minimum(t, "chassis.pitch").value / degree);
    figure(name + "Fz front max [N]", maximum(t, "front_left.tyre.force").value);
    figure(name + "Fz rear max [N]", maximum(t, "rear_left.tyre.force").value);
    figure(name + "x at end [m]", t.at(t.rows() - 1, column(t, "chassis.x")));
    EXPECT_NEAR(1e3 * (z_max.value - 0.57), b.dz_max, 0.02);
    EXPECT_NEAR(z_max.time, b.t_max, 6e-4);
    EXPECT_NEAR(1e3 * (z_min.value - 0.57), b.dz_min, 0.05);
    EXPECT_NEAR(z_min.time, b.t_min, 6e-4);
    EXPECT_NEAR(maximum(t, "chassis.pitch").value / degree, b.pitch_max, 0.02);
    EXPECT_NEAR(minimum(t, "chassis.pitch").value / degree, b.pitch_min, 0.02);
    EXPECT_NEAR(maximum(t, "front_left.tyre.force").value, b.front_max, 30.0);
    EXPECT_NEAR(maximum(t, "rear_left.tyre.force").value, b.rear_max, 30.0);
    EXPECT_NEAR(t.at(t.rows() - 1, column(t, "chassis.x")), b.x_end, 6e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Table, IltisBump,
                         ::testing::Values(Bump{"10", "radial", 1.6, 311.161, 0.521, -83.54, 1.415,
                                                8.462, -8.385, 33820, 24912, 15.4380},
                                           Bump{"10", "vertical", 1.6, 322.221, 0.521, -90.28,
                                                1.431, 8.222, -8.410, 34225, 24890, 15.9973},
                                           Bump{"5", "radial", 2.0, 118.448, 0.706, -23.293, 1.491,
                                                7.728, -6.452, 6191.5, 5745.3, 9.6403},
                                           Bump{"5", "vertical", 2.0, 118.358, 0.641, -24.304,
                                                1.424, 8.301, -6.512, 6988.5, 5919.8, 10.0000}),
                         [](const ::testing::TestParamInfo<Bump>& i) {
                           return "Speed" + std::string(i.param.speed) + "_" + i.param.law;
                         });

}  // namespace
}  // namespace floatframe::test
