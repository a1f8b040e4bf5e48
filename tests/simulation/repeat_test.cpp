// No step after the first allocates, over the whole manoeuvre of the Iltis with its outputs sampled
// after every step; and equal runs give equal bits, fresh or from a state that was set up again.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/simulation/initial_state.hpp"
#include "floatframe/simulation/runner.hpp"
#include "simulation/figures.hpp"
#include "simulation/iltis.hpp"
#include "support/allocation_counter.hpp"

namespace floatframe::test {
namespace {

constexpr double step = 0.01;
constexpr long steps = 800;

StepOptions options_of(const Model& model) {
  const StepOptions o{.spectral_radius = model.simulation.spectral_radius,
                      .tolerance = model.simulation.tolerance,
                      .penalty_mass = default_penalty_mass(model, Coordinates::relative)};
  return o;
}

/// All rows of outputs; adds the allocations after the first step to `allocations`.
template <class F>
std::vector<double> drive(Runner<F>& runner, std::size_t width, std::size_t& allocations) {
  std::vector<double> rows(width * static_cast<std::size_t>(steps));
  double* row = rows.data();
  EXPECT_TRUE(runner.advance(step)) << runner.failure();
  runner.sample(row);
  const AllocationScope scope;
  bool good = true;
  for (long k = 1; k < steps && good; ++k) {
    good = runner.advance(step);
    runner.sample(row += width);
  }
  allocations += scope.count();
  EXPECT_TRUE(good) << runner.failure();
  return rows;
}

State start_of(RelativeFormulation& f, const Model&, InertiaMethod) {
  return relative_start(f, Start::equilibrium);
}
State start_of(AbsoluteFormulation& f, const Model& model, InertiaMethod method) {
  RelativeFormulation tree(model, method);
  const State start = relative_start(tree, Start::equilibrium);
  State state;
  f.start_from(tree, start.q, start.v, state.q, state.v);
  return state;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

template <class F>
void check(const Model& model, const Combination& c, const char* label) {
  const std::string name = std::string(label) + " " + c.name();
  const std::size_t width = model.outputs.size() + 1;
  const StepOptions options = options_of(model);
  std::size_t allocations = 0;
  std::vector<std::vector<double>> histories;
  for (int fresh = 0; fresh < 2; ++fresh) {
    F f(model, c.inertia);
    Runner<F> runner(f, options, step / 1024.0);
    // In the same workspace once more: what an earlier run left behind must not matter.
    for (int again = 0; again < 2; ++again) {
      runner.state() = start_of(f, model, c.inertia);
      start_accelerations(f, runner.state(), options.penalty_mass);
      histories.push_back(drive(runner, width, allocations));
      if (fresh == 0 && again == 0)
        figure(name + " substeps", static_cast<double>(runner.counters().substeps));
    }
  }
  EXPECT_TRUE(same_bits(histories[0], histories[2])) << name << ": two fresh runs";
  EXPECT_TRUE(same_bits(histories[0], histories[1])) << name << ": same workspace, state set again";
  if (allocations_counted()) {
    figure(name + " allocations after the first step", static_cast<double>(allocations));
    EXPECT_EQ(allocations, 0u) << name;
  }
}

void check_all(const ModelDescription& description, const char* label) {
  const Model model = build_model(description);
  for (const Combination& c : combinations) {
    if (c.coordinates == Coordinates::relative)
      check<RelativeFormulation>(model, c, label);
    else
      check<AbsoluteFormulation>(model, c, label);
  }
  if (!allocations_counted())
    GTEST_SKIP() << "allocations are not counted under a sanitizer; repeats were compared";
}

TEST(Repeat, TheCounterSeesTheLibrary) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  const ModelDescription d = iltis();
  const AllocationScope scope;
  const Model model = build_model(d);
  EXPECT_GT(scope.count(), 100u);
}

TEST(Repeat, ManoeuvreWithoutAllocationsAndWithEqualBits) { check_all(iltis(), "iltis"); }

TEST(Repeat, SubstepsDoNotAllocateEither) {
  // A Newton limit that the stairs exceed at 10 ms.
  ModelDescription d = iltis();
  d.simulation.tolerance = 1e-11;
  d.simulation.spectral_radius = 0.4;
  const Model model = build_model(d);
  for (const Combination& c : combinations) {
    const auto one = [&](auto& f) {
      using F = std::remove_reference_t<decltype(f)>;
      StepOptions options = options_of(model);
      options.max_iterations = 5;
      Runner<F> runner(f, options, step / 1024.0);
      runner.state() = start_of(f, model, c.inertia);
      start_accelerations(f, runner.state(), options.penalty_mass);
      std::size_t allocations = 0;
      drive(runner, model.outputs.size() + 1, allocations);
      figure(c.name() + " substeps forced", static_cast<double>(runner.counters().substeps));
      EXPECT_GT(runner.counters().substeps, 0);
      EXPECT_EQ(allocations, 0u) << c.name();
    };
    if (c.coordinates == Coordinates::relative) {
      RelativeFormulation f(model, c.inertia);
      one(f);
    } else {
      AbsoluteFormulation f(model, c.inertia);
      one(f);
    }
  }
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
}

}  // namespace
}  // namespace floatframe::test
