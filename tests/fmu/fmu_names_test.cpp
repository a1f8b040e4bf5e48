// Names by the grammar of variableNamingConvention="structured".
#include "floatframe/fmu/fmu_names.hpp"

#include <gtest/gtest.h>

namespace floatframe {
namespace {

TEST(FmuNames, IdentifiersStayAsTheyAre) {
  for (const char* name : {"z", "chassis.z", "_a1.b_2", "wheel[2].force", "a[1,2]", "der_x"})
    EXPECT_EQ(fmu_name(name), name);
}

TEST(FmuNames, OtherTextsAreQuotedPieceByPiece) {
  EXPECT_EQ(fmu_name("front.wheel z"), "front.'wheel z'");
  EXPECT_EQ(fmu_name("1st.z"), "'1st'.z");
  EXPECT_EQ(fmu_name("der(x)"), "'der(x)'");
  EXPECT_EQ(fmu_name("a[].b"), "'a[]'.b");
  EXPECT_EQ(fmu_name("a[1,]"), "'a[1,]'");
  EXPECT_EQ(fmu_name("[1]"), "'[1]'");
}

TEST(FmuNames, EmptyPiecesAreQuotedTogether) {
  EXPECT_EQ(fmu_name("a..b"), "'a..b'");
  EXPECT_EQ(fmu_name(".a"), "'.a'");
  EXPECT_EQ(fmu_name("a."), "'a.'");
  EXPECT_EQ(fmu_name("."), "'.'");
  EXPECT_EQ(fmu_name(""), "'{}'");
}

TEST(FmuNames, EscapesAreThoseOfTheStandard) {
  EXPECT_EQ(fmu_name("it's"), R"('it\'s')");
  EXPECT_EQ(fmu_name("a\"b\\c"), R"('a\"b\\c')");
  EXPECT_EQ(fmu_name("a\n\t\r\a\b\f\v"), R"('a\n\t\r\a\b\f\v')");
}

TEST(FmuNames, WhatTheGrammarLacksIsWrittenByItsNumber) {
  EXPECT_EQ(fmu_name("größe"), "'gr{U+00F6}{U+00DF}e'");
  EXPECT_EQ(fmu_name("速度"), "'{U+901F}{U+5EA6}'");
  EXPECT_EQ(fmu_name("😀"), "'{U+1F600}'");
  EXPECT_EQ(fmu_name("a`\x01"), "'a{U+0060}{U+0001}'");
  EXPECT_EQ(fmu_name("a\xff"), "'a{0xFF}'");
  EXPECT_TRUE(fmu_name_is_changed("größe"));
  EXPECT_FALSE(fmu_name_is_changed("it's 100 %"));
}

TEST(FmuNames, IdentifiersOfC) {
  EXPECT_EQ(fmu_identifier("iltis"), "iltis");
  EXPECT_EQ(fmu_identifier("my car 2.0"), "my_car_2_0");
  EXPECT_EQ(fmu_identifier("2nd"), "_2nd");
  EXPECT_EQ(fmu_identifier("größe"), "gr____e");
  EXPECT_EQ(fmu_identifier(""), "model");
  EXPECT_EQ(fmu_identifier("../../x"), "______x");
  EXPECT_EQ(fmu_identifier(std::string(200, 'a')).size(), 60u);
}

TEST(FmuNames, EachIsGivenOnce) {
  FmuNames names;
  EXPECT_EQ(names.take("speed", "outputs"), "speed");
  EXPECT_EQ(names.take("speed", "parameters"), "parameters.speed");
  EXPECT_EQ(names.take("speed", "parameters"), "parameters_2.speed");
  EXPECT_EQ(names.take("parameters.speed", "parameters"), "parameters.parameters.speed");
  EXPECT_EQ(names.take("a b", "inputs"), "'a b'");
  EXPECT_EQ(names.take("a b", "outputs"), "outputs.'a b'");
}

}  // namespace
}  // namespace floatframe
