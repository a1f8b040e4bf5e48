// The key `record`, the text of a model with the values of its parameters, outputs from elsewhere.
#include <gtest/gtest.h>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

const std::string two_bodies = R"(
parameters: {m: 2, name: "a \"b\"", on: true, off: false}
points: {p: [0, "${m / 2}", 0]}
bodies:
  arm: {rigid: {mass: "${m}", centre_of_mass: p, inertia: [1, 1, "${m * 0.5}"]}}
  other: {when: "${off}", rigid: {mass: 1, centre_of_mass: p, inertia: [1, 1, 1]}}
  tip: {rigid: {mass: 1, centre_of_mass: [1, 1, 0], inertia: [1, 1, 1]}}
joints:
  hinge: {type: revolute, child: arm, at: p, axis: z}
  end: {type: spherical, parent: arm, child: tip, at: [0.5, 1, 0]}
forces:
  push:
    type: force
    body: arm
    at: p
    direction: [0, 1, 0]
    magnitude: {table: [[0, 0], [1, "${3 * m}"]]}
outputs:
  "tip: height": {position: tip, axis: y}
)";

RecordDescription record_of(const std::string& value) {
  return description_of(two_bodies + "simulation: {record: " + value + "}\n").simulation.record;
}

TEST(Record, IsReadInAllItsForms) {
  using States = RecordDescription::States;
  EXPECT_EQ(description_of(two_bodies).simulation.record.states, States::by_command);
  EXPECT_EQ(record_of("none").states, States::none);
  EXPECT_EQ(record_of("states").states, States::states);
  EXPECT_EQ(record_of("states").every, 0);
  const RecordDescription r =
      record_of("{states: {every: 5, bodies: [tip, arm], accelerations: false}}");
  EXPECT_EQ(r.states, States::states);
  EXPECT_EQ(r.every, 5);
  EXPECT_EQ(r.bodies, (std::vector<std::string>{"tip", "arm"}));
  EXPECT_FALSE(r.accelerations);
  EXPECT_TRUE(contains(error_of([] { record_of("{states: {bodies: [ground]}}"); }), "bodies[1]: "));
}

ModelFingerprint used_by(const std::string& path, ModelDescription& description) {
  ModelFingerprint used;
  ReadOptions options;
  options.keep_text = true;
  description = read_model(path, {{"m", "3"}}, &used, options);
  return used;
}

TEST(ResolvedText, IsTheModelFileWithTheValuesOfItsParameters) {
  const TemporaryFolder folder;
  const std::string path = folder.write("m.yaml", "floatframe: 1\n" + two_bodies);
  ModelDescription description;
  const ModelFingerprint used = used_by(path, description);
  EXPECT_FALSE(contains(used.text, "${"));
  EXPECT_FALSE(contains(used.text, "parameters"));
  const std::string again = folder.write("again/m.yaml", used.text);
  EXPECT_EQ(model_hash(build_model(read_model(again))), model_hash(build_model(description)));
}

TEST(ResolvedText, HasSubsystemsAsSeparateDocuments) {
  const TemporaryFolder folder;
  folder.write("part.yaml",
               "floatframe: 1\nparameters: {k: 1}\nbodies: {a: {rigid: {mass: \"${k}\", "
               "centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}\n");
  const std::string path =
      folder.write("m.yaml",
                   "floatframe: 1\nparameters: {m: 1}\nsubsystems: {left: {file: part.yaml, "
                   "parameters: {k: 7}}}\n");
  ModelDescription description;
  const std::string text = folder.without(used_by(path, description).text);
  EXPECT_TRUE(contains(text,
                       "\n--- # left (part.yaml)\nfloatframe: 1\nbodies:\n  a:\n    rigid:\n"
                       "      mass: 7\n"));
}

TEST(AddedOutputs, FollowThoseOfTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("m.yaml", "floatframe: 1\n" + two_bodies);
  ReadOptions options;
  options.outputs = {"a: {joint_position: hinge}", "{b: {force: push}, c: {velocity: tip}}"};
  const ModelDescription d = read_model(path, {}, nullptr, options);
  ASSERT_EQ(d.outputs.size(), 6u);
  EXPECT_EQ(d.outputs[1].name, "a");
  EXPECT_EQ(d.outputs[5].name, "c.z");
  options.outputs = {"a: {joint_position: hinge, axis: x}", "[1", "3"};
  const std::string error = error_of([&] { read_model(path, {}, nullptr, options); });
  EXPECT_TRUE(contains(error, "--add:1:"));
}

TEST(Shapes, BarsHaveSections) {
  const Model model = model_of(R"(
points: {p: [0, 0, 0], q: [1, 0, 0], r: [1, 1, 0]}
bodies:
  frame:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars:
        one: {from: p, to: q, elements: 2, section: {rectangle: [0.02, 0.01]}}
        two: {from: q, to: r, elements: 1, section: {tube: [0.03, 0.024]}}
      clamped: [p]
      normal_modes: 2
)");
  ASSERT_TRUE(model.bodies[0].data->shape);
  const std::vector<BodyShape::Bar>& bars = model.bodies[0].data->shape->bars;
  ASSERT_EQ(bars.size(), 3u);
  EXPECT_EQ(bars[1].from, bars[0].to);
  EXPECT_EQ(bars[1].width, 0.02);
  EXPECT_EQ(bars[1].height, 0.01);
  EXPECT_FALSE(bars[1].round);
  EXPECT_TRUE(bars[2].round);
  EXPECT_DOUBLE_EQ(bars[2].inner, 0.8);
  EXPECT_NEAR(bars[2].y.norm(), 1.0, 1e-15);
  EXPECT_NEAR(bars[2].y.y(), 0.0, 1e-15) << "across the bar";
}

}  // namespace
}  // namespace floatframe::test
