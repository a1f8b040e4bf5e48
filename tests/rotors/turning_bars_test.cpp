// Bars whose sections turn mass, without geometric stiffening: whirl of a round shaft against
// Rayleigh's theory, a run-up against a rotor assembled in rotating axes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "floatframe/math/dense.hpp"
#include "floatframe/rotors/turning_model.hpp"
#include "floatframe/run/results.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double shaft_E = 2.1e11, shaft_rho = 7850.0;
double shaft_A(double d) { return std::numbers::pi * d * d / 4.0; }
double shaft_I(double d) { return shaft_A(d) * d * d / 16.0; }

/// Of a metre; d: diameter.
std::string shaft_text(double d, const std::string& more) {
  return "gravity: [0, 0, 0]\n"
         "points: {a: [0, 0, 0], b: [1, 0, 0]}\n"
         "bodies:\n"
         "  shaft:\n"
         "    flexible:\n"
         "      material: {young: 2.1e11, poisson: 0.3, density: 7850}\n"
         "      bars: {bar: {from: a, to: b, elements: 20, section: {round: " +
         std::to_string(d) +
         "}}}\n"
         "      clamped: [a]\n"
         "      static_modes: [{point: b, dofs: [y, z]}]\n"
         "      normal_modes: 16\n"
         "      mass_model: hermite\n"
         "      section_inertia: true\n" +
         more;
}

TEST(TurningBars, ShaftWhirlsAsRayleighPredicts) {
  // Hinged at both ends: with k = pi / L and r^2 = I / A
  //   w^2 (1 + r^2 k^2) -+ 2 r^2 k^2 W w = E I k^4 / (rho A)
  // Nothing of it is foreshortening: about its axis a shaft pulls at nothing.
  // The bearings give way by 2e-5 of the frequencies, at all speeds alike.
  const double k = std::numbers::pi, r2 = shaft_I(0.1) / shaft_A(0.1),
               w2 = shaft_E * r2 * std::pow(k, 4) / shaft_rho;
  for (const char* key :
       {"", "    geometric_stiffening: false\n", "    geometric_stiffening: true\n"}) {
    SCOPED_TRACE(key);
    const std::string bearing =
        ", axis: x, axis_2: y, damping: [[0, 0], [0, 0]], stiffness: [[1e12, 0, 0, 0, 0, 0], "
        "[0, 1e12, 0, 0, 0, 0], [0, 0, 1e7, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], "
        "[0, 0, 0, 0, 0, 0]]}\n";
    TurningModel rotor(
        model_of(shaft_text(0.1, key) +
                 "joints: {motor: {type: free, child: shaft, at: a}}\n"
                 "forces:\n"
                 "  a: {type: bearing, from: {body: ground, at: a}, to: {body: shaft, at: a}" +
                 bearing +
                 "  b: {type: bearing, from: {body: ground, at: b}, to: {body: shaft, at: b}" +
                 bearing + "simulation: {step: 1e-4, duration: 0.1}\n"),
        "motor", Vec3::UnitX());
    double at_rest = 1.0;
    for (const double speed : {0.0, 1000.0, 4000.0}) {
      const auto modes = rotor.modes(speed);
      for (const double sign : {1.0, -1.0}) {
        const double half = sign * r2 * k * k * speed, mass = 1.0 + r2 * k * k;
        const double expected = (half + std::sqrt(half * half + mass * w2)) / mass;
        double nearest = 1e300;
        for (const TurningMode& m : modes)
          if (std::abs(m.lambda.imag() - expected) < std::abs(nearest - expected))
            nearest = m.lambda.imag();
        if (speed == 0.0) at_rest = nearest / expected;
        EXPECT_NEAR(at_rest, 1.0, 3e-5);
        EXPECT_NEAR(nearest / expected, at_rest, 2e-6) << speed;
      }
    }
  }
}

/// A cantilever of Hermite elements in axes that turn with W(t) about its axis; x = (v, w), each
/// (deflection, slope) of the nodes 1, 2, ... Sections stay round it: with the masses M_t of
/// translation and M_r of rotation, J_p = 2 J_t,
///   (M_t + M_r) vdd - 2 W M_t wd - Wd M_t w - W^2 (M_t - M_r) v + Wd/2 B w + K v = 0
///   (M_t + M_r) wdd + 2 W M_t vd + Wd M_t v - W^2 (M_t - M_r) w - Wd/2 B v + K w = 0
/// where B is the twist of the tangent: v^T B w = int J_p(x) int_0^x v' w'' - w' v'' dxi dx.
struct RunUp {
  int n;
  MatX M_t, M_r, B, K;
  double rate;  ///< of the speed [rad/s2]

  RunUp(int elements, double d, double acceleration) : n(elements), rate(acceleration) {
    const int nq = 2 * n;
    M_t = M_r = B = K = MatX::Zero(nq + 2, nq + 2);
    const double L = 1.0 / n, J_t = shaft_rho * shaft_I(d);
    for (int e = 0; e < n; ++e)
      for (int g = 0; g < 5; ++g) {
        static const double s5[] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                    0.953089922969332};
        static const double w5[] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                    0.239314335249683, 0.118463442528095};
        const double s = s5[g], dx = w5[g] * L, s2 = s * s, s3 = s2 * s;
        const Vec4 N(1 - 3 * s2 + 2 * s3, L * (s - 2 * s2 + s3), 3 * s2 - 2 * s3, L * (s3 - s2));
        const Vec4 N1(6 * (s2 - s) / L, 1 - 4 * s + 3 * s2, 6 * (s - s2) / L, 3 * s2 - 2 * s);
        const Vec4 N2(6 * (2 * s - 1) / (L * L), (6 * s - 4) / L, 6 * (1 - 2 * s) / (L * L),
                      (6 * s - 2) / L);
        const double beyond = 1.0 - (e + s) * L;
        const Eigen::Matrix4d D = 2.0 * J_t * beyond * dx * N1 * N2.transpose();
        M_t.block<4, 4>(2 * e, 2 * e) += shaft_rho * shaft_A(d) * dx * N * N.transpose();
        M_r.block<4, 4>(2 * e, 2 * e) += J_t * dx * N1 * N1.transpose();
        K.block<4, 4>(2 * e, 2 * e) += shaft_E * shaft_I(d) * dx * N2 * N2.transpose();
        B.block<4, 4>(2 * e, 2 * e) += D - D.transpose();
      }
    for (MatX* m : {&M_t, &M_r, &B, &K}) *m = m->bottomRightCorner(nq, nq).eval();
  }
  using Vec4 = Eigen::Vector4d;

  /// From rest at x0; (v, w) of the tip after `time`, with the twist of the tangent or without it.
  std::array<double, 2> tip(const VecX& x0, double time, bool twist) const {
    const Eigen::Index m = 2 * n;
    const MatX inverse = ldlt_solve(MatX(M_t + M_r), MatX::Identity(m, m));
    const MatX C = inverse * M_t, S = inverse * (M_t - M_r), T = inverse * K,
               U = (twist ? 0.5 : 0.0) * inverse * B;
    const auto slope = [&](double t, const VecX& z) {
      const double W = rate * t;
      const VecX v = z.head(m), w = z.segment(m, m), vd = z.segment(2 * m, m), wd = z.tail(m);
      VecX out(4 * m);
      out << vd, wd, 2.0 * W * (C * wd) + rate * (C * w) + W * W * (S * v) - rate * (U * w) - T * v,
          -2.0 * W * (C * vd) - rate * (C * v) + W * W * (S * w) + rate * (U * v) - T * w;
      return out;
    };
    VecX z = VecX::Zero(4 * m);
    z.head(2 * m) = x0;
    const int steps = 8000;
    const double h = time / steps;
    for (int k = 0; k < steps; ++k) {
      const double t = k * h;
      const VecX a = slope(t, z), b = slope(t + 0.5 * h, z + 0.5 * h * a),
                 c = slope(t + 0.5 * h, z + 0.5 * h * b), e = slope(t + h, z + h * c);
      z += h / 6.0 * (a + 2.0 * b + 2.0 * c + e);
    }
    return {z[m - 2], z[2 * m - 2]};
  }
};

TEST(TurningBars, RunUpIsThatOfARotorInRotatingAxes) {
  // A thick shaft to 6000 rad/s in 0.003 s, through its first critical speed of 1340 rad/s.
  constexpr double rate = 2e6, time = 0.003;
  const Model model = model_of(
      shaft_text(0.3, "") +
      "joints: {hub: {type: revolute, child: shaft, at: a, axis: x, motion: {polynomial: [0, 0, "
      "1e6]}}}\n"
      "initial: {amplitudes: {shaft: [1e-4, 0.6e-4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, "
      "0]}}\n"
      "outputs: {tip: {position: {body: shaft, at: b}}}\n"
      "simulation: {step: 7.5e-7, duration: 0.003}\n");
  ASSERT_TRUE(model.bodies[0].data->turning);
  const RunUp rotor(20, 0.3, rate);
  VecX x0(4 * 20);
  const VecX& y = model.amplitudes[0];
  for (int k = 0; k < 20; ++k) {
    const ModalNode& node = model.bodies[0].data->nodes[static_cast<std::size_t>(k + 1)];
    ASSERT_NEAR(node.p[0], (k + 1) / 20.0, 1e-12);
    const Vec3 u = node.X * y, turn = node.X_theta * y;
    x0.segment<2>(2 * k) << u[1], turn[2];
    x0.segment<2>(40 + 2 * k) << u[2], -turn[1];
  }
  const double angle = 0.5 * rate * time * time;
  const auto in_world = [&](const std::array<double, 2>& tip) {
    return std::array{std::cos(angle) * tip[0] - std::sin(angle) * tip[1],
                      std::sin(angle) * tip[0] + std::cos(angle) * tip[1]};
  };
  const auto expected = in_world(rotor.tip(x0, time, true));
  const auto without = in_world(rotor.tip(x0, time, false));
  const double size = std::hypot(expected[0], expected[1]);
  const double apart = std::hypot(expected[0] - without[0], expected[1] - without[1]) / size;
  figure("what the twist of the tangent does", apart);
  for (const Coordinates coordinates : both_coordinates) {
    Model of = model;
    of.simulation.coordinates = coordinates;
    const RunResult r = completed_run(of);
    const std::size_t last = r.table.rows() - 1;
    const double error = std::hypot(r.table.at(last, column(r.table, "tip.y")) - expected[0],
                                    r.table.at(last, column(r.table, "tip.z")) - expected[1]) /
                         size;
    figure("distance from the rotor", error);
    EXPECT_LT(error, 0.1 * apart);
  }
}

}  // namespace
}  // namespace floatframe::test
