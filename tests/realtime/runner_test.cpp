// The loop of a paced run: results, counts, ends, and what it must not do. Nothing here depends on
// how fast the machine is: slow steps are made slow.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "floatframe/formulation/absolute.hpp"
#include "floatframe/realtime/denormals.hpp"
#include "floatframe/realtime/realtime_runner.hpp"
#include "floatframe/realtime/signal_log.hpp"
#include "floatframe/run/run.hpp"
#include "realtime/recorder.hpp"
#include "support/allocation_counter.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

/// Rows of time and outputs of steps that nobody paces: 10 whole ones and a part of one.
std::vector<double> stepped(const Model& m, const SimulationDescription& s, long& iterations) {
  Stepper steps(m, s, {.duration = s.duration});
  const std::size_t width = m.outputs.size() + 1;
  std::vector<double> rows(12 * width);
  steps.sample(rows.data());
  for (std::size_t k = 1; k <= 11; ++k) {
    EXPECT_TRUE(steps.advance());
    steps.sample(rows.data() + k * width);
  }
  iterations = steps.counters().iterations;
  return rows;
}

TEST(RealTime, GivesTheResultsOfPlainSteps) {
  for (const auto coordinates : {Coordinates::relative, Coordinates::absolute})
    for (const bool paced : {false, true}) {
      SimulationDescription s = simulation(0.052);
      s.coordinates = coordinates;
      const Model m = model();
      long iterations = 0;
      const std::vector<double> expected = stepped(m, s, iterations);
      Recorder port;
      const RealTimeOptions options{.paced = paced};
      const RealTimeReport r = run_real_time(m, s, options, &port);
      EXPECT_EQ(r.status, "completed");
      EXPECT_EQ(r.steps, 11);
      EXPECT_EQ(r.time, 0.052);
      EXPECT_TRUE(port.ended);
      ASSERT_EQ(port.rows.size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i)
        // The test is compiled for another instruction set than the library: rounding differs.
        EXPECT_NEAR(port.rows[i], expected[i], 1e-10 * (1.0 + std::abs(expected[i]))) << i;
      EXPECT_EQ(r.cpu.count(), 11u);
      EXPECT_EQ(r.elapsed.count(), 11u);
      long steps = 0, counted = 0;
      for (std::size_t k = 0; k < r.by_iterations.size(); ++k) {
        steps += r.by_iterations[k].steps;
        counted += static_cast<long>(k) * r.by_iterations[k].steps;
      }
      EXPECT_EQ(steps, 11);
      EXPECT_EQ(counted, iterations);
      EXPECT_EQ(r.iterations, iterations);
    }
}

TEST(RealTime, GivesTheSameBitsEachTime) {
  const Model m = model();
  Recorder first, second, paced;
  run_real_time(m, simulation(0.1), unpaced(), &first);
  run_real_time(m, simulation(0.1), unpaced(), &second);
  run_real_time(m, simulation(0.1), RealTimeOptions{}, &paced);
  ASSERT_EQ(first.rows.size(), 21 * (m.outputs.size() + 1));
  const std::size_t bytes = first.rows.size() * sizeof(double);
  EXPECT_EQ(std::memcmp(first.rows.data(), second.rows.data(), bytes), 0);
  EXPECT_EQ(std::memcmp(first.rows.data(), paced.rows.data(), bytes), 0);
}

TEST(RealTime, InputsActFromTheStepTheyComeIn) {
  const Model m = model();
  Recorder quiet, pushed;
  pushed.answer = [](Recorder& self, InputBuffer& inputs) {
    inputs.accept(std::vector<double>{self.received >= 5 ? 40.0 : 3.25, 1.5, 0.2, 0.0});
  };
  run_real_time(m, simulation(0.05), unpaced(), &quiet);
  const RealTimeReport r = run_real_time(m, simulation(0.05), unpaced(), &pushed);
  const std::size_t width = m.outputs.size() + 1;
  for (std::size_t k = 0; k <= 10; ++k) {
    const double difference = pushed.rows[k * width + 1] - quiet.rows[k * width + 1];
    if (k <= 4)
      EXPECT_EQ(difference, 0.0) << k;
    else  // more push on the cart: force and brake, both with the input
      EXPECT_GT(difference, 0.0) << k;
  }
  EXPECT_EQ(r.inputs, (std::vector<double>{40.0, 1.5, 0.2, 0.0}));
}

TEST(RealTime, RefusedInputsAreCountedAndKeepTheLastValue) {
  Recorder port;
  port.answer = [](Recorder& self, InputBuffer& inputs) {
    const double bad = self.received % 2 == 0 ? 51.0 : std::numeric_limits<double>::quiet_NaN();
    inputs.accept(std::vector<double>{bad, 1.0, 0.1, 0.0});
  };
  const RealTimeReport r = run_real_time(model(), simulation(0.05), unpaced(), &port);
  EXPECT_EQ(r.refused_inputs, (std::vector<long>{10, 0, 0, 0}));
  EXPECT_EQ(r.inputs[0], 3.25);
  EXPECT_EQ(r.inputs[1], 1.0);
}

TEST(RealTime, OverrunsAreTheProgramsOrTheHosts) {
  Recorder port;
  port.answer = [](Recorder& self, InputBuffer&) {
    if (self.received == 3) {  // computes for two steps
      const Nanoseconds begin = thread_cpu_clock();
      while (thread_cpu_clock() - begin < 40'000'000) {
      }
    }
    if (self.received == 6) std::this_thread::sleep_for(std::chrono::milliseconds(40));
  };
  const RealTimeOptions options{.max_lag = 10.0};
  const RealTimeReport r = run_real_time(model(), simulation(0.2, 0.02), options, &port);
  EXPECT_EQ(r.steps, 10);
  EXPECT_GE(r.program_overruns, 1);
  EXPECT_GE(r.host_overruns, 1);
  EXPECT_GE(r.late_steps, 2);
  EXPECT_EQ(r.slips, 0);
  EXPECT_GE(r.cpu.max(), 0.04);
  EXPECT_NEAR(r.worst_cpu_at, 0.06, 1e-12);
  EXPECT_GE(r.wall, 0.18);  // the last step is not due before
}

TEST(RealTime, MovesTheClockWhenItIsTooFarBehind) {
  Recorder port;
  port.answer = [](Recorder& self, InputBuffer&) {
    if (self.received == 2) std::this_thread::sleep_for(std::chrono::milliseconds(60));
  };
  const RealTimeOptions options{.max_lag = 0.0};
  const RealTimeReport r = run_real_time(model(), simulation(0.05), options, &port);
  EXPECT_GE(r.slips, 1);
  EXPECT_GE(r.slipped, 0.05);
  EXPECT_EQ(r.steps, 10);
  EXPECT_GE(r.wall, 0.045 + r.slipped);
}

TEST(RealTime, StopsOnRequest) {
  std::atomic<bool> stop{false};
  Recorder port;
  port.answer = [&stop](Recorder& self, InputBuffer&) { stop = self.received == 7; };
  RealTimeOptions options = unpaced();
  options.endless = true;
  options.stop = &stop;
  std::atomic<double> progress{0.0};
  options.progress = &progress;
  const RealTimeReport r = run_real_time(model(), simulation(0.05), options, &port);
  EXPECT_EQ(r.status, "stopped");
  EXPECT_EQ(r.steps, 7);
  EXPECT_NEAR(r.time, 0.035, 1e-12);
  EXPECT_EQ(progress, r.time);
}

TEST(RealTime, FailsWhenInputsDoNotCome) {
  class Impatient : public Recorder {
   public:
    void send(std::uint64_t step, double, std::span<const double>, bool last) noexcept override {
      last_step = step;
      ended = last;
    }
    std::uint64_t last_step = 0;
  } port;
  port.patience = 4;
  const RealTimeReport r = run_real_time(model(), simulation(0.05), unpaced(), &port);
  EXPECT_EQ(r.status, "failed");
  EXPECT_EQ(r.message, "no inputs arrived in reply to the outputs at t = 0.02 s");
  EXPECT_EQ(r.steps, 4);
  EXPECT_EQ(port.last_step, 4u);
  EXPECT_TRUE(port.ended);
}

TEST(RealTime, FixedIterationsAreCountedAsCutShort) {
  RealTimeOptions options = unpaced();
  options.fixed_iterations = 1;
  SimulationDescription s = simulation(0.1);
  s.coordinates = Coordinates::absolute;  // its constraints take more than one iteration
  const RealTimeReport r = run_real_time(model(), s, options, nullptr);
  EXPECT_EQ(r.status, "completed");
  EXPECT_EQ(r.iterations, 20);
  EXPECT_GT(r.cut_short, 0);
}

TEST(RealTime, AFailedStepNamesItsCulpritAndKeepsTheLastGoodState) {
  Recorder port;
  port.answer = [](Recorder& self, InputBuffer& inputs) {
    if (self.received == 4) inputs.accept(std::vector<double>{0.0, 1e308, 0.0, 0.0});
  };
  const RealTimeReport r = run_real_time(model(), simulation(0.1), unpaced(), &port);
  EXPECT_EQ(r.status, "failed");
  EXPECT_NE(r.message.find("step failed at t = 0.015 s"), std::string::npos) << r.message;
  EXPECT_NEAR(r.time, 0.015, 1e-12);
  for (const double x : r.outputs) EXPECT_TRUE(std::isfinite(x));
}

TEST(RealTime, StrictRunsNeedTheirScheduling) {
  const RealTimeOptions options{.priority = 99, .strict = true};
  try {
    EXPECT_TRUE(run_real_time(model(), simulation(0.01), options, nullptr).priority);
  } catch (const RunError& error) {  // an ordinary user without the right to it
    EXPECT_NE(std::string(error.what()).find("priority 99 is not granted"), std::string::npos);
  }
}

/// Answers, sometimes late, without memory of its own.
class Plain final : public SignalPort {
 public:
  bool receive(InputBuffer& inputs) noexcept override {
    if (++count % 10 != 0) return false;
    const double values[] = {0.1 * static_cast<double>(count), 1.5, 0.2, 0.0};
    inputs.accept(values);
    return true;
  }
  void send(std::uint64_t, double, std::span<const double> outputs, bool) noexcept override {
    sum += outputs[0];
  }
  long count = 0;
  double sum = 0.0;
};

void check_allocations(bool paced, Coordinates coordinates) {
  const Model m = model();
  SimulationDescription d = simulation(0.1, 0.001);
  d.coordinates = coordinates;
  Stepper steps(m, d, {.duration = d.duration});
  RealTimeOptions options{
      .paced = paced, .input_timeout = 0.003, .fallback = SilenceFallback::initial};
  const TemporaryFolder folder;
  SignalLog log(m, folder.file("log.csv"), false);
  options.log = &log;
  Plain port;
  RealTimeReport report;
  RealTimeRunner runner(steps, options, &port, report);
  MotionWatch watch(steps.model(), d.step);
  runner.watched_by(watch);
  const AllocationScope scope;
  const auto end = runner.run();
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_EQ(end, RealTimeRunner::End::completed);
  EXPECT_EQ(report.steps, 100);
  EXPECT_EQ(report.input_timeouts, 10);
  log.finish();
  EXPECT_EQ(log.rows(), 101);
}

TEST(RealTime, LoopDoesNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  for (const bool paced : {false, true})
    for (const auto c : {Coordinates::relative, Coordinates::absolute}) check_allocations(paced, c);
}

TEST(FlushDenormals, OnlyWhileItLives) {
#if !defined(__x86_64__) && !defined(__aarch64__)
  GTEST_SKIP() << "this processor has no such mode";
#endif
  volatile double tiny = std::numeric_limits<double>::min(), half = 0.5;
  EXPECT_GT(tiny * half, 0.0);
  {
    const FlushDenormals flush;
    EXPECT_EQ(tiny * half, 0.0);
    const FlushDenormals again;
    EXPECT_EQ(tiny * half, 0.0);
  }
  EXPECT_GT(tiny * half, 0.0);
}

}  // namespace
}  // namespace floatframe::test
