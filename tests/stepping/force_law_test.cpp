// Forces that a program gives as functions: exact in every iteration, and what they throw.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "floatframe/core/thread_clock.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/start/statics.hpp"
#include "support/allocation_counter.hpp"
#include "support/coordinates.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

/// A ball above a contact, and a pendulum, each with a force to be filled in.
const std::string ball = R"(
points: {c: [0, 0, 0.5]}
bodies: {ball: {rigid: {mass: 1, centre_of_mass: c, inertia: [0.001, 0.001, 0.001]}}}
joints: {z: {type: prismatic, child: ball, at: c, axis: z}}
outputs: {z: {joint_position: z}, vz: {joint_velocity: z}}
)";
const std::string pendulum = R"(
points: {o: [0, 0, 0], c: [0.4, 0, 0], w: [1, 0, 1]}
bodies: {arm: {rigid: {mass: 2, centre_of_mass: c, inertia: [0.01, 0.02, 0.02]}}}
joints: {hinge: {type: revolute, child: arm, at: o, axis: y, position: 6.9}}
outputs: {q: {joint_position: hinge}, f: {force: f}, l: {length: f}}
)";
const std::string on_hinge = "forces: {f: {type: force_law, joint: hinge, law: f}}\n";
const std::string on_line =
    "forces: {f: {type: force_law, from: {body: ground, at: w}, to: {body: arm, at: c}, law: f}}\n";

Model with_law(const std::string& text, ForceFunction law) {
  ModelDescription d = description_of(text);
  std::get<ForceLaw>(d.forces.back().kind).law = std::move(law);
  return build_model(d);
}

/// A cubic spring about a turn on the hinge, and about 1 m on the line, with a damper.
double cubic(double x) { return 3.0 * x + 2.0 * x * x * x; }
ForceFunction law_about(double x0, bool slopes) {
  return [=](double x, double v, double) -> ForceLawValue {
    const double d = x - x0, force = cubic(d) + 0.7 * v;
    if (slopes) return {force, 3.0 + 6.0 * d * d, 0.7};
    return force;
  };
}
const ForceFunction with_slopes = law_about(6.0, true), without_slopes = law_about(6.0, false);

/// Outputs of 0.2 s.
std::vector<double> motion(const Model& model, Coordinates c, double step = 2e-3) {
  Simulation s(model, {.step = step, .coordinates = c});
  std::vector<double> all;
  for (int k = 0; k < std::lround(0.2 / step); ++k) {
    EXPECT_TRUE(s.step()) << s.failure();
    all.insert(all.end(), s.outputs().begin(), s.outputs().end());
  }
  return all;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    worst = std::max(worst, std::abs(a[k] - b[k]) / (1.0 + std::abs(a[k])));
  return worst;
}

double hertz(double z) { return z < -0.5 ? -1e7 * std::pow(-0.5 - z, 1.5) : 0.0; }
ForceLawValue hertz_law(double z, double, double) {
  return {hertz(z), z < -0.5 ? 1.5e7 * std::sqrt(-0.5 - z) : 0.0, 0.0};
}
const std::string on_z = "forces: {f: {type: force_law, joint: z, law: f}}\n";

/// Of the ball dropped from 0.5 m; it comes back to this height, z = 0.
double highest(const Model& model, Coordinates c, double step) {
  Simulation s(model, {.step = step, .coordinates = c});
  double top = -1.0;
  while (s.time() < 1.0 - 0.5 * step) {
    EXPECT_TRUE(s.step()) << s.failure();
    if (s.time() > 0.4) top = std::max(top, s.output("z"));
  }
  return top;
}

// At 1 ms to 0.0003 m, rounded: the integrator gives the same for a table.
TEST(ForceLaw, AHertzContactKeepsItsEnergy) {
  const Model slopes = with_law(ball + on_z, hertz_law);
  const Model differences =
      with_law(ball + on_z, [](double z, double, double) { return hertz(z); });
  const Model formula = model_of(ball + R"(
forces:
  f: {type: joint_spring, joint: z, actuator: {formula: '1e7 * max(0, -0.5 - angle(z))^1.5'}}
)");
  for (const Coordinates c : both_coordinates)
    for (const Model* model : {&slopes, &differences, &formula}) {
      EXPECT_NEAR(highest(*model, c, 1e-3), 0.0, 3.5e-4) << name_of(c);
      EXPECT_NEAR(highest(*model, c, 1e-4), 0.0, 5e-5) << name_of(c);
    }
}

TEST(ForceLaw, IsTheSpringOfItsPolynomial) {
  const std::string cubic_spring = "{polynomial: [0, 3, 0, 2], about: 6}, damper: 0.7}\n";
  const std::string spring =
      "forces:\n  f: {type: joint_spring, joint: hinge, spring: " + cubic_spring;
  const std::string line =
      "forces:\n  f: {type: spring_damper, from: {body: ground, at: w}, to: {body: arm, at: c}, "
      "spring: " +
      cubic_spring;
  for (const auto& [law, table] : {std::pair(on_hinge, spring), std::pair(on_line, line)})
    for (const Coordinates c : both_coordinates) {
      const std::vector<double> expected = motion(model_of(pendulum + table), c);
      EXPECT_LT(distance(motion(with_law(pendulum + law, with_slopes), c), expected), 1e-12);
      EXPECT_LT(distance(motion(with_law(pendulum + law, without_slopes), c), expected), 1e-9);
    }
}

// The difference is the error of the steps, of second order.
TEST(ForceLaw, BothFormulationsMakeOneMotion) {
  for (const auto& [law, x0] : {std::pair(on_hinge, 6.0), std::pair(on_line, 1.0)}) {
    const Model model = with_law(pendulum + law, law_about(x0, true));
    const auto difference = [&](double step) {
      return distance(motion(model, Coordinates::relative, step),
                      motion(model, Coordinates::absolute, step));
    };
    const double long_steps = difference(2e-3), short_steps = difference(5e-4);
    EXPECT_LT(long_steps, 1e-3);
    EXPECT_LT(short_steps, 0.08 * long_steps + 1e-10);
  }
}

TEST(ForceLaw, LinearSystemsAndStaticsAreExact) {
  const std::string level = pendulum + "gravity: [0, 0, -9.81]\n";
  const std::string spring = R"(
forces:
  f: {type: joint_spring, joint: hinge, spring: {polynomial: [0, 3, 0, 2], about: 6}, damper: 0.7}
)";
  const Model law = with_law(level + on_hinge, with_slopes), table = model_of(level + spring);
  for (const Coordinates c : both_coordinates) {
    const MatX A = linear_system(table, {.coordinates = c}).A;
    EXPECT_LT((linear_system(law, {.coordinates = c}).A - A).cwiseAbs().maxCoeff(),
              1e-9 * A.cwiseAbs().maxCoeff());
  }
  const StaticsResult a = statics(law), b = statics(table);
  EXPECT_NEAR(a.forces[0].force, b.forces[0].force, 1e-9 * (1.0 + std::abs(b.forces[0].force)));
  EXPECT_NEAR(a.forces[0].length, b.forces[0].length, 1e-9);
}

TEST(ForceLaw, WhatItThrowsEndsTheStepAndNotTheSimulation) {
  for (const Coordinates c : both_coordinates) {
    bool broken = false;
    long calls = 0;
    const Model model = with_law(pendulum + on_hinge, [&](double x, double v, double) {
      ++calls;
      if (broken) throw std::range_error("the spring broke");
      return cubic(x) + 0.7 * v;
    });
    Simulation s(model, {.step = 2e-3, .coordinates = c});
    for (int k = 0; k < 20; ++k) ASSERT_TRUE(s.step());
    const SimulationState saved = s.save();
    const std::vector<double> before(s.outputs().begin(), s.outputs().end());
    broken = true;
    calls = 0;
    const StepReport r = s.step();
    EXPECT_EQ(calls, 1);  // no smaller parts
    EXPECT_EQ(r.status, StepStatus::law_failed) << step_status_name(r.status);
    EXPECT_EQ(r.where, "force 'f'");
    EXPECT_NEAR(r.time, 0.04, 1e-12);
    EXPECT_EQ(s.failure(), "the law of 'f' threw an exception at t = 0.04 s: the spring broke");
    EXPECT_THROW(std::rethrow_exception(s.thrown()), std::range_error);
    EXPECT_EQ(std::vector<double>(s.outputs().begin(), s.outputs().end()), before);
    EXPECT_EQ(s.step().status, StepStatus::failed_before);
    broken = false;
    s.restore(saved);
    for (int k = 0; k < 20; ++k) {
      ASSERT_TRUE(s.step());
    }
    Simulation whole(model, {.step = 2e-3, .coordinates = c});
    for (int k = 0; k < 40; ++k) ASSERT_TRUE(whole.step());
    EXPECT_EQ(s.output("q"), whole.output("q"));
    broken = true;
    EXPECT_EQ(error_of([&] { Simulation(model, {.coordinates = c}); }), "step_failed");
    EXPECT_EQ(error_of([&] { statics(model); }), "step_failed");
    EXPECT_EQ(error_of([&] { linear_system(model, {.coordinates = c}); }), "step_failed");
  }
}

// Thrown in the second part of a step that a corner divides: the whole step is undone.
TEST(ForceLaw, WhatItThrowsUndoesTheStep) {
  const std::string text = pendulum + R"(
forces:
  push: {type: torque, body: arm, direction: y, magnitude: {table: [[0.021, 0], [0.021, 1]]}}
  f: {type: force_law, joint: hinge, law: f}
)";
  for (const Coordinates c : both_coordinates) {
    const Model model = with_law(text, [](double x, double v, double t) {
      if (t > 0.0212) throw std::range_error("too late");
      return cubic(x) + 0.7 * v;
    });
    Simulation s(model, {.step = 2e-3, .coordinates = c});
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(s.step()) << s.failure();
    const std::vector<double> before(s.outputs().begin(), s.outputs().end());
    EXPECT_EQ(s.step().status, StepStatus::law_failed);
    EXPECT_EQ(s.time(), 0.02);
    EXPECT_EQ(std::vector<double>(s.outputs().begin(), s.outputs().end()), before);
  }
}

// Thrown by the evaluation of the outputs of a step that was made.
TEST(ForceLaw, WhatItThrowsInASampleUndoesTheStep) {
  for (const Coordinates c : both_coordinates) {
    long calls = 0, most = -1;
    const Model model = with_law(pendulum + on_hinge, [&](double x, double v, double) {
      if (most >= 0 && ++calls > most) throw std::range_error("late");
      return cubic(x) + 0.7 * v;
    });
    Simulation s(model, {.step = 2e-3, .coordinates = c});
    for (int k = 0; k < 20; ++k) ASSERT_TRUE(s.step()) << s.failure();
    const SimulationState saved = s.save();
    const std::vector<double> before(s.outputs().begin(), s.outputs().end());
    most = 1000;
    ASSERT_TRUE(s.step());
    const long last = calls - 1;  // the sample is the last call
    s.restore(saved);
    calls = 0;
    most = last;
    EXPECT_EQ(s.step().status, StepStatus::law_failed);
    EXPECT_NEAR(s.time(), 0.04, 1e-12);
    EXPECT_EQ(std::vector<double>(s.outputs().begin(), s.outputs().end()), before);
    EXPECT_NEAR(s.state().time, 0.04, 1e-12);
  }
}

TEST(ForceLaw, WhatItThrowsEndsTheRun) {
  const Model model = with_law(pendulum + on_hinge, [](double x, double, double t) {
    if (t > 0.1) throw 7;
    return cubic(x);
  });
  SimulationDescription o = model.simulation;
  o.step = 1e-2;
  o.duration = 1.0;
  const RunResult r = run(model, o);
  EXPECT_EQ(r.summary.status, "failed");
  EXPECT_EQ(r.summary.message.rfind("the law of 'f' threw an exception at t = 0.1 s: of an", 0), 0u)
      << r.summary.message;
  EXPECT_THROW(std::rethrow_exception(r.thrown), int);
  EXPECT_EQ(r.table.rows(), 11u);
}

// The step is repeated in smaller parts up to where the law ends.
TEST(ForceLaw, AForceThatIsNoNumberIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Model model = with_law(
      pendulum + on_hinge, [=](double x, double, double t) { return t > 0.0505 ? nan : cubic(x); });
  Simulation s(model, {.step = 1e-2});
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(s.step());
  const StepReport r = s.step();
  EXPECT_EQ(r.status, StepStatus::not_finite);
  EXPECT_EQ(r.where, "force 'f'");
  EXPECT_NEAR(r.time, 0.0505, 2e-5);
  EXPECT_NE(s.failure().find("'f'"), std::string::npos) << s.failure();
  const auto expect_refused = [](ForceLawValue y, ErrorCode code) {
    const Model bad = with_law(pendulum + on_hinge, [=](double, double, double) { return y; });
    try {
      Simulation start(bad);
      ADD_FAILURE() << "it starts";
    } catch (const RunError& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_NE(std::string(error.what()).find("'f'"), std::string::npos) << error.what();
    }
  };
  expect_refused(nan, ErrorCode::not_finite);
  expect_refused({1.0, nan, 0.0}, ErrorCode::step_failed);
}

// Steps that may not iterate enough at the contact: the law sees times that they do not reach.
TEST(ForceLaw, IsCalledInStepsThatAreRepeated) {
  long calls = 0;
  double latest = 0.0;
  bool ahead = false;  // called again for an earlier time
  const Model model = with_law(ball + on_z, [&](double z, double v, double t) {
    ++calls;
    ahead = ahead || t < latest;
    latest = std::max(latest, t);
    return hertz_law(z, v, t);
  });
  Simulation s(model, {.step = 1e-2, .max_iterations = 4});
  while (s.time() < 0.5) ASSERT_TRUE(s.step()) << s.failure();
  EXPECT_GT(s.counters().substeps, 0);
  EXPECT_TRUE(ahead);
  EXPECT_GT(calls, s.counters().iterations);
}

TEST(ForceLaw, ItsWorkIsInTheBalanceOfEnergy) {
  const Model model = with_law(pendulum + on_line, [](double x, double v, double t) {
    return 40.0 * (x - 0.5) - 3.0 * v + 10.0 * std::sin(20.0 * t);  // feeds energy
  });
  SimulationDescription o = model.simulation;
  o.step = 1e-3;
  o.duration = 2.0;
  const RunSummary s = run(model, o).summary;
  EXPECT_EQ(s.status, "completed") << s.message;
  for (const RangeWarning& w : s.warnings) ADD_FAILURE() << w.sentence;
  EXPECT_GT(s.energy.work[EnergyFlow::actuators], 1.0);
  EXPECT_LT(std::abs(s.energy.largest_remainder), 1e-4 * s.energy.exchanged);
}

TEST(ForceLaw, SimulationsInThreadsMakeTheSameSteps) {
  const Model model = with_law(pendulum + on_line, without_slopes);
  const std::vector<double> expected = motion(model, Coordinates::relative);
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (std::vector<double>& f : found)
    threads.emplace_back([&] { f = motion(model, Coordinates::relative); });
  for (std::thread& t : threads) t.join();
  for (const std::vector<double>& f : found) EXPECT_EQ(f, expected);
}

TEST(ForceLaw, StepsDoNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  for (const std::string& law : {on_hinge, on_line}) {
    Simulation s(with_law(pendulum + law, without_slopes), {.step = 1e-3});
    s.step();
    const AllocationScope scope;
    for (int k = 0; k < 50; ++k) s.step();
    EXPECT_EQ(scope.count(), 0u);
  }
}

TEST(ForceLaw, AModelFileHasNoFunction) {
  for (const char* law : {"law: f}}\n", "law: {table: [[0, 0], [1, 1]]}}}\n"}) {
    const std::string text = ball + "forces: {f: {type: force_law, joint: z, " + law;
    const std::string error = error_of([&] { model_of(text); });
    EXPECT_TRUE(error.ends_with(".yaml:7:46: forces.f.law: unsupported")) << error;
  }
}

// docs/stepping.md
TEST(ForceLaw, PriceOfALaw) {
  long calls = 0;
  std::string table = "forces: {f: {type: joint_spring, joint: z, spring: {table: [";
  for (int k = 480; k >= 0; --k) {
    const double z = -0.5 - (k > 0 ? 1e-6 * std::pow(1.02, k) : 0.0);
    table += fmt::format("[{:.17g}, {:.17g}], ", z, hertz(z));
  }
  const auto counted = [&](auto law) {
    return ForceFunction([&calls, law](double z, double v, double t) -> ForceLawValue {
      ++calls;
      return law(z, v, t);
    });
  };
  const auto alone = [](double z, double, double) { return hertz(z); };
  const std::pair<const char*, Model> cases[] = {
      {"table", model_of(ball + table + "[1, 0]]}}}\n")},
      {"force_law, slopes", with_law(ball + on_z, counted(hertz_law))},
      {"force_law, F alone", with_law(ball + on_z, counted(alone))},
      {"sampled force",
       model_of(ball + "inputs: {F: {}}\nforces: {f: {type: force, body: ball, direction: z, "
                       "magnitude: {input: F}}}\n")}};
  for (const auto& [name, model] : cases) {
    double best = 1e9;
    for (int round = 0; round < 15; ++round) {
      Simulation s(model, {.step = 1e-3});
      if (!model.inputs.empty())
        s.on_force([&](double, std::span<const double> outputs, std::span<double> inputs) {
          ++calls;
          inputs[0] = -hertz(outputs[0]);
        });
      calls = 0;
      const Nanoseconds begin = thread_cpu_clock();
      for (int k = 0; k < 1000; ++k) ASSERT_TRUE(s.step());
      best = std::min(best, 1e-6 * static_cast<double>(thread_cpu_clock() - begin));
    }
    std::printf("%-18s %5.2f us, %5.2f calls per step\n", name, best,
                1e-3 * static_cast<double>(calls));
  }
}

// A saved state belongs to the function, or to its label.
TEST(ForceLaw, StatesKnowTheFunction) {
  const ForceFunction law = law_about(6.0, false);
  const Model one = with_law(pendulum + on_hinge, law);
  Simulation s(one), same(with_law(pendulum + on_hinge, law)),
      other(with_law(pendulum + on_hinge, law_about(6.0, false)));
  s.step();
  same.restore(s.save());
  EXPECT_EQ(error_of([&] { other.restore(s.save()); }), "mismatch");
  const auto labelled = [](const char* label) {
    return model_hash(with_law(pendulum + on_hinge, {without_slopes, label}));
  };
  EXPECT_EQ(labelled("cubic 1"), labelled("cubic 1"));
  EXPECT_NE(labelled("cubic 1"), labelled("cubic 2"));
}

}  // namespace
}  // namespace floatframe::test
