// Outputs from the states of a run are those of a run that had them from the start.
#include "floatframe/history/new_channels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "floatframe/core/build_info.hpp"
#include "floatframe/history/recorded_motion.hpp"
#include "history/recorded_run.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

const std::string own_outputs = R"(
outputs:
  slider: {position: slider, axis: x}
  spin: {joint_position: spin}
)";

/// Each kind of output, the costly ones last.
const std::string plain_outputs = R"(
  tip: {position: {body: beam, node: tip}}
  tip_v: {velocity: {body: beam, node: tip}, axis: z}
  tip_a: {acceleration: {body: beam, node: tip}}
  stone: {rotation: stone}
  stone_w: {angular_velocity: stone, axis: y}
  stone_aa: {angular_acceleration: stone, axis: y}
  turns: {joint_position: spin}
  rate: {joint_velocity: hinge}
  y1: {modal_amplitude: beam, mode: 1}
  y2: {modal_rate: beam, mode: 2}
  y3: {modal_acceleration: beam, mode: 3}
  coil: {force: coil}
  coil_power: {power: coil}
  apart: {distance: {from: crank, to: slider}}
  kinetic: {kinetic_energy: beam}
  height: {potential_energy: stone}
  strain: {elastic_energy: beam}
)";
const std::string reaction_outputs = R"(
  guide: {joint_force: guide}
  root: {joint_torque: hinge}
  tie: {rod_force: tie}
  motor: {motion_force: drive}
)";

std::size_t added(const Model& more) { return more.outputs.size() - 2; }

struct ChannelCase {
  Coordinates coordinates;
  InertiaMethod inertia;
  bool reactions;
};

class NewChannels : public ::testing::TestWithParam<ChannelCase> {
 protected:
  std::string more() const {
    return std::string(recorded_machine) + own_outputs + plain_outputs +
           (GetParam().reactions ? reaction_outputs : "");
  }
  SimulationDescription options(const Model& model) const {
    SimulationDescription o = model.simulation;
    o.coordinates = GetParam().coordinates;
    o.inertia = GetParam().inertia;
    return o;
  }
};

TEST_P(NewChannels, EqualThoseOfARunThatHadThemToTheBit) {
  const TemporaryFolder folder;
  const Model before = model_of(std::string(recorded_machine) + own_outputs);
  const Model after = model_of(more());
  const SimulationDescription o = options(before);
  recorded_run(before, o, folder.file("states.ffr"));
  const RunResult whole = run(after, o);
  ASSERT_EQ(whole.summary.status, "completed") << whole.summary.message;
  const StateHistory history(folder.file("states.ffr"));
  EXPECT_NO_THROW(require_model(history, before));
  const ResultTable found = new_channels(history, after, o, added(after));
  ASSERT_EQ(found.rows(), whole.table.rows());
  ASSERT_EQ(found.columns.size(), added(after) + 1);
  for (std::size_t c = 1; c < found.columns.size(); ++c) {
    EXPECT_EQ(found.columns[c].name, whole.table.columns[c + 2].name);
    EXPECT_EQ(found.columns[c].unit, whole.table.columns[c + 2].unit);
    for (std::size_t r = 0; r < found.rows(); ++r) {
      const double a = found.at(r, c), b = whole.table.at(r, c + 2);
      ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0)
          << found.columns[c].name << " at row " << r << ": " << a << ", " << b;
    }
  }
}

TEST_P(NewChannels, WithoutAccelerationsTheyAreSolvedFor) {
  const TemporaryFolder folder;
  const Model before = model_of(std::string(recorded_machine) + own_outputs);
  const Model after = model_of(more());
  SimulationDescription o = options(before);
  const RunResult whole = run(after, o);
  o.record.accelerations = false;
  recorded_run(before, o, folder.file("states.ffr"));
  const StateHistory history(folder.file("states.ffr"));
  EXPECT_EQ(history.header().find("accelerations"), nullptr);
  const ResultTable found = new_channels(history, after, o, added(after));
  ASSERT_EQ(found.rows(), whole.table.rows());
  for (std::size_t c = 1; c < found.columns.size(); ++c) {
    double largest = 0.0, difference = 0.0;
    for (std::size_t r = 0; r < found.rows(); ++r) {
      largest = std::max(largest, std::abs(whole.table.at(r, c + 2)));
      difference = std::max(difference, std::abs(found.at(r, c) - whole.table.at(r, c + 2)));
    }
    const std::string& name = found.columns[c].name;
    const bool accelerated = name.starts_with("tip_a") || name == "stone_aa" || name == "y3";
    // Reactions and the accelerations with them satisfy the equations at (q, v): no more is needed.
    // A torque that is zero is so to rounding of torques of 1 N m.
    const double allowed = GetParam().reactions ? 1e-12 : accelerated ? 1e-3 : 0.0;
    EXPECT_LE(difference, allowed * (largest + (GetParam().reactions ? 1.0 : 0.0))) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, NewChannels,
    ::testing::Values(ChannelCase{Coordinates::relative, InertiaMethod::preprocessing, false},
                      ChannelCase{Coordinates::relative, InertiaMethod::preprocessing, true},
                      ChannelCase{Coordinates::relative, InertiaMethod::projection, true},
                      ChannelCase{Coordinates::absolute, InertiaMethod::preprocessing, false},
                      ChannelCase{Coordinates::absolute, InertiaMethod::preprocessing, true}));

TEST(NewChannelsOfSomeBodies, AreThoseOfTheseBodies) {
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    const TemporaryFolder folder;
    const std::string text = std::string(recorded_machine) + own_outputs;
    const Model before = model_of(text);
    const Model after = model_of(text + "  tip: {acceleration: {body: beam, node: tip}}\n");
    SimulationDescription o = before.simulation;
    o.coordinates = coordinates;
    const RunResult whole = run(after, o);
    o.record.bodies = {"beam"};
    o.record.every = 4;
    recorded_run(before, o, folder.file("states.ffr"));
    const StateHistory history(folder.file("states.ffr"));
    const ResultTable found = new_channels(history, after, o, 3);
    ASSERT_EQ(found.rows(), 39u) << "of 151: every fourth, and the last";
    for (std::size_t r = 0; r < found.rows(); ++r)
      for (std::size_t c = 1; c < 4; ++c)
        EXPECT_EQ(found.at(r, c), whole.table.at(std::min<std::size_t>(4 * r, 150), c + 2));
    const auto error = [&](const std::string& output) {
      const Model other = model_of(text + output);
      return error_of([&] { new_channels(history, other, o, 1); });
    };
    EXPECT_EQ(error("  x: {position: stone, axis: x}\n"), history.name() + ": missing");
    EXPECT_EQ(error("  x: {joint_force: hinge, axis: x}\n"), history.name() + ": missing");
  }
}

/// Outputs say the same of places, velocities, amplitudes and accelerations.
TEST(RecordedMotion, IsThatOfMarkersAndOutputs) {
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    const TemporaryFolder folder;
    const Model model = model_of(std::string(recorded_machine) + R"(
outputs:
  p: {position: {body: stone}}
  v: {velocity: {body: stone}}
  a: {acceleration: {body: stone}}
  y: {modal_amplitude: beam, mode: 2}
  yd: {modal_rate: beam, mode: 2}
  ydd: {modal_acceleration: beam, mode: 2}
)");
    SimulationDescription o = model.simulation;
    o.coordinates = coordinates;
    const RunResult whole = recorded_run(model, o, folder.file("states.ffr")).result;
    const StateHistory history(folder.file("states.ffr"));
    RecordedMotion motion(history, model, o);
    ASSERT_EQ(motion.instants(), whole.table.rows());
    for (const std::size_t k : {motion.instants() - 1, std::size_t{0}, std::size_t{77}}) {
      const SystemMotion& view = motion.at(k);
      EXPECT_EQ(view.t, whole.table.at(k, 0));
      const int beam = 2, stone = 4;
      ASSERT_EQ(model.bodies[stone].name, "stone");
      EXPECT_TRUE(motion.recorded(stone));
      for (int i = 0; i < 3; ++i) {
        const auto column = static_cast<std::size_t>(i);
        EXPECT_NEAR(view.body(stone).p_WB[i], whole.table.at(k, 1 + column), 1e-12);
        EXPECT_NEAR(view.body(stone).v_WB[i], whole.table.at(k, 4 + column), 1e-11);
        EXPECT_NEAR(view.body(stone).a_WB[i], whole.table.at(k, 7 + column), 1e-9);
      }
      EXPECT_EQ(view.body(beam).y[1], whole.table.at(k, 10));
      EXPECT_EQ(view.body(beam).yd[1], whole.table.at(k, 11));
      EXPECT_EQ(view.body(beam).ydd[1], whole.table.at(k, 12));
      EXPECT_EQ(motion.outputs().size(), 13u);
    }
    EXPECT_THROW(motion.at(motion.instants()), InputError);
  }
}

// A leg that touches after 0.2 s: its law has another branch there than at the start.
TEST(NewChannelsOfEdges, AreOnTheBranchOfTheRecordedPosition) {
  const std::string text = R"(
bodies: {m: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.01, 0.01, 0.01]}}}
joints: {g: {type: prismatic, child: m, at: [0, 0, 0], axis: z, position: 0.2}}
forces:
  leg:
    {type: spring_damper, from: {body: ground, at: [0, 0, -1]}, to: {body: m, at: [0, 0, 0]},
     spring: {table: [[0.5, -2000], [1, 0], [3, 0]]}}
simulation: {step: 0.005, duration: 0.3, locate_edges: true}
outputs:
  z: {position: m, axis: z}
)";
  const TemporaryFolder folder;
  const Model before = model_of(text), after = model_of(text + "  f: {force: leg}\n");
  const std::string path = folder.file("states.ffr");
  recorded_run(before, before.simulation, path);
  const ResultTable run_again = run(after, after.simulation).table;
  const ResultTable added = new_channels(StateHistory(path), after, after.simulation, 1);
  ASSERT_EQ(added.rows(), run_again.rows());
  double least = 0.0;
  for (std::size_t k = 0; k < added.rows(); ++k) {
    EXPECT_NEAR(added.at(k, 1), run_again.at(k, 2), 1e-9);
    least = std::min(least, added.at(k, 1));
  }
  EXPECT_LT(least, -50.0);
}

TEST(NewChannelsErrors, StatesOfAnotherCopyOfTheProgramAreRefused) {
  const TemporaryFolder folder;
  const Model model = model_of(std::string(recorded_machine) + own_outputs);
  HistoryOrigin origin;
  origin.library = build_description();
  recorded_run(model, model.simulation, folder.file("own.ffr"), origin);
  EXPECT_NO_THROW(require_model(StateHistory(folder.file("own.ffr")), model));
  origin.library = "0.0.1, Debug, GNU 1.0, z80";
  recorded_run(model, model.simulation, folder.file("other.ffr"), origin);
  EXPECT_EQ(error_of([&] { require_model(StateHistory(folder.file("other.ffr")), model); }),
            folder.file("other.ffr") + ": mismatch");
}

TEST(NewChannelsErrors, ImpulsesAndOtherModelsAreRefused) {
  const TemporaryFolder folder;
  const std::string text = std::string(recorded_machine) + own_outputs;
  const Model model = model_of(text);
  recorded_run(model, model.simulation, folder.file("states.ffr"));
  const StateHistory history(folder.file("states.ffr"));
  const Model other = model_of(text + "  x: {projection_impulse: guide, axis: y}\n");
  EXPECT_EQ(error_of([&] { new_channels(history, other, other.simulation, 1); }),
            history.name() + ": unsupported");
  EXPECT_EQ(test::without_folders(error_of([&] { require_model(history, other); })),
            "states.ffr: mismatch");
  const Model small =
      model_of("bodies: {a: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}\n");
  EXPECT_EQ(error_of([&] { new_channels(history, small, small.simulation, 1); }),
            history.name() + ": mismatch");
}

}  // namespace
}  // namespace floatframe::test
