// Journal bearings with clearance: rest, whirl, rolling, friction and rebound against closed forms;
// a slider-crank with a loose pin in both formulations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/start/check.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A shaft of 1 kg in the plane normal to y; its coordinates are x, -z and the angle about y.
std::string shaft_in_bush(const std::string& joint, const std::string& bearing,
                          const std::string& simulation, double gravity = 0.0) {
  return fmt::format(R"(
gravity: [0, 0, {}]
bodies: {{shaft: {{position: [0, 0, 0], rigid: {{mass: 1, inertia: [0.005, 0.005, 0.005]}}}}}}
joints: {{plane: {{type: planar, child: shaft, at: [0, 0, 0], axis: y, axis_2: x, {}}}}}
forces: {{b: {{type: journal_bearing, from: {{body: ground, at: [0, 0, 0]}}, to: {{body: shaft}},
  axis: y, {}}}}}
outputs:
  x: {{position: shaft, axis: x}}
  z: {{position: shaft, axis: z}}
  N: {{force: b}}
  T: {{force: b, output: friction_torque}}
  e: {{length: b}}
  w: {{angular_velocity: shaft, axis: y}}
simulation: {{{}}}
)",
                     -gravity, joint, bearing, simulation);
}
enum Column { x_column = 1, z_column, normal_column, torque_column, play_column, turn_column };

double end_of(const RunResult& r, Column c) { return r.table.at(r.table.rows() - 1, c); }

// It comes to rest in the lowest place, at c + (W / k)^(1/n).
TEST(JournalBearing, RestsWhereTheContactCarriesTheWeight) {
  for (const auto& [stiffness, exponent] : {std::pair(1e6, 1.0), std::pair(1e8, 1.5)}) {
    const Model model = model_of(shaft_in_bush(
        "position: [0, 0.001, 0]",
        fmt::format("radius: 0.02, clearance: 0.001, stiffness: {}, exponent: {}, restitution: 0.3",
                    stiffness, exponent),
        "step: 5.0e-4, duration: 1, spectral_radius: 0.8", 9.81));
    const double rest = 0.001 + std::pow(9.81 / stiffness, 1.0 / exponent);
    for (const Coordinates c : both_coordinates) {
      const RunResult r = completed_run(model, with(model.simulation, c));
      EXPECT_NEAR(end_of(r, z_column), -rest, 1e-9) << exponent;
      EXPECT_NEAR(end_of(r, play_column), rest, 1e-9) << exponent;
      EXPECT_NEAR(end_of(r, normal_column), 9.81, 1e-3) << exponent;
      EXPECT_EQ(end_of(r, torque_column), 0.0);
    }
  }
}

// k (e - c)^n = 1e6 (0.3 - 0.001)
TEST(JournalBearing, AShaftThatIsDrawnBesideItsBushIsNoted) {
  const auto notes = [](const std::string& place) {
    const Model model = model_of(
        shaft_in_bush(place, "radius: 0.02, clearance: 0.001, stiffness: 1.0e6", "step: 1.0e-4"));
    const ModelCounts counts = check(model);
    std::string all;
    for (const std::string& note : counts.start.notes) all += note + "\n";
    return all;
  };
  EXPECT_EQ(notes("position: [0, 0.0011, 0]").find("bush"), std::string::npos);
  const std::string beside = notes("position: [0, 0.3, 0]");
  EXPECT_NE(beside.find("journal_bearing 'b': the shaft is 0.3 m off the centre of its bush, whose "
                        "clearance is 0.001 m, so that at the start it is pushed back with "
                        "2.99e+05 N"),
            std::string::npos)
      << beside;
}

// On a circle of the radius e at the speed W: m W^2 e = k (e - c).
TEST(JournalBearing, WhirlsOnACircle) {
  const double k = 1e5, c = 0.002, W = 100.0, e = k * c / (k - W * W);
  const Model model = model_of(
      shaft_in_bush(fmt::format("position: [{:.17g}, 0, 0], velocity: [0, {:.17g}, 0]", e, -W * e),
                    "radius: 0.02, clearance: 0.002, stiffness: 1e5",
                    "step: 1.0e-4, duration: 0.2, locate_edges: true"));
  for (const Coordinates coordinates : both_coordinates) {
    const RunResult r = completed_run(model, with(model.simulation, coordinates));
    for (std::size_t i = 0; i < r.table.rows(); ++i) {
      EXPECT_NEAR(r.table.at(i, play_column), e, 1e-4 * e);
      EXPECT_NEAR(r.table.at(i, normal_column), k * (e - c), 2e-3 * k * (e - c));
    }
    EXPECT_NEAR(end_of(r, x_column), e * std::cos(W * 0.2), 1e-3 * e);
    EXPECT_NEAR(end_of(r, z_column), e * std::sin(W * 0.2), 1e-3 * e);
  }
}

// Turning at a constant speed it climbs the bush to the angle of friction: N = W cos(atan mu) and
// the torque -mu N r.
TEST(JournalBearing, BrakesAShaftThatTurns) {
  const double mu = 0.2, k = 1e6, angle = std::atan(mu), N = 9.81 * std::cos(angle);
  const double e = 0.001 + N / k;
  for (const double speed : {5.0, -5.0}) {
    const double x = std::copysign(e * std::sin(angle), speed);
    const Model model = model_of(shaft_in_bush(
        fmt::format("motion: {{angle: {{velocity: {}}}}}, position: [{:.17g}, {:.17g}, 0]", speed,
                    x, e * std::cos(angle)),
        "radius: 0.02, clearance: 0.001, stiffness: 1e6, friction: 0.3, kinetic: 0.2, "
        "stribeck: 0.001, bristle_damping: 5",
        "step: 2.0e-4, duration: 0.2", 9.81));
    for (const Coordinates c : both_coordinates) {
      const RunResult r = completed_run(model, with(model.simulation, c));
      EXPECT_NEAR(end_of(r, normal_column), N, 1e-5 * N);
      EXPECT_NEAR(end_of(r, torque_column), std::copysign(mu * N * 0.02, -speed), 1e-6);
      EXPECT_NEAR(end_of(r, x_column), x, 1e-6 * e);
    }
  }
}

// A shaft that rolls in the bush: a pendulum of the length e with the mass m + J / r^2.
TEST(JournalBearing, RollsAsAPendulum) {
  const double r = 0.1, e = 0.05 + 9.81 / 1e6, first = 0.05;
  const double inertia = 1.0 + 0.005 / (r * r);
  const double period =
      2.0 * std::numbers::pi * std::sqrt(inertia * e / 9.81) * (1.0 + first * first / 16.0);
  const Model model = model_of(shaft_in_bush(
      fmt::format("position: [{:.17g}, {:.17g}, 0]", e * std::sin(first), e * std::cos(first)),
      "radius: 0.1, clearance: 0.05, stiffness: 1e6, friction: 0.5, deflection: "
      "1e-6, bristle_damping: 50",
      "step: 2.0e-4, duration: 1.5", 9.81));
  for (const Coordinates c : both_coordinates) {
    const RunResult run = completed_run(model, with(model.simulation, c));
    std::vector<double> crossings;
    for (std::size_t i = 1; i < run.table.rows(); ++i) {
      const double a = run.table.at(i - 1, x_column), b = run.table.at(i, x_column);
      if (a > 0.0 && b <= 0.0)
        crossings.push_back(run.table.at(i, 0) -
                            b / (b - a) * (run.table.at(i, 0) - run.table.at(i - 1, 0)));
    }
    ASSERT_GE(crossings.size(), 2u);
    const double found =
        (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
    EXPECT_NEAR(found, period, 1e-3 * period) << name_of(c);
    figure("period of a shaft that rolls in its bush, " + name_of(c), found / period - 1.0);
  }
}

std::string thrown_shaft(double restitution, double step) {
  return shaft_in_bush(
      "velocity: [1, 0, 0]",
      fmt::format("radius: 0.02, clearance: 0.01, stiffness: 1e6, restitution: {}", restitution),
      fmt::format("step: {:.17g}, duration: 0.02, locate_edges: true", step));
}

TEST(JournalBearing, RestitutionIsThatOfTheKey) {
  for (const double e : {1.0, 0.7, 0.3}) {
    const Model model = model_of(thrown_shaft(e, 5e-5));
    for (const Coordinates c : both_coordinates) {
      const RunResult r = completed_run(model, with(model.simulation, c));
      const std::size_t n = r.table.rows() - 1;
      const double speed = (r.table.at(n, x_column) - r.table.at(n - 10, x_column)) /
                           (r.table.at(n, 0) - r.table.at(n - 10, 0));
      EXPECT_NEAR(speed, -e, 2e-3) << e;
      EXPECT_EQ(r.table.at(n, normal_column), 0.0);
      EXPECT_NEAR(r.summary.energy.total_end / r.summary.energy.total_start, e * e, 4e-3);
      EXPECT_LT(r.summary.energy.largest_remainder, 1e-3 * r.summary.energy.exchanged);
    }
  }
}

// A contact lasts pi sqrt(m / k) = 3.1 ms.
TEST(JournalBearing, FewerThanTwentyStepsInAContactAreWarned) {
  const Model model = model_of(thrown_shaft(1.0, 5e-5));
  for (const double steps : {6.0, 25.0})
    for (const Coordinates c : both_coordinates) {
      const double h = std::numbers::pi * 1e-3 / steps;
      const RunResult r =
          completed_run(model, with(model.simulation, c, h, std::ceil(0.02 / h) * h));
      const auto is_contact = [](const RangeWarning& w) { return w.limit == RangeLimit::contact; };
      EXPECT_EQ(std::ranges::count_if(r.summary.warnings, is_contact), steps < 20.0 ? 1 : 0);
    }
}

/// The pin between crank and rod is a bearing with a play of 1 mm.
const std::string loose_pin = R"(
bodies:
  crank: {position: [0, 0, 0],
    rigid: {mass: 1, centre_of_mass: [0.05, 0, 0], inertia: [0.001, 0.01, 0.01]}}
  rod: {position: [0.1, 0, 0],
    rigid: {mass: 0.5, centre_of_mass: [0.15, 0, 0], inertia: [0.001, 0.004, 0.004]}}
  slider: {position: [0.4, 0, 0], rigid: {mass: 0.5, inertia: [0.001, 0.001, 0.001]}}
joints:
  main: {type: revolute, child: crank, at: [0, 0, 0], axis: y, velocity: -20}
  guide: {type: prismatic, child: slider, at: [0.4, 0, 0], axis: x}
  wrist: {type: revolute, parent: slider, child: rod, at: [0.4, 0, 0], axis: y}
forces:
  pin: {type: journal_bearing, from: {body: rod, at: [0.1, 0, 0]},
    to: {body: crank, at: [0.1, 0, 0]}, axis: y, radius: 0.01, clearance: 0.001,
    stiffness: 1e6, restitution: 0.7, friction: 0.1, kinetic: 0.08, stribeck: 0.1,
    deflection: 1e-4, bristle_damping: 0.01}
outputs: {q: {joint_position: main}, s: {joint_position: guide}, r: {joint_position: wrist},
  N: {force: pin}, e: {length: pin}}
simulation: {step: 4.0e-5, duration: 0.012, locate_edges: true}
)";

// The difference of the formulations falls with the square of the step.
TEST(JournalBearing, HoldsASliderCrankAlikeInBothFormulations) {
  const Model model = model_of(loose_pin);
  std::vector<double> apart;
  double deepest = 0.0;
  for (const double step : {4e-5, 2e-5, 1e-5}) {
    const RunResult r =
        completed_run(model, with(model.simulation, Coordinates::relative, step, 0.012));
    const RunResult a =
        completed_run(model, with(model.simulation, Coordinates::absolute, step, 0.012));
    double d = 0.0;
    for (int c = 1; c <= 3; ++c)
      d = std::max(d,
                   std::abs(r.table.at(r.table.rows() - 1, c) - a.table.at(a.table.rows() - 1, c)));
    apart.push_back(d);
    for (std::size_t i = 0; i < r.table.rows(); ++i) deepest = std::max(deepest, r.table.at(i, 5));
    EXPECT_LT(r.summary.energy.largest_remainder, 2e-3 * r.summary.energy.exchanged);
    EXPECT_LT(a.summary.energy.largest_remainder, 2e-3 * a.summary.energy.exchanged);
  }
  EXPECT_GT(deepest, 0.001);  // it touches
  EXPECT_LT(deepest, 0.01);
  EXPECT_LT(apart[0], 1e-4);
  for (std::size_t k = 1; k < apart.size(); ++k)
    EXPECT_TRUE(apart[k] < 0.4 * apart[k - 1] || apart[k] < 1e-9)
        << apart[k] << " " << apart[k - 1];
  figure("difference of the formulations of a loose pin", apart.back());
}

// What it gives beside the force is a signal and a term of formulas.
TEST(JournalBearing, FrictionTorqueIsASignal) {
  std::string text = shaft_in_bush("motion: {angle: {velocity: 5}}, position: [0, 0.00101, 0]",
                                   "radius: 0.02, clearance: 0.001, stiffness: 1e6, friction: 0.2",
                                   "step: 2.0e-4, duration: 0.02", 9.81);
  text.replace(text.find("forces: {b"), 10,
               "controllers: {twice: {type: limiter, input: {force: b, output: friction_torque, "
               "factor: 2}, lower: -100}}\nforces: {b");
  text.replace(text.find("outputs:\n"), 9,
               "outputs:\n  twice: {controller: twice}\n"
               "  thrice: {formula: \"3 * force(b, friction_torque)\"}\n");
  for (const Coordinates c : both_coordinates) {
    const Model model = model_of(text);
    const RunResult r = completed_run(model, with(model.simulation, c));
    const std::size_t n = r.table.rows() - 1;
    const double torque = r.table.at(n, torque_column + 2);
    EXPECT_LT(torque, -1e-4);
    EXPECT_NEAR(r.table.at(n, 1), 2.0 * torque, 1e-12);
    EXPECT_NEAR(r.table.at(n, 2), 3.0 * torque, 1e-12);
  }
}

}  // namespace
}  // namespace floatframe::test
