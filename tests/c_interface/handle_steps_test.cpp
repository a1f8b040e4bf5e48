// Steps of the C interface are those of a Simulation, bit for bit, do not allocate, and go on from
// saved states with equal bits.
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <thread>

#include "c_interface/handle_case.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "support/allocation_counter.hpp"

namespace floatframe::test {
namespace {

class HandleSteps : public HandleCase {};

TEST_F(HandleSteps, AreThoseOfASimulation) {
  for (const char* coordinates : {"relative", "absolute"}) {
    Simulation s(load_model(path_),
                 {.coordinates = std::string(coordinates) == "absolute" ? Coordinates::absolute
                                                                        : Coordinates::relative});
    const std::vector<double> expected = steps(s, 0, 50);
    for (const bool is_packed : {false, true}) {
      Handle h = is_packed ? packed() : opened();
      ASSERT_EQ(floatframe_set_option(h.get(), "coordinates", coordinates), FLOATFRAME_OK);
      h = started(std::move(h));
      EXPECT_TRUE(equal_bits(steps(h.get(), 0, 50), expected)) << coordinates;
      EXPECT_EQ(floatframe_step_count(h.get()), s.counters().steps);
      EXPECT_EQ(floatframe_substep_count(h.get()), s.counters().substeps);
      EXPECT_EQ(floatframe_iteration_count(h.get()), s.counters().iterations);
    }
  }
}

TEST_F(HandleSteps, OfOtherSizes) {
  Simulation s(load_model(path_));
  const Handle h = started(opened());
  for (const double size : {1e-4, 3e-3, 7e-4}) {
    EXPECT_TRUE(s.step(size));
    EXPECT_EQ(floatframe_step_by(h.get(), size), FLOATFRAME_OK);
    EXPECT_EQ(floatframe_time(h.get()), s.time());
  }
  EXPECT_TRUE(equal_bits(steps(h.get(), 0, 5), steps(s, 0, 5)));
}

TEST_F(HandleSteps, StartAgain) {
  const Handle h = started(opened());
  const std::vector<double> expected = steps(h.get(), 0, 20);
  EXPECT_EQ(floatframe_start(h.get()), FLOATFRAME_OK);
  EXPECT_EQ(floatframe_time(h.get()), 0.0);
  EXPECT_EQ(floatframe_step_count(h.get()), 0);
  EXPECT_EQ(floatframe_input(h.get(), 0), 30.0 * std::sin(0.3 * 19)) << "keeps its value";
  floatframe_set_input(h.get(), 0, floatframe_input_initial(h.get(), 0));
  floatframe_set_input(h.get(), 1, floatframe_input_initial(h.get(), 1));
  EXPECT_EQ(floatframe_start(h.get()), FLOATFRAME_OK);
  EXPECT_TRUE(equal_bits(steps(h.get(), 0, 20), expected));
}

// Inputs that are set before the start are there when it is found.
TEST_F(HandleSteps, EquilibriumUnderAnInput) {
  const std::string path = folder_.write("hangs.yaml", R"(floatframe: 1
gravity: [0, 0, 0]
inputs: {pull: {unit: N}}
bodies: {stone: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}
joints: {guide: {type: prismatic, child: stone, at: [0, 0, 0], axis: z}}
forces:
  spring: {type: joint_spring, joint: guide, spring: 100}
  pull: {type: force, body: stone, at: [0, 0, 0], direction: z, magnitude: {input: pull}}
outputs: {z: {joint_position: guide}}
simulation: {step: 0.01, start: equilibrium}
)");
  const Handle h(floatframe_open(path.c_str(), nullptr, 0));
  ASSERT_TRUE(h != nullptr);
  for (const double pull : {0.0, 20.0, -5.0}) {
    EXPECT_EQ(floatframe_set_input(h.get(), 0, pull), FLOATFRAME_OK);
    ASSERT_EQ(floatframe_start(h.get()), FLOATFRAME_OK) << floatframe_message(h.get());
    EXPECT_NEAR(floatframe_output(h.get(), 0), pull / 100.0, 1e-9);
    EXPECT_EQ(floatframe_step(h.get()), FLOATFRAME_OK);
    EXPECT_NEAR(floatframe_output(h.get(), 0), pull / 100.0, 1e-9);
  }
}

TEST_F(HandleSteps, DoNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted here";
  const Handle h = started(packed());
  steps(h.get(), 0, 3);
  const AllocationScope scope;
  double sum = 0.0;
  for (int k = 0; k < 50; ++k) {
    floatframe_set_input(h.get(), floatframe_find_input(h.get(), "push"), std::sin(0.3 * k));
    floatframe_set_input(h.get(), 1, 1.2 * std::cos(0.1 * k));
    floatframe_set_input(h.get(), 0, std::numeric_limits<double>::quiet_NaN());
    floatframe_set_input(h.get(), 0, 1e6);
    floatframe_step(h.get());
    floatframe_step_by(h.get(), 1e-3);
    floatframe_step_by(h.get(), -1.0);
    sum += floatframe_outputs(h.get())[0] + floatframe_output(h.get(), 1) +
           floatframe_input(h.get(), 0) + floatframe_time(h.get()) +
           floatframe_parameter(h.get(), floatframe_find_parameter(h.get(), "stiff")) +
           floatframe_output(h.get(), floatframe_find_output(h.get(), "tip"));
  }
  EXPECT_EQ(scope.count(), 0u) << sum;
  EXPECT_EQ(floatframe_step_count(h.get()), 103);
}

TEST_F(HandleSteps, TwoThreadsAndOne) {
  const Handle one = started(opened());
  const std::vector<double> expected = steps(one.get(), 0, 40);
  std::array<std::vector<double>, 2> found;
  {
    std::array<std::thread, 2> threads;
    for (std::size_t k = 0; k < threads.size(); ++k)
      threads[k] = std::thread([&found, k, this] {
        const Handle s(floatframe_open(path_.c_str(), nullptr, 0));
        if (s == nullptr || floatframe_start(s.get()) != FLOATFRAME_OK) return;
        found[k] = steps(s.get(), 0, 40);
      });
    for (std::thread& t : threads) t.join();
  }
  for (const std::vector<double>& f : found) EXPECT_TRUE(equal_bits(f, expected));
}

TEST_F(HandleSteps, GoOnFromSavedStates) {
  for (const bool is_packed : {false, true}) {
    const Handle h = started(is_packed ? packed() : opened());
    steps(h.get(), 0, 30);
    const std::vector<std::byte> state = saved(h.get());
    const std::vector<double> expected = steps(h.get(), 30, 50);
    ASSERT_EQ(restore(h.get(), state), FLOATFRAME_OK) << floatframe_message(h.get());
    EXPECT_EQ(floatframe_input(h.get(), 0), 30.0 * std::sin(0.3 * 29));
    EXPECT_TRUE(equal_bits(steps(h.get(), 30, 50), expected));
    const Handle other = is_packed ? packed() : opened();  // not started
    ASSERT_EQ(restore(other.get(), state), FLOATFRAME_OK) << floatframe_message(other.get());
    EXPECT_EQ(floatframe_step_count(other.get()), 30);
    EXPECT_TRUE(equal_bits(steps(other.get(), 30, 50), expected));
  }
}

TEST_F(HandleSteps, StatesOfOthersAreRefused) {
  const Handle h = started(packed());
  const std::vector<double> expected = steps(h.get(), 0, 10);
  ASSERT_EQ(floatframe_set_parameter(h.get(), 0, 4.0), FLOATFRAME_OK)
      << floatframe_message(h.get());
  std::vector<std::byte> state = saved(h.get());
  const auto untouched = [&](floatframe_simulation* s, std::span<const std::byte> bytes) {
    const std::vector<std::byte> before = saved(s);
    EXPECT_EQ(restore(s, bytes), FLOATFRAME_INVALID);
    EXPECT_EQ(saved(s), before);
  };
  const Handle file = started(opened());
  untouched(file.get(), state);
  const Handle slow = packed();
  floatframe_set_option(slow.get(), "tolerance", "1e-6");
  ASSERT_EQ(floatframe_start(slow.get()), FLOATFRAME_OK);
  untouched(slow.get(), state);
  state[state.size() / 2] ^= std::byte{4};
  untouched(h.get(), state);
  untouched(h.get(), std::span(state).first(20));
}

}  // namespace
}  // namespace floatframe::test
