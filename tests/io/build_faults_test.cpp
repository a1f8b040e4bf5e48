// Faults that show only when a model from a file is built, with their places.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "floatframe/io/model_reader.hpp"
#include "floatframe/model/inertia_choice.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {
namespace {

/// A clamped bar with `modes` in place of its last lines, `more` below; the fault without the
/// folder.
template <class Use>
std::string fault_of(const std::string& modes, const std::string& more, const Use& use) {
  const std::string name =
      std::string("bar_") + ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto path = std::filesystem::temp_directory_path() / (name + ".yaml");
  std::ofstream(path) << "floatframe: 1\n"
                         "points: {a: [0, 0, 0], b: [1, 0, 0]}\n"
                         "bodies:\n"
                         "  bar:\n"
                         "    flexible:\n"
                         "      material: {young: 70e9, poisson: 0.3, density: 2700}\n"
                         "      bars: {b: {from: a, to: b, elements: 10, section: {round: 0.01}}}\n"
                         "      clamped: [a]\n"
                      << modes << more;
  std::string text = "no fault";
  try {
    use(read_model(path.string()));
  } catch (const InputError& error) {
    text = error.what();
    if (text.rfind(path.string(), 0) == 0) text = text.substr(path.string().size());
  }
  std::filesystem::remove(path);
  return text;
}

const auto build = [](const ModelDescription& d) { build_model(d); };

TEST(BuildFaults, AmplitudesOfModesBelowAFrequency) {
  const std::string modes =
      "      static_modes: [{point: b, dofs: [y, z]}]\n"
      "      normal_modes: {below: 500}\n";
  EXPECT_EQ(fault_of(modes, "initial: {amplitudes: {bar: [0.1]}}\n", build),
            ":11:29: initial.amplitudes.bar: found a list of 1, expected a list of 10 amplitudes, "
            "one a mode");
  EXPECT_EQ(fault_of(modes, "initial:\n  amplitude_rates:\n    bar: [0.1, 0.2]\n", build),
            ":13:10: initial.amplitude_rates.bar: found a list of 2, expected a list of 10 "
            "amplitudes, one a mode");
}

TEST(BuildFaults, MassModelThatDoesNotGoWithTheInertiaMethod) {
  const std::string modes =
      "      static_modes: [{point: b, dofs: [y, z]}]\n"
      "      mass_model: ";
  const auto with = [](InertiaMethod method) {
    return [method](const ModelDescription& d) { check_inertia_method(d, method); };
  };
  EXPECT_EQ(fault_of(modes + "six_dof\n", "", with(InertiaMethod::preprocessing)),
            ":10:19: bodies.bar.flexible.mass_model: found six_dof with inertia terms by "
            "preprocessing, expected isoparametric or hermite (or projection)");
  EXPECT_EQ(fault_of(modes + "hermite\n", "", with(InertiaMethod::projection)),
            ":10:19: bodies.bar.flexible.mass_model: found hermite with inertia terms by "
            "projection, expected isoparametric or six_dof (or preprocessing)");
  EXPECT_EQ(fault_of(modes + "six_dof\n", "", with(InertiaMethod::projection)), "no fault");
  EXPECT_EQ(fault_of(modes + "hermite\n", "", with(InertiaMethod::preprocessing)), "no fault");
  EXPECT_EQ(fault_of(modes + "isoparametric\n", "", with(InertiaMethod::projection)), "no fault");
}

}  // namespace
}  // namespace floatframe
