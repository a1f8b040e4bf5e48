// Reactions, motor torque, accelerations of bodies and modes against references: pendulums on
// single joints by MSC Adams (examples/benchmarks), and the slider-crank with a flexible rod of
// the Test Set for IVP Solvers (B. Simeon; crank.f, later revision).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "floatframe/math/so3.hpp"
#include "support/descriptions.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

struct AdamsCase {
  const char *file, *joint;
};

class AdamsJoints : public ::testing::TestWithParam<AdamsCase> {
 protected:
  /// 0 time, 1 position, 4 velocity, 7 acceleration, 10 quaternion, 14 angular velocity, 17 angular
  /// acceleration, 20 force, 23 torque on the ground.
  static std::vector<std::array<double, 26>> reference(const std::string& name) {
    std::ifstream file(std::string(FLOATFRAME_EXAMPLES "/benchmarks/adams_") + name + "/adams.csv");
    std::vector<std::array<double, 26>> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::stringstream cells(line);
      std::string cell;
      std::array<double, 26> row{};
      for (double& x : row) {
        std::getline(cells, cell, ',');
        x = std::stod(cell);
      }
      rows.push_back(row);
    }
    return rows;
  }
};

Mat3 of_roll_pitch_yaw(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
          Eigen::AngleAxisd(roll, Vec3::UnitX()))
      .toRotationMatrix();
}

TEST_P(AdamsJoints, MotionAndReactionsAreThoseOfAdams) {
  const auto rows = reference(GetParam().file);
  ASSERT_GE(rows.size(), 6u);
  ModelDescription d = description_of(std::string(R"(
gravity: [0, 0, -9.80665]
bodies: {bob: {position: [3, 2, 3], rigid: {mass: 1, inertia: [0.04, 0.1, 0.1]}}}
joints: {joint: )") + GetParam().joint +
                                      R"(}
outputs:
  p: {position: bob}
  v: {velocity: bob}
  a: {acceleration: bob}
  w: {angular_velocity: bob}
  wd: {angular_acceleration: bob}
  F: {joint_force: joint}
  T: {joint_torque: joint}
  r: {rotation: bob}
simulation: {step: 0.001, duration: 5, output_interval: 0.05}
)");
  for (const Coordinates c : both_coordinates) {
    d.simulation.coordinates = c;
    const RunResult run_of = completed_run(d);
    const ResultTable& t = run_of.table;
    const auto& q0 = rows.front();
    const Mat3 R0 =
        Eigen::Quaterniond(q0[10], q0[11], q0[12], q0[13]).normalized().toRotationMatrix();
    std::array<double, 26> worst{};
    double turned = 0.0;
    for (const auto& x : rows) {
      const auto i = static_cast<std::size_t>(std::lround(x[0] / 0.05));
      ASSERT_LT(i, t.rows());
      const auto ours = [&](std::size_t column) { return t.at(i, 1 + column); };
      const std::size_t of[] = {1, 4, 7, 14, 17, 20, 23};  // p, v, a, w, wd, F, T
      for (std::size_t g = 0; g < 7; ++g)
        for (std::size_t k = 0; k < 3; ++k) {
          const double sign = g >= 5 ? -1.0 : 1.0;  // Adams' act on the ground
          const std::size_t at = of[g] + k;
          worst[of[g]] = std::max(worst[of[g]], std::abs(sign * ours(3 * g + k) - x[at]));
        }
      const Mat3 R = Eigen::Quaterniond(x[10], x[11], x[12], x[13]).normalized().toRotationMatrix();
      const Mat3 difference = of_roll_pitch_yaw(ours(21), ours(22), ours(23)) - R * R0.transpose();
      turned = std::max(turned, difference.cwiseAbs().maxCoeff());
    }
    const std::string who = std::string(GetParam().file) +
                            (c == Coordinates::relative ? ", relative, " : ", absolute, ");
    figure(who + "position [m]", worst[1]);
    figure(who + "velocity [m/s]", worst[4]);
    figure(who + "acceleration [m/s2]", worst[7]);
    figure(who + "rotation matrix", turned);
    figure(who + "angular velocity [rad/s]", worst[14]);
    figure(who + "angular acceleration [rad/s2]", worst[17]);
    figure(who + "force [N]", worst[20]);
    figure(who + "torque [N m]", worst[23]);
    EXPECT_LT(worst[1], 1e-3);
    EXPECT_LT(worst[4], 1e-3);
    EXPECT_LT(worst[7], 1e-2);
    EXPECT_LT(turned, 1e-3);
    EXPECT_LT(worst[14], 1e-3);
    EXPECT_LT(worst[17], 1e-2);
    EXPECT_LT(worst[20], 1e-2);
    EXPECT_LT(worst[23], 1e-2);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, AdamsJoints,
    ::testing::Values(
        AdamsCase{"revolute", "{type: revolute, child: bob, at: [1, 2, 3], axis: [0, 1, 1]}"},
        AdamsCase{"spherical", "{type: spherical, child: bob, at: [1, 2, 3]}"},
        AdamsCase{"prismatic", "{type: prismatic, child: bob, at: [1, 2, 3], axis: y}"}),
    [](const auto& param) { return std::string(param.param.file); });

// -- the slider-crank

struct CrankState {
  std::array<double, 3> p;  ///< crank and rod angle, slider
  std::array<double, 4> q;  ///< 2 bending, 2 axial
  std::array<double, 3> p_rate;
  std::array<double, 4> q_rate;
  std::array<double, 3> p_acceleration;
  std::array<double, 4> q_acceleration;
  std::array<double, 3> lambda;
};

constexpr CrankState crank_start = {
    {0, 0, 0.450016933},
    {0, 0, 1.03339863e-05, 1.69327969e-05},
    {150.0, -74.99576703969453, -2.68938671997904e-06},
    {0.444896112581599, 0.00463433931923867, -1.78591076000055e-06, -2.68938671997904e-06},
    {0, -0.001344541576709835, -5062.194924490193},
    {-6.82972566598631e-05, 1.813207639590617e-20, -4.268463266810281, 0.2098339029337557},
    {-6.552727150584648e-08, 382.4589509350831, -4.635908708561371e-09}};
/// At t = 0.1.
constexpr CrankState crank_end = {
    {15.00000000000104, -0.331173498825626, 0.169737332842786},
    {0.0001893192899613509, 2.375751249879174e-05, -5.323896770569702e-06, -8.363313279112129e-06},
    {150.0, 60.25346755138369, -8.753116326670527},
    {-0.03005541400289738, -0.005500431812571696, 0.0004974111734266989, 0.001105560003626645},
    {0.0, 6488.737541276957, 2167.938629509884},
    {33.91137060286523, 0.1715134772216488, -1.422449408912512, 1.00394642812481},
    {-62.32935833287916, -163.7920993367306, 25.29857947066878}};

/// The start of the benchmark is rounded: its slider is so far beyond the tip of the rod, and stays
/// there, since its loop is closed by accelerations [m].
constexpr double crank_gap = 2.031e-10;

/// The rod, its frame at the crank's pin: bending q1 sin(pi x) + q2 sin(2 pi x), axial
/// q3 4 x (1 - x) + q4 (2 x^2 - x), x = s / L2. The axial block of the mass matrix is that of
/// crank.f,
/// without the factor 1/15 of a line element.
FlexibleBody crank_rod() {
  constexpr double L = 0.3, m = 0.151104, h = 0.008, E = 2e11, pi = 3.1415927;
  const double k = E * h * h / L;
  FlexibleBody rod;
  rod.invariants = InertiaInvariants::zero(4);
  InertiaInvariants& v = rod.invariants;
  v.m = m;
  v.m_u = Vec3(0.5 * m * L, 0, 0);
  v.P_u(0, 0) = 0.0045339259;
  v.S.row(0) << 0, 0, 2.0 / 3.0 * m, m / 6.0;
  v.S.row(1) << 2.0 / pi * m, 0, 0, 0;
  v.Si[0].row(0) << 0, 0, L * m / 3.0, L * m / 6.0;
  v.Si[0].row(1) << L * m / pi, -0.5 * L * m / pi, 0, 0;
  v.Sij[1][1](0, 0) = v.Sij[1][1](1, 1) = 0.5 * m;
  v.Sij[0][0].bottomRightCorner<2, 2>() << 8 * m, m, m, 2 * m;
  MatX& xy = v.Sij[0][1];
  xy(2, 0) = m * 16.0 / (pi * pi * pi);
  xy(3, 0) = m * (1.0 / pi - 8.0 / (pi * pi * pi));
  xy(3, 1) = -0.5 * m / pi;
  v.Sij[1][0] = xy.transpose();
  rod.K = rod.D = MatX::Zero(4, 4);
  const double slender = h / L * h / L, pi4 = pi * pi * pi * pi;
  rod.K(0, 0) = k * pi4 / 24.0 * slender;
  rod.K(1, 1) = k * pi4 * 2.0 / 3.0 * slender;
  rod.K.bottomRightCorner<2, 2>() << k * 16.0 / 3.0, -k * 8.0 / 3.0, -k * 8.0 / 3.0, k * 7.0 / 3.0;
  for (const double s : {0.0, L}) {
    ModalNode node;
    node.name = s > 0.0 ? "tip" : "pin";
    node.p = Vec3(s, 0, 0);
    node.X = node.X_theta = Mat3X::Zero(3, 4);
    if (s > 0.0) node.X(0, 3) = 1.0;
    rod.nodes.push_back(node);
  }
  return rod;
}

/// At the state x; the slider hangs on the rod's tip and slides along x.
ModelDescription crank_model(const CrankState& x) {
  std::ostringstream text;
  text.precision(17);
  text << R"(
gravity: [0, 0, 0]
bodies:
  crank: {position: [0, 0, 0], rigid: {mass: 0.36, inertia: [0.002727, 0.002727, 0.002727]}}
  rod: {position: [0.15, 0, 0], rigid: {mass: 1, inertia: [1, 1, 1]}}
  slider: {position: [0.45, 0, 0], rigid: {mass: 0.075552, inertia: [1e-3, 1e-3, 1e-3]}}
joints:
  drive: {type: revolute, child: crank, at: [0, 0, 0], axis: z,
          motion: {piecewise: [{polynomial: [)"
       << x.p[0] << R"(, 150]}]}}
  pin: {type: revolute, parent: crank, child: rod, at: [0.15, 0, 0], axis: z, position: )"
       << x.p[1] - x.p[0] << ", velocity: " << x.p_rate[1] - x.p_rate[0] << R"(}
  guide: {type: prismatic, child: slider, at: [0.45, 0, 0], axis: x, position: )"
       << x.p[2] - crank_gap - 0.45 << ", velocity: " << x.p_rate[2] << R"(}
  tip: {type: revolute, parent: rod, child: slider, at: [0.45, 0, 0], axis: z}
outputs:
  rod: {rotation: rod, angle: yaw}
  x3: {position: slider, axis: x}
  F: {joint_force: guide}
  tip: {joint_force: tip}
  motor: {motion_force: drive}
  alpha: {angular_acceleration: rod, axis: z}
  a3: {acceleration: slider, axis: x}
simulation: {step: 1.0e-5, duration: 0, tolerance: 1.0e-12}
)";
  ModelDescription d = description_of(text.str());
  d.bodies[1].kind = crank_rod();
  d.joints[1].child.node = "pin";
  d.joints[3].parent.node = "tip";
  d.amplitudes["rod"] = Eigen::Map<const VecX>(x.q.data(), 4);
  d.amplitude_rates["rod"] = Eigen::Map<const VecX>(x.q_rate.data(), 4);
  for (const OutputType type : {OutputType::modal_amplitude, OutputType::modal_acceleration})
    for (int k = 0; k < 4; ++k) {
      const char* name = type == OutputType::modal_amplitude ? "q" : "qdd";
      d.outputs.push_back(make_output(name + std::to_string(k + 1), place_on("rod"), k, type));
    }
  return d;
}

/// lambda1: the rod's tip is at y = 0; lambda2: it is where the slider is; lambda3: the angle of
/// the crank. M a = f - G^T lambda: the guide pushes the slider by -lambda1 in y, the rod by
/// -lambda2 in x, the motor turns the crank by -lambda3.
void expect_multipliers(const ResultTable& t, std::size_t row, const CrankState& x,
                        const std::string& who) {
  const auto of = [&](const std::string& name) { return entry(t, row, name); };
  const double lambda[] = {-of("F.y"), -of("tip.x"), -of("motor")};
  for (std::size_t k = 0; k < 3; ++k) {
    const double error = std::abs(lambda[k] - x.lambda[k]) / std::max(1.0, std::abs(x.lambda[k]));
    figure(who + ", multiplier " + std::to_string(k + 1) + ", relative error", error);
    EXPECT_LT(error, 1e-5) << who << " " << k;
  }
}

TEST(SliderCrankBenchmark, MultipliersAndAccelerationsAtItsStates) {
  for (const Coordinates c : both_coordinates)
    for (const CrankState* x : {&crank_start, &crank_end}) {
      ModelDescription d = crank_model(*x);
      d.simulation.coordinates = c;
      const RunResult r = completed_run(d);
      const std::string who = name_of(c) + (x == &crank_start ? ", start" : ", end");
      expect_multipliers(r.table, 0, *x, who);
      const auto of = [&](const std::string& name) { return entry(r.table, 0, name); };
      EXPECT_NEAR(of("alpha"), x->p_acceleration[1], 1e-5 * 6489);
      EXPECT_NEAR(of("a3"), x->p_acceleration[2], 1e-5 * 5062);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(of("qdd" + std::to_string(k + 1)), x->q_acceleration[k], 1e-4 * 34) << who << k;
    }
}

ResultTable crank_run(Coordinates coordinates, double step) {
  ModelDescription d = crank_model(crank_start);
  d.simulation.coordinates = coordinates;
  d.simulation.duration = 0.1;
  d.simulation.output_interval = 0.1;
  d.simulation.step = step;
  return completed_run(d).table;
}

// The whole run, extrapolated from two steps of a method of second order. The axial modes (2e4
// rad/s) keep what the rounded start excites, and their phase decides the multipliers.
TEST(SliderCrankBenchmark, MultipliersAtTheEndOfARun) {
  const ResultTable coarse = crank_run(Coordinates::relative, 1.25e-6);
  ResultTable t = crank_run(Coordinates::relative, 0.625e-6);
  for (std::size_t k = 1; k < t.columns.size(); ++k)
    t.data[t.columns.size() + k] = (4.0 * t.at(1, k) - coarse.at(1, k)) / 3.0;
  const auto of = [&](const std::string& name) { return entry(t, 1, name); };
  figure("rod angle", std::abs(of("rod") - crank_end.p[1]));
  figure("slider", std::abs(of("x3") + crank_gap - crank_end.p[2]));
  EXPECT_NEAR(of("rod"), crank_end.p[1], 1e-8 * 0.33);
  EXPECT_NEAR(of("x3") + crank_gap, crank_end.p[2], 1e-8 * 0.17);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string name = "q" + std::to_string(k + 1);
    figure(name, std::abs(of(name) / crank_end.q[k] - 1.0));
    EXPECT_NEAR(of(name), crank_end.q[k], 1e-4 * std::abs(crank_end.q[k])) << name;
  }
  expect_multipliers(t, 1, crank_end, "run");
}

TEST(SliderCrankBenchmark, MultipliersOfARunAreThoseOfEitherFormulation) {
  const ResultTable a = crank_run(Coordinates::absolute, 1e-5);
  const ResultTable r = crank_run(Coordinates::relative, 1e-5);
  for (const char* name : {"F.y", "tip.x", "motor"}) {
    const std::size_t k = column(a, name);
    figure(std::string("absolute - relative, ") + name, a.at(1, k) - r.at(1, k));
    EXPECT_NEAR(a.at(1, k), r.at(1, k), 1e-5 * std::abs(r.at(1, k))) << name;
  }
}

}  // namespace
}  // namespace floatframe::test
