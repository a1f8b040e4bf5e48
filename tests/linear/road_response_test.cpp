// Random roads against closed forms and runs; steady motion under a harmonic input against runs.
#include "floatframe/linear/road_response.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "floatframe/description/road_spectrum.hpp"
#include "floatframe/linear/frequency_response.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "support/error_of.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

using Gain = std::complex<double>;

Model example_car(const std::vector<ParameterOverride>& values = {}) {
  return load_model(FLOATFRAME_EXAMPLES "/quarter_car/quarter_car.yaml", values);
}

/// Body acceleration, tyre force and travel of the example for a unit of the road.
std::array<Gain, 3> example_gains(double f) {
  const Gain s(0.0, 2.0 * M_PI * f), strut = 20000.0 + 1500.0 * s, tyre = 2e5 + 100.0 * s;
  const Gain a = 300.0 * s * s + strut, det = a * (40.0 * s * s + strut + tyre) - strut * strut;
  const Gain body = strut * tyre / det, wheel = a * tyre / det;
  return {s * s * body, tyre * (1.0 - wheel), body - wheel};
}

TEST(RoadResponse, QuarterCarIsItsClosedForm) {
  const RoadLoading loading{.roughness = 256e-6, .speed = 20.0, .from = 0.1, .to = 60.0};
  const std::vector<double> at{0.1, 0.5, 1.4, 11.0, 50.0, 59.0};
  const RoadResponse r = road_response(example_car(), {}, at, loading);
  EXPECT_DOUBLE_EQ(r.from, 0.011 * 20.0);
  EXPECT_DOUBLE_EQ(r.to, 2.83 * 20.0);
  ASSERT_EQ(r.outputs.size(), 3u);
  EXPECT_EQ(r.outputs[0].output.name, "body.az");
  EXPECT_NEAR(r.road, std::sqrt(road_variance({}, 0.011, 2.83)), 1e-5 * r.road);
  // By Simpson's rule over f itself.
  std::array<double, 3> squares{};
  const int n = 200000;
  for (int k = 0; k <= n; ++k) {
    const double f = r.from + (r.to - r.from) * k / n, h = (r.to - r.from) / n;
    const double weight = (k == 0 || k == n ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) * h / 3.0;
    const auto G = example_gains(f);
    for (std::size_t i = 0; i < 3; ++i)
      squares[i] += weight * std::norm(G[i]) * 256e-6 * 0.01 * 20.0 / (f * f);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const OutputSpectrum& o = r.outputs[i];
    EXPECT_NEAR(o.rms, std::sqrt(squares[i]), 1e-6 * o.rms);
    figure("rms_" + o.output.name, o.rms);
    for (std::size_t k = 0; k < at.size(); ++k) {
      const bool inside = at[k] > 0.22 && at[k] < 56.6;
      const double expected =
          inside ? std::norm(example_gains(at[k])[i]) * 256e-6 * 0.01 * 20.0 / (at[k] * at[k])
                 : 0.0;
      EXPECT_NEAR(o.density[k], expected, 2e-6 * expected) << at[k];
    }
  }
}

// Effective values over 100 s of driving, from the fifth second on, every 5 ms.
TEST(RoadResponse, RunOnARandomRoadOfClassC) {
  const RoadLoading loading{.roughness = 256e-6, .speed = 20.0, .from = 0.1, .to = 60.0};
  const RoadResponse expected = road_response(example_car(), {}, {}, loading);
  for (const char* const seed : {"1", "2"}) {
    const Model model = example_car({{"seed", seed}});
    Simulation s(model);
    VecX sum = VecX::Zero(3), squares = VecX::Zero(3);
    int count = 0;
    for (int k = 1; k <= 105000; ++k) {
      ASSERT_TRUE(s.step()) << s.failure();
      if (k <= 5000 || k % 5 != 0) continue;
      ++count;
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double y = s.outputs()[static_cast<std::size_t>(i)];
        sum[i] += y;
        squares[i] += y * y;
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double mean = sum[k] / count, rms = std::sqrt(squares[k] / count - mean * mean);
      const OutputSpectrum& o = expected.outputs[i];
      figure(fmt::format("seed_{}_{}_over_spectrum", seed, o.output.name), rms / o.rms);
      EXPECT_NEAR(rms, o.rms, 0.05 * o.rms) << o.output.name;
    }
  }
}

// A bar on two wheels 2.4 m apart, alike in front and behind: it heaves with the mean of the two
// heights, as on a road that lifts all of it, times cos(w L / 2 V), and pitches with the rest.
TEST(RoadResponse, WheelsFollowEachOther) {
  const Model model = model_of(R"(
bodies:
  bar: {rigid: {mass: 500, centre_of_mass: [0, 0, 0.5], inertia: [50, 300, 300]}}
joints:
  heave: {type: planar, child: bar, at: [0, 0, 0.5], axis: y, axis_2: x}
forces:
  front: {type: tyre, body: bar, at: [1.2, 0, 0.5], radius: 0.52, stiffness: 60000, damping: 2000,
          road: flat}
  rear: {type: tyre, body: bar, at: [-1.2, 0, 0.5], radius: 0.52, stiffness: 60000, damping: 2000,
         road: flat}
roads: {flat: {profile: [[-10, 0], [10, 0]]}}
outputs:
  z: {position: bar, axis: z}
  pitch: {rotation: bar, angle: pitch}
simulation: {start: equilibrium, step: 0.001, duration: 1}
)");
  const double V = 15.0, L = 2.4;
  const std::vector<double> at = frequencies_between(0.2, 40.0, 60);
  const RoadResponse r =
      road_response(model, {}, at, {.roughness = 1e-4, .speed = V, .from = 0.1, .to = 60.0});
  const LinearModel linear = linear_model(model, {{"road", "road at front", "road at rear"}, {}});
  EXPECT_NEAR(linear.inputs[1].place, 1.2, 1e-9);
  EXPECT_NEAR(linear.inputs[2].place, -1.2, 1e-9);
  const FrequencyResponse response(linear);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Eigen::MatrixXcd G = response.at_frequency(at[k]);
    const double angle = M_PI * at[k] * L / V, S = 1e-4 * 0.01 * V / (at[k] * at[k]);
    const double heave = std::norm(G(0, 0) * std::cos(angle)) * S,
                 pitch = std::norm(2.0 * G(1, 1) * std::sin(angle)) * S;
    EXPECT_NEAR(r.outputs[0].density[k], heave, 1e-7 * std::norm(G(0, 0)) * S) << at[k];
    EXPECT_NEAR(r.outputs[1].density[k], pitch, 1e-7 * std::norm(G(1, 1)) * S) << at[k];
  }
}

// Wheels of two roads are independent: densities add up, whatever the distance.
TEST(RoadResponse, RoadsAreIndependent) {
  const auto model = [](const char* second) {
    return model_of(std::string(R"(
bodies: {bar: {rigid: {mass: 500, centre_of_mass: [0, 0, 0.5], inertia: [50, 300, 300]}}}
joints: {heave: {type: prismatic, child: bar, at: [0, 0, 0.5], axis: z}}
forces:
  left: {type: tyre, body: bar, at: [0, 1, 0.5], radius: 0.52, stiffness: 60000, damping: 2000,
         road: one}
  right: {type: tyre, body: bar, at: [0, -1, 0.5], radius: 0.52, stiffness: 60000, damping: 2000,
          road: )") +
                    second + R"(}
roads: {one: {profile: [[-10, 0], [10, 0]]}, two: {profile: [[-10, 0], [10, 0]]}}
outputs: {z: {position: bar, axis: z}}
simulation: {start: equilibrium, step: 0.001, duration: 1}
)");
  };
  const RoadLoading loading{.speed = 15.0, .from = 0.1, .to = 60.0};
  const double same = road_response(model("one"), {}, {}, loading).outputs[0].rms,
               two = road_response(model("two"), {}, {}, loading).outputs[0].rms;
  EXPECT_NEAR(two, same / std::sqrt(2.0), 1e-9 * same);
  EXPECT_EQ(error_of([&] { road_response(model("two"), {}, {}, {.speed = 1e-3}); }),
            "out_of_range");
}

// An arm on springs that leans under its weight, on a carriage that a motor moves to and fro: what
// a run comes to is what the frequency response says.
TEST(FrequencyResponse, HarmonicMotionOfTheBaseAgainstARun) {
  constexpr double amplitude = 0.004, frequency = 2.0, step = 5e-4;
  constexpr int period = 1000, before = 20, periods = 4;
  const auto arm = [&](double size) {
    return model_of(fmt::format(R"(
bodies:
  carriage: {{position: [0, 0, 0], rigid: {{mass: 4}}}}
  arm: {{rigid: {{mass: 2, centre_of_mass: [0.4, 0, 0], inertia: [0.01, 0.05, 0.05]}}}}
joints:
  slide: {{type: prismatic, child: carriage, at: [0, 0, 0], axis: x,
           motion: {{sine: {{amplitude: {}, frequency: {}}}}}}}
  pin: {{type: revolute, parent: carriage, child: arm, at: [0, 0, 0], axis: y}}
forces: {{hold: {{type: joint_spring, joint: pin, spring: 25, damper: 1.2}}}}
outputs:
  pin: {{joint_position: pin}}
  arm: {{acceleration: arm, axis: z}}
  motor: {{motion_force: slide}}
simulation: {{start: equilibrium, step: {}, duration: 1, spectral_radius: 1}}
)",
                                size, frequency, step));
  };
  const LinearModel linear = linear_model(arm(0.0));
  const Eigen::VectorXcd expected =
      amplitude * FrequencyResponse(linear).at_frequency(frequency).col(0);
  Simulation run(arm(amplitude));
  Eigen::VectorXcd found = Eigen::VectorXcd::Zero(3);
  for (int k = 1; k <= (before + periods) * period; ++k) {
    ASSERT_TRUE(run.step()) << run.failure();
    if (k <= before * period) continue;
    // The law is a sine: u = Re(-i a e^(i w t)).
    const Gain turn = Gain(0.0, 1.0) * std::polar(1.0, -2.0 * M_PI * frequency * run.time());
    for (Eigen::Index i = 0; i < 3; ++i)
      found[i] += 2.0 / (periods * period) * turn * run.outputs()[static_cast<std::size_t>(i)];
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double error = std::abs(found[i] - expected[i]) / std::abs(expected[i]);
    figure("harmonic_" + linear.outputs[static_cast<std::size_t>(i)].name, error);
    EXPECT_LT(error, 1e-3);
  }
}

TEST(FrequencyResponse, UndampedOscillatorIsItsClosedForm) {
  const Model model = model_of(R"(
bodies: {box: {position: [0, 0, 0], rigid: {mass: 4}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x}}
inputs: {push: {unit: N}}
forces:
  s: {type: joint_spring, joint: slide, spring: 16, actuator: {input: push}}
outputs: {x: {joint_position: slide}}
simulation: {step: 0.001, duration: 1}
)");
  const LinearModel linear = linear_model(model);
  const FrequencyResponse response(linear);
  EXPECT_NEAR(std::abs(response.at({0.0, 1.0})(0, 0)), 1.0 / 12.0, 1e-10);
  EXPECT_NEAR(response.at(0.0)(0, 0).real(), 1.0 / 16.0, 1e-10);
}

}  // namespace
}  // namespace floatframe::test
