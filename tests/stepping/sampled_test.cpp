// Sampled controllers: motions against solutions in the z-domain with steps that divide their
// periods or do not, with delays, in unstable loops; the order at an instant; instants without
// drift; saved simulations; what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floatframe/linear/linear_system.hpp"
#include "floatframe/linear/linearize.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/start/check.hpp"
#include "floatframe/start/statics.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/linear_models.hpp"
#include "support/stepping_models.hpp"

namespace floatframe::test {
namespace {

/// A box of 3 kg at 0.3 m that controllers push: `b` acts.
std::string sampled_box(const std::string& controllers) {
  return R"(
gravity: [0, 0, 0]
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x, position: 0.3}}
forces: {motor: {type: joint_spring, joint: slide, actuator: {controller: b}}}
controllers:
)" + controllers +
         R"(
outputs: {x: {joint_position: slide}, v: {joint_velocity: slide}, u: {controller: b}}
simulation: {step: 0.01, duration: 1}
)";
}

/// The loop of a box and a PID controller of it, with the target 0, from sample to sample: of
/// (x, v, i, e behind the filter, u_k-1, ..., u_k-n-1), the delay being n T + r. The box is
/// discretised exactly, 1/(m s^2) behind a hold.
struct SampledLoop {
  double T = 0.05, kp = 0.0, ki = 0.0, kd = 0.0, filter = 0.0, delay = 0.0, m = 3.0;

  int whole() const { return static_cast<int>(std::floor(delay / T + 1e-9)); }
  VecX start() const {
    VecX s = VecX::Zero(5 + whole());
    s[0] = 0.3;
    s[3] = -0.3;
    return s;
  }
  VecX next(const VecX& s) const {
    const int n = whole();
    const double e = -s[0], d = (e - s[3]) / (filter + T), i = s[2] + ki * T * e;
    VecX all(n + 2), out = s;  // u_k, u_k-1, ...
    all << kp * e + i + kd * d, s.tail(n + 1);
    const double r = std::max(0.0, delay - n * T), late = T - r;
    const double early = all[n + 1] / m, then = all[n] / m;
    out[0] += T * s[1] + early * r * (T - 0.5 * r) + 0.5 * then * late * late;
    out[1] += early * r + then * late;
    out[2] = i;
    out[3] += T * d;
    out.tail(n + 1) = all.head(n + 1);
    return out;
  }
  MatX matrix() const {
    const Eigen::Index size = start().size();
    MatX M(size, size);
    for (Eigen::Index k = 0; k < size; ++k) M.col(k) = next(VecX::Unit(size, k));
    return M;
  }
  std::string text() const {
    return sampled_box(fmt::format(
        "  b: {{type: pid, measured: {{length: motor}}, proportional: {}, integral: {}, "
        "derivative: {}, {}period: {}, delay: {}}}",
        kp, ki, kd, filter > 0.0 ? fmt::format("filter: {}, ", filter) : "", T, delay));
  }
};

const SampledLoop stable_loops[] = {
    {.kp = 60.0, .ki = 20.0, .kd = 25.0},
    {.kp = 60.0, .ki = 20.0, .kd = 25.0, .filter = 0.02},
    {.kp = 20.0, .ki = 4.0, .kd = 12.0, .delay = 0.05},
    {.kp = 20.0, .ki = 4.0, .kd = 12.0, .delay = 0.02},
    {.kp = 8.0, .ki = 1.0, .kd = 8.0, .delay = 0.135},
};

/// Largest differences of x at the samples that end steps, relative to its largest magnitude.
double error_at_samples(const SampledLoop& loop, Coordinates c, double h, double end) {
  const Model model = model_of(loop.text());
  SimulationDescription o = with(model.simulation, c, h, end);
  o.tolerance = 1e-12;
  const RunResult r = completed_run(model, o);
  VecX s = loop.start();
  double error = 0.0, size = 0.3;
  int k = 0, compared = 0;
  for (std::size_t row = 0; row + 3 < r.table.data.size(); row += 4) {
    const double t = r.table.data[row];
    for (; k * loop.T < t - 1e-9; ++k) s = loop.next(s);
    if (std::abs(k * loop.T - t) > 1e-9) continue;
    error = std::max(error, std::abs(r.table.data[row + 1] - s[0]));
    size = std::max(size, std::abs(s[0]));
    ++compared;
  }
  EXPECT_GT(compared, 2);
  return error / size;
}

class Sampled : public ::testing::TestWithParam<Coordinates> {};

// Steps as long as the period, shorter ones, those that do not divide it, longer ones.
TEST_P(Sampled, PidMovesADoubleIntegratorAsInTheZDomain) {
  for (const SampledLoop& loop : stable_loops) {
    EXPECT_LT(general_eigen(loop.matrix()).values.cwiseAbs().maxCoeff(), 1.0);
    for (const double h : {0.05, 0.01, 0.02, 0.035, 0.12})
      EXPECT_LT(error_at_samples(loop, GetParam(), h, 2.1), 1e-10)
          << "delay " << loop.delay << ", filter " << loop.filter << ", step " << h;
  }
}

// The motion of an unstable loop is that of its poles: with too high a gain for the period, and
// with too long a delay.
TEST_P(Sampled, UnstableLoopsGrowAsTheirPolesSay) {
  const SampledLoop loops[] = {{.kp = 900.0, .kd = 30.0},
                               {.kp = 3000.0, .kd = 140.0},
                               {.kp = 100.0, .ki = 20.0, .kd = 50.0, .delay = 0.07}};
  for (const SampledLoop& loop : loops) {
    const double growth = general_eigen(loop.matrix()).values.cwiseAbs().maxCoeff();
    EXPECT_GT(growth, 1.05);
    for (const double h : {0.05, 0.01, 0.035})
      EXPECT_LT(error_at_samples(loop, GetParam(), h, 1.05), 1e-10) << growth << ", step " << h;
  }
}

INSTANTIATE_TEST_SUITE_P(Coordinates, Sampled, ::testing::ValuesIn(both_coordinates));

// The closed form x_k = sum c_j z_j^k, of a loop without delay, whose poles differ.
TEST(SampledPoles, GiveTheMotion) {
  SampledLoop loop = stable_loops[1];
  const GeneralEigen e = general_eigen(loop.matrix().topLeftCorner(4, 4));
  const Eigen::VectorXcd c =
      e.vectors.partialPivLu().solve(loop.start().head(4).cast<std::complex<double>>());
  Simulation s(model_of(loop.text()), {.step = 0.05});
  for (int k = 1; k <= 40; ++k) {
    ASSERT_TRUE(s.step()) << s.failure();
    const Eigen::VectorXcd z = e.values.array().pow(k);
    EXPECT_NEAR(s.output("x"),
                (e.vectors.row(0).transpose().array() * c.array() * z.array()).sum().real(), 1e-10);
  }
}

// Damped steps of the generalised-alpha family, too, and steps that are asked for.
TEST(SampledSteps, OfAnySizeAndScheme) {
  const SampledLoop loop = stable_loops[4];
  const Model model = model_of(loop.text());
  VecX x = loop.start();
  for (int k = 0; k < 40; ++k) x = loop.next(x);
  for (const Coordinates c : both_coordinates) {
    SimulationOptions o{.coordinates = c};
    o.spectral_radius = 0.7;
    o.tolerance = 1e-12;
    Simulation s(model, o);
    for (int k = 0; s.time() < 2.0 - 1e-9; ++k)
      ASSERT_TRUE(s.step(std::min(k % 3 == 0 ? 0.0093 : 0.0317, 2.0 - s.time()))) << s.failure();
    EXPECT_NEAR(s.output("x"), x[0], 1e-9);
  }
}

/// u at the instants, from a run with steps that do not divide any period.
std::vector<double> values_at(const std::string& controllers, const std::vector<double>& times,
                              double h = 0.007) {
  Simulation s(model_of(sampled_box(controllers)), {.step = h});
  std::vector<double> out;
  for (const double t : times) {
    while (s.time() < t - 1e-9)
      if (!s.step(std::min(h, t - s.time()))) ADD_FAILURE() << s.failure();
    out.push_back(s.output("u"));
  }
  return out;
}

TEST(SampledValues, AreHeldFromTheirOffsetAndDelayOn) {
  const std::string ramp =
      "  b: {type: zero_order_hold, input: {polynomial: [0, 1]}, period: 0.1, ";
  const std::vector<double> times{0.0, 0.02, 0.031, 0.099, 0.13, 0.15, 0.31};
  const auto expect = [&](const std::string& keys, const std::vector<double>& expected) {
    const std::vector<double> found = values_at(ramp + keys + "}", times);
    for (std::size_t k = 0; k < times.size(); ++k)
      EXPECT_NEAR(found[k], expected[k], 1e-12) << keys << " at " << times[k];
  };
  expect("initial: 7", {0.0, 0.0, 0.0, 0.0, 0.1, 0.1, 0.3});
  expect("initial: 7, offset: 0.03", {7, 7, 0.03, 0.03, 0.13, 0.13, 0.23});
  expect("initial: 7, offset: 0.03, delay: 0.12", {7, 7, 7, 7, 7, 0.03, 0.13});
  expect("initial: 7, delay: 0.1", {7, 7, 7, 7, 0.0, 0.0, 0.2});
}

// `b` of the same instant reads what `a` has just computed, although it is written before it, also
// behind a formula; those of a ring read what is held, the first one first.
TEST(SampledValues, AreComputedInTheOrderOfTheirSignals) {
  const std::string a = "  a: {type: zero_order_hold, input: {polynomial: [1, 1]}, period: 0.1}\n";
  const std::vector<double> direct = values_at(
      "  b: {type: zero_order_hold, input: {controller: a}, period: 0.1}\n" + a, {0.0, 0.1, 0.25});
  const std::vector<double> behind = values_at(
      "  b: {type: zero_order_hold, input: {formula: '2 * controller(a)'}, period: 0.1}\n" + a,
      {0.0, 0.1, 0.25});
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(direct[k], 1.0 + 0.1 * k, 1e-12);
    EXPECT_NEAR(behind[k], 2.0 + 0.2 * k, 1e-12);
  }
  const std::vector<double> ring = values_at(
      "  b: {type: zero_order_hold, input: {polynomial: [1], controller: c}, period: 0.1}\n"
      "  c: {type: zero_order_hold, input: {controller: b}, period: 0.1}\n",
      {0.0, 0.1, 0.25});
  for (int k = 0; k < 3; ++k) EXPECT_EQ(ring[k], 1.0 + k);
}

// It counts its samples: at k times a period that is no binary number, without drift.
TEST(SampledValues, AreComputedOnceAtEachInstant) {
  Simulation s(model_of(sampled_box("  b: {type: state_space, inputs: 1, A: 1, B: 1, C: 1, D: 1, "
                                    "period: 0.0123}\n")),
               {.step = 0.1});
  for (int k = 1; k <= 2000; ++k) {
    ASSERT_TRUE(s.step());
    ASSERT_EQ(s.output("u"), 1.0 + std::floor(0.1 * k / 0.0123 + 1e-9)) << k;
  }
}

// PI control as a transfer function of z: kp + ki T z / (z - 1), and as a state space.
TEST(SampledValues, OfLinearBlocksAreThoseOfThePid) {
  SampledLoop loop{.kp = 60.0, .ki = 20.0};
  loop.kd = 0.0;
  const std::string in = "{length: motor, factor: -1}, period: 0.05, ";
  const Model models[] = {model_of(loop.text()),
                          model_of(sampled_box("  b: {type: transfer_function, input: " + in +
                                               "numerator: [61, -60], denominator: [1, -1]}\n")),
                          model_of(sampled_box("  b: {type: state_space, inputs: " + in +
                                               "A: 1, B: 1, C: 1, D: 61}\n"))};
  double ends[3];
  for (int k = 0; k < 3; ++k) {
    Simulation s(models[k], {.step = 0.02});
    while (s.time() < 0.5 - 1e-9) ASSERT_TRUE(s.step());
    ends[k] = s.output("x");
  }
  EXPECT_NEAR(ends[1], ends[0], 1e-12);
  EXPECT_NEAR(ends[2], ends[0], 1e-12);
}

// At its limit, the integral does not wind up.
TEST(SampledLimits, AreExactAndTheIntegralReturns) {
  const Model model = model_of(
      sampled_box("  b: {type: pid, measured: {length: motor}, target: 1, proportional: 60, "
                  "integral: 30, derivative: 20, upper: 3, period: 0.01}\n"));
  Simulation s(model, {});
  double largest = 0.0;
  while (s.time() < 8.0 - 1e-9) {
    ASSERT_TRUE(s.step()) << s.failure();
    EXPECT_LE(s.output("u"), 3.0);
    largest = std::max(largest, s.output("x"));
  }
  EXPECT_NEAR(s.output("x"), 1.0, 5e-3);
  EXPECT_LT(largest, 1.15);
}

Model sampled_machine() {
  std::string text = stepped_machine;
  text.insert(text.find("outputs:"), R"(
  motor: {type: joint_spring, joint: spin, actuator: {controller: a}}
  tow: {type: force, body: slider, at: c, direction: x, magnitude: {controller: b}}
controllers:
  a: {type: pid, measured: {length: motor}, target: 13, proportional: 3, integral: 4,
      derivative: 0.1, lower: -2, upper: 2, period: 0.005, delay: 0.0123}
  b: {type: zero_order_hold, period: 0.008, offset: 0.001,
      input: {formula: '10 * controller(a) + 0.1 * acceleration(slider, x) + push'}}
)");
  return model_of(text);
}

TEST(SampledSaved, GoOnWithEqualBits) {
  const Model model = sampled_machine();
  for (const Coordinates c : both_coordinates)
    for (const bool located : {false, true}) {
      SimulationOptions o{.coordinates = c};
      o.locate_edges = located;
      Simulation s(model, o);
      trace(s, 0, 60);
      const SimulationState saved = s.save();
      const std::vector<double> after = trace(s, 60, 120);
      s.restore(saved);
      EXPECT_TRUE(equal_bits(trace(s, 60, 120), after));
      Simulation other(model, o);
      other.restore(saved);
      EXPECT_TRUE(equal_bits(trace(other, 60, 120), after));
    }
}

TEST(SampledSaved, StepsDoNotAllocate) {
  const Model model = sampled_machine();
  for (const Coordinates c : both_coordinates) {
    Simulation s(model, {.coordinates = c});
    trace(s, 0, 20);
    const AllocationScope scope;
    for (int k = 0; k < 40; ++k) s.step();
    EXPECT_EQ(scope.count(), 0u);
  }
}

TEST(SampledStart, ValuesAreHeldByAnalysesAndSayIt) {
  const Model model = model_of(R"(
bodies: {arm: {rigid: {mass: 2, centre_of_mass: [0.3, 0, 0], inertia: [0.001, 0.06, 0.06]}}}
joints: {hinge: {type: revolute, child: arm, at: [0, 0, 0], axis: [0, -1, 0]}}
forces: {motor: {type: joint_spring, joint: hinge, spring: 80, actuator: {controller: hold}}}
controllers:
  hold: {type: pid, measured: {length: motor}, target: 0.2, proportional: 10, period: 0.01}
outputs: {q: {joint_position: hinge}, u: {controller: hold}}
simulation: {step: 0.001, duration: 0.3, start: equilibrium}
)");
  const char* const note =
      "sampled controller 'hold' is held at its value: what follows from the next samples is left "
      "out";
  const StaticsResult rest = statics(model);
  EXPECT_EQ(rest.forces[1].force, 10.0 * 0.2);  // at the design angle, 0
  EXPECT_EQ(rest.notes.back(), note);
  const double q = rest.forces[0].length;
  EXPECT_NEAR(80.0 * q + 2.0 * 9.81 * 0.3 * std::cos(q), 2.0, 1e-8);
  EXPECT_NEAR(Simulation(model, {}).output("u"), 10.0 * (0.2 - q), 1e-9);  // sampled there
  const LinearSystem linear = linear_system(model);
  EXPECT_EQ(linear.A.rows(), 2);
  EXPECT_EQ(linear.notes.back(), note);
  const std::vector<std::string> notes = linearize(model).start.notes;
  EXPECT_NE(std::find(notes.begin(), notes.end(), note), notes.end());
}

TEST(SampledErrors, APeriodOfAFiftiethOfAStep) {
  const Model model =
      model_of(sampled_box("  b: {type: zero_order_hold, input: 1, period: 1.0e-4}\n"));
  // With the place of the period, also by a check.
  EXPECT_TRUE(contains(error_of([&] { Simulation s(model, {}); }), "model.yaml:"));
  EXPECT_TRUE(contains(error_of([&] { check(model); }), "model.yaml:"));
  EXPECT_NO_THROW(Simulation(model, {.step = 1e-3}));
}

}  // namespace
}  // namespace floatframe::test
