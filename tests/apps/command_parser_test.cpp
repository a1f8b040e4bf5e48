// Numbers and lists on the command line: where they go, and what is refused.
#include "floatframe/apps/command_parser.hpp"

#include <gtest/gtest.h>

#include <set>

#include "floatframe/apps/commands.hpp"

namespace floatframe {
namespace {

struct Values {
  double from = 0.5;
  std::vector<double> speeds{1.0, 2.0};
};

/// The exit code of `floatframe study ...`, 0 if its values were accepted.
int parse(Values& values, std::vector<std::string> words) {
  const std::vector<Command> commands{
      {.name = "study",
       .help = "For tests",
       .options = {number_option("--from", values.from, 0.0, 100.0, "HERTZ", "Lowest"),
                   number_list("--speeds", values.speeds, -10.0, 10.0, "LIST", "Speeds [m/s]")},
       .run = [] { return 0; }}};
  words.insert(words.begin(), {"floatframe", "study"});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  const ParsedCommand parsed =
      parse_command_line(commands, static_cast<int>(argv.size()), argv.data());
  return parsed.run ? parsed.run() : parsed.exit_code;
}

TEST(CommandParser, NumbersAndListsReachTheirPlaces) {
  Values values;
  ASSERT_EQ(parse(values, {"--from", "2.5", "--speeds", "3,-4.5,1e-3"}), 0);
  EXPECT_EQ(values.from, 2.5);
  EXPECT_EQ(values.speeds, (std::vector<double>{3.0, -4.5, 1e-3}));
}

TEST(CommandParser, MissingOptionsKeepTheirDefault) {
  Values values;
  ASSERT_EQ(parse(values, {}), 0);
  EXPECT_EQ(values.from, 0.5);
  EXPECT_EQ(values.speeds, (std::vector<double>{1.0, 2.0}));
}

TEST(CommandParser, NumbersOutOfRangeAreRefused) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--from", "-1"},
                                                {"--from", "nan"},
                                                {"--from", "1x"},
                                                {"--speeds", "1,11"},
                                                {"--speeds", "1,x"},
                                                {"--speeds", "1,nan"}}) {
    Values values;
    testing::internal::CaptureStderr();
    EXPECT_EQ(parse(values, words), exit_code::bad_input) << words[1];
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find(words[0] + ": found '"), std::string::npos) << said;
    EXPECT_NE(said.find("a number from "), std::string::npos) << said;
  }
}

TEST(Commands, HaveDifferentNames) {
  std::set<std::string> names;
  for (const Command& command : all_commands())
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
  EXPECT_GE(names.size(), 9u);
}

}  // namespace
}  // namespace floatframe
