// A model in one file builds what the model file builds, and steps with the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "floatframe/body/solid_shapes.hpp"
#include "floatframe/model/model_hash.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/packed/pack.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/temporary_folder.hpp"
#include "support/valid_description.hpp"

namespace floatframe::test {
namespace {

struct NamedModel {
  std::string file;
  ModelDescription description;
};

/// All model files of the examples and of the benchmarks.
std::vector<NamedModel> all_models() {
  std::vector<NamedModel> models;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(FLOATFRAME_EXAMPLES)) {
    if (entry.path().extension() != ".yaml") continue;
    try {
      models.push_back({entry.path().string(), load_description(entry.path().string())});
    } catch (const InputError&) {
      continue;  // part of a model, or of something else
    }
  }
  return models;
}

/// As it comes from a file.
PackedModel through_bytes(const PackedModel& model) {
  const std::vector<std::byte> bytes = model.to_bytes();
  const PackedModel read = PackedModel::from_bytes(bytes);
  EXPECT_EQ(read.to_bytes(), bytes);
  EXPECT_EQ(read.fingerprint(), model.fingerprint());
  return read;
}

/// The outputs of some steps, one instant after the other.
std::vector<double> outputs_of(const Model& model, Coordinates coordinates, int steps) {
  std::vector<double> all;
  Simulation s(model, {.coordinates = coordinates});
  for (int k = 0; k < steps && s.step(); ++k)
    all.insert(all.end(), s.outputs().begin(), s.outputs().end());
  return all;
}

TEST(PackedModel, BuildsWhatTheModelFileBuilds) {
  const std::vector<NamedModel> models = all_models();
  EXPECT_GT(models.size(), 20u);
  for (const auto& [file, d] : models) {
    SCOPED_TRACE(file);
    const Model model = build_model(d);
    for (const auto contents : {PackOptions::Contents::all, PackOptions::Contents::steps}) {
      const Model again = through_bytes(packed(d, model, {.contents = contents})).build();
      EXPECT_EQ(model_hash(again), model_hash(model));
      EXPECT_EQ(again.hints.notes, model.hints.notes);
      EXPECT_EQ(again.markers.size(), model.markers.size());
    }
  }
}

TEST(PackedModel, StepsWithTheSameBits) {
  for (const char* name :
       {"slider_crank", "crane_with_trolley", "rotor", "spin_up", "gear_train"}) {
    const std::string file = std::string(FLOATFRAME_EXAMPLES "/") + name + "/" + name + ".yaml";
    SCOPED_TRACE(name);
    const ModelDescription d = load_description(file);
    const Model model = build_model(d);
    const Model again =
        through_bytes(packed(d, model, {.contents = PackOptions::Contents::steps})).build();
    for (const auto coordinates : {Coordinates::relative, Coordinates::absolute}) {
      const std::vector<double> expected = outputs_of(model, coordinates, 20);
      EXPECT_FALSE(expected.empty());
      EXPECT_EQ(outputs_of(again, coordinates, 20), expected);
    }
  }
}

TEST(PackedModel, HoldsEveryField) {
  const ModelDescription d = valid_description();
  const Model model = build_model(d);
  const Model again = through_bytes(packed(d, model)).build();
  EXPECT_EQ(model_hash(again), model_hash(model));
  const ModelDescription reduced = with_reduced_bodies(d, model);
  const DescriptionBytes bytes = description_bytes(reduced);
  EXPECT_EQ(description_bytes(floatframe::description_of(bytes.bytes)).bytes, bytes.bytes);
  EXPECT_TRUE(std::ranges::is_sorted(bytes.doubles));
  EXPECT_LT(bytes.bodies, bytes.bytes.size());
}

// Descriptions that differ in how their bodies were described are equal before these.
TEST(PackedModel, BodiesStandLast) {
  const ModelDescription d = valid_description();
  const DescriptionBytes as_given = description_bytes(d),
                         reduced = description_bytes(with_reduced_bodies(d, build_model(d)));
  ASSERT_EQ(as_given.bodies, reduced.bodies);
  EXPECT_TRUE(std::equal(as_given.bytes.begin(), as_given.bytes.begin() + as_given.bodies,
                         reduced.bytes.begin()));
  EXPECT_EQ(error_of([&] { floatframe::description_of(as_given.bytes); }), "damaged");
}

// m = m0 + load: the weight that the rod carries.
TEST(PackedModel, ParametersPatchNumbers) {
  const std::string text = R"(
parameters: {load: 2.0}
bodies:
  block: {position: [0, 0, 0], rigid: {mass: '${1 + load}', inertia: [1, 1, 1]}}
joints: {slide: {type: prismatic, child: block, at: [0, 0, 0], axis: z}}
forces:
  spring: {type: spring_damper, from: {body: ground, at: [0, 0, 2]},
           to: {body: block, at: [0, 0, 0]}, spring: 100}
outputs: {z: {position: {body: block}, axis: z}}
)";
  const auto description = [&](const char* load) {
    return test::description_of(text, {{"load", load}});
  };
  const ModelDescription d = description("2.0");
  PackedModel model = packed(d, build_model(d));
  const DescriptionBytes other = description_bytes(description("3.0"));
  const DescriptionBytes own = description_bytes(d);
  ASSERT_EQ(own.doubles, other.doubles);
  std::vector<PackedExpression> numbers;
  for (const std::uint32_t at : own.doubles)
    if (!std::equal(own.bytes.begin() + at, own.bytes.begin() + at + 8, other.bytes.begin() + at))
      numbers.push_back({0, at, 1.0});
  ASSERT_EQ(numbers.size(), 1u);
  model.tune({{"load", "kg", "on the block", 2.0}}, {formula("1 + load")}, numbers);
  model = through_bytes(model);
  EXPECT_EQ(model.find_parameter("load"), 0);
  EXPECT_EQ(model.find_parameter("lead"), -1);
  const std::vector<double> more = {3.0}, packed_value = {2.0};
  EXPECT_EQ(model_hash(model.build(more)), model_hash(build_model(description("3.0"))));
  EXPECT_EQ(model_hash(model.build(packed_value)), model_hash(model.build()));
  const std::vector<double> two = {1.0, 2.0}, none = {nan}, light = {-2.0};
  EXPECT_EQ(error_of([&] { model.build(two); }), "wrong_count");
  EXPECT_EQ(error_of([&] { model.build(none); }), "not_finite");
  EXPECT_NE(error_of([&] { model.build(light); }), "no error");
  EXPECT_EQ(error_of([&] {
              model.tune({{"a", "", "", 0}, {"a", "", "", 0}}, {}, {});
            }),
            "duplicate");
  EXPECT_EQ(error_of([&] { model.tune({}, {formula("b")}, {}); }), "not_found");
  EXPECT_EQ(error_of([&] { model.tune({}, {}, {{0, 0, 1.0}}); }), "damaged");
}

// Tyre files are read when a model is packed, not when it is built.
TEST(PackedModel, KeepsTyreFiles) {
  const ModelDescription d = load_description(FLOATFRAME_EXAMPLES "/iltis/handling.yaml");
  ModelDescription reduced = with_reduced_bodies(d, build_model(d));
  int kept = 0;
  for (ElementDescription& e : reduced.forces)
    if (auto* tyre = std::get_if<MagicFormulaTyre>(&e.kind)) {
      kept += tyre->text.empty() ? 0 : 1;
      tyre->file = "nowhere.tir";
    }
  EXPECT_EQ(kept, std::ranges::count_if(d.forces, [](const ElementDescription& e) {
              return std::holds_alternative<MagicFormulaTyre>(e.kind);
            }));
  EXPECT_EQ(model_hash(PackedModel(reduced, {}).build()), model_hash(build_model(d)));
}

// What a body looks like comes through the file, several colours of its triangles with it.
TEST(PackedModel, KeepsShapes) {
  ModelDescription d;
  BodyDescription body;
  body.name = "a";
  RigidDescription rigid{.mass = 1.0, .J_C = Mat3::Identity()};
  rigid.shape = shape_of_solids({{BoxSolid{}, {}, "#3a6ea5"}, {SphereSolid{}, {}, ""}});
  const auto packed = [&](const RigidDescription& r) {
    body.kind = r;
    d.bodies = {body};
    return PackedModel(d, {}).to_bytes();
  };
  const Model built = PackedModel::from_bytes(packed(rigid)).build();
  const BodyShape& shape = *built.bodies.at(0).data->shape;
  EXPECT_EQ(shape.positions, rigid.shape->positions);
  EXPECT_EQ(shape.triangles, rigid.shape->triangles);
  ASSERT_EQ(shape.paints.size(), 2u);
  EXPECT_EQ(shape.paints[1].first, 12);
  EXPECT_EQ(shape.paints[0].color, "#3a6ea5");
  // Entries that do not ascend from the first triangle, or name none.
  for (const std::vector<int>& first : {std::vector{1, 12}, {0, 0}, {0, 1 << 20}, {0, -1}}) {
    BodyShape bad = *rigid.shape;
    for (std::size_t k = 0; k < 2; ++k) bad.paints[k].first = first[k];
    RigidDescription other = rigid;
    other.shape = std::make_shared<const BodyShape>(bad);
    const auto bytes = packed(other);
    EXPECT_EQ(error_of([&] { PackedModel::from_bytes(bytes).build(); }), "damaged");
  }
}

}  // namespace
}  // namespace floatframe::test
