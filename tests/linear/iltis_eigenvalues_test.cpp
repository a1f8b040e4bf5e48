// Eigenvalues of the rigid Iltis, at rest and driven straight on, against an independent
// linearisation of the same model (tests/data/vehicle/iltis.md).
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "floatframe/linear/linear_system.hpp"
#include "support/iltis.hpp"

namespace floatframe::test {
namespace {

struct IltisPoint {
  std::string tyre_law, wheels, speed;
  double chassis_z, pitch, arm_front, arm_rear, push;
  std::vector<std::complex<double>> eigenvalues;  ///< of each pair that with Im > 0
};

std::vector<IltisPoint> iltis_points() {
  std::ifstream file(std::string(FLOATFRAME_TEST_DATA) + "/vehicle/iltis_eigenvalues.csv");
  std::vector<IltisPoint> points;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::stringstream rest(line);
    for (std::string cell; std::getline(rest, cell, ',');) cells.push_back(cell);
    const auto number = [&](std::size_t k) { return std::stod(cells.at(k)); };
    if (points.empty() || points.back().tyre_law != cells[0] || points.back().speed != cells[2])
      points.push_back({cells[0],
                        cells[1],
                        cells[2],
                        number(3),
                        number(4),
                        number(5),
                        number(6),
                        number(7),
                        {}});
    points.back().eigenvalues.emplace_back(number(8), number(9));
  }
  return points;
}

/// The vehicle at the point, pushed so that it keeps its speed.
Model iltis_at(const IltisPoint& p) {
  ModelDescription d = iltis({{"flexible", "false"},
                              {"road", "flat"},
                              {"start", "given"},
                              {"tyre_law", p.tyre_law},
                              {"wheels", p.wheels},
                              {"speed", p.speed}});
  for (JointDescription& joint : d.joints) {
    if (joint.name == "chassis") joint.position = {0, 0, p.chassis_z - 0.57, 0, p.pitch, 0};
    if (!joint.name.ends_with(".arm_hinge")) continue;
    joint.position = {joint.name.starts_with("front") ? p.arm_front : p.arm_rear};
    joint.keep = true;
  }
  AppliedForce push;
  push.at = {"chassis", Vec3(0, 0, 0.57), std::nullopt, {}};
  push.magnitude.pieces = PiecewisePolynomial::polynomial({p.push});
  push.follows = true;
  d.forces.push_back({"push", push, {}});
  return build_model(d);
}

TEST(IltisEigenvalues, AgainstAnIndependentLinearisation) {
  const std::vector<IltisPoint> points = iltis_points();
  ASSERT_EQ(points.size(), 5u);
  for (const IltisPoint& p : points) {
    const LinearSystem system = linear_system(iltis_at(p));
    // What is left over is the spin of the wheels by the aligning moments, 0.0019 rad/s2.
    EXPECT_LT(system.acceleration, 2e-3);
    const std::vector<LinearMode> modes = linear_modes(system);
    double worst = 0.0;
    for (const std::complex<double>& e : p.eigenvalues) {
      double nearest = 1e300;
      for (const LinearMode& m : modes)
        nearest = std::min(nearest, std::abs(m.lambda - e) / std::abs(e));
      worst = std::max(worst, nearest);
    }
    figure("eigenvalues of the Iltis, " + p.tyre_law + " at " + p.speed + " m/s", worst);
    EXPECT_LT(worst, 1e-7) << p.tyre_law << " " << p.speed;
  }
}

}  // namespace
}  // namespace floatframe::test
