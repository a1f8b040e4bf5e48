#include "floatframe/core/build_info.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <regex>

#include "floatframe/core/version.hpp"

namespace floatframe {
namespace {

TEST(BuildInfo, VersionIsThatOfTheHeaders) {
  EXPECT_EQ(version(), FLOATFRAME_VERSION);
  EXPECT_TRUE(std::regex_match(version(), std::regex(R"(\d+\.\d+\.\d+)")));
}

TEST(BuildInfo, DescriptionNamesVersionBuildTypeCompilerAndInstructionSet) {
  const std::string text = build_description();
  EXPECT_EQ(text.rfind(version() + ", " + FLOATFRAME_BUILD_TYPE + ", ", 0), 0u) << text;
  EXPECT_NE(text.find(instruction_set()), std::string::npos) << text;
}

TEST(BuildInfo, ProcessorNameIsOneLineWithoutBlanksAround) {
  const std::string name = processor_name();
  ASSERT_FALSE(name.empty());
  EXPECT_EQ(name.find('\n'), std::string::npos);
  EXPECT_NE(name.front(), ' ');
}

// instruction_set_test.py runs this one and reads the line.
TEST(BuildInfo, PrintsTheInstructionSet) {
  std::printf("instruction set: %s\n", instruction_set().c_str());
  SUCCEED();
}

}  // namespace
}  // namespace floatframe
