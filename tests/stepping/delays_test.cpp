// Delays: motions against the method of steps, poles against the Pade approximation, the past at
// starts, in equilibria, in saved simulations, at edges and corners.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "floatframe/linear/linear_ports.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// A box of 2 kg at x = 1, and what moves it.
std::string delayed_box(const std::string& rest) {
  return R"(
inputs: {u: {initial: 0.5}}
gravity: [-10, 0, 0]
bodies: {box: {position: [0, 0, 0], rigid: {mass: 2}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x, position: 1}}
simulation: {step: 0.01, duration: 0.5}
)" + rest;
}

/// xdot = -rate x(t - T), or with order 2 xddot = -rate x(t - T), x = 1 until t = 0:
/// x = sum_j (-rate)^j (t - (j - 1) T)^(n j) / (n j)!
double by_method_of_steps(double rate, double T, double t, int order) {
  double x = 1.0, factor = 1.0;
  for (int j = 1; t - (j - 1) * T > 0.0; ++j) {
    factor *= -rate;
    x += factor * std::exp(order * j * std::log(t - (j - 1) * T) - std::lgamma(order * j + 1.0));
  }
  return x;
}

/// The first output at the end, with steps h and h/2.
double order_of_delay(const Model& model, double exact, Coordinates c, double rho) {
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    SimulationDescription o = with(model.simulation, c, k == 0 ? 0.01 : 0.005, 0.5);
    o.spectral_radius = rho;
    const RunResult run = completed_run(model, o);
    errors[k] = std::abs(run.table.data[run.table.data.size() - model.outputs.size()] - exact);
  }
  EXPECT_LT(errors[1], 2e-3);
  fmt::print("[ figure ] delay_error {:.1e} {:.1e}\n", errors[0], errors[1]);
  return std::log2(errors[0] / errors[1]);
}

class Delays : public ::testing::TestWithParam<std::tuple<Coordinates, double>> {};

// T is a multiple of the steps, none, between h and h/2, and shorter than both.
TEST_P(Delays, OfALoopOfFirstOrderConverge) {
  const auto [c, rho] = GetParam();
  for (const double T : {0.1, 0.0937, 0.0071, 0.0033}) {
    const Model model = model_of(delayed_box(fmt::format(
        R"(controllers:
  x: {{type: integrator, input: {{controller: late, factor: -6}}, initial: 1}}
  late: {{type: delay, input: {{controller: x}}, time: {}}}
outputs: {{x: {{controller: x}}}}
)",
        T)));
    EXPECT_NEAR(order_of_delay(model, by_method_of_steps(6.0, T, 0.5, 1), c, rho), 2.0, 0.3) << T;
  }
}

TEST_P(Delays, OfAForceConverge) {
  const auto [c, rho] = GetParam();
  for (const double T : {0.1, 0.0937, 0.0071, 0.0033}) {
    const Model model = model_of(delayed_box(fmt::format(
        R"(forces:
  motor:
    type: joint_spring
    joint: slide
    actuator: {{formula: '20 - 160 * delay(angle(slide), {})'}}
outputs: {{x: {{joint_position: slide}}}}
)",
        T)));
    EXPECT_NEAR(order_of_delay(model, by_method_of_steps(80.0, T, 0.5, 2), c, rho), 2.0, 0.3) << T;
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Delays,
                         ::testing::Combine(::testing::ValuesIn(both_coordinates),
                                            ::testing::Values(1.0, 0.8)));

TEST(DelaysLinear, PolesAreThoseOfThePadeApproximation) {
  const double T = 0.03, k = 12.0;
  const Model model = model_of(delayed_box(R"(controllers:
  x: {type: integrator, input: {controller: late, factor: -12}, initial: 1}
  late: {type: delay, input: {controller: x}, time: 0.03}
forces: {push: {type: joint_spring, joint: slide, actuator: {controller: late}}}
)"));
  // s (s^2 T^2 + 6 s T + 12) + k (s^2 T^2 - 6 s T + 12) = 0
  const MatX companion{{-(6.0 / T + k), -(12.0 / T - 6.0 * k) / T, -12.0 * k / T / T},
                       {1.0, 0.0, 0.0},
                       {0.0, 1.0, 0.0}};
  double worst = 0.0;
  for (const Coordinates c : both_coordinates) {
    const LinearSystem system = linear_system(model, {.coordinates = c});
    const std::vector<LinearMode> modes = linear_modes(system);
    for (const std::complex<double> pole : general_eigen(companion).values) {
      double nearest = 1e300;
      for (const LinearMode& mode : modes)
        nearest = std::min(nearest, std::min(std::abs(mode.lambda - pole),
                                             std::abs(std::conj(mode.lambda) - pole)));
      worst = std::max(worst, nearest / std::abs(pole));
    }
    EXPECT_TRUE(contains(system.notes, "'late'"));
  }
  EXPECT_LT(worst, 1e-9);
  fmt::print("[ figure ] pole_error_of_a_delay {:.1e}\n", worst);
}

// Of order 6 it is exact to rounding at slow frequencies, and of amplitude one at all.
TEST(DelaysLinear, TransferFunctionIsThatOfTheDelay) {
  const LinearModel linear = linear_model(model_of(delayed_box(R"(controllers:
  late: {type: delay, input: {input: u}, time: 0.05, pade: 6}
outputs: {y: {controller: late}}
)")));
  for (const double w : {1.0, 20.0, 60.0, 3000.0}) {
    using Complex = std::complex<double>;
    const Complex s(0.0, w);
    const Eigen::Index n = linear.system.A.rows();
    const Eigen::MatrixXcd M = s * Eigen::MatrixXcd::Identity(n, n) - linear.system.A;
    const Complex G =
        (linear.C.cast<Complex>() * M.partialPivLu().solve(linear.B[0].cast<Complex>()))(0, 0) +
        linear.D[0](0, 0);
    EXPECT_NEAR(std::abs(G), 1.0, 1e-8) << w;
    if (w < 50.0) {
      EXPECT_LT(std::abs(G - std::exp(-0.05 * s)), 1e-8) << w;
    }
  }
}

// At an operating point that a run reaches, y is what it is there.
TEST(DelaysLinear, KeepThePresentValue) {
  const Model model = model_of(delayed_box(R"(controllers:
  late: {type: delay, input: {polynomial: [1, 2]}, time: 0.1}
outputs: {y: {controller: late}}
)"));
  Simulation s(model);
  while (s.time() < 0.295) s.step();
  SimulationOptions o;
  o.start = Start::state;
  o.state = std::make_shared<SystemState>(s.state());
  EXPECT_NEAR(linear_model(model, {}, o).output_values[0], 1.0 + 2.0 * (s.time() - 0.1), 1e-12);
}

TEST(DelaysStart, RestInAnEquilibrium) {
  const std::string text = delayed_box(R"(forces:
  motor: {type: joint_spring, joint: slide, actuator: {formula: '-50 * delay(angle(slide), 0.03)'}}
outputs: {x: {joint_position: slide}}
)");
  EXPECT_NEAR(statics(model_of(text)).forces[0].force, -20.0, 1e-9);
  const Model model = model_of(text);
  for (const Coordinates c : both_coordinates) {
    SimulationOptions o{.coordinates = c};
    o.start = Start::equilibrium;
    Simulation s(model, o);
    for (int k = 0; k < 20; ++k) s.step();
    EXPECT_NEAR(s.output("x"), -0.4, 1e-10);
  }
}

// Of functions of time the past is exact where they are linear; before the start it is the start.
TEST(DelaysStart, MayBeNestedAndStandAnywhere) {
  const Model model = model_of(delayed_box(R"(measures:
  box: {position: {body: box}}
outputs:
  late: {formula: 'delay(t, 0.1) + 2 * delay(delay(t, 0.1), 0.054)'}
  of_input: {formula: 'delay(u + t, 0.03)'}
  of_place: {formula: 'delay(box.x + 4 * t, 0.03)'}
)"));
  Simulation s(model);
  EXPECT_EQ(s.output("of_input"), 0.5);
  EXPECT_EQ(s.output("of_place"), 1.0);
  for (int k = 1; k <= 40; ++k) {
    s.step();
    const double t = s.time();
    EXPECT_NEAR(s.output("late"), std::max(t - 0.1, 0.0) + 2.0 * std::max(t - 0.154, 0.0), 1e-9);
    EXPECT_NEAR(s.output("of_input"), 0.5 + std::max(t - 0.03, 0.0), 1e-12);
  }
}

// Steps much smaller than that of the model are thinned, larger ones kept: the past stays whole.
TEST(DelaysPast, KeepsItsLengthWithOtherSteps) {
  const Model model = model_of(delayed_box(R"(controllers:
  late: {type: delay, input: {sine: {amplitude: 1, frequency: 1}}, time: 0.1}
outputs: {y: {controller: late}}
)"));
  for (const double h : {0.0007, 0.03, 0.25}) {
    Simulation s(model);
    double worst = 0.0;
    while (s.time() < 1.0) {
      s.step(h);
      const double exact = std::sin(2.0 * M_PI * std::max(s.time() - 0.1, 0.0));
      worst = std::max(worst, std::abs(s.output("y") - exact));
    }
    EXPECT_LT(worst, 5.0 * std::max(h, 0.005) * std::max(h, 0.005)) << h;
  }
}

// A jump of what is delayed is a ramp over one step.
TEST(DelaysPast, CrossesCornersAndEdges) {
  const Model model = model_of(delayed_box(R"(controllers:
  late: {type: delay, input: {table: [[0, 0], [0.123, 0], [0.123, 1], [9, 1]]}, time: 0.05}
  relay: {type: hysteresis, input: {controller: late}, lower: 0.3, upper: 0.7, above: 5}
forces: {push: {type: joint_spring, joint: slide, actuator: {controller: relay}}}
outputs: {y: {controller: late}, r: {controller: relay}}
)"));
  for (const bool edges : {false, true}) {
    SimulationOptions o;
    o.locate_edges = edges;
    Simulation s(model, o);
    for (int k = 1; k <= 30; ++k) {
      ASSERT_TRUE(s.step()) << s.failure();
      const double t = s.time(), y = s.output("y");
      EXPECT_TRUE(t < 0.172 ? y < 1e-12 : t < 0.184 || y == 1.0) << t << " " << y;
      EXPECT_TRUE(t < 0.195 || s.output("r") == 5.0) << t;
    }
  }
}

Model machine_with_delays() {
  std::string text = stepped_machine;
  text.insert(text.find("outputs:"), R"(
  motor:
    type: joint_spring
    joint: spin
    actuator: {formula: '-0.4 * delay(rate(spin), 0.013) + delay(sin(30 * t), 0.0004)'}
)");
  return model_of(text);
}

TEST(DelaysSaved, GoOnWithEqualBitsAndDoNotAllocate) {
  const Model model = machine_with_delays();
  for (const Coordinates c : both_coordinates)
    for (const bool edges : {false, true}) {
      SimulationOptions o{.coordinates = c};
      o.locate_edges = edges;
      Simulation s(model, o);
      trace(s, 0, 60);
      const SimulationState saved = s.save();
      const std::vector<double> first = trace(s, 60, 120);
      s.restore(saved);
      EXPECT_TRUE(equal_bits(trace(s, 60, 120), first));
      const AllocationScope scope;
      for (int k = 0; k < 40; ++k) s.step();
      EXPECT_EQ(scope.count(), 0u);
    }
}

TEST(DelaysErrors, NameWhatIsWrong) {
  const std::pair<const char*, const char*> wrong[] = {
      {"controllers: {d: {type: delay, input: 1, time: 1e5}}", "too_large"},
      {"controllers: {d: {type: delay, input: 1, time: 0}}", "out_of_range"},
      {"controllers: {d: {type: delay, input: 1, time: 1, pade: 1.5}}", "out_of_range"},
      {"outputs: {y: {formula: 'delay(t, u)'}}", "wrong_value"},
      {"outputs: {y: {formula: 'delay(t, 0)'}}", "wrong_value"},
      {"outputs: {y: {formula: 'delay(t > 1, 1)'}}", "wrong_value"},
      {"outputs: {y: {formula: 'delay(t)'}}", "wrong_value"},
      {"outputs: {y: {formula: 'delay(nothing, 1)'}}", "not_found"},
      {"outputs: {y: {formula: 'delay(1, 1e6)'}}", "too_large"}};
  for (const auto& [text, code] : wrong)
    EXPECT_TRUE(contains(error_of([&] { model_of(delayed_box(text)); }), code)) << text;
}

}  // namespace
}  // namespace floatframe::test
