// Bearings against what is known without them: a gyroscopic disc in a bearing whose matrices are
// full and not symmetric, the onset of whirl that a cross-coupled stiffness drives, model files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/completed_run.hpp"
#include "support/descriptions.hpp"
#include "support/element_motion.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

using Vec5 = Eigen::Matrix<double, 5, 1>;
using Mat5 = Eigen::Matrix<double, 5, 5>;

struct BearingDisc {
  double mass = 2.0, across = 0.02, polar = 0.035, spin = 200.0;
  MatX K, C;
};

ModelDescription disc_model(const BearingDisc& disc, const Vec5& start) {
  ModelDescription d;
  d.gravity.setZero();
  const Mat3 J = Vec3(disc.across, disc.across, disc.polar).asDiagonal();
  d.bodies = {make_body("disc", RigidDescription{disc.mass, Vec3::Zero(), J})};
  JointDescription j = make_joint("free", JointType::free, "ground", "disc");
  j.position = {start[0], start[1], start[2], start[3], start[4], 0.0};
  j.velocity = {0.0, 0.0, 0.0, 0.0, 0.0, disc.spin};
  d.joints = {j};
  Bearing bearing;
  bearing.from = place_on("ground");
  bearing.to = place_on("disc");
  bearing.stiffness = disc.K;
  bearing.damping = disc.C;
  d.forces = {{"bearing", bearing, {}}};
  for (int k = 0; k < 3; ++k)
    d.outputs.push_back(
        make_output("r" + std::to_string(k), OutputType::joint_position, "free", k));
  return d;
}

/// Largest distance of a run from the small motions of (x, y, z, tilts), over the largest motion.
/// The disc's spin couples the tilts: M a + (C + G) v + K x = 0, H = polar spin (t_y, -t_x, 1).
double distance_from_equations(const BearingDisc& disc, double step, Coordinates coordinates) {
  Vec5 x, v = Vec5::Zero();
  x << 2e-6, -1e-6, 1e-6, 0.0, 0.0;  // the cross terms tilt it
  ModelDescription d = disc_model(disc, x);
  d.simulation.coordinates = coordinates;
  d.simulation.duration = 0.1;
  d.simulation.step = step;
  d.simulation.tolerance = 1e-13;
  const RunResult r = completed_run(d);

  const double J = disc.across, m = disc.mass;
  Vec5 mass;
  mass << m, m, m, J, J;
  Mat5 G = Mat5::Zero();
  G(3, 4) = disc.polar * disc.spin;
  G(4, 3) = -G(3, 4);
  const Mat5 K = disc.K.topLeftCorner<5, 5>(), C = disc.C.topLeftCorner<5, 5>() + G;
  const auto acceleration = [&](const Vec5& q, const Vec5& w) -> Vec5 {
    return -mass.cwiseInverse().cwiseProduct(K * q + C * w);
  };
  const int parts = 20;
  const double h = step / parts;
  double worst = 0.0, largest = 0.0;
  for (std::size_t row = 0; row < r.table.rows(); ++row) {
    for (int k = 0; k < 3; ++k)
      worst = std::max(worst, std::abs(r.table.at(row, static_cast<std::size_t>(1 + k)) - x[k]));
    largest = std::max(largest, x.head<3>().cwiseAbs().maxCoeff());
    for (int i = 0; i < parts; ++i) {  // Runge and Kutta
      const Vec5 a1 = acceleration(x, v), v2 = v + 0.5 * h * a1;
      const Vec5 a2 = acceleration(x + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
      const Vec5 a3 = acceleration(x + 0.5 * h * v2, v3), v4 = v + h * a3;
      const Vec5 a4 = acceleration(x + h * v3, v4);
      x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
      v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
  }
  return worst / largest;
}

BearingDisc cross_coupled() {
  BearingDisc disc;
  disc.K = MatX::Zero(6, 6);
  disc.K.topLeftCorner<5, 5>() << 8e4, 2.5e4, 3e3, 900.0, -2e3,  //
      -1.5e4, 6e4, 1e3, 1.5e3, 700.0,                            //
      2e3, -1e3, 9e4, 300.0, 500.0,                              //
      600.0, 1.8e3, 300.0, 900.0, 120.0,                         //
      -1.7e3, 500.0, 400.0, -60.0, 700.0;
  disc.C = MatX::Zero(6, 6);
  disc.C.topLeftCorner<5, 5>() << 60.0, 12.0, 0.0, 1.0, -0.5,  //
      -9.0, 50.0, 2.0, 0.4, 1.0,                               //
      0.0, 1.0, 40.0, 0.2, 0.3,                                //
      0.7, 0.5, 0.1, 0.4, 0.05,                                //
      -0.6, 0.8, 0.2, -0.04, 0.3;
  return disc;
}

TEST(Bearing, GyroscopicDiscInAFullBearingFollowsItsEquations) {
  const BearingDisc disc = cross_coupled();
  for (const Coordinates c : both_coordinates) {
    const double at_2 = distance_from_equations(disc, 2e-4, c),
                 at_1 = distance_from_equations(disc, 1e-4, c);
    EXPECT_LT(at_1, 5e-3);
    EXPECT_NEAR(std::log2(at_2 / at_1), 2.0, 0.1);
    std::printf("[ figure ] bearing_disc_error_at_0.1_ms %.2e order %.3f\n", at_1,
                std::log2(at_2 / at_1));
  }
}

/// Size of the whirl at the end over that in the middle of 2 s.
double whirl_growth(double cross) {
  BearingDisc disc;
  disc.spin = 0.0;
  disc.K = 8e4 * MatX::Identity(2, 2);
  disc.K(0, 1) = cross;
  disc.K(1, 0) = -cross;
  disc.C = 60.0 * MatX::Identity(2, 2);
  Vec5 start = Vec5::Zero();
  start[0] = 1e-6;
  ModelDescription d = disc_model(disc, start);
  d.simulation.duration = 2.0;
  d.simulation.step = 5e-4;
  d.simulation.tolerance = 1e-13;
  const RunResult r = completed_run(d);
  double middle = 0.0, end = 0.0;
  for (std::size_t row = 0; row < r.table.rows(); ++row) {
    const double size = std::hypot(r.table.at(row, 1), r.table.at(row, 2)), t = r.table.at(row, 0);
    if (t > 0.9 && t <= 1.1) middle = std::max(middle, size);
    if (t > 1.8) end = std::max(end, size);
  }
  return end / middle;
}

// m x'' + c x' + (k -+ i k_x) x = 0 turns from decay to growth where k_x = c sqrt(k/m): 12 000 N/m.
TEST(Bearing, CrossCoupledStiffnessDrivesWhirlAboveTheDamping) {
  const double onset = 60.0 * std::sqrt(8e4 / 2.0);
  EXPECT_LT(whirl_growth(0.99 * onset), 0.95);
  EXPECT_GT(whirl_growth(1.01 * onset), 1.05);
}

ModelDescription read_bearing(const std::string& force) {
  return description_of(
      "bodies:\n  shaft: {position: [0, 0, 1], rigid: {mass: 2, inertia: [1, 1, 1]}}\n"
      "forces:\n  film: {type: bearing, from: {body: ground, at: [0, 0, 0.9]}, "
      "to: {body: shaft, at: [0, 0, 1]}, axis: x, " +
      force + "}\n");
}

TEST(Bearing, InModelFiles) {
  const ModelDescription d =
      read_bearing("axis_2: y, stiffness: [[10, 2], [-3, 20]], damping: [[1, 0], [0, 1]]");
  const Model model = build_model(d);
  const Element& f = model.elements.at(0);
  EXPECT_EQ(f.type, ElementType::bearing);
  const Mat3 R = model.bodies.at(0).X_WB.R * model.markers.at(f.markers[1]).X_NM.R;
  EXPECT_LT((R.col(2) - Vec3::UnitX()).norm() + (R.col(0) - Vec3::UnitY()).norm(), 1e-15);
  ElementExample x;
  x.model = model;
  x.element = f;
  x.element.markers.clear();  // those of the example
  const Vec3 zero = Vec3::Zero();
  x.markers = {{Vec3(0, 0, 0.9), R, zero, zero, zero, zero},
               {Vec3(0, 0, 1.0), R, zero, zero, zero, zero}};
  EXPECT_LT(stacked(efforts(x)).norm(), 1e-14);  // drawn without a force
  x.markers[1].r.y() += 1e-3;                    // along e_1; e_2 is z
  EXPECT_LT((efforts(x).wrench[1].F - Vec3(0, -0.01, 0.003)).norm(), 1e-14);
}

TEST(Bearing, InvalidBearingsAreErrors) {
  const auto error = [](const std::string& force) {
    const std::string text = error_of([&] { read_bearing(force); });
    return text.substr(std::min(text.find("forces."), text.size()));
  };
  EXPECT_EQ(error("axis_2: y, stiffness: [[1, 2, 3]]"), "forces.film.stiffness: wrong_count");
  EXPECT_EQ(error("axis_2: y, stiffness: 5"), "forces.film.stiffness: wrong_value");
  EXPECT_EQ(error("axis_2: y, stiffness: [[1, 2], [3]]"), "forces.film.stiffness[2]: wrong_value");
  const std::string z = "[0, 0, 0, 0, 0, 0], ";
  EXPECT_EQ(error("axis_2: y, stiffness: [" + z + z + z + z + z + "[0, 0, 0, 0, 0, 1]]"),
            "forces.film.stiffness: out_of_range");
  EXPECT_EQ(error("axis_2: y"), "forces.film: missing");
}

}  // namespace
}  // namespace floatframe::test
