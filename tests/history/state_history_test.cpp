// The file of the states of a run: what is in it, what is read back, what is refused.
#include "floatframe/history/state_history.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/history/history_blocks.hpp"
#include "history/recorded_run.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

const Model& machine() {
  static const Model m =
      model_of(std::string(recorded_machine) + "outputs: {x: {position: stone}}\n");
  return m;
}

/// The bytes of a run's file.
std::string bytes_of(const SimulationDescription& o, const Model& model = machine()) {
  const TemporaryFolder folder;
  recorded_run(model, o, folder.file("x.ffr"));
  return folder.read("x.ffr");
}

SimulationDescription short_run() {
  SimulationDescription o = machine().simulation;
  o.duration = 0.01;
  return o;
}

TEST(StateHistory, HoldsEveryInstantAndWhatItMeans) {
  for (const Coordinates coordinates : {Coordinates::relative, Coordinates::absolute}) {
    SimulationDescription o = machine().simulation;
    o.coordinates = coordinates;
    const TemporaryFolder folder;
    const Recorded r = recorded_run(machine(), o, folder.file("x.ffr"));
    const StateHistory history(r.path);
    const HistoryHeader& h = history.header();
    EXPECT_EQ(h.coordinates, coordinates == Coordinates::relative ? "relative" : "absolute");
    EXPECT_EQ(history.status(), "completed");
    EXPECT_TRUE(history.notes().empty());
    EXPECT_TRUE(h.complete());
    ASSERT_EQ(history.instants(), r.result.table.rows());
    ASSERT_EQ(h.bodies.size(), 5u);
    EXPECT_EQ(h.bodies[2].name, "beam");
    EXPECT_EQ(h.bodies[2].modes.size(), 4u);
    EXPECT_GT(h.bodies[2].frequencies[0], 1.0);
    EXPECT_EQ(h.bodies[0].amplitudes, -1);
    std::vector<double> row(h.columns);
    const HistoryGroup& inputs = *h.find("inputs");
    for (std::size_t k = 0; k < history.instants(); ++k) {
      history.instant(k, row);
      ASSERT_EQ(row[0], r.result.table.at(k, 0));
      for (std::size_t c = 0; c < 3; ++c)  // the frame of the stone is where its output is
        ASSERT_NEAR(row[static_cast<std::size_t>(h.bodies[4].pose) + c],
                    r.result.table.at(k, 1 + c), 1e-12);
      ASSERT_EQ(row[inputs.first], 3.0);
      double unit = 0.0;
      for (int c = 3; c < 7; ++c) {
        const double x = row[static_cast<std::size_t>(h.bodies[4].pose + c)];
        unit += x * x;
      }
      ASSERT_NEAR(unit, 1.0, 1e-14);
    }
  }
}

TEST(StateHistory, PosesAndModesGiveThePlaceOfANode) {
  const Model model = model_of(std::string(recorded_machine) +
                               "outputs: {t: {position: {body: beam, node: tip}}}\n");
  const TemporaryFolder folder;
  const Recorded r = recorded_run(model, model.simulation, folder.file("x.ffr"));
  const StateHistory history(r.path);
  const HistoryHeader& h = history.header();
  const HistoryBody& beam = h.bodies[2];
  const std::string at = "shapes/" + std::to_string(beam.shape) + "/";
  const std::vector<std::string>& names = h.shapes[static_cast<std::size_t>(beam.shape)].nodes;
  const auto node =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), "tip") - names.begin());
  ASSERT_LT(node, names.size());
  const std::vector<double> p = history.numbers(at + "node_positions"),
                            X = history.numbers(at + "node_modes");
  ASSERT_EQ(p.size(), 3 * names.size());
  ASSERT_EQ(X.size(), 3 * names.size() * beam.modes.size());
  std::vector<double> row(h.columns);
  for (std::size_t k = 0; k < history.instants(); k += 10) {
    history.instant(k, row);
    const double* x = row.data() + beam.pose;
    Vec3 local;
    for (std::size_t c = 0; c < 3; ++c) {
      local[static_cast<Eigen::Index>(c)] = p[3 * node + c];
      for (std::size_t m = 0; m < 4; ++m)
        local[static_cast<Eigen::Index>(c)] +=
            X[(3 * node + c) * 4 + m] * row[static_cast<std::size_t>(beam.amplitudes) + m];
    }
    const Eigen::Quaterniond turn(x[3], x[4], x[5], x[6]);
    const Vec3 world = Vec3(x[0], x[1], x[2]) + turn * local;
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(world[static_cast<Eigen::Index>(c)], r.result.table.at(k, 1 + c), 1e-12);
  }
  EXPECT_EQ(history.numbers(at + "bars"), (std::vector<double>{0, 1, 1, 2, 2, 3, 3, 4}));
  const std::vector<double> sections = history.numbers(at + "bar_sections");
  ASSERT_EQ(sections.size(), 28u);
  EXPECT_EQ(sections[1], 0.02);
  EXPECT_EQ(sections[2], 0.01);
}

TEST(StateHistory, SurfacesHaveModes) {
  ModelDescription d = description_of(
      "bodies: {a: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}\n"
      "simulation: {duration: 0.001, step: 0.001}\n");
  BodyShape shape;
  shape.positions.resize(3, 4);
  shape.positions << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.1;
  shape.triangles = {{0, 2, 1}, {0, 1, 3}};
  shape.nodes = {4, 7, 9, 11};
  std::get<RigidDescription>(d.bodies[0].kind).shape = std::make_shared<const BodyShape>(shape);
  const Model model = build_model(d);
  const StateHistory history = StateHistory::of_bytes(bytes_of(model.simulation, model), "x");
  EXPECT_EQ(history.numbers("shapes/0/surface_triangles"), (std::vector<double>{0, 2, 1, 0, 1, 3}));
  EXPECT_EQ(history.numbers("shapes/0/surface_nodes"), (std::vector<double>{4, 7, 9, 11}));
  const std::vector<double> p = history.numbers("shapes/0/surface_positions");
  ASSERT_EQ(p.size(), 12u);
  EXPECT_EQ(p[3], 1.0);
  EXPECT_EQ(p[11], static_cast<double>(0.1f)) << "surfaces are kept in single precision";
  EXPECT_TRUE(history.numbers("shapes/0/surface_modes").empty());
}

TEST(StateHistory, SelectedBodiesIncludeTheirParents) {
  SimulationDescription o = short_run();
  o.record.bodies = {"beam"};
  const StateHistory some = StateHistory::of_bytes(bytes_of(o), "x");
  EXPECT_FALSE(some.header().complete());
  EXPECT_EQ(some.header().q.size(), 5u) << "an angle and four amplitudes";
  for (const HistoryBody& b : some.header().bodies) EXPECT_EQ(b.pose >= 0, b.name == "beam");
  o.coordinates = Coordinates::absolute;
  EXPECT_EQ(StateHistory::of_bytes(bytes_of(o), "x").header().q.size(), 16u);
  o.record.bodies = {"beem"};
  EXPECT_EQ(error_of([&] { bytes_of(o); }), "not_found");
}

TEST(StateHistory, LongRunsKeepNoMoreThanTwentyThousandInstants) {
  RecordDescription record;
  EXPECT_EQ(states_every(record, 20000), 1);
  EXPECT_EQ(states_every(record, 20001), 2);
  EXPECT_EQ(states_every(record, 600001), 31);
  record.every = 3;
  EXPECT_EQ(states_every(record, 600001), 3);
}

TEST(StateHistory, AFileThatIsCutOffKeepsItsWholeBlocks) {
  const std::string bytes = bytes_of(short_run());
  const StateHistory whole = StateHistory::of_bytes(bytes, "x");
  ASSERT_EQ(whole.instants(), 6u);
  int refused = 0, shortened = 0;
  for (std::size_t n = 0; n < bytes.size(); n += n % 97 == 0 ? 1 : 8) {
    try {
      const StateHistory cut = StateHistory::of_bytes(bytes.substr(0, n), "x");
      ++shortened;
      EXPECT_EQ(cut.status(), "running");
      // The first one is written at once.
      EXPECT_TRUE(cut.instants() == 0 || cut.instants() == 1 || cut.instants() == 6) << n;
    } catch (const InputError& error) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(shortened, 100);
}

TEST(StateHistory, AByteThatWasChangedIsNoticed) {
  const std::string bytes = bytes_of(short_run());
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::string changed = bytes;
    changed[n] = static_cast<char>(changed[n] ^ 0x10);
    try {
      const StateHistory found = StateHistory::of_bytes(std::move(changed), "x");
      // In what fills a block up to eight bytes, or in the last block, which is left out.
      EXPECT_TRUE(bytes[n] == '\0' || !found.notes().empty()) << n;
      // A length that is too large is the same as an end that is missing, and is reported.
      EXPECT_TRUE(found.instants() == 6u || !found.notes().empty()) << n;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, 3), "x: ") << n;
    }
  }
}

TEST(StateHistory, InvalidFilesAreErrors) {
  const auto error = [](const std::string& bytes) {
    return error_of([&] { StateHistory::of_bytes(bytes, "x"); });
  };
  EXPECT_EQ(error(""), "x: wrong_file");
  std::string other = history_beginning();
  EXPECT_EQ(error(other), "x: damaged");
  other[8] = 7;
  EXPECT_EQ(error(other), "x: mismatch");
  const auto with_header = [&](const std::function<void(HistoryHeader&)>& change) {
    HistoryHeader h = StateHistory::of_bytes(bytes_of(short_run()), "x").header();
    h.arrays.clear();
    change(h);
    return history_beginning() + history_block(HistoryBlockKind::head, header_json(h));
  };
  const auto changed = [&](const std::function<void(HistoryHeader&)>& change) {
    return error(with_header(change));
  };
  EXPECT_EQ(error(with_header([](HistoryHeader&) {})), "no error");
  EXPECT_EQ(changed([](HistoryHeader& h) { h.coordinates = "polar"; }), "x: wrong_value");
  EXPECT_EQ(changed([](HistoryHeader& h) { h.q[1] = h.q[0]; }), "x: out_of_range");
  EXPECT_EQ(changed([](HistoryHeader& h) { h.q.back() = h.configurations; }), "x: out_of_range");
  EXPECT_EQ(changed([](HistoryHeader& h) { h.groups[1].first = 5; }), "x: contradiction");
  EXPECT_EQ(changed([](HistoryHeader& h) { h.bodies[2].amplitudes = 0; }), "x: out_of_range");
  EXPECT_EQ(changed([](HistoryHeader& h) { h.bodies[2].shape = 9; }), "x: not_found");
  EXPECT_EQ(changed([](HistoryHeader& h) {
              h.arrays.push_back({"a", "f64", {2000000000, 2000000000, 2000000000}});
            }),
            "x: too_large");
  EXPECT_EQ(changed([](HistoryHeader& h) {
              h.arrays.push_back({"a", "f16", {1}});
            }),
            "x: wrong_value");
  const std::string plain = with_header([](HistoryHeader&) {});
  EXPECT_EQ(error(plain + history_block(HistoryBlockKind::rows, "12345678")), "x: wrong_count");
  EXPECT_EQ(error(plain + history_block(HistoryBlockKind::done, "{}")), "x: damaged");
  const std::string end =
      history_block(HistoryBlockKind::done, R"({"status": "completed", "message": ""})");
  EXPECT_EQ(error(plain + end), "no error");
  EXPECT_EQ(error(plain + end + end), "x: damaged");
}

TEST(StateHistory, NumbersThatAreNotFiniteAreRefused) {
  const std::string bytes = bytes_of(short_run());
  const StateHistory whole = StateHistory::of_bytes(bytes, "x");
  const std::size_t columns = whole.header().columns;
  std::vector<double> row(columns, 1.0);
  row[3] = std::nan("");
  HistoryHeader h = whole.header();
  h.arrays.clear();
  const std::string_view numbers(reinterpret_cast<const char*>(row.data()), 8 * columns);
  const StateHistory found = StateHistory::of_bytes(
      history_beginning() + history_block(HistoryBlockKind::head, header_json(h)) +
          history_block(HistoryBlockKind::rows, numbers),
      "x");
  ASSERT_EQ(found.instants(), 1u);
  EXPECT_EQ(error_of([&] { found.instant(0, row); }), "x: not_finite");
  EXPECT_NE(error_of([&] { found.instant(1, row); }), "no error");
  EXPECT_NE(error_of([&] { static_cast<void>(found.numbers(0)); }), "no error");
}

}  // namespace
}  // namespace floatframe::test
