// Response to unbalance against closed forms: a Laval (Jeffcott) rotor with a gyroscopic disc, a
// rigid rotor in bearings that are not round; bearings whose coefficients depend on the speed.
#include "floatframe/rotors/unbalance_response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "rotors/turning_modes.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/rotor_models.hpp"

namespace floatframe::test {
namespace {

using Complex = std::complex<double>;
const Complex i(0.0, 1.0);

/// A disc at a of the length L of a shaft of a thousandth of its mass, in stiff bearings, with
/// damping of the disc against the housing.
constexpr const char* laval_text = R"(
gravity: [0, 0, -9.81]
points: {left: [0, 0, 0], disc: [0.3333333333333333, 0, 0], right: [1, 0, 0]}
bodies:
  shaft:
    flexible:
      material: {young: 2.1e11, poisson: 0.3, density: 10}
      bars:
        first: {from: left, to: disc, elements: 4, section: {round: 0.03}}
        second: {from: disc, to: right, elements: 8, section: {round: 0.03}}
      clamped: [left]
      static_modes: [{point: disc, dofs: all}, {point: right, dofs: all}]
      normal_modes: 4
      mass_model: hermite
      section_inertia: true
  disc: {rigid: {mass: 12, centre_of_mass: disc, inertia: [0.3, 0.16, 0.16]}}
joints:
  motor: {type: free, child: shaft, at: left}
  hub: {type: weld, parent: shaft, child: disc, at: disc}
forces:
  left: {type: bearing, from: {body: ground, at: left}, to: {body: shaft, at: left}, axis: x,
    axis_2: y, stiffness: [[1e10, 0, 0, 0, 0, 0], [0, 1e10, 0, 0, 0, 0], [0, 0, 1e7, 0, 0, 0],
      [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]]}
  right: {type: bearing, from: {body: ground, at: right}, to: {body: shaft, at: right}, axis: x,
    axis_2: y, stiffness: [[1e10, 0], [0, 1e10]]}
  housing: {type: bearing, from: {body: ground, at: disc}, to: {body: disc, at: disc}, axis: x,
    axis_2: y, stiffness: [[0, 0], [0, 0]], damping: [[216, 0], [0, 216]]}
outputs:
  disc: {position: {body: disc, at: disc}}
  rate: {velocity: {body: disc, at: disc}}
  edge: {position: {body: disc, at: [0.3333333333333333, 0.1, 0]}}
simulation: {step: 1e-4, duration: 1}
)";

const UnbalanceCurve& curve(const UnbalanceResponse& r, const std::string& name) {
  const auto at = std::find_if(r.curves.begin(), r.curves.end(),
                               [&](const UnbalanceCurve& c) { return c.output.name == name; });
  EXPECT_NE(at, r.curves.end()) << name;
  return at == r.curves.end() ? r.curves.at(0) : *at;
}

// r = y + i z and tilt phi, all e^(i W t):
//   (k11 - m W^2 + i c W) r + k12 phi = U W^2 e^(i a),  k12 r + (k22 + (J_p - J_t) W^2) phi = 0
TEST(UnbalanceResponse, LavalRotorWithGyroscopicDisc) {
  const double EI = 2.1e11 * std::numbers::pi * std::pow(0.03, 4) / 64.0, L = 1.0, a = 1.0 / 3.0,
               b = L - a, c3 = 3.0 * EI * L, m = 12.0, J_p = 0.3, J_t = 0.16, c = 216.0;
  Eigen::Matrix2d flexibility;
  flexibility << a * a * b * b / c3, a * b * (b - a) / c3, a * b * (b - a) / c3,
      (a * a - a * b + b * b) / c3;
  const Eigen::Matrix2d K = flexibility.inverse();
  const double U = 2e-4, angle = 0.5;
  const UnbalanceResponse r = unbalance_response(
      model_of(laval_text),
      {.joint = "motor", .from = 0, .to = 400, .step = 20, .unbalances = {{"disc", "", U, angle}}});
  ASSERT_EQ(r.speeds.size(), 21u);
  double worst = 0.0;
  for (std::size_t k = 1; k < r.speeds.size(); ++k) {
    const double W = r.speeds[k], tilt = K(1, 1) + (J_p - J_t) * W * W;
    const Complex stiff = K(0, 0) - m * W * W + i * c * W - K(0, 1) * K(0, 1) / tilt;
    // y = Re(r), z = Im(r) of r e^(i W t).
    const Complex whirl = U * W * W * std::exp(i * angle) / stiff;
    worst = std::max({worst, std::abs(curve(r, "disc.y").amplitudes[k] / whirl - 1.0),
                      std::abs(curve(r, "disc.z").amplitudes[k] / (-i * whirl) - 1.0),
                      std::abs(curve(r, "rate.y").amplitudes[k] / (i * W * whirl) - 1.0)});
  }
  std::printf("[ figure ] unbalance_laval %.1e\n", worst);
  EXPECT_LT(worst,
            5e-3);  // 1e-4 of the frequency for the mass of the shaft, ten times in resonance
  EXPECT_NEAR(curve(r, "disc.z").means.back(), -12.0 * 9.81 * flexibility(0, 0), 1e-5);
  EXPECT_EQ(std::abs(curve(r, "disc.y").amplitudes[0]), 0.0);
  // A point of the rim turns with the disc: in the world it moves by far more than linearly.
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_TRUE(contains(r.notes[0], "turn with the rotor: edge.x, edge.y, edge.z"));
}

/// M x'' + (C + W G) x' + K x = F for x, y and the tilts about x, y of a disc of 2 kg.
Eigen::Vector4cd disc_response(const Eigen::Matrix4d& K, const Eigen::Matrix4d& C, double W,
                               double U) {
  Eigen::Matrix4d G = Eigen::Matrix4d::Zero();
  G(2, 3) = 0.035 * W;
  G(3, 2) = -0.035 * W;
  Eigen::Matrix4cd A =
      (K - W * W * Eigen::Vector4d(2, 2, 0.02, 0.02).asDiagonal().toDenseMatrix()).cast<Complex>() +
      i * W * (C + G).cast<Complex>();
  Eigen::Vector4cd F(U * W * W, -i * U * W * W, 0.0, 0.0);
  return A.inverse() * F;
}

TEST(UnbalanceResponse, RigidRotorInBearingsThatAreNotRound) {
  Eigen::Matrix4d K, C = Eigen::Matrix4d::Zero();
  K << 8e4, 1e4, 0, -2e3, 1e4, 5e4, 1.5e3, 0, 0, 1.5e3, 900, 100, -2e3, 0, 100, 600;
  C.diagonal() << 6, 5, 0.04, 0.03;
  const Model model = model_of(disc_in_bearing(
      "stiffness: [[8e4, 1e4, 0, 0, -2e3, 0], [1e4, 5e4, 0, 1.5e3, 0, 0], [0, 0, 9e4, 0, 0, 0], "
      "[0, 1.5e3, 0, 900, 100, 0], [-2e3, 0, 0, 100, 600, 0], [0, 0, 0, 0, 0, 0]], damping: [[6, "
      "0, 0, 0, 0, 0], [0, 5, 0, 0, 0, 0], [0, 0, 3, 0, 0, 0], [0, 0, 0, 0.04, 0, 0], [0, 0, 0, 0, "
      "0.03, 0], [0, 0, 0, 0, 0, 0]]",
      "outputs: {c: {position: disc}}\n"));
  const double U = 3e-5;
  const UnbalanceResponse r = unbalance_response(model, {.joint = "motor",
                                                         .from = -300,
                                                         .to = 300,
                                                         .step = 37.5,
                                                         .unbalances = {{"disc", "", U, 0}}});
  double worst = 0.0;
  for (std::size_t k = 0; k < r.speeds.size(); ++k) {
    if (r.speeds[k] == 0.0) continue;
    const Eigen::Vector4cd x = disc_response(K, C, r.speeds[k], U);
    worst = std::max({worst, std::abs(curve(r, "c.x").amplitudes[k] - x[0]) / x.head<2>().norm(),
                      std::abs(curve(r, "c.y").amplitudes[k] - x[1]) / x.head<2>().norm()});
  }
  std::printf("[ figure ] unbalance_rigid_rotor %.1e\n", worst);
  EXPECT_LT(worst, 1e-7);
}

constexpr const char* film =
    "stiffness: [[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 9e4, 0, 0, 0], [0, 0, 0, 900, 0, "
    "0], [0, 0, 0, 0, 600, 0], [0, 0, 0, 0, 0, 0]], speed_table: [[50, 8e4, 1e4, -3e4, 5e4, 60, 2, "
    "3, 50], [150, 6e4, 2e4, -2e4, 7e4, 40, 1, 1, 30], [400, 5e4, 1e4, -1e4, 9e4, 20, 0, 0, 10]]";

/// The table above, linear between rows, constant beyond; the mirror image at negative speeds.
void film_at(double W, Eigen::Matrix4d& K, Eigen::Matrix4d& C) {
  const double rows[3][9] = {{50, 8e4, 1e4, -3e4, 5e4, 60, 2, 3, 50},
                             {150, 6e4, 2e4, -2e4, 7e4, 40, 1, 1, 30},
                             {400, 5e4, 1e4, -1e4, 9e4, 20, 0, 0, 10}};
  const double size = std::clamp(std::abs(W), 50.0, 400.0), sign = W < 0.0 ? -1.0 : 1.0;
  const int k = size < 150.0 ? 0 : 1;
  const double s = (size - rows[k][0]) / (rows[k + 1][0] - rows[k][0]);
  const auto at = [&](int column) { return (1.0 - s) * rows[k][column] + s * rows[k + 1][column]; };
  K.setZero();
  C.setZero();
  K.diagonal() << at(1), at(4), 900, 600;
  C.diagonal() << at(5), at(8), 0, 0;
  K(0, 1) = sign * at(2);
  K(1, 0) = sign * at(3);
  C(0, 1) = sign * at(6);
  C(1, 0) = sign * at(7);
}

TEST(BearingsOverSpeed, EigenvaluesOfARigidRotor) {
  const Model model = model_of(disc_in_bearing(film));
  TurningModel turning(model, "motor", std::nullopt);
  double worst = 0.0;
  for (const double W : {10.0, 100.0, 150.0, 290.0, 500.0, -200.0}) {
    Eigen::Matrix4d K, C;
    film_at(W, K, C);
    C(2, 3) += 0.035 * W;
    C(3, 2) -= 0.035 * W;
    const Eigen::Vector4d mass(2, 2, 0.02, 0.02);
    worst = std::max(worst, distance_of_modes(mass, C, K, turning.modes(W)));
  }
  std::printf("[ figure ] bearings_over_speed eigenvalues %.1e\n", worst);
  EXPECT_LT(worst, 1e-7);
}

TEST(BearingsOverSpeed, UnbalanceOfARigidRotor) {
  const UnbalanceResponse r = unbalance_response(
      model_of(disc_in_bearing(film, "outputs: {c: {position: disc}}\n")),
      {.joint = "motor", .from = 20, .to = 420, .step = 40, .unbalances = {{"disc", "", 1e-5, 0}}});
  for (std::size_t k = 0; k < r.speeds.size(); ++k) {
    Eigen::Matrix4d K, C;
    film_at(r.speeds[k], K, C);
    const Eigen::Vector4cd x = disc_response(K, C, r.speeds[k], 1e-5);
    EXPECT_LT(std::abs(curve(r, "c.x").amplitudes[k] - x[0]), 1e-7 * x.norm());
  }
}

TEST(UnbalanceResponse, WrongInput) {
  const Model model = model_of(laval_text);
  const auto error = [&](const Unbalance& u, const std::string& output = "disc.y") {
    return error_of([&] {
      unbalance_response(model, {.joint = "motor",
                                 .from = 0,
                                 .to = 100,
                                 .step = 50,
                                 .unbalances = {u},
                                 .outputs = {output}});
    });
  };
  EXPECT_EQ(error({"disk", "", 1e-4, 0}), "not_found");
  EXPECT_EQ(error({"shaft", "", 1e-4, 0}), "missing");
  EXPECT_EQ(error({"shaft", "middle", 1e-4, 0}), "missing");
  EXPECT_EQ(error({"disc", "", 1e-4, 0}, "disk.y"), "not_found");
  EXPECT_EQ(error({"shaft", "disc", 1e-4, 0}), "no error");
}

}  // namespace
}  // namespace floatframe::test
