// A partner that falls silent: reported with its times, and the chosen fallback acts.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "realtime/recorder.hpp"

namespace floatframe::test {
namespace {

/// Sends inputs at the steps chosen, counted from 1.
class Sometimes : public Recorder {
 public:
  explicit Sometimes(std::function<bool(long)> speaks) : speaks_(std::move(speaks)) {}
  bool receive(InputBuffer& inputs) noexcept override {
    if (!speaks_(++received)) return false;
    inputs.accept(std::vector<double>{30.0, 1.0, 0.1, 0.0});
    return true;
  }

 private:
  std::function<bool(long)> speaks_;
};

/// Speaks at every step, in words that no input understands: NaN from some step on.
class Confused : public Recorder {
 public:
  bool receive(InputBuffer& inputs) noexcept override {
    const double nan = std::nan("");
    return inputs.accept(++received < 3 ? std::vector<double>{30.0, 1.0, 0.1, 0.0}
                                        : std::vector<double>{nan, nan, nan, nan});
  }
};

RealTimeOptions four_steps_of_patience(SilenceFallback fallback) {
  RealTimeOptions options = unpaced();
  options.input_timeout = 0.02;
  options.fallback = fallback;
  return options;
}

TEST(Silence, SilentInputsAreHeldOrReturnToTheirInitialValues) {
  for (const auto fallback : {SilenceFallback::hold, SilenceFallback::initial}) {
    std::atomic<double> since{-1.0};
    RealTimeOptions options = four_steps_of_patience(fallback);
    options.silent_since = &since;
    Sometimes silent([](long k) { return k == 3; }), alive([](long) { return true; });
    const RealTimeReport r = run_real_time(model(), simulation(0.1), options, &silent);
    EXPECT_EQ(r.status, "completed");
    EXPECT_EQ(r.input_timeouts, 1);
    EXPECT_EQ(r.silences[0].from, 0.01);
    EXPECT_NEAR(r.silences[0].to, 0.1, 1e-15);
    EXPECT_FALSE(r.silences[0].ended);
    EXPECT_EQ(since, 0.01);  // they have not come again only because the run is over
    EXPECT_EQ(r.inputs[0], fallback == SilenceFallback::hold ? 30.0 : 3.25);
    const RealTimeReport spoken = run_real_time(model(), simulation(0.1), options, &alive);
    EXPECT_EQ(spoken.input_timeouts, 0);
    EXPECT_EQ(spoken.inputs[0], 30.0);
  }
}

TEST(Silence, InputsThatAreAllNaNAreSilence) {
  for (const auto fallback : {SilenceFallback::hold, SilenceFallback::initial}) {
    Confused confused;
    const RealTimeReport r =
        run_real_time(model(), simulation(0.1), four_steps_of_patience(fallback), &confused);
    EXPECT_EQ(r.input_timeouts, 1);
    EXPECT_EQ(r.inputs[0], fallback == SilenceFallback::hold ? 30.0 : 3.25);
  }
  Confused confused;
  const RealTimeReport stopped = run_real_time(
      model(), simulation(0.1), four_steps_of_patience(SilenceFallback::stop), &confused);
  EXPECT_EQ(stopped.status, "failed");
  // One value is enough.
  InputBuffer buffer(model());
  const double nan = std::nan("");
  EXPECT_TRUE(buffer.accept(std::vector<double>{nan, nan, 0.1, nan}));
  EXPECT_FALSE(buffer.accept(std::vector<double>{nan, nan, nan, nan}));
  EXPECT_EQ(buffer.refused(0), 2);
}

TEST(Silence, SilenceIsReportedAfterASecondByDefault) {
  for (const double duration : {0.9, 1.1}) {
    Sometimes silent([](long k) { return k == 1; });
    const RealTimeReport r = run_real_time(model(), simulation(duration), unpaced(), &silent);
    EXPECT_EQ(r.status, "completed");
    EXPECT_EQ(r.input_timeouts, duration > 1.0 ? 1 : 0);
    EXPECT_EQ(r.inputs[0], 30.0);  // held
  }
}

TEST(Silence, EverySilenceHasItsTimes) {
  Sometimes port([](long k) { return k == 2 || k == 8 || k == 10 || k == 16; });
  std::atomic<double> since{-1.0};
  RealTimeOptions options = four_steps_of_patience(SilenceFallback::initial);
  options.silent_since = &since;
  const RealTimeReport r = run_real_time(model(), simulation(0.095), options, &port);
  ASSERT_EQ(r.input_timeouts, 2);
  EXPECT_NEAR(r.silences[0].from, 0.005, 1e-15);
  EXPECT_NEAR(r.silences[0].to, 0.035, 1e-15);
  EXPECT_TRUE(r.silences[0].ended);
  EXPECT_NEAR(r.silences[1].from, 0.045, 1e-15);
  EXPECT_NEAR(r.silences[1].to, 0.075, 1e-15);
  EXPECT_EQ(since, -1.0);
  EXPECT_EQ(r.inputs[0], 30.0);
}

TEST(Silence, MoreSilencesThanAreListedAreCounted) {
  Sometimes port([](long k) { return k % 5 == 1; });
  const RealTimeReport r =
      run_real_time(model(), simulation(0.5), four_steps_of_patience(SilenceFallback::hold), &port);
  EXPECT_EQ(r.input_timeouts, 20);
  EXPECT_NEAR(r.silences.back().from, 0.375, 1e-12);
}

TEST(Silence, ASilentPartnerStopsTheRunOnlyIfItEverSpoke) {
  const RealTimeOptions options = four_steps_of_patience(SilenceFallback::stop);
  Sometimes silent([](long k) { return k == 3; }), mute([](long) { return false; });
  const RealTimeReport r = run_real_time(model(), simulation(0.1), options, &silent);
  EXPECT_EQ(r.status, "failed");
  EXPECT_EQ(r.message, "no inputs arrived for 0.02 s after t = 0.01 s");
  EXPECT_EQ(r.steps, 6);
  EXPECT_TRUE(silent.ended);
  // A silence before the first inputs is none of the partner's.
  Sometimes late([](long k) { return k == 8; });
  const RealTimeReport after = run_real_time(model(), simulation(0.2), options, &late);
  EXPECT_EQ(after.input_timeouts, 2);
  EXPECT_EQ(after.message, "no inputs arrived for 0.02 s after t = 0.035 s");
  const RealTimeReport waiting = run_real_time(model(), simulation(0.1), options, &mute);
  EXPECT_EQ(waiting.status, "completed");
  EXPECT_EQ(waiting.input_timeouts, 1);
  EXPECT_FALSE(waiting.inputs_came);
}

TEST(Silence, OtherPortsDoNotWaitForInputs) {
  class Listener : public Recorder {
   public:
    bool gives_inputs() const noexcept override { return false; }
  } listener;
  const RealTimeReport r = run_real_time(model(), simulation(0.1),
                                         four_steps_of_patience(SilenceFallback::stop), &listener);
  EXPECT_EQ(r.input_timeouts, 0);
}

}  // namespace
}  // namespace floatframe::test
