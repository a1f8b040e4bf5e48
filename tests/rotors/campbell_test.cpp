// Campbell diagrams against closed forms: a Laval rotor with a gyroscopic disc, a rigid rotor in
// bearings that are not round, the onset of instability by internal damping; rotors that are not
// symmetric.
#include "floatframe/rotors/campbell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/model_file/load_model.hpp"
#include "rotors/turning_modes.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A disc on a shaft without mass between hinges, at a of its length L. With r = y + i z and the
/// tilt phi, both e^(i w t):
///   (k11 - m w^2) r + k12 phi = 0,  k12 r + (k22 - J_t w^2 + J_p W w) phi = 0
struct LavalRotor {
  double EI = 2.1e11 * std::numbers::pi * std::pow(0.03, 4) / 64.0;
  double L = 1.0, a = 1.0 / 3.0, m = 12.0, J_p = 0.3, J_t = 0.16;

  Eigen::Matrix2d stiffness() const {
    const double b = L - a, c = 3.0 * EI * L;
    Eigen::Matrix2d flexibility;
    flexibility << a * a * b * b / c, a * b * (b - a) / c, a * b * (b - a) / c,
        (a * a - a * b + b * b) / c;
    return flexibility.inverse();
  }
  double determinant(double w, double W) const {
    const Eigen::Matrix2d K = stiffness();
    return (K(0, 0) - m * w * w) * (K(1, 1) - J_t * w * w + J_p * W * w) - K(0, 1) * K(0, 1);
  }
  /// Zeros of g between from and to.
  template <class G>
  static std::vector<double> zeros(double from, double to, const G& g) {
    std::vector<double> found;
    constexpr int parts = 20000;
    for (int k = 0; k < parts; ++k) {
      double a = from + (to - from) * k / parts, b = from + (to - from) * (k + 1) / parts;
      if ((g(a) > 0.0) == (g(b) > 0.0)) continue;
      for (int i = 0; i < 60; ++i)
        ((g(0.5 * (a + b)) > 0.0) == (g(a) > 0.0) ? a : b) = 0.5 * (a + b);
      found.push_back(0.5 * (a + b));
    }
    return found;
  }
};

CampbellOptions motor(double from, double to, double step) {
  CampbellOptions o;
  o.joint = "motor";
  o.from = from;
  o.to = to;
  o.step = step;
  o.axis = Vec3::UnitX();
  return o;
}

// The shaft has a thousandth of the disc's mass, the bearings ten thousand times its stiffness.
TEST(Campbell, LavalRotorWithGyroscopicDisc) {
  const LavalRotor laval;
  const Model model =
      load_model(FLOATFRAME_EXAMPLES "/rotor/rotor.yaml", {{"density", "10"}, {"bearing", "1e10"}});
  const CampbellDiagram d = campbell(model, motor(0.0, 900.0, 75.0));
  ASSERT_GE(d.lines.size(), 5u);
  EXPECT_LT(d.dependence_on_angle, 1e-5);
  double worst = 0.0, critical = 0.0;
  for (std::size_t s = 1; s < d.speeds.size(); ++s) {
    const double W = d.speeds[s];
    const auto w =
        LavalRotor::zeros(-3000.0, 3000.0, [&](double x) { return laval.determinant(x, W); });
    ASSERT_EQ(w.size(), 4u);
    for (const double expected : w) {
      double best = 1e300, whirl = 0.0;
      for (const CampbellLine& line : d.lines) {
        const CampbellPoint& p = line.points[s];
        if (p.across < 0.5 || p.whirl * expected < 0.0) continue;
        const double off = std::abs(p.frequency() / std::abs(expected) - 1.0);
        if (off >= best) continue;
        best = off;
        whirl = std::abs(p.whirl);
      }
      EXPECT_GT(whirl, 0.99);  // round bearings: circles
      worst = std::max(worst, best);
    }
  }
  for (const double direction : {1.0, -1.0}) {
    const auto expected = LavalRotor::zeros(
        1.0, 899.0, [&](double W) { return laval.determinant(direction * W, W); });
    // Unbalance excites forward whirl alone.
    const std::vector<CriticalSpeed>& speeds = direction > 0.0 ? d.critical : d.crossings;
    for (const double W : expected) {
      double best = 1e300;
      for (const CriticalSpeed& c : speeds)
        if (c.whirl * direction > 0.5) best = std::min(best, std::abs(c.speed / W - 1.0));
      critical = std::max(critical, best);
    }
    const auto found = std::count_if(speeds.begin(), speeds.end(), [&](const CriticalSpeed& c) {
      return c.whirl * direction > 0.5 &&
             d.lines[static_cast<std::size_t>(c.line)].kind != "axial or torsion";
    });
    EXPECT_EQ(found, static_cast<long>(expected.size()));
  }
  std::printf("[ figure ] laval_rotor lines %.1e critical speeds %.1e\n", worst, critical);
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(critical, 1e-3);
}

// Lines are followed across each other: the mode along the axis keeps its frequency where the
// backward line of the disc crosses it.
TEST(Campbell, LinesCross) {
  const Model model = load_model(FLOATFRAME_EXAMPLES "/rotor/rotor.yaml");
  const CampbellDiagram d = campbell(model, motor(0.0, 900.0, 100.0));
  const auto axial = std::find_if(d.lines.begin(), d.lines.end(), [](const CampbellLine& l) {
    return l.kind == "axial or torsion";
  });
  ASSERT_NE(axial, d.lines.end());
  for (const CampbellPoint& p : axial->points) EXPECT_NEAR(p.frequency(), 747.19, 0.05);
  int above_then_below = 0;
  for (const CampbellLine& l : d.lines)
    above_then_below +=
        l.points.front().frequency() > 750.0 && l.points.back().frequency() < 740.0 ? 1 : 0;
  EXPECT_EQ(above_then_below, 1);
}

/// A rigid rotor that spins about z in one bearing of five stiffnesses.
std::string rigid_rotor(const char* inertia) {
  return std::string(R"(
gravity: [0, 0, 0]
bodies: {disc: {position: [0, 0, 0], rigid: {mass: 2, inertia: )") +
         inertia + R"(}}}
joints: {motor: {type: free, child: disc, at: [0, 0, 0]}}
forces:
  housing: {type: bearing, from: {body: ground, at: [0, 0, 0]}, to: {body: disc, at: [0, 0, 0]},
    stiffness: [[8e4, 1e4, 0, 0, -2e3, 0], [1e4, 5e4, 0, 1.5e3, 0, 0], [0, 0, 9e4, 0, 0, 0],
      [0, 1.5e3, 0, 900, 100, 0], [-2e3, 0, 0, 100, 600, 0], [0, 0, 0, 0, 0, 0]],
    damping: [[6, 2, 0, 0, 0, 0], [-3, 5, 0, 0, 0, 0], [0, 0, 3, 0, 0, 0],
      [0, 0, 0, 0.04, 0, 0], [0, 0, 0, 0, 0.03, 0], [0, 0, 0, 0, 0, 0]]}
simulation: {step: 0.001, duration: 1}
)";
}

TEST(Campbell, RigidRotorInBearingsThatAreNotRound) {
  const double m = 2.0, J = 0.02, polar = 0.035;
  const Model model = model_of(rigid_rotor("[0.02, 0.02, 0.035]"));
  TurningModel turning(model, "motor", Vec3::UnitZ());
  double worst = 0.0;
  for (const double W : {0.0, 60.0, 400.0}) {
    MatX K(5, 5), C(5, 5);
    K << 8e4, 1e4, 0, 0, -2e3, 1e4, 5e4, 0, 1.5e3, 0, 0, 0, 9e4, 0, 0, 0, 1.5e3, 0, 900, 100, -2e3,
        0, 0, 100, 600;
    C << 6, 2, 0, 0, 0, -3, 5, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0.04, polar * W, 0, 0, 0,
        -polar * W, 0.03;
    VecX mass(5);
    mass << m, m, m, J, J;
    worst = std::max(worst, distance_of_modes(mass, C, K, turning.modes(W)));
  }
  std::printf("[ figure ] rigid_rotor_eigenvalues %.1e\n", worst);
  EXPECT_LT(worst, 1e-7);
}

// m lambda^2 + (c_e + c_i) lambda + k - i W c_i = 0 for r = y + i z: unstable from
// W = sqrt(k / m) (1 + c_e / c_i) on.
TEST(Campbell, InternalDampingMakesUnstable) {
  const double external = 30.0;  // [N s/m]
  const Model model = model_of(R"(
gravity: [0, 0, 0]
points: {left: [0, 0, 0], middle: [0.5, 0, 0], right: [1, 0, 0]}
bodies:
  shaft:
    flexible:
      material: {young: 2.1e11, poisson: 0.3, density: 100}
      bars:
        a: {from: middle, to: left, elements: 6, section: {round: 0.03}}
        b: {from: middle, to: right, elements: 6, section: {round: 0.03}}
      clamped: [middle]
      static_modes: [{point: left, dofs: [y, z]}, {point: right, dofs: [y, z]}]
      damping: 0.5
  disc: {rigid: {mass: 12, centre_of_mass: middle, inertia: [0.3, 0.16, 0.16]}}
joints:
  motor: {type: free, child: shaft, at: middle}
  hub: {type: weld, parent: shaft, child: disc, at: middle}
forces:
  left: {type: bearing, from: {body: ground, at: left}, to: {body: shaft, at: left}, axis: x,
    axis_2: y, stiffness: [[1e9, 0], [0, 1e9]], damping: [[0, 0], [0, 0]]}
  right: {type: bearing, from: {body: ground, at: right}, to: {body: shaft, at: right}, axis: x,
    axis_2: y, stiffness: [[1e9, 0], [0, 1e9]], damping: [[0, 0], [0, 0]]}
  air: {type: bearing, from: {body: ground, at: middle}, to: {body: disc, at: middle}, axis: x,
    axis_2: y, stiffness: [[0, 0], [0, 0]], damping: [[30, 0], [0, 30]]}
simulation: {step: 0.001, duration: 1}
)");
  // Half of the shaft in one plane: the static mode of one end.
  const FlexibleBody& shaft = *model.bodies[0].data;
  const double k = 2.0 * shaft.K(0, 0), internal = 2.0 * shaft.D(0, 0);
  EXPECT_NEAR(k, 48.0 * LavalRotor().EI, 1e-6 * k);
  const double onset = std::sqrt(k / 12.0) * (1.0 + external / internal);
  const CampbellDiagram d = campbell(model, motor(0.0, 1.6 * onset, 0.1 * onset));
  ASSERT_EQ(d.unstable.size(), 1u);
  const double found = d.unstable[0].speed;
  std::printf("[ figure ] internal_damping onset %.2f rad/s, %.2f times the frequency, %.1e\n",
              found, found / std::sqrt(k / 12.0), found / onset - 1.0);
  EXPECT_NEAR(found, onset, 2e-3 * onset);
  EXPECT_NEAR(d.unstable[0].frequency, std::sqrt(k / 12.0), 2e-3 * std::sqrt(k / 12.0));
  EXPECT_GT(onset, 1.2 * std::sqrt(k / 12.0));
}

// A disc in free space nutates at J_p / J_t times its spin, and has no critical speed.
TEST(Campbell, FreeDiscNutates) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
bodies: {disc: {position: [0, 0, 0], rigid: {mass: 1, inertia: [1, 1, 1.8]}}}
joints: {motor: {type: free, child: disc, at: [0, 0, 0]}}
simulation: {step: 0.001, duration: 1}
)");
  const CampbellDiagram d = campbell(model, {.joint = "motor", .from = 0, .to = 100, .step = 50});
  ASSERT_EQ(d.lines.size(), 1u);
  EXPECT_EQ(d.lines[0].kind, "forward");
  EXPECT_NEAR(d.lines[0].points[2].frequency(), 180.0, 1e-6);
  EXPECT_TRUE(d.critical.empty());
}

TEST(Campbell, RotorsThatAreNotSymmetric) {
  const Model model = model_of(rigid_rotor("[0.02, 0.024, 0.035]"));
  const auto turned = [&] {
    campbell(model, {.joint = "motor", .from = 0, .to = 100, .step = 20});
  };
  EXPECT_TRUE(contains(sentences_of(turned), "depends on the angle"));
}

}  // namespace
}  // namespace floatframe::test
