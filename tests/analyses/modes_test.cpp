// Vibrations of the Iltis and of a hanging chain against what other programs and theories say of
// them, and what the report says.
#include <fmt/format.h>
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

// Of the rigid vehicle about its equilibrium, vertical tyres, by another program.
const std::vector<Complex> iltis_sheet{{-4.825, 11.003}, {-3.779, 9.585}, {-22.32, 13.45},
                                       {-27.16, 70.47},  {-29.07, 82.48}, {-28.90, 83.17},
                                       {-28.73, 86.13}};

// To every digit: that program took for the shock absorbers the slopes that the public model
// quotes, 24529 N/m in front and 36975 N/m behind. Their law has 24439 and 37088 N/m at the lengths
// of the equilibrium (0.434874 m, 0.437943 m), with the same forces there.
TEST(Modes, OfTheRigidIltisWithTheSlopesOfTheSheet) {
  ModelDescription d = load_description(FLOATFRAME_EXAMPLES "/iltis/iltis.yaml",
                                        {{"flexible", "false"}, {"speed", "0"}});
  for (ElementDescription& e : d.forces) {
    if (!e.name.ends_with(".shock")) continue;
    const bool front = e.name.starts_with("front");
    const double length = front ? 0.434874 : 0.437943, slope = front ? 24529.0 : 36975.0;
    const double force = -4.0092e6 + length * (2.8397e7 + length * (-6.7061e7 + length * 5.2796e7));
    std::get<SpringDamper>(e.kind).spring =
        PiecewisePolynomial::polynomial({force - slope * length, slope});
  }
  const auto json = Json::parse(modes_analysis().run(build_model(d)).json);
  for (const Complex& e : iltis_sheet) {
    const double digit = std::abs(e.real()) < 10.0 ? 5e-4 : 5e-3;
    double real = 1e9, imaginary = 1e9;
    for (const Json& m : json["modes"]) {
      const Complex found(m["real_1_s"], m["imaginary_1_s"]);
      if (std::abs(found - e) > 0.1) continue;
      real = std::abs(found.real() - e.real());
      imaginary = std::abs(found.imag() - e.imag());
    }
    EXPECT_LE(real, 1.001 * digit) << e;
    EXPECT_LE(imaginary, 1.001 * digit) << e;
  }
}

TEST(Modes, OfTheRigidIltis) {
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    Model model = load_model(FLOATFRAME_EXAMPLES "/iltis/iltis.yaml",
                             {{"flexible", "false"}, {"speed", "0"}});
    model.simulation.coordinates = coordinates;
    const auto json = Json::parse(modes_analysis().run(model).json);
    const double worst = worst_of(iltis_sheet, json["modes"]);
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

/// The same in its plane with bars that bend: beams of cubic elements between hinges, with the
/// stiffness of the tension T(z), which falls linearly to the lower end. Two unknowns a node and a
/// second angle at each hinge.
MatX assembled_chain(int bars, int elements, double length, double EI, double rho_A, MatX& M) {
  const int n = bars * elements + bars * (elements + 1);
  MatX K = MatX::Zero(n, n);
  M = MatX::Zero(n, n);
  const double h = length / elements, total = bars * length;
  for (int b = 0; b < bars; ++b)
    for (int e = 0; e < elements; ++e) {
      // Displacements of the nodes, the first is held; then the angles of each bar.
      const auto displacement = [&](int local) {
        return b * elements + local == 0 ? -1 : b * elements + local - 1;
      };
      const auto angle = [&](int local) { return bars * elements + b * (elements + 1) + local; };
      const int dof[4] = {displacement(e), angle(e), displacement(e + 1), angle(e + 1)};
      Eigen::Matrix4d bend, mass, pull;
      bend << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h,
          6 * h, 2 * h * h, -6 * h, 4 * h * h;
      bend *= EI / (h * h * h);
      mass << 156, 22 * h, 54, -13 * h, 22 * h, 4 * h * h, 13 * h, -3 * h * h, 54, 13 * h, 156,
          -22 * h, -13 * h, -3 * h * h, -22 * h, 4 * h * h;
      mass *= rho_A * h / 420.0;
      pull.setZero();  // int T w'w' dz by Gauss points
      const double point[3] = {-std::sqrt(0.6), 0.0, std::sqrt(0.6)}, weight[3] = {5, 8, 5};
      for (int g = 0; g < 3; ++g) {
        const double s = 0.5 * (1.0 + point[g]), z = b * length + (e + s) * h;
        const double T = rho_A * 9.81 * (total - z);
        Eigen::Vector4d d(6 * s * s - 6 * s, h * (1 - 4 * s + 3 * s * s), 6 * s - 6 * s * s,
                          h * (3 * s * s - 2 * s));
        d /= h;
        pull += T * weight[g] / 18.0 * h * d * d.transpose();
      }
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          if (dof[i] >= 0 && dof[j] >= 0) {
            K(dof[i], dof[j]) += bend(i, j) + pull(i, j);
            M(dof[i], dof[j]) += mass(i, j);
          }
    }
  return K;
}

// Four flexible bars (eight fixed-interface modes each way, geometric stiffening) against the
// assembled beams: swinging, and bending under tension.
TEST(Modes, OfAHangingChainOfBarsThatBend) {
  std::string bodies, joints;
  for (int k = 0; k < 4; ++k) {
    bodies += fmt::format(R"(
  bar{0}:
    flexible:
      material: {{young: 2e9, poisson: 0.3, density: 1200}}
      bars: {{b: {{from: p{0}, to: p{1}, elements: 20, section: {{round: 0.01}}}}}}
      clamped: [{{point: p{0}, dofs: [x, y, z, rx, rz]}}, {{point: p{1}, dofs: [x]}}]
      static_modes: [{{point: p{0}, dofs: [ry]}}, {{point: p{1}, dofs: [ry]}}]
      normal_modes: 12
      mass_model: hermite
)",
                          k, k + 1);
    joints += fmt::format("  j{0}: {{type: revolute, {1}child: bar{0}, at: p{0}, axis: y}}\n", k,
                          k == 0 ? std::string() : fmt::format("parent: bar{}, ", k - 1));
  }
  const Model model = model_of(
      "points: {p0: [0, 0, 0], p1: [0, 0, -0.5], p2: [0, 0, -1], p3: [0, 0, -1.5], p4: [0, 0, "
      "-2]}\nbodies:" +
      bodies + "joints:\n" + joints +
      "simulation: {step: 0.001, duration: 1, geometric_stiffening: true, start: equilibrium}\n");
  MatX M;
  const double r = 0.005, area = std::numbers::pi * r * r;
  const MatX K = assembled_chain(4, 20, 0.5, 2e9 * 0.25 * area * r * r, 1200 * area, M);
  const SymmetricEigen expected = generalised_eigenvalues(K, M);
  const auto json = Json::parse(modes_analysis().run(model).json);
  std::vector<double> found;  // in the plane: the hinges hold the bars out of it
  for (const Json& m : json["modes"])
    if (m["kind"] == "vibration") found.push_back(m["frequency_Hz"]);
  double worst = 0.0;
  std::string figures;
  for (int k = 0; k < 12; ++k) {
    const double f = std::sqrt(expected.values[k]) / (2.0 * std::numbers::pi);
    double best = 1e300;
    for (const double x : found) best = std::min(best, std::abs(x / f - 1.0));
    figures += fmt::format(" {:.4g} ({:.0e})", f, best);
    worst = std::max(worst, best);
  }
  std::printf("[ figure ] hanging_chain [Hz]%s\n", figures.c_str());
  EXPECT_LT(worst, 1e-3) << figures;
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

// Friction that sticks holds a slide as a spring of 2e4 N/m, wherever it is: a root of zero that is
// no rigid motion, also beside those of a free body.
TEST(Modes, FrictionThatSticksHolds) {
  const std::string slide = R"(
gravity: [0, 0, 0]
bodies:
  c: {position: [0, 0, 1], rigid: {mass: 1, inertia: [1, 1, 1]}}
  box: {position: [0, 0, 0], rigid: {mass: 2, inertia: [1, 1, 1]}}
joints:
  c: {type: prismatic, child: c, at: [0, 0, 1], axis: z,
      friction: {breakaway: 20, stiffness: 2.0e4, damping: 20, elastic: ELASTIC}}
  box: {type: FREE, child: box, at: [0, 0, 0]}
simulation: {step: 0.001, duration: 1}
)";
  const auto with = [&](const std::string& joint, const std::string& elastic) {
    std::string text = slide;
    text.replace(text.find("FREE"), 4, joint);
    text.replace(text.find("ELASTIC"), 7, elastic);
    return model_of(text);
  };
  for (const char* elastic : {"0.95", "0"})
    for (const Coordinates c : {Coordinates::relative, Coordinates::absolute})
      for (const bool free : {false, true}) {
        Model model = with(free ? "free" : "weld", elastic);
        model.simulation.coordinates = c;
        const AnalysisReport report = modes_analysis().run(model);
        const auto json = Json::parse(report.json);
        int held = 0;
        double frequency = 0.0;
        for (const auto& m : json["modes"]) {
          held += m["kind"] == "held";
          if (m["kind"] == "vibration") frequency = m["undamped_frequency_Hz"];
        }
        EXPECT_EQ(held, 1) << report.text;
        EXPECT_EQ(json["rigid_motions"], free ? 6 : 0) << report.text;
        EXPECT_NEAR(frequency, std::sqrt(2e4) / (2.0 * std::numbers::pi), 1e-6);
        EXPECT_NE(report.text.find("1 root of zero without a motion"), std::string::npos)
            << report.text;
      }
}

}  // namespace
}  // namespace floatframe::test
