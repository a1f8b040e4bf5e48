// The log of inputs and outputs: what is in the file, that nothing is lost where nobody paces, and
// what happens when it cannot be written.
#include "floatframe/realtime/signal_log.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <thread>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/realtime/realtime.hpp"
#include "support/allocation_counter.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

Model one_in_one_out() {
  Model m;
  m.inputs.push_back({"push", "N", 0.5});
  Output o;
  o.name = "z";
  o.unit = "m";
  m.outputs.push_back(o);
  return m;
}

using Values = std::vector<double>;

TEST(SignalLog, HoldsEveryRowWithAllItsDigits) {
  const TemporaryFolder folder;
  SignalLog log(one_in_one_out(), folder.file("log.csv"), true);
  log.push(0.0, Values{0.5}, Values{1.0});
  log.push(0.1, Values{-3.0}, Values{1.0 / 3.0});
  log.finish();
  EXPECT_EQ(folder.read("log.csv"),
            "time [s],input.push [N],z [m]\n"
            "0,0.5,1\n"
            "0.10000000000000001,-3,0.33333333333333331\n");
  EXPECT_EQ(log.rows(), 2);
  EXPECT_EQ(log.lost(), 0);
  EXPECT_EQ(log.error(), 0);
}

TEST(SignalLog, LosesNothingWithoutPacing) {
  const TemporaryFolder folder;
  Model wide = one_in_one_out();
  for (int k = 0; k < 5000; ++k) wide.outputs.push_back(wide.outputs[0]);
  const Values outputs(wide.outputs.size(), 1.0);
  SignalLog log(wide, folder.file("log.csv"), true);
  for (int k = 0; k < 1000; ++k) log.push(k, Values{0.0}, outputs);  // more rows than the ring has
  log.finish();
  EXPECT_EQ(log.rows(), 1000);
  EXPECT_EQ(log.lost(), 0);
  const std::string text = folder.read("log.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1001);
}

TEST(SignalLog, CanBeFollowedWhileItGrows) {
  const TemporaryFolder folder;
  SignalLog log(one_in_one_out(), folder.file("log.csv"), false);
  std::string expected = "time [s],input.push [N],z [m]\n";
  for (int k = 0; k < 3; ++k) {
    log.push(k, Values{0.5}, Values{2.0});
    expected += std::to_string(k) + ",0.5,2\n";
    for (int waited = 0; folder.read("log.csv") != expected && waited < 6000; ++waited)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(folder.read("log.csv"), expected);
  }
}

TEST(SignalLog, PushingDoesNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const TemporaryFolder folder;
  SignalLog log(one_in_one_out(), folder.file("log.csv"), false);
  const Values in{1.0}, out{2.0};
  const AllocationScope scope;
  for (int k = 0; k < 100; ++k) log.push(k, in, out);
  EXPECT_EQ(scope.count(), 0u);
}

TEST(SignalLog, ErrorsOfTheDiskAreReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  SignalLog log(one_in_one_out(), "/dev/full", true);
  for (int k = 0; k < 100; ++k) log.push(k, Values{1.0}, Values{2.0});
  log.finish();
  EXPECT_EQ(log.error(), ENOSPC);
  EXPECT_EQ(log.rows(), 0);
  EXPECT_EQ(log.lost(), 100);
}

TEST(SignalLog, WhatCannotBeOpenedIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(SignalLog(one_in_one_out(), folder.file("nowhere/log.csv"), true), OutputError);
  // A pipe that nobody reads would block for ever.
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(SignalLog(one_in_one_out(), pipe, true), OutputError);
}

/// Pushes with the number of the step.
class Counting final : public SignalPort {
 public:
  bool receive(InputBuffer& inputs) noexcept override {
    inputs.accept(Values{static_cast<double>(++count), 1.5, 0.2, 0.0});
    return true;
  }
  void send(std::uint64_t, double time, std::span<const double> outputs, bool) noexcept override {
    rows.push_back(time);
    rows.push_back(outputs[0]);
  }
  int count = 0;
  Values rows;
};

TEST(SignalLog, EachStepOfARunHasOneRow) {
  const TemporaryFolder folder;
  const ModelDescription d = read_model(FLOATFRAME_TEST_DATA "/good_models/inputs.yaml");
  const Model model = build_model(d);
  SimulationDescription s = d.simulation;
  s.duration = 0.05;
  SignalLog log(model, folder.file("log.csv"), true);
  const RealTimeOptions options{.paced = false, .log = &log};
  Counting port;
  const RealTimeReport r = run_real_time(model, s, options, &port);
  log.finish();
  EXPECT_EQ(r.status, "completed");
  EXPECT_EQ(log.rows(), 11);
  std::istringstream text(folder.read("log.csv"));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line.substr(0, 31), "time [s],input.push [N],input.p");
  for (std::size_t k = 0; k <= 10; ++k) {
    ASSERT_TRUE(std::getline(text, line));
    double time = 0, push = 0, pull = 0, angle = 0, speed = 0, cart = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", &time, &push, &pull, &angle,
                          &speed, &cart),
              6);
    EXPECT_EQ(time, port.rows[2 * k]);
    EXPECT_EQ(push, k == 0 ? 3.25 : static_cast<double>(k));
    EXPECT_EQ(cart, port.rows[2 * k + 1]);
  }
}

}  // namespace
}  // namespace floatframe::test
