// Files that are read again for each variant of a model are parsed as long as they change, and no
// longer.
#include "floatframe/model_file/parsed_files.hpp"

#include <gtest/gtest.h>

#include "floatframe/model_file/model_reader.hpp"

namespace floatframe::test {
namespace {

TEST(ParsedFiles, ParseAFileAgainWhenItsTextChanges) {
  ParsedFiles files;
  ReadErrors errors;
  const auto first = files.get("m.yaml", "a: 1\n", errors);
  EXPECT_EQ(files.get("m.yaml", "a: 1\n", errors), first);
  EXPECT_NE(files.get("other.yaml", "a: 1\n", errors), first);
  const auto changed = files.get("m.yaml", "a: 2\n", errors);
  EXPECT_EQ(changed->root.entries.at(0).value.text, "2");
  EXPECT_TRUE(errors.empty());
}

// What is wrong with a file is said each time.
TEST(ParsedFiles, KeepNoFileWithErrors) {
  ParsedFiles files;
  for (int k = 0; k < 2; ++k) {
    ReadErrors errors;
    files.get("m.yaml", "a: 1\na: 2\n", errors);
    EXPECT_EQ(errors.size(), 1u);
  }
}

TEST(ParsedFiles, VariantsAreThoseOfFreshReadings) {
  const std::string text =
      "floatframe: 1\nparameters: {mass: 1}\n"
      "bodies: {b: {rigid: {mass: \"${mass}\", centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}\n";
  ReadOptions kept, fresh;
  kept.text = fresh.text = &text;
  kept.parsed = std::make_shared<ParsedFiles>();
  for (const char* mass : {"2", "x", "3"}) {
    const std::vector<ParameterOverride> values{{"mass", mass}};
    std::string messages[2];
    double masses[2] = {};
    for (int k = 0; k < 2; ++k) {
      try {
        const ModelDescription d = read_model("m.yaml", values, nullptr, k == 0 ? kept : fresh);
        masses[k] = std::get<RigidDescription>(d.bodies.at(0).kind).mass;
      } catch (const InputError& error) {
        messages[k] = error.what();
      }
    }
    EXPECT_EQ(messages[0], messages[1]);
    EXPECT_EQ(masses[0], masses[1]);
    EXPECT_EQ(messages[0].empty(), mass[0] != 'x');
  }
}

}  // namespace
}  // namespace floatframe::test
