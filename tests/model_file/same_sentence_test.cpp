// A mistake has one sentence and one place, whether a model file holds it or a C++ program puts it
// into the description that was read.
#include <gtest/gtest.h>

#include <functional>

#include "floatframe/model/model.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

const std::string model_text =
    "floatframe: 1\n"
    "points: {a: [0, 0, 1], b: [1, 0, 1]}\n"
    "bodies:\n"
    "  arm:\n"
    "    rigid: {mass: 1, inertia: [1, 1, 1]}\n"
    "    position: [1, 0, 0]\n"
    "  bar:\n"
    "    flexible:\n"
    "      material: {young: 2e11, poisson: 0.3, density: 7800}\n"
    "      bars: {one: {from: a, to: b, elements: 4, section: {round: 0.02}}}\n"
    "      damping: 0.01\n"
    "      normal_modes: 2\n"
    "      section_inertia: false\n"
    "      clamped: [a]\n"
    "joints:\n"
    "  cross: {type: universal, child: arm, at: [0, 0, 0], axis: x, axis_2: y, keep: false}\n"
    "inputs:\n"
    "  push: {unit: N, initial: 2, min: 1, max: 5}\n"
    "simulation:\n"
    "  start:\n"
    "    equilibrium: true\n"
    "    offset: {arm: [0, 0, 0.1]}\n"
    "  step: 0.001\n"
    "  duration: 1\n"
    "  min_step: 0.0001\n";

struct Mistake {
  const char *right, *wrong;                    ///< in the file
  std::function<void(ModelDescription&)> made;  ///< in the description of the right file
};

FlexibleDescription& bar_of(ModelDescription& d) {
  return std::get<FlexibleDescription>(d.bodies[1].kind);
}

TEST(SameSentence, InAFileAndInADescription) {
  using D = ModelDescription;
  const std::vector<Mistake> mistakes{
      {"mass: 1", "mass: -1",
       [](D& d) { std::get<RigidDescription>(d.bodies[0].kind).mass = -1.0; }},
      {"[1, 1, 1]", "[1, 1, 5]",
       [](D& d) { std::get<RigidDescription>(d.bodies[0].kind).J_C(2, 2) = 5.0; }},
      {"young: 2e11", "young: 0", [](D& d) { bar_of(d).young = 0.0; }},
      {"poisson: 0.3", "poisson: 0.5", [](D& d) { bar_of(d).poisson = 0.5; }},
      {"damping: 0.01", "damping: 2", [](D& d) { bar_of(d).damping = 2.0; }},
      {"density: 7800", "density: 0", [](D& d) { bar_of(d).density = 0.0; }},
      {"normal_modes: 2", "normal_modes: 100", [](D& d) { bar_of(d).normal_modes = 100; }},
      {"section_inertia: false", "section_inertia: true",
       [](D& d) { bar_of(d).section_inertia = true; }},
      {"elements: 4", "elements: 0", [](D& d) { bar_of(d).bars[0].elements = 0; }},
      {"axis_2: y", "axis_2: x", [](D& d) { d.joints[0].axis_2 = Vec3::UnitX(); }},
      {"keep: false", "keep: true", [](D& d) { d.joints[0].keep = true; }},
      {"unit: N", "unit: 'N,m'", [](D& d) { d.inputs[0].unit = "N,m"; }},
      {"initial: 2", "initial: 0", [](D& d) { d.inputs[0].initial = 0.0; }},
      {"max: 5", "max: 0.5", [](D& d) { d.inputs[0].high = 0.5; }},
      {"equilibrium: true", "equilibrium: false", [](D& d) { d.simulation.start = Start::given; }},
      {"duration: 1", "duration: -1", [](D& d) { d.simulation.duration = -1.0; }},
      {"min_step: 0.0001", "min_step: 1", [](D& d) { d.simulation.min_step = 1.0; }}};
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& text) { return read_model(folder.write("m", text)); };
  ASSERT_EQ(test::sentences_of([&] { build_model(read(model_text)); }), "no error");
  for (const Mistake& m : mistakes) {
    std::string text = model_text;
    const std::size_t at = text.find(m.right);
    ASSERT_NE(at, std::string::npos) << m.right;
    text.replace(at, std::string(m.right).size(), m.wrong);
    const std::string in_file = test::sentences_of([&] { read(text); });
    ModelDescription d = read(model_text);
    m.made(d);
    EXPECT_EQ(test::sentences_of([&] { build_model(d); }), in_file) << m.wrong;
    EXPECT_NE(test::error_of([&] { read(text); }), "no error") << m.wrong;
  }
}

}  // namespace
}  // namespace floatframe
