// Motions without mass that stiffness holds: a straight bar without inertia about its axis on a
// ball joint, with a body at its other end. They follow by statics, and the energy of the rest is
// kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "floatframe/model_file/load_model.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/allocation_counter.hpp"
#include "support/completed_run.hpp"

namespace floatframe::test {
namespace {

Model bar_on_ball_joint() {
  return load_model(std::string(FLOATFRAME_TEST_DATA) + "/loops/bar_on_ball_joint.yaml");
}

/// The largest change of the energy [J].
double energy_error(const Model& model, Coordinates coordinates, double step, double duration) {
  SimulationDescription o = with(model.simulation, coordinates);
  o.step = o.output_interval = step;
  o.duration = duration;
  const RunResult r = completed_run(model, o);
  const auto energy = [&](std::size_t row) {
    double sum = 0.0;
    for (const char* part : {"T1", "T2", "V1", "V2", "U"})
      sum += r.table.at(row, r.table.column(part));
    return sum;
  };
  double most = 0.0;
  for (std::size_t row = 0; row < r.table.rows(); ++row)
    most = std::max(most, std::abs(energy(row) - energy(0)));
  std::printf(
      "[ figure ] bar on a ball joint, step %g, %g s: largest error of the energy [J] %.3g\n", step,
      duration, most);
  return most;
}

TEST(MasslessMotion, EnergyOfABarOnABallJointIsOfSecondOrder) {
  const Model model = bar_on_ball_joint();
  for (const Coordinates coordinates : both_coordinates) {
    double first = 0.0, last = 1e-3;  // 6e3 J with a trapezoidal rule
    for (const double step : {1e-3, 5e-4, 2e-4, 1e-4, 5e-5}) {
      const double error = energy_error(model, coordinates, step, 20.0);
      EXPECT_LT(error, 0.5 * last);
      if (first == 0.0) first = error;
      last = error;
    }
    EXPECT_LT(last, 2e-6);
    EXPECT_GT(first / last, 100.0);
  }
}

TEST(MasslessMotion, FormulationsAgree) {
  Model model = bar_on_ball_joint();
  model.simulation.duration = 2.0;
  model.simulation.step = 2e-4;
  model.simulation.output_interval = 0.01;
  SimulationDescription o = with(model.simulation, Coordinates::relative);
  const RunResult a = run(model, o);
  o.coordinates = Coordinates::absolute;
  const RunResult b = run(model, o);
  double most = 0.0;
  for (const char* name : {"p.x", "p.y", "p.z"})
    for (std::size_t row = 0; row < a.table.rows(); ++row)
      most = std::max(most, std::abs(a.table.at(row, a.table.column(name)) -
                                     b.table.at(row, b.table.column(name))));
  EXPECT_LT(most, 1e-5);
}

TEST(MasslessMotion, StepsDoNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  const Model model = bar_on_ball_joint();
  for (const Coordinates coordinates : both_coordinates) {
    Simulation s(model, {.step = 2e-4, .coordinates = coordinates});
    const AllocationScope scope;
    for (int k = 0; k < 50; ++k) EXPECT_TRUE(s.step());
    EXPECT_EQ(scope.count(), 0u);
  }
}

TEST(MasslessMotion, CheckSuggestsInertia) {
  const std::vector<std::string> notes = check(bar_on_ball_joint()).start.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("body 'beam' has a motion without mass") != std::string::npos &&
           note.find("section_inertia: true") != std::string::npos;
  }));
}

}  // namespace
}  // namespace floatframe::test
