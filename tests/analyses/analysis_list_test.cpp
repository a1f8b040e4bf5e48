// What holds of every analysis of the list: as a command, and what it reports of a small model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>

#include "floatframe/analyses/analysis.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

// A bar on a hinge that hangs, and a block beside it.
const char* const hanging_bar = R"(
points: {a: [0, 0, 0], b: [0, 0, -1]}
bodies:
  bar:
    flexible:
      material: {young: 70e9, poisson: 0.3, density: 2700}
      bars: {b: {from: a, to: b, elements: 4, section: {round: 0.02}}}
      clamped: [a]
      static_modes: [{point: b, dofs: [x, y]}]
  block: {position: [1, 0, 0], rigid: {mass: 2, inertia: [0.1, 0.2, 0.3]}}
joints:
  hinge: {type: revolute, child: bar, at: a, axis: y}
  slide: {type: prismatic, child: block, at: [1, 0, 0], axis: x}
forces:
  tie: {type: joint_spring, joint: slide, spring: 100, damper: 5}
outputs:
  end: {position: {body: bar, at: b}, axis: x}
simulation: {step: 0.001, duration: 0.02}
)";

bool is_command_word(const std::string& word) {
  for (const char c : word)
    if (!std::islower(static_cast<unsigned char>(c)) && c != '-') return false;
  return !word.empty();
}

TEST(AnalysisList, EveryAnalysisIsACommandOfItsOwn) {
  std::set<std::string> names;
  for (const Analysis& a : all_analyses()) {
    EXPECT_TRUE(is_command_word(a.name)) << a.name;
    EXPECT_TRUE(names.insert(a.name).second) << a.name;
    EXPECT_FALSE(a.help.empty()) << a.name;
    EXPECT_EQ(a.help.find('\n'), std::string::npos) << a.name;
    EXPECT_NE(a.footer.find("Exit codes: 0"), std::string::npos) << a.name;
    EXPECT_TRUE(a.run) << a.name;
  }
  EXPECT_GE(names.size(), 3u);
}

TEST(AnalysisList, OptionsAreNeitherSharedOnesNorTwice) {
  for (const Analysis& a : all_analyses()) {
    std::set<std::string> names{"--help", "--set", "--json", "--strict", "--step", "--duration"};
    const auto is_new = [&](const std::string& name) {
      EXPECT_EQ(name.find("--"), 0u) << a.name << ": " << name;
      EXPECT_TRUE(names.insert(name).second) << a.name << ": " << name;
    };
    for (const Option& option : a.options) {
      is_new(option.name);
      EXPECT_FALSE(option.help.empty()) << a.name << ": " << option.name;
    }
    for (const AnalysisFile& file : a.files) is_new(file.option);
  }
}

TEST(AnalysisList, ReportsAreTextJsonAndOptionalFiles) {
  const Model model = model_of(hanging_bar);
  for (const Analysis& a : all_analyses()) {
    // What must be given depends on the model: tests of their own.
    if (std::any_of(a.options.begin(), a.options.end(), [](const Option& o) { return o.required; }))
      continue;
    const AnalysisReport report = a.run(model);
    ASSERT_FALSE(report.text.empty()) << a.name;
    EXPECT_EQ(report.text.back(), '\n') << a.name;
    EXPECT_EQ(report.text.find("nan"), std::string::npos) << a.name << ": " << report.text;
    const auto json = nlohmann::json::parse(report.json, nullptr, false);
    EXPECT_TRUE(json.is_object() && !json.empty()) << a.name << ": " << report.json;
    EXPECT_EQ(report.json.back(), '\n') << a.name;
    EXPECT_EQ(report.files.size(), a.files.size()) << a.name;
    for (const auto& file : report.files) {
      std::string content;
      const std::string error = error_of([&] { content = file(); });
      EXPECT_TRUE(!content.empty() || error.find("without the viewer") != std::string::npos)
          << a.name << ": " << error;
    }
    EXPECT_TRUE(report.warnings.empty()) << a.name << ": " << report.warnings[0];
  }
}

}  // namespace
}  // namespace floatframe::test
