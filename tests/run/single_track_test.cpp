// A single-track vehicle on linear tyres against its closed forms: steady gains, eigenvalues,
// frequency response, a ramp of the steering; and the relaxation of a tyre.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "floatframe/linear/frequency_response.hpp"
#include "floatframe/linear/linear_ports.hpp"
#include "support/completed_run.hpp"
#include "support/figures.hpp"
#include "support/model_text.hpp"
#include "support/named_rows.hpp"

namespace floatframe::test {
namespace {

using Complex = std::complex<double>;

/// At the speed v along x, one wheel for each axle, carried without rolling resistance; the front
/// one on a massless link that is steered.
std::string single_track(const std::string& vehicle, double v, const std::string& steering) {
  const NamedRow p = named_rows("tyres/singletrack_parameters.csv", vehicle).at(0);
  const double a = p("a_m"), b = p("b_m"), m = p("m_kg");
  const auto tyre = [&](const char* body, double x, double load, double stiffness) {
    return fmt::format(R"({{type: linear_tyre, body: {}, at: [{}, 0, 0.3], road: flat,
      spinning: false, relaxation: false, damping_speed: 1, radius: {}, stiffness: 2.0e+5,
      slip_stiffness: 1, cornering_stiffness: {}, friction: 100,
      relaxation_x: 1, relaxation_y: 1}})",
                       body, x, 0.3 + load / 2e5, stiffness);
  };
  const double g = 9.81, front = m * g * b / (a + b), rear = m * g * a / (a + b);
  return fmt::format(R"(
bodies:
  car: {{rigid: {{mass: {}, centre_of_mass: [0, 0, 0.5], inertia: [500, 2000, {}]}}}}
  link: {{rigid: {{mass: 0, centre_of_mass: [{}, 0, 0.3], inertia: [0, 0, 0]}}}}
joints:
  plane: {{type: planar, child: car, at: [0, 0, 0.5], axis: z, axis_2: x, velocity: [{}, 0, 0]}}
  steer: {{type: revolute, parent: car, child: link, at: [{}, 0, 0.3], axis: z, motion: {}}}
forces:
  front: {}
  rear: {}
roads: {{flat: {{profile: [[-1, 0], [1, 0]]}}}}
outputs:
  r: {{angular_velocity: car, axis: z}}
  ay: {{acceleration: car, axis: y}}
  vy: {{velocity: car, axis: y}}
simulation: {{step: 0.001, duration: 2, output_interval: 0.025}}
)",
                     m, p("Iz_kgm2"), a, v, a, steering, tyre("link", a, front, p("Cf_N_rad_axle")),
                     tyre("car", -b, rear, p("Cr_N_rad_axle")));
}

double relative_error(Complex x, Complex reference) {
  return std::abs(x - reference) / std::abs(reference);
}

/// Yaw rate, lateral acceleration and side slip over the angle of steering.
struct Gains {
  Complex r, ay, beta;
};
Gains gains(const FrequencyResponse& response, double v, double omega) {
  const Complex s(0.0, omega);
  const Eigen::MatrixXcd G = response.at(s);
  // vy across the course of the start; beta = vy/v - psi.
  return {G(0, 0), G(1, 0), G(2, 0) / v - G(0, 0) / s};
}

/// Of yaw rate and lateral acceleration: means over a circle about s = 0, which is an eigenvalue,
/// since place and heading are free, but no pole of these two.
std::pair<double, double> steady_gains(const FrequencyResponse& response) {
  constexpr int points = 16;
  constexpr double radius = 0.02;  // the slowest root of the table is 0.12 1/s
  Complex r = 0.0, ay = 0.0;
  for (int k = 0; k < points; ++k) {
    const Eigen::MatrixXcd G =
        response.at(std::polar(radius, 2.0 * std::numbers::pi * (k + 0.5) / points));
    r += G(0, 0);
    ay += G(1, 0);
  }
  return {r.real() / points, ay.real() / points};
}

TEST(SingleTrack, SteadyGainsAndEigenvaluesAreTheClosedForms) {
  double gain = 0.0, root = 0.0;
  for (const NamedRow& row : named_rows("tyres/singletrack_steady.csv")) {
    const double v = row("v_m_s");
    const Model model = model_of(single_track(row.name, v, "{polynomial: [0]}"));
    // States that move are linear in relative coordinates alone.
    const LinearModel linear = linear_model(model, {{"motion of steer"}, {"r", "ay", "vy"}});
    const auto [r, ay] = steady_gains(FrequencyResponse(linear));
    gain = std::max({gain, relative_error(r, row("yawrate_gain_1_s")),
                     relative_error(ay, row("ay_gain_m_s2_rad"))});
    const auto modes = linear_modes(linear.system);
    for (const char* k : {"1", "2"}) {
      const Complex reference(row(fmt::format("lambda{}_re", k)),
                              std::abs(row(fmt::format("lambda{}_im", k))));
      double nearest = INFINITY;
      for (const LinearMode& mode : modes)
        nearest = std::min(nearest, relative_error(mode.lambda, reference));
      root = std::max(root, nearest);
    }
  }
  figure("single_track_gains", gain);
  figure("single_track_eigenvalues", root);
  EXPECT_LT(gain, 1e-8);
  EXPECT_LT(root, 1e-8);
}

TEST(SingleTrack, FrequencyResponseIsTheClosedForm) {
  double worst = 0.0;
  for (const NamedRow& row : named_rows("tyres/singletrack_frequency.csv")) {
    const double v = row("v_m_s"), omega = 2.0 * std::numbers::pi * row("f_Hz");
    const LinearModel linear =
        linear_model(model_of(single_track(row.name, v, "{polynomial: [0]}")),
                     {{"motion of steer"}, {"r", "ay", "vy"}});
    const Gains G = gains(FrequencyResponse(linear), v, omega);
    const auto reference = [&](const char* gain, const char* phase) {
      return std::polar(row(gain), row(phase) * std::numbers::pi / 180.0);
    };
    worst =
        std::max({worst, relative_error(G.r, reference("yawrate_gain_1_s", "yawrate_phase_deg")),
                  relative_error(G.ay, reference("ay_gain_m_s2_rad", "ay_phase_deg")),
                  relative_error(G.beta, reference("beta_gain", "beta_phase_deg"))});
  }
  figure("single_track_frequency_response", worst);
  EXPECT_LT(worst, 1e-8);
}

/// Largest deviation of the yaw rate, relative to its largest value, with a ramp of 0.15 s.
double ramp_deviation(Coordinates c, double step) {
  constexpr double small = 1e-4;  // times the angle of the reference, which is linear
  const auto rows = named_rows("tyres/singletrack_step.csv");
  const double angle = small * rows[0]("delta_deg") * std::numbers::pi / 180.0;
  const Model model =
      model_of(single_track(rows[0].name, rows[0]("v_m_s"),
                            fmt::format("{{piecewise: [{{below: 0.15, polynomial: [0, {:.17g}]}}, "
                                        "{{polynomial: [{:.17g}]}}]}}",
                                        angle / 0.15, angle)));
  SimulationDescription s = with(model.simulation, c, step, 2.0);
  s.tolerance = 1e-12;  // the yaw rate is 2e-5 rad/s
  const RunResult r = completed_run(model, s);
  double worst = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < r.table.rows() && k < rows.size(); ++k) {
    EXPECT_NEAR(r.table.at(k, 0), rows[k]("t_s"), 1e-9);
    const double reference = small * rows[k]("yawrate_deg_s") * std::numbers::pi / 180.0;
    largest = std::max(largest, std::abs(reference));
    worst = std::max(worst, std::abs(r.table.at(k, 1) - reference));
  }
  return worst / largest;
}

TEST(SingleTrack, FollowsARampWithTheSquareOfTheStep) {
  for (const Coordinates c : both_coordinates) {
    const double coarse = ramp_deviation(c, 5e-3), fine = ramp_deviation(c, 2.5e-3);
    EXPECT_GT(coarse / fine, 3.6);
    EXPECT_LT(coarse / fine, 4.4);
    const double at_1_ms = ramp_deviation(c, 1e-3);
    figure("single_track_ramp_" + name_of(c), at_1_ms);
    EXPECT_LT(at_1_ms, 1e-5);
  }
}

// A wheel that is pushed along at V and steered by delta(t) = w t: with T = sigma/V
//   F_y = C w (t - T (1 - exp(-t/T)))
TEST(SingleTrack, RelaxationIsItsClosedForm) {
  const Model model = model_of(R"(
bodies:
  sledge: {rigid: {mass: 10, centre_of_mass: [0, 0, 0.5], inertia: [1, 1, 1]}}
  link: {rigid: {mass: 1, centre_of_mass: [0, 0, 0.3], inertia: [1, 1, 1]}}
joints:
  slide: {type: prismatic, child: sledge, at: [0, 0, 0.5], axis: x, motion: {polynomial: [0, 8]}}
  steer:
    {type: revolute, parent: sledge, child: link, at: [0, 0, 0.3], axis: z,
     motion: {polynomial: [0, 1.0e-4]}}
forces:
  tyre: {type: linear_tyre, body: link, at: [0, 0, 0.3], road: flat, spinning: false,
    radius: 0.31, stiffness: 2.0e+5, slip_stiffness: 5.0e+4, cornering_stiffness: 6.0e+4,
    relaxation_x: 0.3, relaxation_y: 0.4}
roads: {flat: {profile: [[-1, 0], [1, 0]]}}
outputs: {Fy: {force: tyre, output: lateral_force}}
simulation: {step: 1.0e-3, duration: 0.3}
)");
  const double V = 8.0, w = 1e-4, C = 6e4, T = 0.4 / V;
  const auto deviation = [&](Coordinates c, double step) {
    const RunResult r = completed_run(model, with(model.simulation, c, step, 0.3));
    double worst = 0.0;
    for (std::size_t k = 0; k < r.table.rows(); ++k) {
      const double t = r.table.at(k, 0);
      worst =
          std::max(worst, std::abs(r.table.at(k, 1) - C * w * (t - T * (1.0 - std::exp(-t / T)))));
    }
    return worst / (C * w * 0.3);
  };
  for (const Coordinates c : both_coordinates) {
    const double coarse = deviation(c, 2e-3), fine = deviation(c, 1e-3);
    figure("tyre_relaxation_" + name_of(c), fine);
    EXPECT_NEAR(coarse / fine, 4.0, 0.4);
    EXPECT_LT(fine, 1e-5);
  }
}

}  // namespace
}  // namespace floatframe::test
