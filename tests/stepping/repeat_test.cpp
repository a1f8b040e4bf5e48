// No step after the first allocates, over the whole manoeuvre of the Iltis with its outputs sampled
// after every step; and equal runs give equal bits, fresh or from a state that was set up again.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "support/allocation_counter.hpp"
#include "support/figures.hpp"
#include "support/iltis.hpp"

namespace floatframe::test {
namespace {

constexpr double step = 0.01;
constexpr long steps = 800;

SimulationDescription options_of(const Model& model, const Combination& c) {
  SimulationDescription o = with(model.simulation, c.coordinates);
  o.inertia = c.inertia;
  o.start = Start::equilibrium;
  o.step = step;
  return o;
}

/// All rows of outputs; adds the allocations after the first step to `allocations`.
std::vector<double> drive(Stepper& stepper, std::size_t& allocations) {
  const std::size_t width = stepper.model().outputs.size() + 1;
  std::vector<double> rows(width * static_cast<std::size_t>(steps));
  double* row = rows.data();
  EXPECT_TRUE(stepper.advance()) << stepper.failure();
  stepper.sample(row);
  const AllocationScope scope;
  bool good = true;
  for (long k = 1; k < steps && good; ++k) {
    good = stepper.advance();
    stepper.sample(row += width);
  }
  allocations += scope.count();
  EXPECT_TRUE(good) << stepper.failure();
  return rows;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void check(const Model& model, const Combination& c, const char* label) {
  const std::string name = std::string(label) + " " + c.name();
  std::size_t allocations = 0;
  std::vector<std::vector<double>> histories;
  for (int fresh = 0; fresh < 2; ++fresh) {
    Stepper stepper(model, options_of(model, c));
    // In the same workspace once more: what an earlier run left behind must not matter.
    for (int again = 0; again < 2; ++again) {
      stepper.restart();
      histories.push_back(drive(stepper, allocations));
      if (fresh == 0 && again == 0)
        figure(name + " substeps", static_cast<double>(stepper.counters().substeps));
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
  for (const Combination& c : combinations) check(model, c, label);
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
    SimulationDescription o = options_of(model, c);
    o.max_iterations = 5;
    Stepper stepper(model, o);
    std::size_t allocations = 0;
    drive(stepper, allocations);
    figure(c.name() + " substeps forced", static_cast<double>(stepper.counters().substeps));
    EXPECT_GT(stepper.counters().substeps, 0);
    EXPECT_EQ(allocations, 0u) << c.name();
  }
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
}

}  // namespace
}  // namespace floatframe::test
