// States that are kept and started from, in both formulations, and starts away from an equilibrium.
#include "floatframe/start/system_state.hpp"

#include <gtest/gtest.h>

#include "floatframe/model/model.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/model_file/state_json.hpp"
#include "floatframe/start/statics.hpp"
#include "support/completed_run.hpp"
#include "support/error_of.hpp"
#include "support/stepping_models.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

/// All kinds of joints that a state must hold: a driven crank that turns many times with a slider
/// behind it (a loop), a flexible pendulum, a universal joint, a ball joint, a free body.
const std::string machine =
    "floatframe: 1\n" + test::machine_bodies +
    R"(  top: {rigid: {mass: 1, centre_of_mass: [0, 2, 0.1], inertia: [0.02, 0.03, 0.04]}}
  bob: {rigid: {mass: 1, centre_of_mass: [0, 3, -0.3], inertia: [0.02, 0.02, 0.01]}}
  stone: {rigid: {mass: 1, centre_of_mass: [0, 4, 0], inertia: [0.02, 0.03, 0.04]}}
)" + test::machine_joints +
    R"(  cross: {type: universal, child: top, at: [0, 2, 0], axis: x, axis_2: y, velocity: [1, 2]}
  ball: {type: spherical, child: bob, at: [0, 3, 0], position: [0.2, 0.1, 0], velocity: [0.5, 1, 3]}
  loose: {type: free, child: stone, at: [0, 4, 0], position: [0, 0, 0.1, 0.3, 0.2, 0.1],
      velocity: [1, 0, 2, 1, 9, 2]}
forces:
  spring: {type: spring_damper, from: {body: ground, at: [0, 4, 3]}, to: {body: stone,
      at: [0, 4, 0.1]}, spring: 20}
  wave: {type: force, body: stone, at: [0, 4, 0], direction: x, magnitude: {sine: {amplitude: 3,
      frequency: 2}}}
outputs:
  drive: {joint_position: drive}
  eye: {joint_position: eye}
  hinge: {joint_position: hinge}
  cross: {joint_position: cross, coordinate: 2}
  tip: {position: {body: beam, node: tip}, axis: z}
  bob: {position: {body: bob, at: [0, 3, -0.3]}}
  stone: {position: stone}
  turn: {rotation: stone, angle: pitch}
  y1: {modal_amplitude: beam, mode: 1}
simulation: {step: 1.0e-3, duration: 0.4, output_interval: 0.01}
)";

ModelDescription read_text(const std::string& text, const std::string& state = "") {
  const test::TemporaryFolder folder;
  folder.write("state.json", state);
  return read_model(folder.write("model.yaml", text));
}

SystemState copy_through_file(const SystemState& state) {
  const test::TemporaryFolder folder;
  return read_state(folder.write("copy.json", state_json(state)));
}

RunResult run_keeping(const Model& model, const SimulationDescription& o) {
  RunOptions options;
  options.keep_state = true;
  return run(model, o, options);
}

TEST(SystemState, FilesHoldEveryBit) {
  const Model model = build_model(read_text(machine));
  const SystemState s = *run_keeping(model, model.simulation).state;
  const SystemState r = copy_through_file(s);
  EXPECT_EQ(r.model, s.model);
  EXPECT_EQ(r.time, s.time);
  ASSERT_EQ(r.joints.size(), s.joints.size());
  for (std::size_t k = 0; k < s.joints.size(); ++k) {
    EXPECT_EQ(r.joints[k].name, s.joints[k].name);
    EXPECT_EQ(r.joints[k].type, s.joints[k].type);
    EXPECT_EQ(r.joints[k].position, s.joints[k].position);
    EXPECT_EQ(r.joints[k].velocity, s.joints[k].velocity);
  }
  ASSERT_EQ(r.bodies.size(), s.bodies.size());
  for (std::size_t k = 0; k < s.bodies.size(); ++k) {
    EXPECT_EQ(r.bodies[k].name, s.bodies[k].name);
    EXPECT_EQ(r.bodies[k].position, s.bodies[k].position);
    EXPECT_EQ(r.bodies[k].orientation, s.bodies[k].orientation);
    EXPECT_EQ(r.bodies[k].velocity, s.bodies[k].velocity);
    EXPECT_EQ(r.bodies[k].angular_velocity, s.bodies[k].angular_velocity);
    EXPECT_EQ(r.bodies[k].amplitudes, s.bodies[k].amplitudes);
    EXPECT_EQ(r.bodies[k].amplitude_rates, s.bodies[k].amplitude_rates);
  }
  EXPECT_NEAR(s.joints[0].position[0], 0.3 + 40.0 * 0.4, 1e-9);  // turns are counted
}

/// The first sample is the state itself; what follows differs by the accelerations, which a start
/// finds anew and a step carries along with the error of its Newton iterations.
TEST(SystemState, TwoRunsAreOne) {
  const Model model = build_model(read_text(machine));
  for (const Coordinates first : test::both_coordinates)
    for (const Coordinates second : test::both_coordinates) {
      SimulationDescription o = test::with(model.simulation, second);
      o.duration = 0.8;
      const ResultTable whole = run(model, o).table;
      o.duration = 0.4;
      o.coordinates = first;
      const RunResult begun = run_keeping(model, o);
      o.coordinates = second;
      o.start = Start::state;
      o.state = std::make_shared<const SystemState>(copy_through_file(*begun.state));
      const RunResult continued = test::completed_run(model, o);
      EXPECT_NEAR(continued.summary.duration, 0.4, 1e-12);
      ASSERT_EQ(continued.table.rows(), 41u);
      ASSERT_EQ(whole.rows(), 81u);
      double at_start = 0.0, later = 0.0;
      for (std::size_t row = 0; row < 41; ++row)
        for (std::size_t c = 0; c < whole.columns.size(); ++c) {
          const double difference = std::abs(continued.table.at(row, c) - whole.at(40 + row, c));
          (row == 0 ? at_start : later) = std::max(row == 0 ? at_start : later, difference);
        }
      const bool same = first == second;
      EXPECT_LT(at_start, same ? 1e-11 : 2e-4);  // two formulations: their own difference
      EXPECT_LT(later, same ? 1e-8 : 2e-4);
      std::printf("[ figure ] continued_run_difference %.1e at the start, %.1e later\n", at_start,
                  later);
    }
}

TEST(SystemState, ContinuesInTheOtherFormulation) {
  const Model model = build_model(read_text(machine));
  for (const Coordinates first : test::both_coordinates) {
    SimulationDescription o = test::with(model.simulation, first);
    const RunResult begun = run_keeping(model, o);
    o.coordinates = first == Coordinates::relative ? Coordinates::absolute : Coordinates::relative;
    o.start = Start::state;
    o.state = begun.state;
    o.duration = 0.0;
    const RunResult continued = run(model, o);
    ASSERT_EQ(continued.table.rows(), 1u);
    for (std::size_t c = 0; c < begun.table.columns.size(); ++c)
      EXPECT_NEAR(continued.table.at(0, c), begun.table.at(40, c), 1e-9)
          << begun.table.columns[c].name;
  }
}

const char* const suspended = R"(floatframe: 1
bodies:
  chassis: {rigid: {mass: 100, centre_of_mass: [0, 0, 1], inertia: [5, 10, 12]}}
  wheel: {rigid: {mass: 10, centre_of_mass: [1, 0, 1], inertia: [1, 1, 1]}}
joints:
  free: {type: free, child: chassis, at: [0, 0, 1]}
  arm: {type: revolute, parent: chassis, child: wheel, at: [0.3, 0, 1], axis: y}
forces:
  front: {type: spring_damper, from: {body: ground, at: [0.5, 0.3, 3]}, to: {body: chassis,
      at: [0.5, 0.3, 1]}, spring: 1000}
  rear: {type: spring_damper, from: {body: ground, at: [-0.5, 0, 3]}, to: {body: chassis,
      at: [-0.5, 0, 1]}, spring: 1000}
  left: {type: spring_damper, from: {body: ground, at: [0.5, -0.3, 3]}, to: {body: chassis,
      at: [0.5, -0.3, 1]}, spring: 1000}
  spring: {type: joint_spring, joint: arm, spring: 500}
outputs:
  c: {position: chassis}
  turn: {rotation: chassis}
  w: {position: wheel}
  arm: {joint_position: arm}
simulation: {step: 1.0e-3, duration: 0.05, start: equilibrium}
)";

TEST(SystemState, OfTheStaticsStartsInTheEquilibrium) {
  const Model model = build_model(read_text(suspended));
  SimulationDescription o = model.simulation;
  const StaticsResult equilibrium = statics(model);
  ASSERT_TRUE(equilibrium.state);
  const SystemState state = copy_through_file(*equilibrium.state);
  EXPECT_EQ(state.time, 0.0);
  EXPECT_LT((state.bodies[0].position - equilibrium.bodies[0].position).norm(), 1e-14);
  for (const Coordinates coordinates : test::both_coordinates) {
    o.coordinates = coordinates;
    o.start = Start::equilibrium;
    const ResultTable a = run(model, o).table;
    o.start = Start::state;
    o.state = std::make_shared<const SystemState>(state);
    const ResultTable b = run(model, o).table;
    ASSERT_EQ(a.data.size(), b.data.size());
    for (std::size_t i = 0; i < a.data.size(); ++i) EXPECT_NEAR(a.data[i], b.data[i], 1e-10);
  }
}

TEST(SystemState, OffsetsFromTheEquilibrium) {
  const Model model = build_model(read_text(suspended));
  SimulationDescription o = model.simulation;
  o.duration = 0.0;
  const ResultTable rest = run(model, o).table;
  const SystemState::Body level = statics(model).state->bodies[0];
  for (const Coordinates coordinates : test::both_coordinates) {
    o.coordinates = coordinates;
    // The chassis goes up as it is oriented, the wheel on its arm goes with it.
    o.offset = {{"chassis", {Vec3(0, 0, 0.05), std::nullopt}}};
    const ResultTable up = run(model, o).table;
    const double expected[] = {0, 0, 0.05, 0, 0, 0, 0, 0, 0.05, 0};
    for (std::size_t c = 0; c < 10; ++c)
      EXPECT_NEAR(up.at(0, 1 + c) - rest.at(0, 1 + c), expected[c], 1e-9) << c;
    // Six numbers: turned about the world's x axis.
    o.offset = {{"chassis", {Vec3(0, 0, 0.05), Vec3(0.1, 0, 0)}}};
    const SystemState::Body turned = run_keeping(model, o).state->bodies[0];
    EXPECT_NEAR(turned.position.z() - rest.at(0, 3), 0.05, 1e-9);
    const auto rotation = [](const Eigen::Vector4d& q) {
      return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    };
    const Mat3 by = rotation(turned.orientation) * rotation(level.orientation).transpose();
    EXPECT_LT((by - rotation_exp(Vec3(0.1, 0, 0))).cwiseAbs().maxCoeff(), 1e-9);
    // What the joint does not let move is turned about it: the wheel's origin goes on its circle.
    o.offset = {{"wheel", {Vec3(0, 0, 0.05), std::nullopt}},
                {"chassis", {Vec3::Zero(), Vec3::Zero()}}};
    EXPECT_NE(test::error_of([&] { run(model, o); }), "no error");
  }
  o.offset = {{"nobody", {Vec3(0, 0, 0.05), std::nullopt}}};
  EXPECT_EQ(test::error_of([&] { run(model, o); }), "not_found");
}

TEST(SystemState, OffsetsFromAState) {
  const Model model = build_model(read_text(machine));
  SimulationDescription o = model.simulation;
  const RunResult begun = run_keeping(model, o);
  o.start = Start::state;
  o.state = begun.state;
  o.duration = 0.0;
  o.offset = {{"stone", {Vec3(0, 0.1, 0), std::nullopt}}};
  const ResultTable moved = run(model, o).table;
  const std::size_t stone = begun.table.columns.size() - 3;
  EXPECT_EQ(begun.table.columns[stone].name, "stone.z");
  EXPECT_NEAR(moved.at(0, stone - 1) - begun.table.at(40, stone - 1), 0.1, 1e-9);
  EXPECT_NEAR(moved.at(0, stone), begun.table.at(40, stone), 1e-9);
  EXPECT_NEAR(moved.at(0, 0), 0.4, 1e-15);
  // A driven crank stays where its motion has it.
  o.offset = {{"crank", {Vec3(0, 0.1, 0), std::nullopt}}};
  const std::string text = test::error_of([&] { run(model, o); });
  const std::string expected = "not_assembled";
  EXPECT_EQ(text.substr(0, expected.size()), expected);
}

TEST(SystemState, OfAnotherModel) {
  const Model model = build_model(read_text(suspended));
  const SystemState state = *statics(model).state;
  const auto start = [&](const std::function<void(SystemState&)>& change) {
    auto s = std::make_shared<SystemState>(state);
    s->file = "s.json";
    change(*s);
    SimulationDescription o = model.simulation;
    o.start = Start::state;
    o.state = s;
    std::string text = test::error_of([&] { run(model, o); });
    const std::size_t end = text.find(" (the state was taken of");
    return end == std::string::npos ? text : text.substr(0, end);
  };
  EXPECT_EQ(start([](SystemState&) {}), "no error");
  EXPECT_EQ(start([](SystemState& s) { s.joints.pop_back(); }), "s.json: duplicate");
  EXPECT_EQ(start([](SystemState& s) { s.joints.push_back(s.joints[0]); }), "s.json: duplicate");
  EXPECT_EQ(start([](SystemState& s) { s.bodies[0].name = "chasis"; }), "s.json: not_found");
  EXPECT_EQ(start([](SystemState& s) { s.joints[1].type = JointType::prismatic; }),
            "s.json: wrong_count");
  EXPECT_EQ(start([](SystemState& s) { s.joints[1].position.push_back(0.0); }),
            "s.json: wrong_count");
  EXPECT_EQ(start([](SystemState& s) { s.joints[1].velocity[0] = NAN; }), "s.json: not_finite");
  EXPECT_EQ(start([](SystemState& s) { s.time = INFINITY; }), "s.json: not_finite");
  const std::string late = start([](SystemState& s) { s.time = -1e17; });
  EXPECT_EQ(late.substr(0, late.find(" of ")), "s.json: out_of_range");
  EXPECT_EQ(start([&](SystemState& s) { s.time = 0.9e9 * model.simulation.step; }), "no error");
  EXPECT_NE(start([&](SystemState& s) { s.time = 1.1e9 * model.simulation.step; }), "no error");
  EXPECT_EQ(start([](SystemState& s) { s.bodies[1].amplitudes = VecX::Zero(2); }),
            "s.json: wrong_count");
  const std::string moved = start([](SystemState& s) { s.bodies[0].position.z() += 0.5; });
  const std::string expected = "s.json: contradiction";
  EXPECT_EQ(moved.substr(0, expected.size()), expected);
}

TEST(SystemState, DamagedFiles) {
  const auto read = [](const std::string& text) {
    const test::TemporaryFolder folder;
    const std::string file = folder.write("damaged.json", text) + ": ";
    const std::string error = test::error_of([&] { read_state(folder.file("damaged.json")); });
    return error.starts_with(file) ? error.substr(file.size()) : error;
  };
  EXPECT_EQ(read(""), "wrong_file");
  EXPECT_EQ(read("{\"floatframe_state\": 1, "), "wrong_file");
  EXPECT_EQ(read("[1, 2]"), "wrong_file");
  EXPECT_EQ(read("{\"floatframe_state\": 2}"), "mismatch");
  EXPECT_EQ(read("{\"floatframe_state\": 1}"), "missing");
  const std::string head = "{\"floatframe_state\": 1, \"model\": \"m\", ";
  EXPECT_EQ(read(head + "\"time\": null}"), "out_of_range");
  EXPECT_EQ(read(head + "\"time\": 0, \"joints\": [], \"bodies\": {}}"), "wrong_value");
  EXPECT_EQ(read(head + "\"time\": 0, \"joints\": {\"a\": {\"type\": \"pin\"}}}"), "wrong_value");
  EXPECT_EQ(read(head + "\"time\": 0, \"joints\": {\"a\": {\"type\": \"weld\", \"position\": "
                        "[\"1\"], \"velocity\": []}}}"),
            "out_of_range");
  EXPECT_EQ(read(head + "\"time\": 0, \"joints\": {}, \"bodies\": {\"b\": {\"position\": [0]}}}"),
            "wrong_count");
  EXPECT_EQ(read(head + "\"time\": 0, \"joints\": {}, \"bodies\": {\"b\": {\"position\": [0, 0, "
                        "0], \"quaternion\": [2, 0, 0, 0]}}}"),
            "wrong_value");
}

TEST(SystemState, OfAModelFile) {
  const Model model = build_model(read_text(suspended));
  const std::string state = state_json(*statics(model).state);
  std::string text = suspended;
  const std::string word = "start: equilibrium";
  const auto with = [&](const std::string& start) {
    return std::string(suspended).replace(text.find(word), word.size(), "start: " + start);
  };
  const ModelDescription d =
      read_text(with("{state: state.json, offset: {chassis: [0, 0, 0.05]}}"), state);
  EXPECT_EQ(d.simulation.start, Start::state);
  ASSERT_TRUE(d.simulation.state);
  EXPECT_EQ(d.simulation.offset.at("chassis").translation, Vec3(0, 0, 0.05));
  EXPECT_FALSE(d.simulation.offset.at("chassis").rotation);
  const ModelDescription e =
      read_text(with("{equilibrium: true, offset: {wheel: [0, 0, 0, 0, 0.1, 0]}}"), state);
  EXPECT_EQ(e.simulation.start, Start::equilibrium);
  EXPECT_EQ(e.simulation.offset.at("wheel").rotation.value(), Vec3(0, 0.1, 0));
  EXPECT_EQ(read_text(with("{equilibrium: false}")).simulation.start, Start::given);
  EXPECT_EQ(read_text(with("given")).simulation.start, Start::given);
}

}  // namespace
}  // namespace floatframe
