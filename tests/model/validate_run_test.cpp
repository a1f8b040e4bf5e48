// Every option of a run, one change at a time, as `build_model` and as `run` are given it.
#include <gtest/gtest.h>

#include "floatframe/description/validate.hpp"
#include "support/error_of.hpp"
#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

TEST(Validate, Simulation) {
  using S = SimulationDescription;
  const std::pair<std::function<void(S&)>, const char*> cases[] = {
      {[](S& s) { s.step = nan; }, "simulation.step: out_of_range"},
      {[](S& s) { s.step = 0.0; }, "simulation.step: out_of_range"},
      {[](S& s) { s.step = -1.0; }, "simulation.step: out_of_range"},
      {[](S& s) { s.duration = inf; }, "simulation.duration: out_of_range"},
      {[](S& s) { s.output_interval = -1.0; }, "simulation.output_interval: out_of_range"},
      {[](S& s) { s.max_iterations = -1; }, "simulation.max_iterations: out_of_range"},
      {[](S& s) { s.spectral_radius = 5.0; }, "simulation.spectral_radius: out_of_range"},
      {[](S& s) { s.tolerance = 0.0; }, "simulation.tolerance: out_of_range"},
      {[](S& s) { s.tolerance = 1e300; }, "simulation.tolerance: out_of_range"},
      {[](S& s) { s.position_tolerance = 2.0; }, "simulation.position_tolerance: out_of_range"},
      {[](S& s) { s.velocity_tolerance = 2.0; }, "simulation.velocity_tolerance: out_of_range"},
      {[](S& s) { s.min_step = 1.0; }, "simulation.min_step: out_of_range"},
      {[](S& s) { s.penalty = nan; }, "simulation.penalty: out_of_range"},
      {[](S& s) { s.position_tolerance = 0.0; }, "simulation.position_tolerance: out_of_range"},
      {[](S& s) { s.velocity_tolerance = -1.0; }, "simulation.velocity_tolerance: out_of_range"},
      {[](S& s) { s.velocity.y() = nan; }, "simulation.velocity[2]: out_of_range"},
      {[](S& s) { s.coordinates = static_cast<Coordinates>(2); },
       "simulation.coordinates: wrong_value"},
      {[](S& s) { s.inertia = static_cast<InertiaMethod>(-1); }, "simulation.inertia: wrong_value"},
      {[](S& s) { s.start = static_cast<Start>(5); }, "simulation.start: wrong_value"},
      {[](S& s) { s.start = Start::state; }, "simulation.start: missing"},
      {[](S& s) { s.offset["block"].translation.x() = 0.1; },
       "simulation.start.offset: incomplete"},
      {[](S& s) {
         s.start = Start::equilibrium;
         s.offset["block"].translation.x() = nan;
       },
       "simulation.start.offset.block[1]: out_of_range"},
  };
  for (const auto& [change, expected] : cases) {
    ModelDescription d = valid_description();
    change(d.simulation);
    EXPECT_EQ(errors(d), expected);
    // And what a run is given beside the model.
    EXPECT_EQ(error_of([&, &run = d.simulation] { require_valid_run(run); }), expected);
  }
  SimulationDescription s;
  s.duration = 1e30;
  EXPECT_EQ(error_of([&] { require_valid_run(s); }), "out_of_range");
  ModelDescription d = valid_description();
  d.simulation.duration = 1e9;  // a shorter run may be asked for
  EXPECT_EQ(errors(d), "no error");
}

/// Where a sentence about the step and the duration stands.
TEST(Validate, PlaceOfStepAndDuration) {
  SimulationDescription s;
  s.duration = 1e30;
  const auto place = [&] {
    const std::string text = sentences_of([&] { require_valid_run(s); });
    return text.substr(0, text.find("a duration"));
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
            "bodies.block.rigid.mass: out_of_range\noutputs.z.axis: wrong_value\nsimulation.step: "
            "out_of_range");
}

}  // namespace
}  // namespace floatframe
