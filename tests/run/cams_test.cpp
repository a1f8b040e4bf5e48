// Cams against closed forms in both formulations: accelerations and forces of followers under laws
// and under tables of a law, the speed at which a follower lifts off, a cam that its own inertia
// drives, and one that slides.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/model/cam_profile.hpp"
#include "floatframe/run/run.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double cam_mass = 0.2, cam_stiffness = 3000.0, cam_preload = 40.0, cam_lift = 0.01;

/// A follower of 0.2 kg with a spring on a cam that turns at a constant speed [rad/s].
std::string valve(const std::string& lift, double speed, double duration, double step) {
  return fmt::format(R"(
bodies:
  shaft: {{position: [0, 0, 0], rigid: {{mass: 1, inertia: [0.01, 0.01, 0.02]}}}}
  valve: {{position: [0, 0, 0.1], rigid: {{mass: 0.2, inertia: [0.001, 0.001, 0.001]}}}}
joints:
  shaft: {{type: revolute, child: shaft, at: [0, 0, 0], axis: y, motion: {{velocity: {}}}}}
  valve: {{type: prismatic, child: valve, at: [0, 0, 0.1], axis: z}}
couplings:
  cam: {{type: cam, follower: valve, cam: shaft, {}}}
forces:
  spring: {{type: joint_spring, joint: valve, spring: {{linear: {{stiffness: 3000, preload: 40}}}}}}
outputs:
  x: {{joint_position: shaft}}
  s: {{joint_position: valve}}
  a: {{acceleration: valve, axis: z}}
  F: {{coupling_force: cam}}
simulation: {{step: {}, duration: {}}}
)",
                     speed, lift, step, duration);
}

std::string law_text(CamLaw law) {
  return fmt::format(
      "law: {}, segments: [[{:.17g}, 0.01], [{:.17g}, 0], [{:.17g}, -0.01], "
      "[{:.17g}, 0]]",
      cam_laws[index_of(law)], 0.75 * half_turn, half_turn, 1.75 * half_turn, 2.0 * half_turn);
}

/// The closed form: rise over 0.75 pi, dwell to pi, return to 1.75 pi, dwell to 2 pi.
PiecewisePolynomial::Value lift_at(CamLaw law, double x) {
  const double width = 0.75 * half_turn, at = std::fmod(x, 2.0 * half_turn);
  const auto scaled = [&](double u, double sign) {
    const PiecewisePolynomial::Value r = cam_rise(law, u);
    return PiecewisePolynomial::Value{cam_lift * (sign > 0.0 ? r.f : 1.0 - r.f),
                                      sign * cam_lift * r.df / width,
                                      sign * cam_lift * r.ddf / (width * width)};
  };
  if (at < width) return scaled(at / width, 1.0);
  if (at < half_turn) return {cam_lift, 0.0, 0.0};
  if (at < half_turn + width) return scaled((at - half_turn) / width, -1.0);
  return {0.0, 0.0, 0.0};
}

bool near_an_end(double x, double within) {
  for (const double end : {0.0, 0.75 * half_turn, half_turn, 1.75 * half_turn, 2.0 * half_turn})
    if (std::abs(std::fmod(x, 2.0 * half_turn) - end) < within) return true;
  return false;
}

struct CamCase {
  CamLaw law;
  Coordinates coordinates;
};

class Cams : public ::testing::TestWithParam<CamCase> {
 protected:
  RunResult turned(const std::string& lift, double speed = 50.0) const {
    ModelDescription d = description_of(valve(lift, speed, 0.3, 1e-3));
    d.simulation.coordinates = GetParam().coordinates;
    return completed_run(d);
  }
  /// The largest differences of the acceleration and of the force from the closed form, relative to
  /// the largest acceleration and force, but near the ends of a rise.
  std::pair<double, double> errors(const RunResult& r, double of_lift = 1e-6,
                                   double from_ends = 1e-6) const {
    constexpr double speed = 50.0;
    double error = 0.0, most = 0.0, error_F = 0.0, most_F = 0.0;
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      const double x = speed * r.table.at(k, 0);
      if (near_an_end(x, from_ends)) continue;
      const PiecewisePolynomial::Value s = lift_at(GetParam().law, x);
      const double a = speed * speed * s.ddf,
                   F = cam_mass * (a + 9.81) + cam_stiffness * s.f + cam_preload;
      most = std::max(most, std::abs(a));
      most_F = std::max(most_F, std::abs(F));
      error = std::max(error, std::abs(r.table.at(k, 3) - a));
      error_F = std::max(error_F, std::abs(r.table.at(k, 4) - F));
      EXPECT_NEAR(r.table.at(k, 2), s.f, of_lift * cam_lift);
    }
    return {error / most, error_F / most_F};
  }
};

TEST_P(Cams, AccelerateTheFollowerAsTheClosedForm) {
  const auto [a, F] = errors(turned(law_text(GetParam().law)));
  EXPECT_LT(a, 1e-6);
  EXPECT_LT(F, 1e-6);
  std::printf("[ figure ] cam by a law, error of the acceleration: %.1e\n", a);
}

// 720 points of 12 digits. Where the acceleration jumps, that of a cubic spline swings: by 2 -
// sqrt(3) times as much from one point to the next, below a thousandth from the sixth.
TEST_P(Cams, OfATableAccelerateTheFollowerToAThousandth) {
  std::string points;
  for (int k = 0; k <= 720; ++k) {
    const double x = 2.0 * half_turn * k / 720;
    points += fmt::format("{}[{:.12g}, {:.12g}]", k > 0 ? ", " : "", x,
                          k == 720 ? 0.0 : lift_at(GetParam().law, x).f);
  }
  const bool jumps = GetParam().law == CamLaw::harmonic;
  const auto [a, F] = errors(turned("points: [" + points + "]"), jumps ? 1e-5 : 1e-6,
                             jumps ? 6.01 * 2.0 * half_turn / 720 : 1e-6);
  EXPECT_LT(a, 1e-3);
  EXPECT_LT(F, 1e-3);
  std::printf("[ figure ] cam by points, error of the acceleration: %.1e\n", a);
}

std::vector<CamCase> cam_cases() {
  std::vector<CamCase> all;
  for (const CamLaw law :
       {CamLaw::harmonic, CamLaw::cycloidal, CamLaw::polynomial_345, CamLaw::polynomial_4567})
    for (const Coordinates c : both_coordinates) all.push_back({law, c});
  return all;
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, Cams, ::testing::ValuesIn(cam_cases()), [](const auto& c) {
  return std::string(cam_laws[index_of(c.param.law)]) + "_" + name_of(c.param.coordinates);
});

// An eccentric, s = e (1 - cos x), by its formula and by 720 points. The force
// m (e w^2 cos x + g) + k e (1 - cos x) + F0 is least at x = pi, where it is zero at
// w^2 = (g + (2 k e + F0) / m) / e.
TEST(LiftOff, IsWhereTheForceChangesItsSign) {
  const double e = 0.005;
  const double speed = std::sqrt((9.81 + (2.0 * cam_stiffness * e + cam_preload) / cam_mass) / e);
  std::string points;
  for (int k = 0; k <= 720; ++k)
    points += fmt::format("{}[{:.12g}, {:.12g}]", k > 0 ? ", " : "", 2.0 * half_turn * k / 720,
                          k == 720 ? 0.0 : e * (1.0 - std::cos(2.0 * half_turn * k / 720)));
  for (const std::string& lift :
       {std::string("formula: 0.005 * (1 - cos(x))"), "points: [" + points + "]"})
    for (const Coordinates c : both_coordinates)
      for (const double faster : {-1e-3, 1e-3}) {
        const double w = (1.0 + faster) * speed;
        ModelDescription d =
            description_of(valve(lift, w, 2.0 * half_turn / w, 2.0 * half_turn / w / 720));
        d.simulation.coordinates = c;
        const RunResult r = completed_run(d);
        double least = 1e9;
        for (std::size_t k = 0; k < r.table.rows(); ++k) least = std::min(least, r.table.at(k, 4));
        EXPECT_EQ(least<0.0, faster> 0.0) << lift.substr(0, 10) << least;
      }
}

// Nothing drives the cam but its inertia: I w^2 / 2 + m (s' w)^2 / 2 + m g s is constant.
TEST(FreeCam, KeepsItsEnergyOverTurns) {
  for (const Coordinates c : both_coordinates) {
    ModelDescription d = description_of(R"(
bodies:
  shaft: {position: [0, 0, 0], rigid: {mass: 1, inertia: [0.01, 0.02, 0.01]}}
  valve: {position: [0, 0, 0.1], rigid: {mass: 4, inertia: [0.001, 0.001, 0.001]}}
joints:
  shaft:
    type: revolute
    child: shaft
    at: [0, 0, 0]
    axis: y
    position: 50.265482457436692
    velocity: 30
  valve: {type: prismatic, child: valve, at: [0, 0, 0.1], axis: z}
couplings:
  cam: {type: cam, follower: valve, cam: shaft, formula: 0.05 * (1 - cos(x)) + 0.01 * sin(2 * x)}
outputs:
  x: {joint_position: shaft}
  w: {joint_velocity: shaft}
  s: {joint_position: valve}
simulation: {step: 2.0e-4, duration: 1.5}
)");
    d.simulation.coordinates = c;
    const RunResult r = completed_run(d);
    double first = 0.0, slowest = 1e9;
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      const double x = r.table.at(k, 1), w = r.table.at(k, 2), s = r.table.at(k, 3);
      const double slope = 0.05 * std::sin(x) + 0.02 * std::cos(2.0 * x);
      EXPECT_NEAR(s, 0.05 * (1.0 - std::cos(x)) + 0.01 * std::sin(2.0 * x), 1e-9);
      const double energy = 0.5 * 0.02 * w * w + 0.5 * 4.0 * slope * slope * w * w + 4.0 * 9.81 * s;
      if (k == 0) first = energy;
      EXPECT_NEAR(energy, first, 2e-4 * first);
      slowest = std::min(slowest, w);
    }
    EXPECT_GT(r.table.at(r.table.rows() - 1, 1) - r.table.at(0, 1), 8.0);
    EXPECT_LT(slowest, 25.0);
  }
}

// A wedge of 3 kg with the slope 1/2, pushed by 20 N under a weight of 1 kg:
// (M + m / 4) x'' = F - m g / 2.
TEST(Wedge, IsACamThatSlides) {
  for (const Coordinates c : both_coordinates) {
    ModelDescription d = description_of(R"(
bodies:
  wedge: {position: [0, 0, 0], rigid: {mass: 3, inertia: [0.1, 0.1, 0.1]}}
  weight: {position: [0, 0, 1], rigid: {mass: 1, inertia: [0.1, 0.1, 0.1]}}
joints:
  wedge: {type: prismatic, child: wedge, at: [0, 0, 0], axis: x}
  weight: {type: prismatic, child: weight, at: [0, 0, 1], axis: z}
couplings:
  cam: {type: cam, follower: weight, cam: wedge, formula: x / 2}
forces: {push: {type: force, body: wedge, at: [0, 0, 0], direction: x, magnitude: 20}}
outputs:
  x: {joint_position: wedge}
  F: {coupling_force: cam}
simulation: {step: 1.0e-3, duration: 1}
)");
    d.simulation.coordinates = c;
    const RunResult r = completed_run(d);
    const std::size_t end = r.table.rows() - 1;
    const double a = (20.0 - 0.5 * 9.81) / 3.25;
    EXPECT_NEAR(r.table.at(end, 1), 0.5 * a, 1e-6);
    EXPECT_NEAR(r.table.at(end, 2), 9.81 + 0.5 * a, 1e-8);
    EXPECT_EQ(r.table.columns[2].unit, "N");
  }
}

/// A follower of 1 kg on a free cam.
std::string free_cam(const std::string& lift, const std::string& start) {
  return fmt::format(R"(
bodies:
  shaft: {{position: [0, 0, 0], rigid: {{mass: 1, inertia: [0.01, 0.01, 0.01]}}}}
  valve: {{position: [0, 0, 1], rigid: {{mass: 1, inertia: [0.01, 0.01, 0.01]}}}}
joints:
  shaft: {{type: revolute, child: shaft, at: [0, 0, 0], axis: y, {}}}
  valve: {{type: prismatic, child: valve, at: [0, 0, 1], axis: z}}
couplings: {{cam: {{type: cam, follower: valve, cam: shaft, formula: {}}}}}
outputs: {{s: {{joint_position: valve}}}}
simulation: {{step: 1.0e-3, duration: 1}}
)",
                     start, lift);
}

// As drawn, at x = 0, the lift has no value or no slope: the start is found from the given values.
TEST(EndsOfLifts, StartsBesideThem) {
  struct Start {
    const char* lift;
    double s;
  };
  for (const Start& c : {Start{"sqrt(x)", std::sqrt(0.5)}, {"log(x)", std::log(0.5)}}) {
    ModelDescription d = description_of(free_cam(c.lift, "position: 0.5, velocity: 1, keep: true"));
    d.simulation.duration = 0.01;
    EXPECT_NEAR(completed_run(d).table.at(0, 1), c.s, 1e-9) << c.lift;
  }
}

TEST(EndsOfLifts, AreNamedWhereAStartOrAStepFails) {
  for (const Coordinates c : both_coordinates) {
    const auto said = [&](const std::string& text) {
      ModelDescription d = description_of(text);
      d.simulation.coordinates = c;
      const Model model = build_model(d);
      return message_of<RunError>([&] { run(model, model.simulation); });
    };
    expect_in(said(free_cam("sqrt(x)", "velocity: 3")),
              "the model cannot be assembled: cam 'cam': its lift 'sqrt(x)' has a slope without "
              "bound at x = 0, at the start");
    const ModelDescription into =
        description_of(free_cam("sqrt(x)", "position: 0.5, velocity: -3, keep: true"));
    const Model model = build_model(into);
    SimulationDescription o = model.simulation;
    o.coordinates = c;
    const RunResult r = run(model, o);
    EXPECT_EQ(r.summary.status, "failed");
    expect_in(r.summary.message, "; cam 'cam': its lift 'sqrt(x)' ");
  }
}

}  // namespace
}  // namespace floatframe::test
