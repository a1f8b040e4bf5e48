// Studies in one process: figures of rows, sharing of models, options, failures.
#include "floatframe/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "floatframe/description/simulation_option.hpp"
#include "floatframe/run/results.hpp"
#include "floatframe/sweep/sweep_run.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

const char* const pendulum = R"(
floatframe: 1
parameters: {mass: 2, push: 0, step: 0.01}
bodies:
  rod: {rigid: {mass: "${mass}", centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.2, 0.2]}}
joints:
  hinge: {type: revolute, child: rod, at: [0, 0, 0], axis: y, velocity: "${push}"}
outputs:
  tip.z: {position: {body: rod, at: [1, 0, 0]}, axis: z}
simulation: {step: "${step}", duration: 0.2}
)";

class Sweep : public testing::Test {
 protected:
  void SetUp() override {
    options_.model = folder_.write("pendulum.yaml", pendulum);
    options_.folder = folder_.file("out");
  }
  SweepReport run() {
    return run_sweep(options_, stop_, [](const SweepProgress&) {});
  }
  std::string error() {
    return test::error_of([&] { run(); });
  }

  test::TemporaryFolder folder_;
  SweepOptions options_;
  std::atomic<bool> stop_{false};
};

TEST(SweepRow, FiguresOfAKnownCurve) {
  RunResult result;
  result.table.columns = {{"time", "s"}, {"a", "m"}, {"b", ""}};
  // a: 0, 3, -1 at t = 0, 1, 3
  result.table.data = {0, 0, 5, 1, 3, 5, 3, -1, 5};
  const auto value = [&](const SweepRow& row, const std::string& title) {
    for (const auto& [name, text] : row.fields)
      if (name == title) return text;
    return std::string("missing");
  };
  const SweepRow all = sweep_row(result, {});
  EXPECT_EQ(value(all, "a final [m]"), "-1");
  EXPECT_EQ(value(all, "a min [m]"), "-1");
  EXPECT_EQ(value(all, "a time of min [s]"), "3");
  EXPECT_EQ(value(all, "a max [m]"), "3");
  EXPECT_EQ(value(all, "a time of max [s]"), "1");
  // integral of a^2: 1 * (0 + 9) / 2 + 2 * (9 + 1) / 2 = 14.5 over 3 s
  EXPECT_DOUBLE_EQ(std::stod(value(all, "a rms [m]")), std::sqrt(14.5 / 3.0));
  EXPECT_EQ(value(all, "b rms"), "5");
  const SweepRow some = sweep_row(result, {sweep_measure("a:max"), sweep_measure("b")});
  EXPECT_EQ(value(some, "a max [m]"), "3");
  EXPECT_EQ(value(some, "a rms [m]"), "missing");
  EXPECT_EQ(value(some, "b final"), "5");
  EXPECT_EQ(value(some, "time reached [s]"), "0");
}

TEST(SweepCsv, ColumnsOfAllRowsAndQuotes) {
  const std::vector<SweepRow> rows{{"completed", "", {{"x [m]", "1"}, {"y [m]", "2"}}},
                                   {"failed", "a, \"b\"\nc", {{"z", "3"}, {"x [m]", "4"}}}};
  EXPECT_EQ(sweep_csv({"p", "q,r"}, {{"1", "a,b"}, {"2", "c"}}, rows),
            "run,p,\"q,r\",status,message,x [m],y [m],z\n"
            "1,1,\"a,b\",completed,,1,2,\n"
            "2,2,c,failed,\"a, \"\"b\"\" c\",4,,3\n");
}

TEST_F(Sweep, ParametersBeforeSimulationOptions) {
  options_.plan = grid_plan({"step=0.02,0.05", "simulation.step=0.01,0.04", "inertia=projection"});
  options_.fixed = {{"duration", "0.4"}};
  std::atomic<bool> stop{false};
  SweepRunner runner(options_, stop);
  EXPECT_EQ(runner.prepare(0).simulation.step, 0.01);
  EXPECT_EQ(runner.prepare(3).simulation.step, 0.04);
  EXPECT_EQ(runner.prepare(3).simulation.duration, 0.4);
  EXPECT_EQ(runner.prepare(3).simulation.inertia, InertiaMethod::projection);
}

// Every option by name: it can be set, and a wrong value is refused.
TEST(SimulationOption, AllNames) {
  for (const std::string& name : simulation_option_names()) {
    SimulationDescription s;
    EXPECT_NE(set_simulation_option(s, name, "rubbish"), "") << name;
    EXPECT_NE(set_simulation_option(s, name, "-1"), "") << name;
    const bool word = name == "coordinates" || name == "inertia" || name == "start" ||
                      name == "locate_edges" || name == "input";
    const std::string good = name == "coordinates"    ? "absolute"
                             : name == "inertia"      ? "projection"
                             : name == "start"        ? "equilibrium"
                             : name == "locate_edges" ? "true"
                             : name == "input"        ? "ramp"
                                                      : "1";
    EXPECT_EQ(set_simulation_option(s, name, good), "") << name;
    EXPECT_TRUE(word || !set_simulation_option(s, name, "true").empty()) << name;
  }
  SimulationDescription s;
  EXPECT_EQ(set_simulation_option(s, "step", "0"), "found '0', expected a positive number [s]");
  s.step = 1e-12;
  s.duration = 1.0;
  EXPECT_EQ(simulation_error(s),
            "a duration of 1 s with a step of 1e-12 s takes more than 1e+09 steps");
}

TEST_F(Sweep, RunsThatShareAModelShareTheObject) {
  options_.plan = grid_plan({"mass=2,3", "step=0.01,0.02", "push=1"});
  std::atomic<bool> stop{false};
  SweepRunner runner(options_, stop);
  const auto model = [&](std::size_t run) { return runner.model(run, runner.prepare(run)); };
  const auto a = model(0), same = model(0), other_step = model(1), other_mass = model(2);
  EXPECT_EQ(a, same);
  // Another step is another model.simulation, but the bodies are the same objects.
  EXPECT_NE(a, other_step);
  EXPECT_EQ(other_step->simulation.step, 0.02);
  EXPECT_EQ(a->bodies[0].data, other_step->bodies[0].data);
  EXPECT_NE(a->bodies[0].data, other_mass->bodies[0].data);
  EXPECT_EQ(other_mass->bodies[0].data->invariants.m, 3.0);
}

TEST_F(Sweep, TableDoesNotDependOnThreads) {
  options_.plan = grid_plan({"push=-2:2:5", "mass=1,2", "coordinates=relative,absolute"});
  EXPECT_EQ(run().finished, 20u);
  const std::string one = folder_.read("out/sweep.csv");
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 21);
  options_.threads = 3;
  options_.folder = folder_.file("three");
  run();
  EXPECT_EQ(folder_.read("three/sweep.csv"), one);
}

TEST_F(Sweep, FailedRunsHaveRows) {
  // A rod between two bodies, one of them driven away: too short for the second value, torn in the
  // third.
  options_.model = folder_.write("tie.yaml", R"(
floatframe: 1
parameters: {length: 2, far: 0}
bodies:
  slider: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.1, 0.1, 0.1]}}
  crank: {position: [1, 0, 0], rigid: {mass: 1, centre_of_mass: [1.25, 0, 0],
      inertia: [0.1, 0.1, 0.1]}}
joints:
  drive: {type: prismatic, child: slider, at: [0, 0, 0], axis: x,
      motion: {polynomial: [0, "${far}"]}}
  hinge: {type: revolute, child: crank, at: [1, 0, 0], axis: y}
rods:
  tie: {from: {body: slider, at: [0, 0, 0]}, to: {body: crank, at: [1, 0, 0.75]},
      length: "${length}"}
outputs:
  slider.x: {position: slider, axis: x}
simulation: {step: 0.01, duration: 1}
)");
  options_.plan.names = {"length", "far"};
  options_.plan.runs = {{"1.25", "0"}, {"9", "0"}, {"1.25", "-2"}};
  options_.plan.origins.assign(3, "--vary");
  const SweepReport report = run();
  EXPECT_EQ(report.finished, 3u);
  EXPECT_EQ(report.failed, 2u);
  EXPECT_EQ(report.first_failed, 2u);
  const std::string table = folder_.read("out/sweep.csv");
  EXPECT_TRUE(test::contains(table, "\n1,1.25,0,completed,,1,"));
  EXPECT_TRUE(test::contains(table, "\n2,9,0,failed,"));
  EXPECT_TRUE(test::contains(table, "\n3,1.25,-2,failed,step failed at t = "));
  // Continuing does not repeat failures.
  EXPECT_EQ(run().before, 3u);
}

TEST_F(Sweep, ARunThatTakesTooLongIsARowAndCanBeRepeated) {
  options_.plan = grid_plan({"duration=0.1,1000000,0.2"});
  options_.threads = 2;
  options_.limits.seconds = 2.0;
  options_.keep_results = true;
  SweepReport report = run();
  EXPECT_EQ(report.failed, 1u);
  EXPECT_EQ(report.first_failed, 2u);
  EXPECT_EQ(report.first_message, "stopped after 2 s (--case-timeout)");
  EXPECT_TRUE(test::contains(folder_.read("out/sweep.csv"),
                             "\n2,1000000,failed,stopped after 2 s (--case-timeout),,"));
  EXPECT_TRUE(test::contains(folder_.read("out/runs/2/summary.json"), "stopped after 2 s"));
  options_.limits.seconds = 1.5;  // no part of what the study is
  EXPECT_EQ(run().before, 3u);
  options_.retry_failed = true;
  report = run();
  EXPECT_EQ(report.before, 2u);
  EXPECT_EQ(report.first_message, "stopped after 1.5 s (--case-timeout)");
}

TEST_F(Sweep, BadInputIsRefusedBeforeAnythingIsWritten) {
  options_.plan = grid_plan({"mas=1,2"});
  EXPECT_EQ(error(), "unknown_key");
  options_.plan = grid_plan({"mass=1,x,y", "push=1,2"});  // each error once
  EXPECT_EQ(error(), options_.model + ": wrong_value\n" + options_.model + ": wrong_value");
  options_.plan = grid_plan({"mass=1,2", "tolerance=0,1e-9"});
  EXPECT_EQ(error(), "wrong_value");
  options_.plan = grid_plan({"mass=1,2"});
  options_.measures = {sweep_measure("tip.x")};
  EXPECT_EQ(error(), "not_found");
  options_.measures.clear();
  options_.fixed = {{"mass", "3"}};
  EXPECT_EQ(error(), "duplicate");
  EXPECT_FALSE(std::filesystem::exists(options_.folder));
}

TEST_F(Sweep, ContinuesWhereItWasStopped) {
  options_.plan = grid_plan({"push=1:2:6"});
  run();
  const std::string table = folder_.read("out/sweep.csv"),
                    journal = folder_.read("out/sweep.journal");
  // The state after a kill: three finished runs and a torn line; no table.
  std::size_t cut = 0;
  for (int lines = 0; lines < 4; ++lines) cut = journal.find('\n', cut) + 1;
  folder_.write("out/sweep.journal", journal.substr(0, cut + 30));
  std::filesystem::remove(options_.folder + "/sweep.csv");
  const SweepReport report = run();
  EXPECT_EQ(report.before, 3u);
  EXPECT_EQ(folder_.read("out/sweep.csv"), table);
  const std::string continued = folder_.read("out/sweep.journal");
  EXPECT_EQ(std::count(continued.begin(), continued.end(), '\n'), 7);

  folder_.write("pendulum.yaml", std::string(pendulum) + "# changed\n");
  EXPECT_EQ(error(), "mismatch") << error();
  options_.fresh = true;
  EXPECT_EQ(run().before, 0u);
}

TEST_F(Sweep, StoppedAtOnceItFinishesNothingMore) {
  options_.plan = grid_plan({"push=1:2:6"});
  std::atomic<bool> stop{false};
  const SweepReport report = run_sweep(options_, stop, [&](const SweepProgress& p) {
    if (p.stage == SweepProgress::Stage::running && p.done > 0) stop.store(true);
  });
  EXPECT_TRUE(report.interrupted || report.finished == 6u);
  EXPECT_EQ(std::filesystem::exists(options_.folder + "/sweep.csv"), !report.interrupted);
}

TEST_F(Sweep, PlansOfAProgram) {
  options_.plan.names = {"push"};
  EXPECT_EQ(error(), "out_of_range");
  options_.plan.runs = {{"1"}, {"2", "3"}};
  EXPECT_EQ(error(), "wrong_count");
  options_.plan.runs = {{"1"}, {"2"}};
  options_.plan.origins = {"here"};
  EXPECT_EQ(error(), "wrong_count");
  options_.plan.origins.clear();
  options_.threads = 0;
  EXPECT_EQ(error(), "out_of_range");
  options_.threads = 1;
  EXPECT_EQ(run_sweep(options_, stop_, {}).finished, 2u);  // no progress asked for
  options_.plan.names = {"pull"};
  EXPECT_EQ(error(), "unknown_key") << error();
}

}  // namespace
}  // namespace floatframe
