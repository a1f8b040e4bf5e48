// A model file in one call.
#include "floatframe/model_file/load_model.hpp"

#include <gtest/gtest.h>

#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

constexpr const char* text =
    "floatframe: 1\n"
    "parameters: {mass: 2}\n"
    "bodies:\n"
    "  ball: {rigid: {mass: \"${mass}\", centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}\n"
    "joints:\n"
    "  ball: {type: free, child: ball}\n";

TEST(LoadModel, TakesParametersAndBuilds) {
  const TemporaryFolder folder;
  const std::string path = folder.write("ball.yaml", text);
  EXPECT_EQ(load_model(path).bodies.at(0).data->invariants.m, 2.0);
  EXPECT_EQ(load_model(path, {{"mass", "7"}}).bodies.at(0).data->invariants.m, 7.0);
  EXPECT_EQ(load_description(path, {{"mass", "5"}}).bodies.size(), 1u);
}

TEST(LoadModel, ReadsATextInPlaceOfAFile) {
  const ModelDescription d = read_description(text, "/nowhere/<text>", {{"mass", "5"}});
  EXPECT_EQ(build_model(d).bodies.at(0).data->invariants.m, 5.0);
  const std::string message =
      error_of([&] { read_description("floatframe: 1\nbodies:\n  a: {colour: red}\n", "<text>"); });
  EXPECT_EQ(message, "<text>:3:3: bodies.a: missing\n<text>:3:7: bodies.a.colour: unknown_key")
      << message;
}

TEST(LoadModel, NamesAnUnknownParameter) {
  const TemporaryFolder folder;
  const std::string path = folder.write("ball.yaml", text);
  const std::string message = error_of([&] { load_model(path, {{"mas", "1"}}); });
  EXPECT_EQ(test::without_folders(message), "ball.yaml: unknown_key") << message;
}

}  // namespace
}  // namespace floatframe::test
