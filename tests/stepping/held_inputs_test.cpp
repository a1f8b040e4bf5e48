// Inputs are held over the whole of a step: against zero-order hold in closed form, order by
// halving, work, saved states, the same in a ramp, no allocation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floatframe/realtime/realtime.hpp"
#include "floatframe/run/run_watch.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/figures.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// 1 kg on a slide, at 0.1 m, pushed by an input; `spring` [N/m] to the ground.
Model pushed_mass(double spring = 0.0) {
  return model_of(R"(
gravity: [0, 0, 0]
inputs: {F: {unit: N}}
bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}
joints: {z: {type: prismatic, child: b, at: [0, 0, 0], axis: z, position: 0.1}}
forces:
  f: {type: force, body: b, direction: z, magnitude: {input: F}}
  s: {type: joint_spring, joint: z, spring: )" +
                  std::to_string(spring) + R"(}
outputs: {z: {joint_position: z}, v: {joint_velocity: z}, a: {acceleration: b, axis: z}}
simulation: {step: 0.01}
)");
}

class HeldInputs : public ::testing::TestWithParam<Coordinates> {
 protected:
  SimulationOptions options(double step, double rho = 1.0) const {
    const SimulationOptions o{.step = step, .coordinates = GetParam(), .spectral_radius = rho};
    return o;
  }
};

TEST_P(HeldInputs, AForceActsFromTheBeginningOfItsStepToTheEnd) {
  const Model model = pushed_mass();
  for (const double rho : {1.0, 0.8, 0.0}) {
    const double h = 0.01;
    Simulation s(model, options(h, rho));
    s.set_input("F", 1.0);
    for (int k = 1; k <= 5; ++k) {
      ASSERT_TRUE(s.step()) << s.failure();
      EXPECT_NEAR(s.output("v") / (k * h), 1.0, 1e-10) << "rho " << rho << ", step " << k;
      EXPECT_NEAR(s.output("z") - 0.1, 0.5 * k * k * h * h, 1e-12);
      EXPECT_NEAR(s.output("a"), 1.0, 1e-10);
    }
    // One step of it more, backwards: what it had given is taken again.
    s.set_input("F", -5.0);
    ASSERT_TRUE(s.step());
    EXPECT_NEAR(s.output("v"), 0.0, 1e-12);
    s.set_input("F", 0.0);
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(s.step());
      EXPECT_NEAR(s.output("v"), 0.0, 1e-12) << "rho " << rho;
    }
  }
}

TEST_P(HeldInputs, ARampActsByTheMeanOfBothEnds) {
  SimulationOptions o = options(0.01);
  o.input = InputUse::ramp;
  Simulation s(pushed_mass(), o);
  s.set_input("F", 1.0);
  for (int k = 1; k <= 4; ++k) {
    ASSERT_TRUE(s.step());
    EXPECT_NEAR(s.output("v") / (0.01 * k), (k - 0.5) / k, 1e-12) << "0.5, 0.75, 0.83, ...";
  }
}

/// Growth of the energy over 5 s of 5 Hz oscillations, `part` of whose stiffness is a law of the
/// program, by the exact motion under a force that is held for h.
double exact_growth(double h, double part) {
  const double w2 = std::pow(10.0 * std::numbers::pi, 2), law = part * w2, inside = w2 - law;
  double x = 0.1, v = 0.0;
  for (long k = 0; k < std::lround(5.0 / h); ++k) {
    const double u = -law * x;
    if (inside == 0.0) {
      x += h * v + 0.5 * h * h * u;
      v += h * u;
      continue;
    }
    const double w = std::sqrt(inside), at = u / inside, away = x - at;
    x = at + away * std::cos(w * h) + v / w * std::sin(w * h);
    v = -away * w * std::sin(w * h) + v * std::cos(w * h);
  }
  return (v * v + w2 * x * x) / (w2 * 0.01);
}

double growth(Coordinates coordinates, double h, double part, double rho) {
  const double w2 = std::pow(10.0 * std::numbers::pi, 2);
  const SimulationOptions o{.step = h, .coordinates = coordinates, .spectral_radius = rho};
  Simulation s(pushed_mass((1.0 - part) * w2), o);
  s.on_force([&](double, std::span<const double> outputs, std::span<double> inputs) {
    inputs[0] = -part * w2 * outputs[0];
  });
  for (long k = 0; k < std::lround(5.0 / h); ++k) EXPECT_TRUE(s.step());
  const double z = s.output("z"), v = s.output("v");
  return (v * v + w2 * z * z) / (w2 * 0.01);
}

// A spring of the program is a zero-order hold, which lets energy grow like that of a sampled
// controller: exactly, where nothing else acts on the mass.
TEST_P(HeldInputs, ALawOfAProgramIsAZeroOrderHold) {
  const double law = growth(GetParam(), 1e-3, 1.0, 1.0);
  figure("growth, spring by the program", law);
  EXPECT_NEAR(law, 11.79, 0.005);
  EXPECT_NEAR(law / exact_growth(1e-3, 1.0), 1.0, 1e-6);
  const double half = growth(GetParam(), 1e-3, 0.5, 1.0);
  figure("growth, half of it inside the model", half);
  EXPECT_NEAR(half, 3.433, 0.005);
  // Beside other forces of second order, for every rule.
  for (const double rho : {1.0, 0.8, 0.5}) {
    double previous = 0.0;
    for (const double h : {4e-3, 2e-3, 1e-3}) {
      const double error = std::abs(growth(GetParam(), h, 0.5, rho) / exact_growth(h, 0.5) - 1.0);
      figure("rho " + std::to_string(rho) + " error", error);
      if (previous > 0.0) {
        EXPECT_GT(previous / error, 3.3) << rho << ", " << h;
      }
      previous = error;
    }
  }
}

/// Slider crank, motors with targets and loads, whose inputs jump every 8 ms.
std::vector<double> driven_machine(Coordinates coordinates, double h, double rho) {
  const SimulationOptions o{
      .step = h, .coordinates = coordinates, .tolerance = 1e-11, .spectral_radius = rho};
  Simulation s(model_of(stepped_machine), o);
  const long every = std::lround(8e-3 / h);
  for (long k = 0; k < 25 * every; ++k) {
    if (k % every == 0) {
      drive_inputs(s, static_cast<int>(k / every));
      s.set_input("shove", k / every % 2 == 0 ? 5.0 : -5.0);
    }
    EXPECT_TRUE(s.step()) << s.failure();
  }
  return {s.output("spin"), s.output("cut"), s.output("eye"), s.output("turn"), s.output("y1")};
}

TEST_P(HeldInputs, JumpsLeaveTheSecondOrder) {
  for (const double rho : {1.0, 0.8}) {
    const std::vector<double> fine = driven_machine(GetParam(), 1.25e-4, rho);
    double previous = 0.0;
    for (const double h : {2e-3, 1e-3, 5e-4}) {
      const std::vector<double> x = driven_machine(GetParam(), h, rho);
      double worst = 0.0;
      for (std::size_t k = 0; k < 2; ++k) worst = std::max(worst, std::abs(x[k] - fine[k]));
      figure("discs on motors, rho " + std::to_string(rho), worst);
      if (previous > 0.0) {
        EXPECT_GT(previous / worst, 3.4) << h;
      }
      previous = worst;
    }
  }
}

// With edges located the branch of a law is that of the new target.
TEST_P(HeldInputs, ATargetJumpsAcrossTheCornersOfItsSpring) {
  const Model model = model_of(R"(
gravity: [0, 0, 0]
inputs: {aim: {unit: rad}}
bodies: {b: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [2, 2, 2]}}}
joints: {r: {type: revolute, child: b, at: [0, 0, 0], axis: z}}
forces:
  m:
    type: joint_spring
    joint: r
    target: {input: aim}
    spring: {table: [[-9, -5], [-0.1, -5], [0.1, 5], [9, 5]]}
outputs: {w: {joint_velocity: r}, T: {force: m}}
simulation: {step: 0.01}
)");
  for (const bool locate : {false, true}) {
    SimulationOptions o = options(0.01);
    o.locate_edges = locate;
    Simulation s(model, o);
    for (const double aim : {1.0, -1.0, 1.0}) {
      const double before = s.output("w");
      s.set_input("aim", aim);
      ASSERT_TRUE(s.step()) << s.failure();
      EXPECT_NEAR(s.output("w") - before, 0.01 * 5.0 / 2.0 * aim, 1e-9)
          << "seven digits of accelerations, " << locate;
    }
    EXPECT_EQ(s.counters().edges, 0);
  }
}

/// Energy of a run in which the input changes before each step.
EnergySummary balance(const Model& model, const SimulationDescription& d, double& travelled) {
  Stepper steps(model, d, {.duration = d.duration});
  Formulation& f = steps.formulation();
  RunWatch watch(f, d.step, steps.grid().steps());
  steps.set_edge_watch({&watch, [](void* w, const State& s, const VecX& reactions) noexcept {
                          static_cast<RunWatch*>(w)->edge(s, reactions);
                        }});
  watch.start(steps.state());
  std::vector<double> row(model.outputs.size() + 1);
  steps.sample(row.data());
  travelled = 0.0;
  for (long k = 0; k < steps.grid().steps(); ++k) {
    const double force[] = {3.0 * std::cos(1.7 * static_cast<double>(k * k))}, before = row[1];
    f.set_inputs(force);
    const PlannedStep planned = steps.grid().next();
    EXPECT_TRUE(steps.advance(planned));
    steps.sample(row.data());
    travelled += force[0] * (row[1] - before);
    watch.step(steps.state(), steps.reactions(), true, planned.whole);
  }
  RunSummary summary;
  watch.finish(steps.state(), d.spectral_radius, {}, summary);
  return summary.energy;
}

// At each instant the power jumps; without the values on both sides the work of an input would be
// that of the mean of two of them.
TEST_P(HeldInputs, WorkIsTheValueTimesTheTravel) {
  const Model model = pushed_mass(200.0);
  SimulationDescription d = with(model.simulation, GetParam());
  d.duration = 1.0;
  double travelled = 0.0;
  const EnergySummary e = balance(model, d, travelled);
  EXPECT_GT(std::abs(travelled), 1e-4);
  EXPECT_NEAR(e.work[EnergyFlow::loads], travelled, 1e-10);
  EXPECT_LT(std::abs(e.largest_remainder), 1e-9 * e.exchanged + 1e-12);
}

/// Sends other values before each step and notes the velocities that come of them.
class Pusher final : public SignalPort {
 public:
  bool receive(InputBuffer& inputs) noexcept override {
    const double force[] = {static_cast<double>(1 + velocities.size() % 3)};
    inputs.accept(force);
    return true;
  }
  void send(std::uint64_t, double, std::span<const double> outputs, bool) noexcept override {
    velocities.push_back(outputs[1]);
  }
  std::vector<double> velocities;
};

TEST_P(HeldInputs, RealTimeHoldsThemToo) {
  const Model model = pushed_mass();
  SimulationDescription d = with(model.simulation, GetParam());
  d.duration = 0.1;
  const RealTimeOptions o{.paced = false};
  for (const InputUse use : {InputUse::held, InputUse::ramp}) {
    d.input = use;
    Pusher port;
    run_real_time(model, d, o, &port);
    ASSERT_EQ(port.velocities.size(), 11u);
    for (std::size_t k = 1; k < port.velocities.size(); ++k) {
      const double now = static_cast<double>(1 + k % 3);
      const double last = k == 1 ? 0.0 : static_cast<double>(1 + (k - 1) % 3);
      const double mean = use == InputUse::held ? now : 0.5 * (now + last);
      EXPECT_NEAR(port.velocities[k] - port.velocities[k - 1], d.step * mean, 1e-10) << k;
    }
  }
}

TEST_P(HeldInputs, AStateBetweenAnInputAndItsStepContinuesWithEqualBits) {
  const Model model = model_of(stepped_machine);
  SimulationOptions o = options(2e-3, 0.8);
  Simulation s(model, o), other(model, o);
  trace(s, 0, 7);
  s.set_input("shove", 4.0);  // not yet used
  const std::vector<std::byte> bytes = s.save().to_bytes();
  const std::vector<double> first = trace(s, 7, 40);
  other.restore(SimulationState::from_bytes(bytes));
  EXPECT_EQ(other.save().to_bytes(), bytes);
  EXPECT_TRUE(equal_bits(trace(other, 7, 40), first));
  // Set to what it is, an input changes nothing.
  s.restore(SimulationState::from_bytes(bytes));
  s.set_input("shove", 0.0);
  Simulation plain(model, o);
  trace(plain, 0, 7);
  EXPECT_TRUE(equal_bits(trace(s, 7, 20), trace(plain, 7, 20)));
}

TEST_P(HeldInputs, NoStepAllocates) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  Simulation s(model_of(stepped_machine), options(2e-3));
  s.step();
  const AllocationScope scope;
  for (int k = 0; k < 50; ++k) {
    drive_inputs(s, k);
    ASSERT_TRUE(s.step());
  }
  EXPECT_EQ(scope.count(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Both, HeldInputs, ::testing::ValuesIn(both_coordinates),
                         [](const auto& x) { return name_of(x.param); });

}  // namespace
}  // namespace floatframe::test
