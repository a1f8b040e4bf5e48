// Every option of a run, one change at a time, as `build_model` and as `run` are given it.
#include <gtest/gtest.h>

#include "floatframe/model/validate.hpp"
#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

TEST(Validate, Simulation) {
  using S = SimulationDescription;
  const std::pair<std::function<void(S&)>, const char*> cases[] = {
      {[](S& s) { s.step = nan; },
       "simulation.step: found nan, expected a positive number [s] (numbers must be finite)"},
      {[](S& s) { s.step = 0.0; }, "simulation.step: found 0, expected a positive number [s]"},
      {[](S& s) { s.step = -1.0; }, "simulation.step: found -1, expected a positive number [s]"},
      {[](S& s) { s.duration = inf; },
       "simulation.duration: found inf, expected a number >= 0 [s] (numbers must be finite)"},
      {[](S& s) { s.output_interval = -1.0; },
       "simulation.output_interval: found -1, expected a number >= 0 [s]"},
      {[](S& s) { s.max_iterations = -1; },
       "simulation.max_iterations: found -1, expected a number of iterations (a whole number from "
       "1 to 1000)"},
      {[](S& s) { s.spectral_radius = 5.0; },
       "simulation.spectral_radius: found 5, expected a number from 0 to 1"},
      {[](S& s) { s.tolerance = 0.0; },
       "simulation.tolerance: found 0, expected a number from 1e-15 to 1"},
      {[](S& s) { s.tolerance = 1e300; },
       "simulation.tolerance: found 1e+300, expected a number from 1e-15 to 1"},
      {[](S& s) { s.position_tolerance = 2.0; },
       "simulation.position_tolerance: found 2, expected a number from 1e-15 to 1 [m]"},
      {[](S& s) { s.velocity_tolerance = 2.0; },
       "simulation.velocity_tolerance: found 2, expected a number from 1e-15 to 1 [m/s]"},
      {[](S& s) { s.min_step = 1.0; },
       "simulation.min_step: found 1, expected at most the step, 0.001 [s]"},
      {[](S& s) { s.penalty = nan; },
       "simulation.penalty: found nan, expected a number >= 0 (numbers must be finite)"},
      {[](S& s) { s.position_tolerance = 0.0; },
       "simulation.position_tolerance: found 0, expected a number from 1e-15 to 1 [m]"},
      {[](S& s) { s.velocity_tolerance = -1.0; },
       "simulation.velocity_tolerance: found -1, expected a number from 1e-15 to 1 [m/s]"},
      {[](S& s) { s.velocity.y() = nan; },
       "simulation.velocity[2]: found nan, expected a number [m/s] (numbers must be finite)"},
      {[](S& s) { s.coordinates = static_cast<Coordinates>(2); },
       "simulation.coordinates: found 2, expected relative or absolute"},
      {[](S& s) { s.inertia = static_cast<InertiaMethod>(-1); },
       "simulation.inertia: found -1, expected preprocessing or projection"},
      {[](S& s) { s.start = static_cast<Start>(5); },
       "simulation.start: found 5, expected given, equilibrium or {state: file}"},
      {[](S& s) { s.start = Start::state; },
       "simulation.start: found no state, expected the state to start from"},
      {[](S& s) { s.offset["block"].translation.x() = 0.1; },
       "simulation.start.offset: found without 'equilibrium: true' or 'state', expected where to "
       "start from"},
      {[](S& s) {
         s.start = Start::equilibrium;
         s.offset["block"].translation.x() = nan;
       },
       "simulation.start.offset.block[1]: found nan, expected a number [m] (numbers must be "
       "finite)"},
  };
  for (const auto& [change, expected] : cases) {
    ModelDescription d = valid_description();
    change(d.simulation);
    EXPECT_EQ(errors(d), expected);
    try {  // and what a run is given beside the model
      require_valid_run(d.simulation);
      ADD_FAILURE() << expected;
    } catch (const InputError& error) {
      EXPECT_STREQ(error.what(), expected);
    }
  }
  SimulationDescription s;
  s.duration = 1e30;
  try {
    require_valid_run(s);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a duration of 1e+30 s with a step of 0.001 s takes more than 1e+09 steps");
  }
  ModelDescription d = valid_description();
  d.simulation.duration = 1e9;  // a shorter run may be asked for
  EXPECT_EQ(errors(d), "no error");
}

/// Where a sentence about the step and the duration stands.
TEST(Validate, PlaceOfStepAndDuration) {
  SimulationDescription s;
  s.duration = 1e30;
  const auto place = [&] {
    try {
      require_valid_run(s);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(0, std::string(error.what()).find("a duration"));
    }
    return std::string("no error");
  };
  EXPECT_EQ(place(), "");
  s.origin.mark = {"m.yaml", 3, 1};
  EXPECT_EQ(place(), "m.yaml:3:1: ");
  s.origin.keys["duration"] = {"m.yaml", 5, 13};
  EXPECT_EQ(place(), "m.yaml:5:13: ");
  s.origin.keys["step"] = {"m.yaml", 4, 9};
  EXPECT_EQ(place(), "m.yaml:4:9: ");
  s.given_by("", "duration");  // changed by a program
  EXPECT_EQ(place(), "");
  s.given_by("--duration", "duration");
  EXPECT_EQ(place(), "--duration: ");
  s.given_by("--step", "step");
  EXPECT_EQ(place(), "--step: ");
  s.given_by("", "step");
  EXPECT_EQ(place(), "--duration: ");
  s.given_by("", "duration");
  EXPECT_EQ(place(), "");
}

TEST(Validate, AllErrorsAtOnce) {
  ModelDescription d = valid_description();
  d.simulation.step = nan;
  rigid(d).mass = -1.0;
  d.outputs[0].component = 7;
  EXPECT_EQ(errors(d),
            "bodies.block.rigid.mass: found -1, expected a number >= 0 [kg]\n"
            "outputs.z.axis: found 7, expected x, y or z\n"
            "simulation.step: found nan, expected a positive number [s] (numbers must be finite)");
}

}  // namespace
}  // namespace floatframe
