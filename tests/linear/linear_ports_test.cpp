// Linear systems between inputs and outputs: transfer functions of a quarter car against their
// closed forms, of both formulations against each other, and against the nonlinear run.
#include "floatframe/linear/linear_ports.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "floatframe/linear/frequency_response.hpp"
#include "support/error_of.hpp"
#include "support/figures.hpp"
#include "support/linear_models.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

using Complex = std::complex<double>;
// A body on a wheel on a road, an actuator between them; beside it the same on a plate that a motor
// lifts instead of the road.
const char* const two_quarter_cars = R"(
bodies:
  load: {rigid: {mass: 300, centre_of_mass: [0, 0, 0.8], inertia: [1, 1, 1]}}
  wheel: {rigid: {mass: 40, centre_of_mass: [0, 0, 0.3], inertia: [1, 1, 1]}}
  plate: {rigid: {mass: 15, centre_of_mass: [1, 0, 0], inertia: [1, 1, 1]}}
  load_2: {rigid: {mass: 300, centre_of_mass: [1, 0, 0.8], inertia: [1, 1, 1]}}
  wheel_2: {rigid: {mass: 40, centre_of_mass: [1, 0, 0.3], inertia: [1, 1, 1]}}
joints:
  load: {type: prismatic, child: load, at: [0, 0, 0], axis: z}
  wheel: {type: prismatic, child: wheel, at: [0, 0, 0], axis: z}
  plate: {type: prismatic, child: plate, at: [1, 0, 0], axis: z, motion: {polynomial: [0]}}
  load_2: {type: prismatic, child: load_2, at: [1, 0, 0], axis: z}
  wheel_2: {type: prismatic, child: wheel_2, at: [1, 0, 0], axis: z}
inputs: {active: {unit: N}}
forces:
  strut:
    type: spring_damper
    from: {body: load, at: [0, 0, 0.8]}
    to: {body: wheel, at: [0, 0, 0.3]}
    spring: {linear: {stiffness: 20000, free: 0.6}}
    damper: 1500
    actuator: {input: active}
  tyre:
    {type: tyre, body: wheel, at: [0, 0, 0.3], radius: 0.32, stiffness: 2.0e+5, damping: 300,
     road: flat}
  strut_2:
    type: spring_damper
    from: {body: load_2, at: [1, 0, 0.8]}
    to: {body: wheel_2, at: [1, 0, 0.3]}
    spring: {linear: {stiffness: 20000, free: 0.6}}
    damper: 1500
  tyre_2:
    type: spring_damper
    from: {body: wheel_2, at: [1, 0, 0.3]}
    to: {body: plate, at: [1, 0, 0]}
    spring: {linear: {stiffness: 2.0e+5, free: 0.32}}
    damper: 300
roads: {flat: {profile: [[-1, 0], [10, 0]]}}
outputs:
  load.a: {acceleration: load, axis: z}
  load.v: {velocity: load, axis: z}
  travel: {length: strut}
  tyre: {force: tyre}
  load_2.a: {acceleration: load_2, axis: z}
  tyre_2: {force: tyre_2}
  motor: {motion_force: plate}
simulation: {start: equilibrium, step: 0.001, duration: 1}
)";

/// Displacements of load and wheel with a road of height u, and with a tension F in the strut.
struct QuarterCarForm {
  Complex load_u, wheel_u, load_F, wheel_F;
};
QuarterCarForm closed_form(Complex s) {
  const Complex strut = 20000.0 + 1500.0 * s, tyre = 2e5 + 300.0 * s;
  const Complex a = 300.0 * s * s + strut, d = 40.0 * s * s + strut + tyre;
  const Complex det = a * d - strut * strut;
  return {strut * tyre / det, a * tyre / det, (strut - d) / det, (a - strut) / det};
}

TEST(LinearPorts, QuarterCarIsItsClosedForm) {
  const Model model = model_of(two_quarter_cars);
  for (const Coordinates c : both_coordinates) {
    const LinearModel linear = linear_model(model, {}, {.coordinates = c});
    ASSERT_EQ(linear.inputs.size(), 3u);
    EXPECT_EQ(linear.inputs[0].name, "active");
    EXPECT_EQ(linear.inputs[1].name, "motion of plate");
    EXPECT_EQ(linear.inputs[2].name, "road");
    EXPECT_NEAR(linear.output_values[3], 340 * 9.81, 1e-6);
    const FrequencyResponse response(linear);
    double worst = 0.0;
    for (double f = 0.05; f < 100.0; f *= 1.1) {
      const Complex s(0.0, 2.0 * M_PI * f), tyre = 2e5 + 300.0 * s;
      const QuarterCarForm x = closed_form(s);
      Eigen::MatrixXcd expected = Eigen::MatrixXcd::Zero(7, 3);
      expected.col(0) << s * s * x.load_F, s * x.load_F, x.load_F - x.wheel_F, -tyre * x.wheel_F, 0,
          0, 0;
      const Complex touch = tyre * (1.0 - x.wheel_u);
      expected.col(2) << s * s * x.load_u, s * x.load_u, x.load_u - x.wheel_u, touch, 0, 0, 0;
      expected.col(1) << 0, 0, 0, 0, s * s * x.load_u, -touch, 15.0 * s * s + touch;
      const Eigen::MatrixXcd found = response.at_frequency(f);
      for (Eigen::Index j = 0; j < 3; ++j)
        for (Eigen::Index i = 0; i < 7; ++i) {
          // What must vanish is compared with the largest of its output.
          double size = std::abs(expected(i, j));
          if (size == 0.0) size = expected.row(i).cwiseAbs().maxCoeff();
          const double error = std::abs(found(i, j) - expected(i, j)) / size;
          EXPECT_LT(error, 1e-6) << f << " Hz, output " << i << ", input " << j;
          worst = std::max(worst, error);
        }
    }
    figure(c == Coordinates::relative ? "quarter_car_relative" : "quarter_car_absolute", worst);
  }
}

// On a flat road a radial tyre is a vertical one, also if the road is lifted.
TEST(LinearPorts, RadialTyreOnAFlatRoad) {
  std::string radial = two_quarter_cars;
  const std::string damping = "damping: 300,";
  radial.replace(radial.find(damping), damping.size(), damping + " law: radial,");
  const LinearModel one = linear_model(model_of(two_quarter_cars), {{"road"}, {}}),
                    two = linear_model(model_of(radial), {{"road"}, {}});
  const Eigen::MatrixXcd G = FrequencyResponse(one).at_frequency(3.0),
                         H = FrequencyResponse(two).at_frequency(3.0);
  EXPECT_LT((G - H).cwiseAbs().maxCoeff(), 1e-9 * G.cwiseAbs().maxCoeff());
}

TEST(LinearPorts, StateSpaceHasTheSameTransferFunction) {
  const Model model = model_of(two_quarter_cars);
  const LinearModel linear = linear_model(model);
  const StateSpace s = state_space(linear);
  EXPECT_EQ(s.inputs[0].name, "active");
  EXPECT_EQ(s.inputs[1].name, "acceleration of motion of plate");
  EXPECT_EQ(s.inputs[1].unit, "m/s2");
  EXPECT_EQ(s.inputs[2].name, "rate of road");
  EXPECT_EQ(s.inputs[2].unit, "m/s");
  ASSERT_EQ(s.A.rows(), linear.system.A.rows() + 3);
  ASSERT_EQ(static_cast<Eigen::Index>(s.states.size()), s.A.rows());
  EXPECT_EQ(s.states.back(), "road");
  const Resolvent resolvent(s.A);
  const Complex at(0.0, 12.0);
  Eigen::MatrixXcd z;
  ASSERT_TRUE(resolvent.solve(at, s.B.cast<Complex>(), z));
  Eigen::MatrixXcd G = s.C * z + s.D.cast<Complex>();
  G.col(1) *= at * at;
  G.col(2) *= at;
  EXPECT_LT((G - FrequencyResponse(linear).at(at)).norm(), 1e-9 * G.norm());
}

TEST(LinearPorts, ChoosesByNameInThatOrder) {
  const Model model = model_of(two_quarter_cars);
  const LinearModel linear = linear_model(model, {{"road", "active"}, {"tyre", "load.v"}});
  const LinearModel all = linear_model(model);
  ASSERT_EQ(linear.C.rows(), 2);
  EXPECT_EQ(linear.outputs[0].name, "tyre");
  EXPECT_EQ(linear.outputs[1].unit, "m/s");
  EXPECT_LT((linear.C.row(0) - all.C.row(3)).norm(), 1e-8 * all.C.row(3).norm());
  EXPECT_LT((linear.B[1].col(0) - all.B[1].col(2)).norm(), 1e-10);
  EXPECT_EQ(error_of([&] { linear_model(model, {{"rod"}, {}}); }), "not_found");
  EXPECT_EQ(error_of([&] { linear_model(model, {{}, {"tire"}}); }), "not_found");
}

// A flexible crank and rocker: a closed loop with a motor, reactions and a load with an input.
TEST(LinearPorts, BothFormulationsHaveOneTransferFunction) {
  const Model model = model_of(R"(
points: {a: [0, 0, 0], b: [0.3, 0, 0], c: [0.8, 0, 0.3], d: [0.8, 0, -0.3]}
bodies:
  crank: {rigid: {mass: 2, centre_of_mass: [0.15, 0, 0], inertia: [0.01, 0.02, 0.02]}}
  coupler:
    flexible:
      material: {young: 2e9, poisson: 0.3, density: 2700}
      bars: {one: {from: b, to: c, elements: 4, section: {round: 0.02}}}
      clamped: [b]
      static_modes: [{point: c, dofs: [x, y, z]}]
  rocker: {rigid: {mass: 3, centre_of_mass: [0.8, 0, 0], inertia: [0.1, 0.1, 0.01]}}
joints:
  drive: {type: revolute, child: crank, at: a, axis: y, motion: {polynomial: [0.1]}}
  b: {type: spherical, parent: crank, child: coupler, at: b}
  c: {type: universal, parent: coupler, child: rocker, at: c, axis: y, axis_2: x}
  d: {type: revolute, child: rocker, at: d, axis: y}
inputs: {push: {unit: N}}
forces:
  hold: {type: joint_spring, joint: d, spring: 800, damper: 3}
  push: {type: force, body: rocker, at: c, direction: [1, 0.4, 0.2], magnitude: {input: push}}
outputs:
  c: {position: {body: coupler, at: c}}
  c.a: {acceleration: {body: coupler, at: c}}
  b.F: {joint_force: b}
  d.F: {joint_force: d}
  drive: {motion_force: drive}
  bend: {modal_amplitude: coupler, mode: 3}
  turn: {rotation: rocker}
simulation: {start: equilibrium, step: 0.001, duration: 1}
)");
  const LinearModel one = linear_model(model, {}, {.coordinates = Coordinates::relative}),
                    two = linear_model(model, {}, {.coordinates = Coordinates::absolute});
  const FrequencyResponse first(one), second(two);
  const auto vector_of = [&](Eigen::Index i) {
    const std::string& name = one.outputs[static_cast<std::size_t>(i)].name;
    return name.substr(0, name.rfind('.'));
  };
  double worst = 0.0;
  for (double f = 0.1; f < 1000.0; f *= 2.0) {
    const Eigen::MatrixXcd G = first.at_frequency(f), H = second.at_frequency(f);
    for (Eigen::Index j = 0; j < G.cols(); ++j)
      for (Eigen::Index i = 0; i < G.rows(); ++i) {
        // Components that vanish are compared with the others of their vector.
        double size = 0.0;
        for (Eigen::Index k = 0; k < G.rows(); ++k)
          if (vector_of(k) == vector_of(i)) size = std::max(size, std::abs(G(k, j)));
        if (size > 1e-12) worst = std::max(worst, std::abs(G(i, j) - H(i, j)) / size);
      }
  }
  figure("transfer_of_both_formulations", worst);
  EXPECT_LT(worst, 1e-6);
}

// A bead on a spring slides along an arm that a motor turns at 12 rad/s, where it is in balance:
// m r'' + (k - m W^2) r = 2 m W rho u' for a small angle u of the motor more, with the torque
// (I + m rho^2) u'' + 2 m rho W r'.
TEST(LinearPorts, MotorOfAnArmThatTurns) {
  const Model model = arm_and_bead("[1, 1, 0.3]", "motion: {polynomial: [0, 12]}", R"(outputs:
  r: {joint_position: slide}
  x: {position: bead, axis: x}
  y: {position: bead, axis: y}
  vx: {velocity: bead, axis: x}
  motor: {motion_force: pin}
)");
  const LinearModel linear = linear_model(model);
  ASSERT_EQ(linear.inputs.size(), 1u);
  EXPECT_EQ(linear.inputs[0].unit, "rad");
  const FrequencyResponse response(linear);
  const double m = 0.2, W = 12.0, rho = 0.5, I = 0.3;
  for (const double f : {0.1, 1.0, 2.0, 5.0, 20.0}) {
    const Complex s(0.0, 2.0 * M_PI * f), r = 2.0 * W * rho * s / (s * s + 90.0 / m - W * W);
    Eigen::VectorXcd expected(5);
    expected << r, r, rho, s * r - W * rho, (I + m * rho * rho) * s * s + 2.0 * m * rho * W * s * r;
    const Eigen::VectorXcd found = response.at_frequency(f).col(0);
    for (Eigen::Index i = 0; i < 5; ++i)
      EXPECT_LT(std::abs(found[i] - expected[i]), 1e-6 * std::abs(expected[i])) << f << ": " << i;
  }
}

// An arm that leans, of two parts of which the second bends easily, on a carriage that a motor
// moves, with a load at its end. Disturbed by e: the motor's motion e t^3, the load and a rate.
std::string leaning_arm(double e, const char* stiffening) {
  const std::string size = fmt::format("{:.17g}", e);
  return R"(
points: {a: [0, 0, 0], b: [0.5, 0, 0], c: [1, 0, 0]}
bodies:
  carriage: {position: [0, 0, 0], rigid: {mass: 4, inertia: [1, 1, 1]}}
  arm: {rigid: {mass: 2, centre_of_mass: [0.25, 0, 0], inertia: [0.01, 0.05, 0.05]}}
  end:
    flexible:
      material: {young: 2e8, poisson: 0.3, density: 1500}
      bars: {one: {from: b, to: c, elements: 4, section: {round: 0.04}}}
      clamped: [b]
      static_modes: [{point: c, dofs: [z]}]
joints:
  slide: {type: prismatic, child: carriage, at: a, axis: x, motion: {polynomial: [0, 0, 0, )" +
         size + R"(]}}
  pin: {type: revolute, parent: carriage, child: arm, at: a, axis: y, velocity: )" +
         fmt::format("{:.17g}", 0.5 * e) + R"(}
  elbow: {type: revolute, parent: arm, child: end, at: b, axis: y}
inputs: {load: {unit: N}}
forces:
  hold: {type: joint_spring, joint: pin, spring: 60, damper: 1}
  bend: {type: joint_spring, joint: elbow, spring: 12, damper: 0.2}
  load: {type: force, body: end, at: c, direction: [0.3, 0, 1], magnitude: {input: load}}
outputs:
  c.x: {position: {body: end, at: c}, axis: x}
  c.vz: {velocity: {body: end, at: c}, axis: z}
  c.az: {acceleration: {body: end, at: c}, axis: z}
  pin.F: {joint_force: pin, axis: z}
  slide: {motion_force: slide}
  hold: {force: hold}
simulation: {start: equilibrium, step: 0.0001, duration: 0.5, spectral_radius: 1,
             geometric_stiffening: )" +
         stiffening + "}\n";
}

/// Outputs of the linear system every `interval`, by the rule of fourth order.
std::vector<VecX> linear_outputs(const StateSpace& s, VecX z, double load, double e,
                                 double interval, int count) {
  constexpr int parts = 100;
  const double h = interval / parts;
  const auto u = [&](double t) { return VecX(Eigen::Vector2d(load, 6.0 * e * t)); };
  const auto rate = [&](double t, const VecX& x) { return VecX(s.A * x + s.B * u(t)); };
  std::vector<VecX> all;
  for (int k = 1; k <= count; ++k) {
    for (int part = 0; part < parts; ++part) {
      const double t = (k - 1) * interval + part * h;
      const VecX k1 = rate(t, z), k2 = rate(t + 0.5 * h, z + 0.5 * h * k1);
      const VecX k3 = rate(t + 0.5 * h, z + 0.5 * h * k2), k4 = rate(t + h, z + h * k3);
      z += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    all.push_back(s.C * z + s.D * u(k * interval));
  }
  return all;
}

void expect_second_order_in_the_amplitude(const char* stiffening) {
  constexpr int count = 50, steps = 100;
  const LinearModel linear = linear_model(model_of(leaning_arm(0.0, stiffening)));
  const StateSpace s = state_space(linear);
  ASSERT_EQ(s.inputs[0].name, "load");
  for (const Coordinates c : both_coordinates) {
    std::vector<VecX> errors;
    for (double e = 0.4; e > 0.04; e *= 0.5) {
      Simulation run(model_of(leaning_arm(e, stiffening)), {.coordinates = c});
      run.set_input("load", e);
      VecX z = VecX::Zero(s.A.rows());
      for (std::size_t k = 0; k < s.states.size(); ++k)
        if (s.states[k] == "rate of joint 'pin'") z[static_cast<Eigen::Index>(k)] = 0.5 * e;
      ASSERT_GT(z.norm(), 0.0);
      const std::vector<VecX> expected = linear_outputs(s, z, e, e, 0.01, count);
      VecX error = VecX::Zero(s.C.rows());
      for (int k = 0; k < count; ++k) {
        for (int step = 0; step < steps; ++step) ASSERT_TRUE(run.step()) << run.failure();
        for (Eigen::Index i = 0; i < error.size(); ++i)
          error[i] = std::max(error[i], std::abs(run.outputs()[static_cast<std::size_t>(i)] -
                                                 linear.output_values[i] -
                                                 expected[static_cast<std::size_t>(k)][i]));
      }
      for (Eigen::Index i = 0; i < error.size(); ++i)
        figure(fmt::format("{}_e_{}_{}", c == Coordinates::relative ? "relative" : "absolute", e,
                           s.outputs[static_cast<std::size_t>(i)].name),
               error[i]);
      errors.push_back(error);
    }
    for (std::size_t k = 1; k < errors.size(); ++k)
      for (Eigen::Index i = 0; i < errors[k].size(); ++i) {
        const double ratio = errors[k - 1][i] / errors[k][i];
        EXPECT_GT(ratio, 3.6) << s.outputs[static_cast<std::size_t>(i)].name << ", halving " << k;
        EXPECT_LT(ratio, 4.4) << s.outputs[static_cast<std::size_t>(i)].name << ", halving " << k;
      }
  }
}

TEST(LinearPorts, NonlinearRunDiffersBySecondOrderInTheAmplitude) {
  // Runs leave geometric stiffening out unless they are asked for it, linear systems unless they
  // are asked not to.
  for (const char* stiffening : {"false", "true"}) {
    SCOPED_TRACE(stiffening);
    expect_second_order_in_the_amplitude(stiffening);
  }
}

}  // namespace
}  // namespace floatframe::test
