// Errors that show only when a model from a file is built, with their places.
#include <gtest/gtest.h>

#include "floatframe/description/inertia_choice.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

/// A clamped bar with `modes` in place of its last lines, `more` below; the error without the
/// folder.
template <class Use>
std::string error_of(const std::string& modes, const std::string& more, const Use& use,
                     int elements = 10, const std::string& clamped = "      clamped: [a]\n") {
  const test::TemporaryFolder folder;
  const std::string path = folder.write(
      "bar.yaml",
      "floatframe: 1\n"
      "points: {a: [0, 0, 0], b: [1, 0, 0]}\n"
      "bodies:\n"
      "  bar:\n"
      "    flexible:\n"
      "      material: {young: 70e9, poisson: 0.3, density: 2700}\n"
      "      bars: {b: {from: a, to: b, elements: " +
          std::to_string(elements) + ", section: {round: 0.01}}}\n" + clamped + modes + more);
  const std::string text = test::error_of([&] { use(read_model(path)); });
  return text.starts_with(path) ? text.substr(path.size()) : text;
}

const auto build = [](const ModelDescription& d) { build_model(d); };

TEST(BuildErrors, AmplitudesOfModesBelowAFrequency) {
  const std::string modes =
      "      static_modes: [{point: b, dofs: [y, z]}]\n"
      "      normal_modes: {below: 500}\n";
  EXPECT_EQ(error_of(modes, "initial: {amplitudes: {bar: [0.1]}}\n", build), ":11:29: wrong_count");
  EXPECT_EQ(error_of(modes, "initial:\n  amplitude_rates:\n    bar: [0.1, 0.2]\n", build),
            ":13:10: wrong_count");
}

TEST(BuildErrors, MassModelThatDoesNotGoWithTheInertiaMethod) {
  const std::string modes =
      "      static_modes: [{point: b, dofs: [y, z]}]\n"
      "      mass_model: ";
  const auto with = [](InertiaMethod method) {
    return [method](const ModelDescription& d) { check_inertia_method(d, method); };
  };
  EXPECT_EQ(error_of(modes + "six_dof\n", "", with(InertiaMethod::preprocessing)),
            ":10:19: unsupported");
  EXPECT_EQ(error_of(modes + "hermite\n", "", with(InertiaMethod::projection)),
            ":10:19: unsupported");
  EXPECT_EQ(error_of(modes + "six_dof\n", "", with(InertiaMethod::projection)), "no error");
  EXPECT_EQ(error_of(modes + "hermite\n", "", with(InertiaMethod::preprocessing)), "no error");
  EXPECT_EQ(error_of(modes + "isoparametric\n", "", with(InertiaMethod::projection)), "no error");
}

// Twenty shapes on the twenty transverse dofs that the ten free nodes of a bar have.
TEST(BuildErrors, AsManyModesAsTheMeshHasWaysToMove) {
  const auto text = [](int shapes, const std::string& joint, int elements) {
    const std::string bar = "      analytic: {dynamic_per_plane: " + std::to_string(shapes) + "}\n";
    std::string error = error_of(bar, joint, build, elements, "");
    const std::size_t number = error.find("(relative");
    return number == std::string::npos ? error : error.substr(0, number);
  };
  const std::string hinge =
      "joints: {h: {type: universal, child: bar, at: a, axis: y, axis_2: z}}\n";
  EXPECT_EQ(text(8, hinge, 10), "no error");
  EXPECT_EQ(text(9, hinge, 10), ":6:7: wrong_value");
  EXPECT_EQ(text(9, "", 10), ":6:7: wrong_value");
  EXPECT_EQ(text(9, hinge, 20), "no error");
  // What is fixed to the ground has no rigid motion that its modes could repeat.
  const std::string weld = "joints: {h: {type: weld, child: bar, at: a}}\n";
  EXPECT_EQ(text(9, weld, 10), "no error");
  EXPECT_EQ(text(10, weld, 10), ":6:7: wrong_value");
  EXPECT_EQ(text(0, weld, 1), "no error");
  EXPECT_EQ(text(0, hinge, 1), ":6:7: wrong_value");
}

TEST(BuildErrors, ForceOfAMotorWithoutAMotion) {
  const std::string modes =
      "joints: {h: {type: revolute, child: bar, at: a, axis: y}}\n"
      "outputs:\n"
      "  f: {motion_force: h}\n";
  EXPECT_EQ(error_of("      static_modes: [{point: b, dofs: [y, z]}]\n", modes, build),
            ":12:21: outputs.f.motion_force: wrong_value");
}

}  // namespace
}  // namespace floatframe
