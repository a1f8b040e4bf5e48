// Steps of an instance: what of the importer's step becomes inner steps, early return, overruns,
// failures; and what an instance says to its importer.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "fmi/resources.hpp"
#include "fmi/versions.hpp"
#include "support/allocation_counter.hpp"

namespace floatframe::testing {
namespace {

template <class Fmi>
struct Ready {
  Heard heard;
  void* c;
  explicit Ready(void* made = nullptr) : c(made != nullptr ? made : Fmi::make(heard)) {
    EXPECT_EQ(Fmi::enter(c), ok);
    EXPECT_EQ(Fmi::exit(c), ok);
    set(input0, 30.0);
  }
  ~Ready() { Fmi::free(c); }
  Ready(const Ready&) = delete;
  Ready& operator=(const Ready&) = delete;
  double get(std::uint32_t reference) {
    double value = 0.0;
    EXPECT_EQ(Fmi::get(c, &reference, 1, &value), ok);
    return value;
  }
  void set(std::uint32_t reference, double value) {
    EXPECT_EQ(Fmi::set(c, &reference, 1, &value), ok);
  }
};

template <class Fmi>
class FmiStep : public ::testing::Test {};
using Versions = ::testing::Types<Fmi2, Fmi3>;
TYPED_TEST_SUITE(FmiStep, Versions);

TYPED_TEST(FmiStep, AMultipleOfTheInnerStepGivesTheSameBits) {
  Ready<TypeParam> small, large;
  double summed = 0.0;  // as masters sum, with its rounding
  for (int k = 0; k < 1000; ++k, summed += fake_step)
    ASSERT_EQ(TypeParam::step(small.c, summed, fake_step), ok);
  for (int k = 0; k < 40; ++k) ASSERT_EQ(TypeParam::step(large.c, 0.25 * k, 0.25), ok);
  for (std::uint32_t k = 0; k < 3; ++k) EXPECT_EQ(small.get(output0 + k), large.get(output0 + k));
  EXPECT_EQ(small.get(figure0), 1000.0);
  EXPECT_EQ(large.get(0), small.get(0));
}

TYPED_TEST(FmiStep, AnyOtherStepIsReachedByAShorterLastOne) {
  Ready<TypeParam> any;
  ASSERT_EQ(TypeParam::step(any.c, 0.0, 0.025), ok);  // two, and one of 0.005
  EXPECT_EQ(any.get(figure0), 3.0);
  EXPECT_NEAR(any.get(0), 0.025, 1e-15);
  ASSERT_EQ(TypeParam::step(any.c, 0.025, 0.02), ok);  // whole ones again
  EXPECT_EQ(any.get(figure0), 5.0);
  EXPECT_NEAR(any.get(0), 0.045, 1e-15);
}

TYPED_TEST(FmiStep, NoInnerStepIsMuchShorterThanTheOneBefore) {
  Ready<TypeParam> any, divided;
  ASSERT_EQ(TypeParam::step(any.c, 0.0, 0.0201), ok);  // one, and two of 0.00505
  ASSERT_EQ(TypeParam::step(divided.c, 0.0, 0.01), ok);
  ASSERT_EQ(TypeParam::step(divided.c, 0.01, 0.00505), ok);
  ASSERT_EQ(TypeParam::step(divided.c, 0.01505, 0.00505), ok);
  EXPECT_EQ(any.get(figure0), 3.0);
  EXPECT_NEAR(any.get(0), 0.0201, 1e-15);
  EXPECT_NEAR(any.get(output0), divided.get(output0), 1e-12 * std::fabs(any.get(output0)));
  ASSERT_EQ(TypeParam::step(any.c, 0.0201, 0.0001), ok);  // there is none before
  EXPECT_EQ(any.get(figure0), 4.0);
}

TYPED_TEST(FmiStep, TheImportersClockIsFollowedOrRefused) {
  Ready<TypeParam> late;
  ASSERT_EQ(TypeParam::step(late.c, 0.003, 0.01), ok);  // less than half an inner step away
  EXPECT_NEAR(late.get(0), 0.013, 1e-15);
  EXPECT_EQ(TypeParam::step(late.c, 0.03, 0.01), error);
  EXPECT_TRUE(late.heard.has("found the communication point"));
}

TYPED_TEST(FmiStep, AFailedStepLeavesTheLastAcceptedOne) {
  Ready<TypeParam> weak;
  weak.set(parameter0 + 2, 0.035);  // in step mode: acts from the next step
  EXPECT_EQ(TypeParam::step(weak.c, 0.0, 0.1), error);
  EXPECT_NEAR(weak.get(0), 0.03, 1e-15);
  EXPECT_TRUE(std::isfinite(weak.get(output0)));
  EXPECT_EQ(weak.get(figure0), 3.0);
  // FMI 2 takes the message for a format.
  EXPECT_TRUE(weak.heard.has(TypeParam::version == 2 ? "100 %% of ##1" : "100 % of #1"));
  EXPECT_EQ(weak.heard.categories.back(), (std::pair<int, std::string>(error, "logStatusError")));
  EXPECT_EQ(TypeParam::step(weak.c, 0.03, 0.01), error);  // the run is over
  EXPECT_EQ(TypeParam::reset(weak.c), ok);
  EXPECT_EQ(weak.get(input0), 1.0);
  EXPECT_EQ(weak.get(parameter0 + 2), INFINITY);
}

TYPED_TEST(FmiStep, ASavedStateGoesOnWithTheSameBits) {
  Ready<TypeParam> first;
  ASSERT_EQ(TypeParam::step(first.c, 0.0, 0.123), ok);
  void* state = nullptr;
  ASSERT_EQ(TypeParam::get_state(first.c, &state), ok);
  std::size_t size = 0;
  ASSERT_EQ(TypeParam::size(first.c, state, &size), ok);
  std::vector<std::uint8_t> bytes(size);
  ASSERT_EQ(TypeParam::write(first.c, state, bytes.data(), size), ok);
  ASSERT_EQ(TypeParam::step(first.c, 0.123, 0.2), ok);
  const double x = first.get(output0);
  ASSERT_EQ(TypeParam::set_state(first.c, state), ok);
  ASSERT_EQ(TypeParam::step(first.c, 0.123, 0.2), ok);
  EXPECT_EQ(first.get(output0), x);
  // In an instance that has never been started.
  Heard heard;
  void* const other = TypeParam::make(heard);
  void* read = nullptr;
  ASSERT_EQ(TypeParam::read(other, bytes.data(), size, &read), ok);
  ASSERT_EQ(TypeParam::set_state(other, read), ok);
  ASSERT_EQ(TypeParam::step(other, 0.123, 0.2), ok);
  double values[2] = {};
  const std::uint32_t references[2] = {output0, figure0};
  ASSERT_EQ(TypeParam::get(other, references, 2, values), ok);
  EXPECT_EQ(values[0], x);
  EXPECT_EQ(values[1], first.get(figure0));
  TypeParam::free(other);
}

TYPED_TEST(FmiStep, TheEquilibriumFollowsWhatIsSetInInitialization) {
  Heard heard;
  void* const c = TypeParam::make(heard);
  double x = 0.0, force = 20.0, stiffness = 80.0;
  const std::uint32_t references[3] = {output0, input0, parameter0};
  EXPECT_EQ(TypeParam::enter(c), ok);
  EXPECT_EQ(TypeParam::get(c, &references[0], 1, &x), ok);
  EXPECT_EQ(x, 1.0 / 40.0);
  EXPECT_EQ(TypeParam::set(c, &references[1], 1, &force), ok);
  EXPECT_EQ(TypeParam::set(c, &references[2], 1, &stiffness), ok);
  EXPECT_EQ(TypeParam::get(c, &references[0], 1, &x), ok);
  EXPECT_EQ(x, 20.0 / 80.0);
  EXPECT_EQ(TypeParam::exit(c), ok);
  EXPECT_EQ(TypeParam::step(c, 0.0, 1.0), ok);  // stays at rest
  EXPECT_EQ(TypeParam::get(c, &references[0], 1, &x), ok);
  EXPECT_EQ(x, 20.0 / 80.0);
  EXPECT_TRUE(heard.has("the mass is at rest"));
  TypeParam::free(c);
}

TYPED_TEST(FmiStep, WhatHoldsForAWholeRunIsSetInInitialization) {
  Heard heard;
  void* const c = TypeParam::make(heard);
  const std::uint32_t mass = parameter0 + 1, output = output0;
  const double heavy = 7.0;
  double x = 0.0;
  EXPECT_EQ(TypeParam::enter(c), ok);
  EXPECT_EQ(TypeParam::get(c, &output, 1, &x), ok);  // the start is found
  EXPECT_EQ(TypeParam::set(c, &mass, 1, &heavy), ok) << "and found again";
  EXPECT_EQ(TypeParam::exit(c), ok);
  EXPECT_EQ(TypeParam::step(c, 0.0, 0.1), ok);
  EXPECT_EQ(TypeParam::set(c, &mass, 1, &heavy), error);
  EXPECT_TRUE(heard.has("this mass stays"));
  EXPECT_EQ(TypeParam::reset(c), ok);
  EXPECT_EQ(TypeParam::set(c, &mass, 1, &heavy), ok);
  TypeParam::free(c);
}

TYPED_TEST(FmiStep, AnInputOutsideOfItsLimitsIsDiscardedWithAllOfItsCall) {
  Ready<TypeParam> ready;
  const std::uint32_t references[3] = {input0, input0 + 1, parameter0};
  const double good[2] = {20.0, 3.0}, outside[3] = {30.0, 1001.0, 50.0};
  ASSERT_EQ(TypeParam::set(ready.c, references, 2, good), ok);
  EXPECT_EQ(TypeParam::set(ready.c, references, 2, outside), discard);
  EXPECT_TRUE(ready.heard.has("expected -1000 to 1000"));
  EXPECT_EQ(ready.get(input0), 20.0);
  EXPECT_EQ(ready.get(input0 + 1), 3.0);
  EXPECT_EQ(TypeParam::step(ready.c, 0.0, 0.1), ok) << "the run goes on";
  EXPECT_EQ(TypeParam::set(ready.c, references, 3, outside), error) << "the parameter is set";
}

TYPED_TEST(FmiStep, OverrunsAreCountedAndSaid) {
  Ready<TypeParam> slow;
  slow_down_fakes(0.012);
  for (int k = 0; k < 3; ++k) ASSERT_EQ(TypeParam::step(slow.c, 0.01 * k, 0.01), ok);
  slow_down_fakes(0.0);
  EXPECT_EQ(slow.get(figure0 + 3), 3.0);
  EXPECT_GT(slow.get(figure0 + 4), 1.2);
  int said = 0;
  for (const auto& category : slow.heard.categories) said += category.second == "logOverrun";
  EXPECT_EQ(said, 2);  // the first and the second
}

TYPED_TEST(FmiStep, StepsAndValuesDoNotAllocate) {
  Ready<TypeParam> ready;
  const std::uint32_t inputs[2] = {input0, input0 + 1}, outputs[2] = {output0, figure0 + 4};
  const std::uint32_t stiffness = parameter0;
  double values[2] = {};
  const test::AllocationScope allocations;
  for (int k = 0; k < 3; ++k) {
    const double force[2] = {10.0 * k, 1.0}, softer = 50.0 - k;
    ASSERT_EQ(TypeParam::set(ready.c, inputs, 2, force), ok);
    ASSERT_EQ(TypeParam::set(ready.c, &stiffness, 1, &softer), ok);
    ASSERT_EQ(TypeParam::step(ready.c, 0.015 * k, 0.015), ok);
    ASSERT_EQ(TypeParam::get(ready.c, outputs, 2, values), ok);
  }
  EXPECT_EQ(allocations.count(), 0u);
}

TYPED_TEST(FmiStep, InstancesRunInThreads) {
  double x[4] = {};
  std::vector<std::thread> threads;
  for (double& result : x)
    threads.emplace_back([&result] {
      Ready<TypeParam> own;
      for (int k = 0; k < 200; ++k) ASSERT_EQ(TypeParam::step(own.c, 0.05 * k, 0.05), ok);
      result = own.get(output0);
    });
  for (std::thread& thread : threads) thread.join();
  for (const double result : x) EXPECT_EQ(result, x[0]);
}

TYPED_TEST(FmiStep, NoInstanceOfWhatIsWrongAndTheReasonIsSaid) {
  Heard heard;
  EXPECT_EQ(TypeParam::make(heard, false, "4567"), nullptr);
  EXPECT_TRUE(heard.has("found the token '4567'"));
  EXPECT_EQ(TypeParam::make(heard, false, nullptr), nullptr);
  EXPECT_TRUE(heard.has("found no token"));
  EXPECT_EQ(open_fakes(), 0);
}

TYPED_TEST(FmiStep, LoggingFollowsTheImporter) {
  Heard heard;
  void* const c = TypeParam::make(heard, false);
  EXPECT_EQ(TypeParam::step(c, 0.0, 0.1), error);
  EXPECT_EQ(heard.messages.size(), TypeParam::version == 2 ? 1u : 0u);
  const char* const overrun = "logOverrun";
  EXPECT_EQ(TypeParam::log(c, true, 1, &overrun), ok);
  EXPECT_EQ(TypeParam::step(c, 0.0, 0.1), error);
  EXPECT_EQ(heard.messages.size(), TypeParam::version == 2 ? 1u : 0u);
  EXPECT_EQ(TypeParam::log(c, true, 0, nullptr), ok);
  EXPECT_EQ(TypeParam::step(c, 0.0, 0.1), error);
  EXPECT_TRUE(heard.has("in which this call is not allowed"));
  TypeParam::free(c);
}

/// What the importer does in intermediate updates.
struct Updates {
  Heard heard;
  void* c = nullptr;
  std::vector<double> times, x;
  double leave_at = INFINITY;  // asked for in the first update
  bool misbehaves = false;
  static void update(void* environment, double time, bool set, bool get, bool finished, bool can,
                     bool* wants, double* wanted) {
    auto& me = *static_cast<Updates*>(environment);
    EXPECT_TRUE(!set && get && finished);
    me.times.push_back(time);
    const std::uint32_t reference = output0;
    double x = 0.0;
    EXPECT_EQ(Fmi3::get(me.c, &reference, 1, &x), ok);
    me.x.push_back(x);
    if (me.misbehaves) {
      Fmi3::free(me.c);  // refused: the step is still at work
      EXPECT_EQ(Fmi3::step(me.c, time, 0.1), error);
    }
    if (!can || me.times.size() != 1) return;
    *wants = me.leave_at < INFINITY;
    *wanted = me.leave_at;
  }
  explicit Updates(bool early) {
    // The environment of an instance is that of its messages: these tests need none.
    c = fmi3InstantiateCoSimulation("car", "0123abcd", fake_resources().c_str(), false, false,
                                    false, early, nullptr, 0, this, nullptr, &update);
    EXPECT_EQ(Fmi3::enter(c), ok);
    EXPECT_EQ(Fmi3::exit(c), ok);
  }
  ~Updates() { Fmi3::free(c); }
  Updates(const Updates&) = delete;
  Updates& operator=(const Updates&) = delete;
  fmi3Status step(double at, double h, bool& early, double& last) const {
    bool event = true, end = true;
    const fmi3Status status = fmi3DoStep(c, at, h, true, &event, &end, &early, &last);
    EXPECT_TRUE(!event && !end);
    return status;
  }
};

TEST(FmiUpdate, FollowsEachInnerStepAndReturnsEarly) {
  bool early = false;
  double last = 0.0;
  Updates all(false);
  all.leave_at = 0.01;  // not allowed: ignored
  EXPECT_EQ(all.step(0.0, 0.035, early, last), fmi3OK);
  EXPECT_EQ(all.times.size(), 4u);
  EXPECT_FALSE(early);
  EXPECT_NEAR(last, 0.035, 1e-15);
  Updates now(true);
  now.leave_at = 0.01;
  EXPECT_EQ(now.step(0.0, 0.035, early, last), fmi3OK);
  EXPECT_TRUE(early);
  EXPECT_EQ(last, 0.01);
  EXPECT_EQ(now.times.size(), 1u);
  EXPECT_EQ(now.step(0.01, 0.02, early, last), fmi3OK);
  EXPECT_FALSE(early);
  Updates later(true);
  later.leave_at = 0.025;
  EXPECT_EQ(later.step(0.0, 0.1, early, last), fmi3OK);
  EXPECT_TRUE(early);
  EXPECT_NEAR(last, 0.025, 1e-15);
}

TEST(FmiUpdate, WhatIsNotAllowedInItEndsTheRun) {
  Updates wrong(true);
  wrong.misbehaves = true;
  bool early = false;
  double last = 0.0;
  EXPECT_EQ(wrong.step(0.0, 0.05, early, last), fmi3Error);
  EXPECT_EQ(wrong.times.size(), 1u);
  EXPECT_EQ(last, 0.01);
}

TEST(FmiInstance, EventsAndOtherKindsAreRefused) {
  Heard heard;
  EXPECT_EQ(fmi3InstantiateCoSimulation("car", "0123abcd", fake_resources().c_str(), false, true,
                                        true, false, nullptr, 0, &heard, &Fmi3::hear, nullptr),
            nullptr);
  const fmi3ValueReference references[] = {output0, input0};
  EXPECT_EQ(fmi3InstantiateCoSimulation("car", "0123abcd", fake_resources().c_str(), false, true,
                                        false, false, references, 2, &heard, &Fmi3::hear, nullptr),
            nullptr);
  EXPECT_EQ(fmi3InstantiateModelExchange("car", "", "", false, true, &heard, &Fmi3::hear), nullptr);
  const fmi2CallbackFunctions importer{&Fmi2::hear, nullptr, nullptr, nullptr, &heard};
  EXPECT_EQ(fmi2Instantiate("car", fmi2ModelExchange, "0123abcd", "", &importer, 0, 1), nullptr);
  EXPECT_EQ(fmi2Instantiate("car", fmi2CoSimulation, "0123abcd", "", nullptr, 0, 1), nullptr);
  EXPECT_EQ(fmi2Instantiate(nullptr, fmi2CoSimulation, "0123abcd", "", &importer, 0, 1), nullptr);
  EXPECT_EQ(heard.messages.size(), 5u);
}

TEST(FmiInstance, StatusOfTheLastStep) {
  Ready<Fmi2> ready;
  ASSERT_EQ(Fmi2::step(ready.c, 0.0, 0.02), ok);
  double time = 0.0;
  int yes = 7;
  fmi2Status status = fmi2OK;
  fmi2String text = nullptr;
  EXPECT_EQ(fmi2GetRealStatus(ready.c, fmi2LastSuccessfulTime, &time), fmi2OK);
  EXPECT_EQ(time, 0.02);
  EXPECT_EQ(fmi2GetBooleanStatus(ready.c, fmi2Terminated, &yes), fmi2OK);
  EXPECT_EQ(yes, 0);
  EXPECT_EQ(fmi2GetStatus(ready.c, fmi2DoStepStatus, &status), fmi2Discard);
  EXPECT_EQ(fmi2GetIntegerStatus(ready.c, fmi2DoStepStatus, &yes), fmi2Discard);
  EXPECT_EQ(fmi2GetStringStatus(ready.c, fmi2PendingStatus, &text), fmi2Discard);
  EXPECT_EQ(fmi2GetRealStatus(ready.c, fmi2LastSuccessfulTime, nullptr), fmi2Error);
  EXPECT_STREQ(fmi2GetVersion(), "2.0");
  EXPECT_STREQ(fmi2GetTypesPlatform(), "default");
  EXPECT_STREQ(fmi3GetVersion(), "3.0");
}

TEST(FmiResources, AreFoundByUriAndByPath) {
  const auto path = [](const char* text) { return fmi::model_path(text); };
  EXPECT_EQ(path("file:///tmp/a%20b/resources"), "/tmp/a b/resources/model.ffm");
  EXPECT_EQ(path("file:/tmp/r/"), "/tmp/r/model.ffm");
  EXPECT_EQ(path("FILE://localhost/tmp/r"), "/tmp/r/model.ffm");
  EXPECT_EQ(path("file:///C:/tmp/r"), "C:/tmp/r/model.ffm");
  EXPECT_EQ(path("file://C:/tmp/r"), "C:/tmp/r/model.ffm");
  EXPECT_EQ(path("C:\\tmp\\r\\"), "C:\\tmp\\r\\model.ffm");
  EXPECT_EQ(path("/tmp/100%/r"), "/tmp/100%/r/model.ffm");
  EXPECT_EQ(path("file:///tmp/100%/%4"), "/tmp/100%/%4/model.ffm");
  EXPECT_EQ(path("file://server/tmp/r"), "");
  EXPECT_EQ(path("http://a/r"), "");
  EXPECT_EQ(path(""), "");
}

}  // namespace
}  // namespace floatframe::testing
