// Options of a paced run that a C++ program gives are checked before anything is done.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/realtime/realtime.hpp"
#include "floatframe/realtime/udp_port.hpp"

namespace floatframe::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Never asked for anything: the run must not begin.
class Untouched final : public SignalPort {
 public:
  bool wait() noexcept override { return touched(); }
  bool receive(InputBuffer&) noexcept override { return touched(); }
  void send(std::uint64_t, double, std::span<const double>, bool) noexcept override { touched(); }

 private:
  static bool touched() {
    ADD_FAILURE() << "the run began";
    return false;
  }
};

struct Case {
  std::function<void(RealTimeOptions&, SimulationDescription&)> change;
  const char* sentence;
};

TEST(RealTimeOptions, EachHasItsSentence) {
  using O = RealTimeOptions;
  using S = SimulationDescription;
  const Case cases[] = {
      {[](O& o, S&) { o.fixed_iterations = -1; },
       "realtime.fixed_iterations: found -1, expected a number of Newton iterations per step (a "
       "whole number from 0 to 1000)"},
      {[](O& o, S&) { o.fixed_iterations = 1001; }, "realtime.fixed_iterations: found 1001"},
      {[](O& o, S&) { o.time_budget = -1e-3; },
       "realtime.time_budget: found -0.001, expected a number >= 0 [s]"},
      {[](O& o, S&) { o.time_budget = nan; }, "realtime.time_budget: found nan"},
      {[](O& o, S&) { o.max_lag = -0.1; },
       "realtime.max_lag: found -0.1, expected a number from 0 to 1e9 [s]"},
      {[](O& o, S&) { o.max_lag = 1e300; }, "realtime.max_lag: found 1e+300"},
      {[](O& o, S&) { o.input_timeout = nan; }, "realtime.input_timeout: found nan"},
      {[](O& o, S&) { o.input_timeout = infinity; }, "realtime.input_timeout: found inf"},
      {[](O& o, S&) { o.fallback = static_cast<SilenceFallback>(7); },
       "realtime.fallback: found 7, expected hold, initial or stop"},
      {[](O& o, S&) { o.priority = 100; },
       "realtime.priority: found 100, expected a real-time priority, 0 for none (a whole number "
       "from 0 to 99)"},
      {[](O& o, S&) { o.priority = -1; }, "realtime.priority: found -1"},
      {[](O&, S& s) { s.step = 1e-7; },
       "found a step of 1e-07 s, expected at least 1e-6 s and at most 1e6 s in step with the wall "
       "clock"},
      {[](O&, S& s) { s.step = s.duration = 1e7; }, "found a step of 1e+07 s"},
      {[](O&, S& s) { s.step = nan; }, "simulation.step: found nan"},
      {[](O& o, S& s) { o.paced = false, s.step = 1e-300; },
       "a duration of 1 s with a step of 1e-300 s takes more than 1e+12 steps"},
      {[](O&, S& s) { s.duration = infinity; }, "simulation.duration: found inf"},
      {[](O&, S& s) { s.step = 2.0; }, "the step of 2 s is longer than the duration of 1 s"}};
  const ModelDescription d = read_model(FLOATFRAME_TEST_DATA "/good_models/inputs.yaml");
  const Model model = build_model(d);
  for (const Case& c : cases) {
    RealTimeOptions options;
    SimulationDescription simulation = d.simulation;
    simulation.step = 0.01;
    simulation.duration = 1.0;
    c.change(options, simulation);
    Untouched port;
    try {
      run_real_time(model, simulation, options, &port);
      ADD_FAILURE() << "no error: " << c.sentence;
    } catch (const InputError& error) {
      ASSERT_EQ(error.errors().size(), 1u) << error.what();
      EXPECT_EQ(error.errors()[0].message.find(c.sentence), 0u) << error.what();
    }
  }
}

TEST(RealTimeOptions, AllErrorsAreReported) {
  RealTimeOptions options;
  options.max_lag = options.input_timeout = -1.0;
  try {
    require_valid(options, SimulationDescription{});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.errors().size(), 2u) << error.what();
  }
}

TEST(RealTimeOptions, TimeoutOfThePort) {
  const Model model = build_model(read_model(FLOATFRAME_TEST_DATA "/good_models/inputs.yaml"));
  for (const double timeout : {0.0, -1.0, nan, infinity, 1e300}) {
    UdpPortOptions options;
    options.listen = parse_udp_address("127.0.0.1:0", "--listen");
    options.timeout = timeout;
    EXPECT_THROW(UdpPort(model, options), InputError) << timeout;
  }
}

}  // namespace
}  // namespace floatframe::test
