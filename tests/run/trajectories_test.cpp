// Flexible pendulum and slider-crank against histories of independent integrations in minimal
// coordinates (explicit Runge-Kutta of order 8, tolerance 1e-11): both formulations, both inertia
// methods, order of convergence measured, energy balance.
#include <gtest/gtest.h>

#include "support/figures.hpp"
#include "support/trajectory_models.hpp"

namespace floatframe::test {
namespace {

using trajectories::Csv;
using trajectories::TrajectoryCase;

Csv reference_history(const std::string& name) {
  return trajectories::read_csv(std::string(FLOATFRAME_TEST_DATA) + "/trajectories/" + name +
                                ".csv");
}

/// Largest deviation of any output at any time of the reference [m].
double deviation(const RunResult& r, const TrajectoryCase& c, const Csv& reference) {
  double worst = 0.0;
  for (std::size_t i = 0; i < r.table.rows(); ++i) {
    if (std::abs(reference.rows[i][0] - r.table.at(i, 0)) > 1e-9) return NAN;
    for (std::size_t k = 0; k < c.columns.size(); ++k)
      worst = std::max(worst, std::abs(r.table.at(i, 1 + k) -
                                       reference.rows[i][reference.column(c.columns[k])]));
  }
  return worst;
}

struct Expectation {
  const char* mechanism;
  const char* mass;  ///< iso: isoparametric, both methods; eb: exact Hermite invariants
  double interval;   ///< of the reference [s]
  double span;       ///< in which the order is measured [s]
  std::vector<double> steps;
  double whole_span, whole_step;
  double whole_deviation;  ///< bound at `whole_step` [m]
  double whole_energy;     ///< bound of |energy at the end - at the start| [J]
};

class Trajectories : public ::testing::TestWithParam<Expectation> {
 protected:
  const Expectation& e = GetParam();
  const std::string name = std::string(e.mechanism) + "_" + e.mass;
  const Csv reference = reference_history(name);
  const bool swings = e.mechanism == std::string("pendulum");
  const TrajectoryCase c =
      swings ? trajectories::pendulum(e.mass) : trajectories::slider_crank(e.mass);
  const Model model = build_model(c.description);
};

TEST_P(Trajectories, ConvergeWithTheSquareOfTheStep) {
  for (const Combination& combination : combinations) {
    if (e.mass == std::string("eb") && combination.inertia == InertiaMethod::projection) continue;
    const std::string label = name + " " + combination.name();
    double previous = 0.0;
    for (const double h : e.steps) {
      const RunResult r =
          completed_run(model, with(c.description.simulation, combination, h, e.span, e.interval));
      const double error = deviation(r, c, reference);
      figure(label + " step [s]", h);
      figure(label + " error [m]", error);
      if (previous > 0.0) {
        const double order = std::log2(previous / error);
        figure(label + " order", order);
        EXPECT_GT(order, 1.9) << label << " at " << h;
        EXPECT_LT(order, 2.1) << label << " at " << h;
      }
      previous = error;
    }
  }
}

TEST_P(Trajectories, WholeSpanAtAPracticalStep) {
  for (const Combination& combination : combinations) {
    if (e.mass == std::string("eb") && combination.inertia == InertiaMethod::projection) continue;
    const std::string label = name + " " + combination.name();
    const RunResult r = completed_run(
        model, with(c.description.simulation, combination, e.whole_step, e.whole_span, e.interval));
    EXPECT_EQ(r.summary.substeps, 0);
    const double error = deviation(r, c, reference);
    const double energy = std::abs(r.summary.energy.total_end - r.summary.energy.total_start);
    figure(label + " whole span, error [m]", error);
    figure(label + " whole span, energy change [J]", energy);
    figure(label + " whole span, position constraints [m]", r.summary.max_position_violation);
    EXPECT_LT(error, e.whole_deviation);
    EXPECT_LT(energy, e.whole_energy);
    EXPECT_LT(r.summary.max_position_violation, 1e-9);
    EXPECT_LT(r.summary.max_velocity_violation, 1e-8);
  }
}

const std::vector<double> pendulum_steps{6.25e-5, 3.125e-5, 1.5625e-5, 7.8125e-6};
const std::vector<double> crank_steps{1.25e-5, 6.25e-6, 3.125e-6};

INSTANTIATE_TEST_SUITE_P(
    References, Trajectories,
    ::testing::Values(
        Expectation{"pendulum", "iso", 2e-3, 0.25, pendulum_steps, 2.0, 1e-3, 1.5e-3, 2e-6},
        Expectation{"pendulum", "eb", 2e-3, 0.25, pendulum_steps, 2.0, 1e-3, 1.5e-3, 2e-6},
        Expectation{"slider_crank", "iso", 5e-4, 0.03, crank_steps, 0.3, 5e-4, 0.035, 6e-3},
        Expectation{"slider_crank", "eb", 5e-4, 0.03, crank_steps, 0.3, 5e-4, 0.035, 6e-3}),
    [](const ::testing::TestParamInfo<Expectation>& i) {
      return std::string(i.param.mechanism) + "_" + i.param.mass;
    });

}  // namespace
}  // namespace floatframe::test
