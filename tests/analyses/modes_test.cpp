// Vibrations of the Iltis and of a hanging chain against what other programs and theories say of
// them, and what the report says.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

using Json = nlohmann::json;
using Complex = std::complex<double>;

/// Largest distance of the expected values from the nearest found, in parts of their size.
double worst_of(const std::vector<Complex>& expected, const Json& modes) {
  double worst = 0.0;
  for (const Complex& e : expected) {
    double best = 1e300;
    for (const Json& m : modes)
      best = std::min(best, std::abs(Complex(m["real_1_s"], m["imaginary_1_s"]) - e) / std::abs(e));
    worst = std::max(worst, best);
  }
  return worst;
}

// Computed by another program for the rigid vehicle about its equilibrium, vertical tyres.
TEST(Modes, OfTheRigidIltis) {
  const std::vector<Complex> expected{{-4.825, 11.003}, {-3.779, 9.585}, {-22.32, 13.45},
                                      {-27.16, 70.47},  {-29.07, 82.48}, {-28.90, 83.17},
                                      {-28.73, 86.13}};
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    Model model = load_model(FLOATFRAME_EXAMPLES "/iltis/iltis.yaml",
                             {{"flexible", "false"}, {"speed", "0"}});
    model.simulation.coordinates = coordinates;
    const auto json = Json::parse(modes_analysis().run(model).json);
    const double worst = worst_of(expected, json["modes"]);
    EXPECT_LT(worst, 1e-3) << json.dump(1);
    std::printf("[ figure ] iltis_eigenvalues %.1e of %d degrees of freedom\n", worst,
                json["degrees_of_freedom"].get<int>());
  }
}

// A chain of four bars on hinges, pulled straight by gravity, in its plane: the first three
// frequencies of a heavy chain of N equal links by the eigenvalues of the small motions written
// down by hand: with the angles t_i and link length l, mass m each,
//   M_ij = m l^2 (N - max(i, j) + c_ij),  K_ii = m g l (N - i + 1/2),  i from 1
TEST(Modes, OfAHangingChainOfRigidBars) {
  const Model model = model_of(R"(
bodies:
  a: {rigid: {mass: 2, centre_of_mass: [0, 0, -0.25],
      inertia: [0.0416666666666667, 0.0416666666666667, 0]}}
  b: {rigid: {mass: 2, centre_of_mass: [0, 0, -0.75],
      inertia: [0.0416666666666667, 0.0416666666666667, 0]}}
  c: {rigid: {mass: 2, centre_of_mass: [0, 0, -1.25],
      inertia: [0.0416666666666667, 0.0416666666666667, 0]}}
  d: {rigid: {mass: 2, centre_of_mass: [0, 0, -1.75],
      inertia: [0.0416666666666667, 0.0416666666666667, 0]}}
joints:
  one: {type: revolute, child: a, at: [0, 0, 0], axis: y}
  two: {type: revolute, parent: a, child: b, at: [0, 0, -0.5], axis: y}
  three: {type: revolute, parent: b, child: c, at: [0, 0, -1], axis: y}
  four: {type: revolute, parent: c, child: d, at: [0, 0, -1.5], axis: y}
simulation: {step: 0.001, duration: 1}
)");
  const int n = 4;
  const double m = 2.0, l = 0.5, g = 9.81;
  MatX M(n, n), K = MatX::Zero(n, n);
  for (int i = 1; i <= n; ++i) {
    K(i - 1, i - 1) = m * g * l * (n - i + 0.5);
    for (int j = 1; j <= n; ++j)
      M(i - 1, j - 1) = m * l * l * (i == j ? n - i + 1.0 / 3.0 : n - std::max(i, j) + 0.5);
  }
  const SymmetricEigen expected = generalised_eigenvalues(K, M);
  const auto json = Json::parse(modes_analysis().run(model).json);
  ASSERT_EQ(json["modes"].size(), 4u);
  for (int k = 0; k < n; ++k) {
    const double f = std::sqrt(expected.values[k]) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(json["modes"][k]["frequency_Hz"].get<double>(), f, 1e-9 * f);
    EXPECT_EQ(json["modes"][k]["kind"], "vibration");
    double sum = 0.0;
    for (const auto& part : json["modes"][k]["kinetic_energy"]) sum += part.get<double>();
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

// A free box, and a cart that creeps to its place: six rigid motions are named.
TEST(Modes, NamesRigidMotionsAndDecays) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
bodies:
  box: {position: [0, 0, 0], rigid: {mass: 2, inertia: [1, 1, 1]}}
  cart: {position: [0, 1, 0], rigid: {mass: 3}}
joints:
  fly: {type: free, child: box, at: [0, 0, 0]}
  slide: {type: prismatic, child: cart, at: [0, 1, 0], axis: x}
forces:
  pot: {type: joint_spring, joint: slide, spring: 10, damper: 600}
simulation: {step: 0.001, duration: 1}
)");
  const AnalysisReport report = modes_analysis().run(model);
  const auto json = Json::parse(report.json);
  int decay = 0;
  for (const auto& m : json["modes"]) {
    decay += m["kind"] == "decay";
    if (m["kind"] == "decay") {
      EXPECT_NEAR(m["potential_energy"]["pot"].get<double>(), 1.0, 1e-12);
    }
  }
  EXPECT_EQ(decay, 2);
  EXPECT_EQ(json["rigid_motions"], 6) << report.text;
  EXPECT_NE(report.text.find("6 rigid motions that nothing holds (frequency 0): moves box\n"),
            std::string::npos)
      << report.text;
}

}  // namespace
}  // namespace floatframe::test
