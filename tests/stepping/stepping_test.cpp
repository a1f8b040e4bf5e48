// A simulation makes the steps of a run, bit for bit, and goes on from what it has saved with equal
// bits: in the same object, in another one, through bytes in another process.
#include "floatframe/stepping/stepping.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/stepping_models.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

struct Kind {
  Coordinates coordinates;
  InertiaMethod inertia;
  bool substeps;
};

class Stepping : public ::testing::TestWithParam<Kind> {
 protected:
  static const Model& model() {
    static const Model m = model_of(stepped_machine);
    return m;
  }
  /// With `substeps` few iterations are allowed, so that steps are divided.
  static SimulationOptions options() {
    SimulationOptions o{.coordinates = GetParam().coordinates, .inertia = GetParam().inertia};
    if (GetParam().substeps) {
      o.max_iterations = 2;
      o.tolerance = 1e-11;
    }
    return o;
  }
};

TEST_P(Stepping, StepsAreThoseOfARun) {
  Simulation s(model(), options());
  const RunResult r = completed_run(model(), s.options());
  const std::size_t width = r.table.columns.size();
  ASSERT_EQ(r.table.rows(), 201u);
  for (std::size_t k = 0; k < r.table.rows(); ++k) {
    if (k > 0) {
      ASSERT_TRUE(s.step()) << s.failure();
    }
    std::vector<double> mine{s.time()};
    mine.insert(mine.end(), s.outputs().begin(), s.outputs().end());
    const auto row = r.table.data.begin() + static_cast<std::ptrdiff_t>(k * width);
    ASSERT_TRUE(equal_bits(mine, {row, row + static_cast<std::ptrdiff_t>(width)})) << "step " << k;
  }
  const StepCounters c = s.counters();
  EXPECT_EQ(c.steps, r.summary.steps);
  EXPECT_EQ(c.substeps, r.summary.substeps);
  EXPECT_EQ(c.iterations, r.summary.iterations);
  EXPECT_EQ(c.factorizations, r.summary.factorizations);
  EXPECT_EQ(c.max_position_violation, r.summary.max_position_violation);
  if (GetParam().substeps) {
    EXPECT_GT(c.substeps, 0);
  }
  EXPECT_GT(std::abs(s.output("drive")), 10.0) << "turns are counted";
  EXPECT_EQ(s.output("spin"), s.output(0));
}

TEST_P(Stepping, StatesGoOnWithEqualBits) {
  Simulation s(model(), options());
  trace(s, 0, 60);
  const SimulationState saved = s.save();
  EXPECT_EQ(saved.time(), s.time());
  const std::vector<double> first = trace(s, 60, 120);
  const SystemState end = s.state();

  s.restore(saved);
  EXPECT_EQ(saved.time(), s.time());
  EXPECT_TRUE(equal_bits(trace(s, 60, 120), first)) << "the same object";
  EXPECT_EQ(s.state().joints[1].position, end.joints[1].position);

  const std::vector<std::byte> bytes = saved.to_bytes();
  Simulation fresh(model(), options());
  fresh.restore(SimulationState::from_bytes(bytes));
  EXPECT_EQ(fresh.save().to_bytes(), bytes);
  EXPECT_TRUE(equal_bits(trace(fresh, 60, 120), first)) << "a fresh object";

  Simulation used(model(), options());
  used.step(0.0011);  // another size, another history
  trace(used, 7, 33);
  used.restore(saved);
  used.state();  // looking changes nothing
  EXPECT_TRUE(equal_bits(trace(used, 60, 120), first)) << "an object with another history";
}

TEST_P(Stepping, StepsOfAnotherSizeAreAPartOfTheState) {
  Simulation s(model(), options());
  ASSERT_TRUE(s.step(0.0007));
  EXPECT_EQ(s.time(), 0.0007);
  ASSERT_TRUE(s.step());
  EXPECT_EQ(s.time(), 0.0007 + 0.002);
  const SimulationState saved = s.save();
  const std::vector<double> first = trace(s, 0, 20);
  Simulation fresh(model(), options());
  fresh.restore(saved);
  EXPECT_TRUE(equal_bits(trace(fresh, 0, 20), first));
}

TEST_P(Stepping, ContinuesAfterAFailedStep) {
  Simulation s(model(), options());
  trace(s, 0, 10);
  const SimulationState saved = s.save();
  const std::vector<double> first = trace(s, 10, 30);
  s.restore(saved);
  s.set_input("shove", 1.7e308);
  double before = s.time();
  StepReport r = s.step();
  for (int k = 0; k < 3 && r; ++k) {  // what is free and linear takes one such step
    before = s.time();
    r = s.step();
  }
  EXPECT_FALSE(r);
  EXPECT_FALSE(r.where.empty()) << step_status_name(r.status);
  EXPECT_EQ(s.time(), before);
  const std::string why = s.failure();
  EXPECT_TRUE(contains(why, "step failed at t = 0.0"));
  EXPECT_EQ(s.failure(), why);
  EXPECT_EQ(s.step().status, StepStatus::failed_before);
  EXPECT_EQ(s.step(1e-3).status, StepStatus::failed_before);
  EXPECT_EQ(s.step().where, r.where);
  EXPECT_EQ(s.failure(), why);
  EXPECT_EQ(error_of([&] { s.save(); }).substr(0, 38), "step_failed");
  s.restore(saved);
  EXPECT_EQ(s.failure(), "");
  EXPECT_TRUE(equal_bits(trace(s, 10, 30), first));
}

TEST_P(Stepping, NoStepAllocates) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  Simulation s(model(), options());
  s.on_force([](double t, std::span<const double> y, std::span<double> u) {
    u[0] = 30.0 * std::sin(9.0 * t) - 0.1 * y[0];
  });
  bool good = true;
  const AllocationScope scope;
  for (int k = 0; k < 100; ++k) {
    s.set_input(1, 0.01 * k);
    good = s.step() && good;
  }
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_TRUE(good) << s.failure();
  const AllocationScope failing;
  s.set_input("shove", 1.7e308);
  for (int k = 0; k < 3 && good; ++k) good = static_cast<bool>(s.step());
  EXPECT_EQ(failing.count(), 0u) << "a step that fails";
  EXPECT_FALSE(good);
}

TEST_P(Stepping, ForcesOfACallbackAreInputsBeforeEachStep) {
  Simulation s(model(), options()), called(model(), options());
  const auto push = [](double t, double spin) { return 20.0 * std::sin(50.0 * t) - 0.2 * spin; };
  int calls = 0;
  called.on_force([&](double t, std::span<const double> y, std::span<double> u) {
    ++calls;
    u[0] = push(t, y[0]);
    u[1] = 7.0;  // clamped to 1
  });
  for (int k = 0; k < 50; ++k) {
    s.set_input("push", push(s.time(), s.output("spin")));
    s.set_input("aim", 1.0);
    ASSERT_TRUE(s.step());
    ASSERT_TRUE(called.step());
    ASSERT_EQ(called.inputs()[1], 1.0);
    ASSERT_TRUE(equal_bits({s.outputs().begin(), s.outputs().end()},
                           {called.outputs().begin(), called.outputs().end()}))
        << "step " << k;
  }
  EXPECT_EQ(calls, 50) << "once for a step, whatever its substeps";
  called.on_force(nullptr);
  ASSERT_TRUE(called.step());
  EXPECT_EQ(calls, 50);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Stepping,
    ::testing::Values(Kind{Coordinates::relative, InertiaMethod::preprocessing, false},
                      Kind{Coordinates::relative, InertiaMethod::projection, true},
                      Kind{Coordinates::absolute, InertiaMethod::preprocessing, true},
                      Kind{Coordinates::absolute, InertiaMethod::projection, false}),
    [](const auto& x) {
      return std::string(x.param.coordinates == Coordinates::relative ? "relative" : "absolute") +
             (x.param.substeps ? "_substeps" : "");
    });

TEST(SteppingStart, FromAStateOfTheOtherFormulation) {
  const Model m = model_of(stepped_machine);
  SimulationOptions o;
  Simulation a(m, o);
  trace(a, 0, 50);
  o.coordinates = Coordinates::absolute;
  o.state = std::make_shared<const SystemState>(a.state());
  Simulation b(m, o);
  EXPECT_NEAR(b.time(), 0.1, 1e-12);
  for (std::size_t k = 0; k < a.outputs().size(); ++k)
    // But for a force and an acceleration, whose inputs are not the same.
    if (a.output_names()[k] != "coil" && a.output_names()[k] != "tip") {
      EXPECT_NEAR(a.outputs()[k], b.outputs()[k], 1e-6 * (1.0 + std::abs(a.outputs()[k])))
          << a.output_names()[k];
    }
}

TEST(SteppingStart, ReportsWhatBecameOfTheStart) {
  const Model m = model_of(
      "bodies: {arm: {rigid: {mass: 1, centre_of_mass: [1, 0, 0], inertia: [1, 1, 1]}}}\n"
      "joints:\n"
      "  one: {type: revolute, child: arm, at: [0, 0, 0], axis: y}\n"
      "  two: {type: revolute, child: arm, at: [0, 1, 0], axis: y}\n");
  Simulation s(m);
  EXPECT_EQ(s.start_report().redundant.size(), 5u);
  EXPECT_EQ(s.start_report().notes.size(), 1u);
  EXPECT_EQ(s.time(), 0.0);
  EXPECT_TRUE(s.step());
}

/// The second half of the next test, in a process of its own: numbers written by one and read by
/// the other.
TEST(SteppingProcess, DISABLED_Continues) {
  const char* folder = std::getenv("FLOATFRAME_STEPPING");
  ASSERT_NE(folder, nullptr);
  for (const Coordinates c : both_coordinates) {
    const std::string name =
        std::string(folder) + (c == Coordinates::relative ? "/relative" : "/absolute");
    std::ifstream in(name + ".state", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    const SimulationOptions o{.coordinates = c, .tolerance = 1e-11, .max_iterations = 2};
    Simulation s(model_of(stepped_machine), o);
    s.restore(SimulationState::from_bytes({data, text.size()}));
    const std::vector<double> numbers = trace(s, 40, 90);
    std::ofstream(name + ".trace", std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers.data()),
               static_cast<std::streamsize>(numbers.size() * sizeof(double)));
  }
}

TEST(SteppingProcess, AnotherProcessContinuesWithEqualBits) {
  const TemporaryFolder folder;
  std::vector<std::string> expected;
  long substeps = 0;
  for (const Coordinates c : both_coordinates) {
    const SimulationOptions o{.coordinates = c, .tolerance = 1e-11, .max_iterations = 2};
    Simulation s(model_of(stepped_machine), o);
    trace(s, 0, 40);
    const std::vector<std::byte> bytes = s.save().to_bytes();
    folder.write(c == Coordinates::relative ? "relative.state" : "absolute.state",
                 std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    const std::vector<double> numbers = trace(s, 40, 90);
    substeps += s.counters().substeps;
    expected.emplace_back(reinterpret_cast<const char*>(numbers.data()),
                          numbers.size() * sizeof(double));
  }
  EXPECT_GT(substeps, 0);
  char program[4096] = {};
  ASSERT_GT(readlink("/proc/self/exe", program, sizeof(program) - 1), 0);
  const std::string command =
      "FLOATFRAME_STEPPING='" + folder.path().string() + "' '" + program +
      "' --gtest_also_run_disabled_tests --gtest_filter=SteppingProcess.DISABLED_Continues "
      "> /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  for (std::size_t k = 0; k < 2; ++k) {
    std::ifstream in(folder.file(k == 0 ? "relative.trace" : "absolute.trace"), std::ios::binary);
    const std::string found{std::istreambuf_iterator<char>(in), {}};
    EXPECT_TRUE(found == expected[k]) << (k == 0 ? "relative" : "absolute");
  }
}

}  // namespace
}  // namespace floatframe::test
