// The flexible Iltis on the road of the benchmark: absolute against relative coordinates,
// projection against preprocessing, constraint levels, substeps, growth of a perturbation beyond
// the stairs, left-right symmetry. The stairs begin at 3.8 s.
#include <gtest/gtest.h>

#include <algorithm>

#include "floatframe/formulation/relative.hpp"
#include "floatframe/start/initial_state.hpp"
#include "floatframe/stepping/stepper.hpp"
#include "support/figures.hpp"
#include "support/iltis.hpp"

namespace floatframe::test {
namespace {

constexpr const char* heights[] = {"chassis.z", "front_left.wheel.z"};

TEST(IltisRuns, AbsoluteAndRelativeMeetWithTheSquareOfTheStep) {
  const ModelDescription d = iltis({{"spectral_radius", "1"}, {"tolerance", "1e-11"}});
  const Model model = build_model(d);
  double previous = 0.0;
  for (const double h : {2e-3, 1e-3, 5e-4, 2.5e-4}) {
    const RunResult a = completed_run(model, with(d.simulation, combinations[2], h, 3.5, 0.01));
    const RunResult b = completed_run(model, with(d.simulation, combinations[0], h, 3.5, 0.01));
    const double chassis = difference(a.table, b.table, heights[0]);
    const double wheel = difference(a.table, b.table, heights[1]);
    const double both = std::max(chassis, wheel);
    figure("step [s]", h);
    figure("absolute - relative, chassis height [m]", chassis);
    figure("absolute - relative, wheel height [m]", wheel);
    if (previous > 0.0) {
      figure("ratio to the step before", previous / both);
      EXPECT_GT(previous / both, 3.6) << h;
      EXPECT_LT(previous / both, 4.4) << h;
    }
    previous = both;
  }
}

TEST(IltisRuns, ProjectionEqualsPreprocessingBeforeTheStairs) {
  const ModelDescription d = iltis({{"tolerance", "1e-11"}});
  const Model model = build_model(d);
  for (const double h : {0.01, 0.001}) {
    for (const int k : {0, 2}) {
      const RunResult p = completed_run(model, with(d.simulation, combinations[k], h, 3.5, 0.01));
      const RunResult b =
          completed_run(model, with(d.simulation, combinations[k + 1], h, 3.5, 0.01));
      for (const char* name : heights) {
        const double x = difference(p.table, b.table, name);
        figure("step " + std::to_string(h) + " s, " + (k == 0 ? "relative" : "absolute") +
                   ", projection - preprocessing, " + name + " [m]",
               x);
        EXPECT_LT(x, 1e-9);
      }
    }
  }
}

TEST(IltisRuns, ConstraintLevelsThroughoutTheManoeuvre) {
  const ModelDescription d = iltis();
  const Model model = build_model(d);
  for (const Combination& c : combinations) {
    const RunResult r = completed_run(model, with(d.simulation, c, 0.01, 8.0));
    EXPECT_EQ(r.summary.steps, 800);
    figure(c.name() + " position constraints [m]", r.summary.max_position_violation);
    figure(c.name() + " velocity constraints [m/s]", r.summary.max_velocity_violation);
    figure(c.name() + " substeps", static_cast<double>(r.summary.substeps));
    figure(c.name() + " iterations", static_cast<double>(r.summary.iterations));
    figure(c.name() + " factorizations", static_cast<double>(r.summary.factorizations));
    figure(c.name() + " cpu [s]", r.summary.cpu);
    for (const char* name : heights) {
      figure(c.name() + " lowest " + name + " [m]", minimum(r.table, name).value);
      figure(c.name() + " highest " + name + " [m]", maximum(r.table, name).value);
      figure(c.name() + " last " + name + " [m]",
             r.table.at(r.table.rows() - 1, column(r.table, name)));
    }
    EXPECT_LT(r.summary.max_position_violation, 1e-9);
    EXPECT_LT(r.summary.max_velocity_violation, 1e-8);
    // The curves of the paper: chassis 0.5 to 2.6 m, wheel 0.3 to 2.4 m.
    EXPECT_NEAR(minimum(r.table, heights[0]).value, 0.5, 0.1);
    EXPECT_NEAR(maximum(r.table, heights[0]).value, 2.6, 0.05);
    EXPECT_NEAR(minimum(r.table, heights[1]).value, 0.3, 0.05);
    EXPECT_NEAR(maximum(r.table, heights[1]).value, 2.4, 0.05);
  }
}

TEST(IltisRuns, LeftAndRightStayEqual) {
  const ModelDescription d = iltis();
  const Model model = build_model(d);
  for (const Combination& c : combinations) {
    const RunResult r = completed_run(model, with(d.simulation, c, 0.01, 8.0));
    double worst = 0.0, before_stairs = 0.0;
    for (const std::string axle : {"front", "rear"}) {
      const std::size_t left = column(r.table, axle + "_left.wheel.z");
      const std::size_t right = column(r.table, axle + "_right.wheel.z");
      for (std::size_t i = 0; i < r.table.rows(); ++i) {
        const double x = std::abs(r.table.at(i, left) - r.table.at(i, right));
        worst = std::max(worst, x);
        if (r.table.at(i, 0) < 3.75) before_stairs = std::max(before_stairs, x);
      }
    }
    figure(c.name() + " left - right wheel height before the stairs [m]", before_stairs);
    figure(c.name() + " left - right wheel height [m]", worst);
    figure(c.name() + " largest roll [rad]", std::max(maximum(r.table, "chassis.roll").value,
                                                      -minimum(r.table, "chassis.roll").value));
    EXPECT_LT(before_stairs, 1e-9);
    // On the stairs rounding errors grow (GrowthOfAPerturbation): to 2e-8 .. 2.4e-7 m, whatever the
    // Newton tolerance.
    EXPECT_LT(worst, 1e-6);
  }
}

TEST(IltisRuns, GrowthOfAPerturbation) {
  // 1e-13 m on the chassis height at the start; compared at the same step.
  for (const double h : {0.01, 0.001}) {
    const ModelDescription d = iltis({{"tolerance", "1e-11"}});
    const Model model = build_model(d);
    std::vector<std::vector<double>> z;
    for (const double shift : {0.0, 1e-13}) {
      SimulationDescription o = with(d.simulation, Coordinates::relative);
      o.step = h;
      Stepper steps(model, o);
      StepperMemory m = steps.memory();
      m.state.q[2] += shift;
      start_accelerations(steps.formulation(), m.state, steps.step_options().penalty_mass);
      steps.set_memory(m);
      std::vector<double> row(model.outputs.size() + 1);
      z.emplace_back();
      for (long k = 0; k < std::lround(8.0 / h); ++k) {
        ASSERT_TRUE(steps.advance()) << steps.failure();
        steps.sample(row.data());
        z.back().push_back(row[3]);  // time, chassis.x, .y, .z
      }
    }
    for (const double t : {1.0, 2.0, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 7.0, 8.0}) {
      const std::size_t n = std::lround(t / h);
      double worst = 0.0;
      for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::abs(z[0][i] - z[1][i]));
      char name[100];
      std::snprintf(name, sizeof name, "step %g s: 1e-13 m has grown by %g s to [m]", h, t);
      figure(name, worst);
      if (t <= 3.5) {
        EXPECT_LT(worst, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace floatframe::test
