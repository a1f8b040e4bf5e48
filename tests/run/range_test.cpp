// Runs that leave the range of the method say so, in both formulations; the examples do not; and
// the watch neither changes a run nor allocates while it goes.
#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run_watch.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "support/allocation_counter.hpp"
#include "support/figures.hpp"

namespace floatframe::test {
namespace {

#define RANGE(name) FLOATFRAME_TEST_DATA "/range/" name ".yaml"
#define EXAMPLE(name) FLOATFRAME_EXAMPLES "/" name "/" name ".yaml"

RunSummary summary_of(const ModelDescription& d, Coordinates coordinates) {
  const SimulationDescription s = with(d.simulation, coordinates);
  return run(build_model(d), s).summary;
}

RunSummary summary_of(const char* file, const std::vector<ParameterOverride>& set,
                      Coordinates coordinates) {
  return summary_of(read_model(file, set), coordinates);
}

/// The one warning with these words; "" and a failure if there is none.
std::string warning(const RunSummary& s, const std::string& words) {
  for (const RangeWarning& w : s.warnings)
    if (w.sentence.find(words) != std::string::npos) return w.sentence;
  ADD_FAILURE() << "no warning '" << words << "' among " << s.warnings.size();
  return "";
}
bool says(const std::string& sentence, const std::string& part) {
  return sentence.find(part) != std::string::npos;
}

TEST(Range, BeamBentBeyondItsLength) {
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = summary_of(RANGE("cantilever"), {}, c);
    EXPECT_EQ(s.status, "completed");
    const std::string far = warning(s, "deforms too far");
    EXPECT_TRUE(says(far, "body 'beam'")) << far;
    EXPECT_TRUE(says(far, "node 'tip' is displaced by 7.")) << far;
    EXPECT_TRUE(says(far, "more than 10 % of its size of 1 m")) << far;
    EXPECT_TRUE(says(warning(s, "bends too far"), "0.2 rad"));
    EXPECT_EQ(s.warnings.size(), 2u);
  }
}

// Up to a tenth of its length nothing is said: linear and exact deflection differ by 1 %.
TEST(Range, BeamBentALittle) {
  for (const Coordinates c : both_coordinates)
    EXPECT_TRUE(summary_of(RANGE("cantilever"), {{"load", "3.5"}}, c).warnings.empty());
  EXPECT_FALSE(
      summary_of(RANGE("cantilever"), {{"load", "6"}}, Coordinates::relative).warnings.empty());
}

TEST(Range, PendulumWithAStepOfHalfASecond) {
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = summary_of(RANGE("pendulum"), {}, c);
    EXPECT_TRUE(says(warning(s, "turns too far in one step of 0.5 s"), "body 'bob'"));
    EXPECT_TRUE(says(warning(s, "is too long for"), "steps per period"));
    EXPECT_TRUE(says(warning(s, "energy balance does not close"), "J exchanged (limit 5 %)"));
  }
}

// What a study needs to say each only once.
TEST(Range, WarningsAreOfKinds) {
  std::set<RangeLimit> limits;
  std::size_t count = 0;
  for (const char* file : {RANGE("cantilever"), RANGE("pendulum")})
    for (const RangeWarning& w : summary_of(file, {}, Coordinates::relative).warnings) {
      limits.insert(w.limit);
      ++count;
    }
  EXPECT_GE(count, 4u);
  EXPECT_EQ(limits.size(), count);
  for (const RangeLimit limit : {RangeLimit::displacement, RangeLimit::rotation, RangeLimit::turn})
    EXPECT_TRUE(limits.contains(limit));
  const auto bent = [](const char* load, Coordinates coordinates) {
    for (const RangeWarning& w :
         summary_of(RANGE("cantilever"), {{"load", load}}, coordinates).warnings)
      if (says(w.sentence, "bends too far")) return w.limit;
    return RangeLimit::balance;
  };
  EXPECT_EQ(bent("385", Coordinates::relative), RangeLimit::rotation);
  EXPECT_EQ(bent("200", Coordinates::absolute), RangeLimit::rotation);
}

TEST(Range, PendulumWithAStepThatResolvesIt) {
  for (const Coordinates c : both_coordinates)
    EXPECT_TRUE(summary_of(RANGE("pendulum"), {{"step", "0.02"}}, c).warnings.empty());
}

TEST(Range, BeamThatSpinsNearItsLowestFrequency) {
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = summary_of(RANGE("spinning_beam"), {}, c);
    const std::string w = warning(s, "spins too fast");
    EXPECT_TRUE(says(w, "lowest frequency of 31")) << w;
    EXPECT_TRUE(says(w, "at 25 rad/s")) << w;
    EXPECT_EQ(s.warnings.size(), 1u);
    // Beyond it the deflection grows without bound: that is said too.
    const RunSummary beyond = summary_of(RANGE("spinning_beam"), {{"rate", "35"}}, c);
    warning(beyond, "spins too fast");
    warning(beyond, "deforms too far");
    EXPECT_TRUE(summary_of(RANGE("spinning_beam"), {{"rate", "8"}}, c).warnings.empty());
  }
}

// Turning about its own long axis pulls at no bar: the same rate, no warning.
TEST(Range, ShaftThatTurnsAboutItsOwnAxis) {
  ModelDescription d = read_model(RANGE("spinning_beam"));
  d.joints[0].axis = Vec3::UnitX();
  d.amplitudes.clear();
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = summary_of(d, c);
    EXPECT_TRUE(s.warnings.empty()) << s.warnings.front().sentence;
  }
}

// A spring of 25 Hz with 4.0 steps to a period; the trapezoidal rule keeps its energy whatever the
// step.
TEST(Range, OscillationThatTheStepDoesNotResolve) {
  ModelDescription d = read_model(RANGE("springs"), {{"step", "0.01"}});
  std::erase_if(d.forces, [](const ElementDescription& f) { return f.name != "strut"; });
  auto& strut = std::get<SpringDamper>(d.forces.at(0).kind);
  strut.spring = PiecewisePolynomial::polynomial({-0.9 * 74000.0, 74000.0});
  strut.damper = {};
  strut.actuator.reset();
  d.joints[1].velocity = {0.0};
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = summary_of(d, c);
    const std::string w = warning(s, "is too long for the motion of body 'mass'");
    EXPECT_TRUE(says(w, "steps per period")) << w;
    EXPECT_LT(std::abs(s.energy.remainder), 0.05 * s.energy.exchanged);
  }
  d.simulation.step = 0.002;
  EXPECT_TRUE(summary_of(d, Coordinates::relative).warnings.empty());
}

TEST(Range, NumericalDampingThatTakesTheVibrationAway) {
  ModelDescription d = read_model(EXAMPLE("flexible_pendulum"));
  d.gravity.setZero();
  d.simulation.step = 0.02;
  d.simulation.spectral_radius = 0.2;
  for (const Coordinates c : both_coordinates)
    EXPECT_TRUE(says(warning(summary_of(d, c), "numerical damping"), "spectral radius 0.2"));
}

TEST(Range, ExamplesPrintNothing) {
  for (const char* file : {EXAMPLE("flexible_pendulum"), EXAMPLE("slider_crank"),
                           EXAMPLE("active_damper"), EXAMPLE("iltis")})
    for (const Coordinates c : both_coordinates) {
      const RunSummary s = summary_of(file, {}, c);
      EXPECT_EQ(s.status, "completed");
      EXPECT_TRUE(s.energy.balanced);
      EXPECT_TRUE(s.warnings.empty()) << file << ": " << s.warnings.front().sentence;
    }
}

// A vehicle that rolls on a flat road from its equilibrium: nothing moves but by the tolerances of
// the solver, and nothing is said of these.
TEST(Range, NoiseIsNoMotion) {
  for (const char* speed : {"0", "5"})
    for (const Coordinates c : both_coordinates) {
      const RunSummary s = summary_of(EXAMPLE("iltis"),
                                      {{"road", "flat"},
                                       {"speed", speed},
                                       {"step", "0.002"},
                                       {"spectral_radius", "1"},
                                       {"duration", "1"}},
                                      c);
      EXPECT_TRUE(s.warnings.empty()) << s.warnings.front().sentence;
    }
}

TEST(Range, NothingHasMass) {
  for (const Coordinates c : both_coordinates) {
    const RunSummary s = summary_of(RANGE("massless"), {}, c);
    EXPECT_EQ(s.status, "completed");
    EXPECT_TRUE(s.warnings.empty()) << s.warnings.front().sentence;
  }
}

TEST(Range, StepLongerThanTheDuration) {
  ModelDescription d = read_model(RANGE("pendulum"));
  const Model model = build_model(d);
  for (const double step : {1e300, 25.0}) {
    d.simulation.step = step;
    EXPECT_TRUE(test::contains(test::sentences_of([&] { run(model, d.simulation); }),
                               "is longer than the duration of 20 s"));
  }
  d.simulation.step = d.simulation.duration;
  EXPECT_EQ(run(model, d.simulation).summary.steps, 1);
}

TEST(Range, TheWatchLeavesRunsAsTheyAre) {
  for (const char* file : {RANGE("driven_arm"), RANGE("springs"), EXAMPLE("iltis")})
    for (const Coordinates c : both_coordinates) {
      ModelDescription d = read_model(file);
      d.simulation.coordinates = c;
      d.simulation.duration = 0.5;
      const Model model = build_model(d);
      RunOptions without;
      without.watch = false;
      const RunResult a = run(model, d.simulation), b = run(model, d.simulation, without);
      ASSERT_EQ(a.table.data.size(), b.table.data.size());
      EXPECT_EQ(std::memcmp(a.table.data.data(), b.table.data.data(),
                            a.table.data.size() * sizeof(double)),
                0)
          << file;
      EXPECT_EQ(a.summary.iterations, b.summary.iterations);
      EXPECT_FALSE(b.summary.energy.balanced);
      EXPECT_TRUE(b.summary.warnings.empty());
    }
}

std::size_t allocations(const Model& model, Coordinates coordinates) {
  const SimulationDescription d = with(model.simulation, coordinates);
  Stepper steps(model, d);
  RunWatch watch(steps.formulation(), d.step, 10);
  EXPECT_TRUE(steps.advance());
  const AllocationScope scope;
  watch.start(steps.state());
  for (int k = 0; k < 20; ++k) {
    steps.advance();
    watch.step(steps.state(), steps.reactions(), k % 2 == 0, true);
    watch.attempt(steps.state(), steps.last());
  }
  return scope.count();
}

TEST(Range, TheWatchDoesNotAllocateInSteps) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const Model model = build_model(read_model(EXAMPLE("iltis")));
  for (const Coordinates c : both_coordinates) EXPECT_EQ(allocations(model, c), 0u);
}

}  // namespace
}  // namespace floatframe::test
