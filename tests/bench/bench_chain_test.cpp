#include "floatframe/bench/bench_chain.hpp"

#include <gtest/gtest.h>

#include <string>

#include "floatframe/bench/bench_scaling.hpp"
#include "floatframe/bench/chain_model.hpp"
#include "floatframe/bench/solid_link.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "floatframe/run/run.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

/// The chain as a user would write it.
std::string chain_file(int links, int elements) {
  std::string points, bodies, joints;
  for (int i = 0; i <= links; ++i)
    points += "  p" + std::to_string(i) + ": [" + std::to_string(i) + ", 0, 0]\n";
  for (int i = 0; i < links; ++i) {
    const std::string from = "p" + std::to_string(i), to = "p" + std::to_string(i + 1);
    const std::string name = "link_" + std::to_string(i + 1);
    bodies += "  " + name +
              ":\n    flexible:\n"
              "      material: {young: 2.0e11, poisson: 0.3, density: 7500}\n"
              "      bars:\n        bar: {from: " +
              from + ", to: " + to + ", elements: " + std::to_string(elements) +
              ", section: {rectangle: [0.02, 0.02]}}\n"
              "      clamped: [" +
              from + "]\n      static_modes:\n";
    for (const char* dof : {"z", "ry", "y", "rz", "x", "rx"})
      bodies += "        - {point: " + to + ", dofs: [" + dof + "]}\n";
    bodies += "      normal_modes: 2\n";
    joints += "  hinge_" + std::to_string(i + 1) +
              ": {type: revolute, parent: " + (i == 0 ? "ground" : "link_" + std::to_string(i)) +
              ", child: " + name + ", at: " + from + ", axis: y}\n";
  }
  const std::string last = std::to_string(links);
  return "floatframe: 1\nname: chain_" + last + "\npoints:\n" + points + "bodies:\n" + bodies +
         "joints:\n" + joints + "outputs:\n  tip: {position: {body: link_" + last + ", at: p" +
         last + "}}\nsimulation: {step: 0.001, duration: 2}\n";
}

TEST(ChainModel, EqualsTheModelFile) {
  const test::TemporaryFolder folder;
  const Model read = build_model(read_model(folder.write("chain.yaml", chain_file(3, 6))));
  const Model made = build_model(chain_model(3, 8, 6));
  EXPECT_EQ(made.name, read.name);
  EXPECT_EQ(made.gravity, read.gravity);
  ASSERT_EQ(made.bodies.size(), read.bodies.size());
  for (std::size_t i = 0; i < made.bodies.size(); ++i) {
    EXPECT_EQ(made.bodies[i].name, read.bodies[i].name);
    const FlexibleBody &a = *made.bodies[i].data, &b = *read.bodies[i].data;
    EXPECT_EQ(made.bodies[i].X_WB.p, read.bodies[i].X_WB.p);
    EXPECT_NEAR(a.invariants.m, 3.0, 1e-12);
    EXPECT_EQ(a.invariants.m, b.invariants.m);
    ASSERT_EQ(a.K.rows(), 8);
    ASSERT_EQ(b.K.rows(), 8);
    EXPECT_LE((a.K - b.K).cwiseAbs().maxCoeff(), 1e-12 * b.K.cwiseAbs().maxCoeff());
  }
  SimulationDescription options = made.simulation;
  EXPECT_EQ(options.step, read.simulation.step);
  EXPECT_EQ(options.duration, read.simulation.duration);
  options.duration = 0.3;
  const ResultTable a = run(made, options).table, b = run(read, options).table;
  ASSERT_EQ(a.columns.size(), 4u);
  ASSERT_EQ(b.columns.size(), 4u);
  ASSERT_EQ(a.rows(), 301u);
  ASSERT_EQ(b.rows(), 301u);
  for (std::size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(a.columns[c].name, b.columns[c].name);
    for (std::size_t row = 0; row < a.rows(); ++row) ASSERT_NEAR(a.at(row, c), b.at(row, c), 1e-9);
  }
  EXPECT_LT(a.at(300, 3), -0.2);  // it did fall
}

TEST(ChainModel, StartsLevelAndUndeformedAtRest) {
  const Model model = build_model(chain_model(5, 8, 4));
  const auto stepper = std::make_unique<BenchStepper>(model, model.simulation);
  EXPECT_LT((stepper->sample() - Eigen::Vector4d(0, 5, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(stepper->energies().kinetic, 0.0);
  EXPECT_EQ(stepper->energies().elastic, 0.0);
  EXPECT_EQ(stepper->freedoms(), 5 * (1 + 8));
}

TEST(ChainModel, AnyNumberOfModesUpToTheLargest) {
  for (const int modes : {1, 4, 6, 8})
    EXPECT_EQ(build_model(chain_model(1, modes, 4)).bodies[0].modes(), modes);
  EXPECT_EQ(largest_chain_modes(4), 8);
  EXPECT_THROW(build_model(chain_model(1, 10, 4)), InputError);
}

TEST(BenchChain, TipMatchesTheReference) {
  ChainOptions options;
  options.links = {4};
  options.duration = 1.0;
  options.seconds = 1e3;  // the check run may take what it takes
  options.inertia = {InertiaMethod::preprocessing};
  options.runs = 1;
  options.most_runs = 1;
  const ChainResult result = bench_chain(options);
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(result.tip_reference_step, 5e-5);
  EXPECT_GT(result.dense_llt, 0.0);
  for (const ChainRow& row : result.rows) {
    SCOPED_TRACE(row.combination.coordinates == Coordinates::relative ? "relative" : "absolute");
    EXPECT_EQ(row.failure, "");
    ASSERT_TRUE(row.tip_error.has_value());
    ASSERT_TRUE(row.tip_published.has_value());
    EXPECT_LT(*row.tip_error, 3e-5);
    EXPECT_GT(*row.tip_error, 0.0);
    EXPECT_LT(*row.tip_published, 3e-4);
    EXPECT_LT(row.energy_drift, 1e-3);
    EXPECT_EQ(row.time.steps, 1000);
    EXPECT_EQ(row.time.counts.steps, 1000);
    EXPECT_EQ(row.time.runs, 1);
    EXPECT_GE(row.time.counts.iterations, 1000);
    EXPECT_GE(row.time.least, 0.0);
    EXPECT_LE(row.time.least, row.time.median);
  }
}

TEST(BenchChain, AFailedRowHasItsReasonAndOthersRun) {
  ChainOptions options;
  options.links = {2, 1};
  options.duration = 0.02;
  options.step = 0.01;
  options.elements = 4;
  options.seconds = 0.001;
  options.tolerance = 1e-300;  // no step can reach it
  options.coordinates = {Coordinates::relative};
  options.inertia = {InertiaMethod::preprocessing};
  const ChainResult result = bench_chain(options);
  ASSERT_EQ(result.rows.size(), 2u);
  for (const ChainRow& row : result.rows)
    EXPECT_NE(row.failure.find("step failed at t"), row.failure.npos);
}

TEST(BenchStepper, StepsAsARunDoes) {
  const Model model = build_model(chain_model(2, 8, 4));
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    SimulationDescription options = model.simulation;
    options.coordinates = coordinates;
    options.duration = 0.1;
    const RunResult result = run(model, options);
    const auto stepper = std::make_unique<BenchStepper>(model, options);
    ASSERT_TRUE(stepper->advance(60));
    ASSERT_TRUE(stepper->advance(40));
    const VecX row = stepper->sample();
    for (Eigen::Index c = 0; c < 4; ++c)
      EXPECT_NEAR(row[c], result.table.at(100, static_cast<std::size_t>(c)), 1e-12);
    EXPECT_EQ(stepper->counts().steps, 100);
    stepper->restart();
    EXPECT_EQ(stepper->counts().steps, 0);
    EXPECT_EQ(stepper->counts().iterations, 0);
    ASSERT_TRUE(stepper->advance(100));
    EXPECT_EQ(stepper->sample(), row);  // to the last bit
  }
}

TEST(BenchScaling, BrickLinksAreLikeBeamLinks) {
  ReductionOptions options;
  options.clamped = {{"start", all_dofs}};
  options.interfaces = {{"end", all_dofs}};
  options.normal_modes = 2;
  for (const int across : {1, 3, 9}) {
    const FeModel mesh = solid_link(across, 50);
    EXPECT_EQ(mesh.nodes(), (across + 1) * (across + 1) * 51 + 2);
    const FlexibleBody link = reduce(mesh, options);
    EXPECT_NEAR(link.invariants.m, 3.0, 1e-9);
    const Model chain = build_model(chain_model(1, 8, 20));
    const FlexibleBody& beam = *chain.bodies[0].data;
    ASSERT_EQ(link.fixed_interface_frequencies.size(), 2);
    EXPECT_NEAR(link.fixed_interface_frequencies[0] / beam.fixed_interface_frequencies[0], 1.0,
                0.25);
  }
}

TEST(BenchScaling, SameWorkWhateverTheMesh) {
  ScalingOptions options;
  options.sweeps = {Sweep::modes};
  options.steps = 5;
  options.runs = 1;
  options.seconds = 1e-6;
  options.coordinates = {Coordinates::relative};
  const ScalingResult result = bench_scaling(options);
  ASSERT_EQ(result.rows.size(), 5u);
  for (const ScalingRow& row : result.rows) {
    EXPECT_EQ(row.failure, "");
    EXPECT_EQ(row.freedoms, row.links * (1 + row.modes));
    EXPECT_EQ(row.value, row.modes);
    EXPECT_GE(row.time.steps, 1);
    EXPECT_GT(row.iteration, 0.0);
  }
  EXPECT_EQ(round_steps(1), 1);
  EXPECT_EQ(round_steps(4), 2);
  EXPECT_EQ(round_steps(5), 5);
  EXPECT_EQ(round_steps(1999), 1000);
  EXPECT_EQ(round_steps(2000), 2000);
}

}  // namespace
}  // namespace floatframe
