// Parameters of packed models that take new values: the same bits as a file that is read with
// --set, which are tunable and which are not and why, subsystems, formulas, the long form.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <fstream>

#include "floatframe/model/model_hash.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/model_file/pack_model.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "support/contains.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

using Overrides = std::vector<ParameterOverride>;

const std::string examples = FLOATFRAME_EXAMPLES;

std::vector<std::string> names_of(const PackedModel& model) {
  std::vector<std::string> names;
  for (const PackedParameter& p : model.parameters()) names.push_back(p.name);
  return names;
}
bool tunable(const PackedModel& model, const char* name) { return model.find_parameter(name) >= 0; }

/// The description of the packed model with these values is that of the file with --set, after the
/// values `given` with which it was packed, up to the
/// texts of formulas, in front of what a reduction computes; and both make the same steps.
void expect_same_bits(const PackedModel& packed, const std::string& path, const Overrides& values,
                      Overrides given = {}) {
  const std::vector<double> numbers = packed_values(packed, values);
  given.insert(given.end(), values.begin(), values.end());
  DescriptionBytes a = bytes_without_formula_texts(packed.description(numbers)),
                   b = bytes_without_formula_texts(load_description(path, given));
  ASSERT_EQ(a.bodies, b.bodies);
  a.bytes.resize(a.bodies);
  b.bytes.resize(b.bodies);
  EXPECT_TRUE(a.bytes == b.bytes);
  Simulation x(packed.build(numbers)), y(load_model(path, given));
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(x.step()) << x.failure();
    ASSERT_TRUE(y.step()) << y.failure();
    for (std::size_t i = 0; i < x.outputs().size(); ++i)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(x.outputs()[i]),
                std::bit_cast<std::uint64_t>(y.outputs()[i]))
          << x.output_names()[i] << ", step " << k;
  }
}

TEST(TunableParameters, OfTheQuarterCarAreItsMassesSpringsAndDampers) {
  const std::string path = examples + "/quarter_car/quarter_car.yaml";
  const Overrides shorter{{"duration", "1"}};
  std::vector<std::string> fixed;
  const PackedModel packed = pack_model(path, shorter, {}, &fixed);
  EXPECT_EQ(names_of(packed),
            (std::vector<std::string>{"body_mass", "wheel_mass", "stiffness", "damping",
                                      "tyre_stiffness", "tyre_damping"}));
  EXPECT_EQ(count_with(fixed, "'speed'"), 1) << "the length of its random road follows from it";
  EXPECT_EQ(count_with(fixed, "'seed'"), 1);
  EXPECT_EQ(count_with(fixed, "'duration'"), 1);
  expect_same_bits(packed, path, {}, shorter);
  expect_same_bits(packed, path, {{"body_mass", "317.3"}, {"stiffness", "23456.7"}}, shorter);
  expect_same_bits(packed, path, {{"damping", "0"}, {"tyre_stiffness", "1.7e5"}}, shorter);
  expect_same_bits(packed, path, {{"wheel_mass", "0.1"}, {"tyre_damping", "333.333"}}, shorter);
}

TEST(TunableParameters, OfTheIltisPassThroughItsSubsystems) {
  const std::string path = examples + "/active_damper/active_damper.yaml";
  std::vector<std::string> fixed;
  const PackedModel packed = pack_model(path, {{"ne", "5"}}, {}, &fixed);
  EXPECT_TRUE(tunable(packed, "speed"));
  EXPECT_TRUE(tunable(packed, "largest_force"));
  EXPECT_TRUE(tunable(packed, "step"));
  EXPECT_EQ(count_with(fixed, "'ne'"), 1);
  EXPECT_EQ(count_with(fixed, "'ride_height'"), 1);
  EXPECT_FALSE(tunable(packed, "chassis_mass")) << "it follows from flexible";
  expect_same_bits(packed, path, {{"speed", "7.3"}, {"step", "0.002"}}, {{"ne", "5"}});
}

TEST(TunableParameters, GivenMassesOfSubsystemsAreTunable) {
  const std::string path = examples + "/active_damper/active_damper.yaml";
  const Overrides given{{"flexible", "false"}, {"chassis_mass", "1260"}, {"wheel_mass", "57"}};
  const PackedModel packed = pack_model(path, given);
  EXPECT_TRUE(tunable(packed, "chassis_mass"));
  EXPECT_TRUE(tunable(packed, "wheel_mass"));
  Overrides other = given;
  other[1].value = "1345.6";
  other[2].value = "61.7";
  const Overrides set{{"chassis_mass", "1345.6"}, {"wheel_mass", "61.7"}};
  const Model a = packed.build(packed_values(packed, set)), b = load_model(path, other);
  EXPECT_EQ(model_hash(a), model_hash(b));
}

/// A swing with a controller, parameters of all sorts, in a folder with a subsystem.
std::string write_swing(const TemporaryFolder& folder) {
  folder.write("arm.yaml", R"yaml(floatframe: 1
external: [base]
parameters: {weight: 1, twice: "${2 * weight}", length: 0.5}
bodies:
  arm:
    rigid:
      mass: ${weight}
      centre_of_mass: ["${length}", 0, 0]
      inertia: ["${0.01 * twice}", 0.1, 0.1]
joints: {hinge: {type: revolute, parent: base, child: arm, at: [0, 0, 0], axis: y}}
)yaml");
  return folder.write("swing.yaml", R"yaml(floatframe: 1
parameters:
  heavy: {value: 3, unit: kg, about: mass of the arm}
  kp: 60
  kd: {value: 8}
  aim: 0.2
  diameter: 0.02
  lever: 0.4
  limit: 5
  count: 3
  spare: 1
  k: 900
  stop: 40
  double_k: ${2 * k}
bodies:
  rail: {rigid: {mass: 5, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}
joints: {rail: {type: prismatic, child: rail, at: [0, 0, 0], axis: x}}
subsystems:
  left:
    file: arm.yaml
    connect: {base: rail}
    mirror: [{normal: x}]
    parameters: {weight: "${heavy / 2}", length: "${lever}"}
forces:
  motor:
    type: joint_spring
    joint: left.hinge
    actuator: {formula: "kp * (${aim} - angle(left.hinge)) - kd * rate(left.hinge)"}
  spring:
    type: joint_spring
    joint: rail
    spring: ${k}
    damper: {table: [[-1, "${-stop}"], [0, 0], [1, "${stop}"]]}
  second:
    type: joint_spring
    joint: rail
    spring: ${double_k}
    damper: ${1e9 * pi * diameter^4 / 64}
  more: {when: "${limit > 4}", type: joint_spring, joint: rail, spring: 1}
outputs: {x: {joint_position: rail}, angle: {joint_position: left.hinge}, motor: {force: motor}}
simulation: {step: 0.002, duration: 1, max_iterations: "${10 * count}"}
)yaml");
}

TEST(TunableParameters, SubsystemsFormulasTablesAndPowers) {
  const TemporaryFolder folder;
  const std::string path = write_swing(folder);
  std::vector<std::string> fixed;
  const PackedModel packed = pack_model(path, {}, {}, &fixed);
  for (const char* name : {"heavy", "kp", "kd", "aim", "diameter", "k", "stop"})
    EXPECT_TRUE(tunable(packed, name)) << name;
  for (const char* name : {"limit", "count", "spare", "double_k"}) {
    EXPECT_FALSE(tunable(packed, name)) << name;
    EXPECT_EQ(count_with(fixed, ("'" + std::string(name) + "'").c_str()), 1) << name;
  }
  expect_same_bits(packed, path, {});
  expect_same_bits(packed, path, {{"heavy", "4.7"}, {"k", "777.7"}, {"diameter", "0.0213"}});
  expect_same_bits(packed, path, {{"kp", "33.3"}, {"kd", "7.1"}, {"aim", "-0.3"}});
  expect_same_bits(packed, path, {{"stop", "12.3"}, {"kp", "100"}, {"kd", "0.7"}, {"k", "0"}});
}

TEST(TunableParameters, HaveUnitsAndDescriptions) {
  const TemporaryFolder folder;
  const PackedModel packed = pack_model(write_swing(folder));
  const auto& p = packed.parameters();
  EXPECT_EQ(p[packed.find_parameter("heavy")].unit, "kg");
  EXPECT_EQ(p[packed.find_parameter("heavy")].about, "mass of the arm");
  EXPECT_EQ(p[packed.find_parameter("heavy")].value, 3.0);
  EXPECT_EQ(p[packed.find_parameter("kp")].unit, "");
  EXPECT_EQ(p[packed.find_parameter("k")].unit, "N/m") << "of the key where it stands alone";
}

TEST(TunableParameters, AFileOfOneTakesSet) {
  const TemporaryFolder folder;
  const std::string path = write_swing(folder), file = folder.file("swing.ffm");
  const PackedModel packed = pack_model(path);
  const std::vector<std::byte> bytes = packed.to_bytes();
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  const Model a = load_model(file, {{"k", "123.4"}}), b = load_model(path, {{"k", "123.4"}});
  EXPECT_EQ(model_hash(a), model_hash(b));
  EXPECT_EQ(model_parameters(file), names_of(packed));
  EXPECT_EQ(error_of([&] { load_model(file, {{"count", "4"}}); }), "unknown_key");
  EXPECT_TRUE(contains(sentences_of([&] { load_model(file, {{"count", "4"}}); }), "heavy, kp"));
  EXPECT_EQ(error_of([&] { load_model(file, {{"k", "soft"}}); }), "not_a_number");
}

TEST(TunableParameters, TakeEffectBetweenSteps) {
  const TemporaryFolder folder;
  const PackedModel packed = pack_model(write_swing(folder));
  const auto with = [&](const char* value) {
    return packed.build(packed_values(packed, {{"kp", value}}));
  };
  Simulation x(with("60"));
  for (int k = 0; k < 10; ++k) ASSERT_TRUE(x.step());
  const SimulationState before = x.save();
  x.change_model(with("61"));
  EXPECT_EQ(error_of([&] { x.restore(before); }), "mismatch")
      << "a gain inside a formula makes another model";
  EXPECT_TRUE(x.step());
}

}  // namespace
}  // namespace floatframe::test
