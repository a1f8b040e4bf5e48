// The content of a model file as plain values.
#include "floatframe/model_file/model_values.hpp"

#include <gtest/gtest.h>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe::test {
namespace {

using Kind = ModelValue::Kind;

const ModelValue& entry(const ModelValue& map, const std::string& key) {
  for (std::size_t k = 0; k < map.keys.size(); ++k)
    if (map.keys[k] == key) return map.items.at(k);
  throw std::out_of_range(key);
}

TEST(ModelValues, AreWhatTheReaderTakesThemFor) {
  const ModelValue v = model_values(
      "whole: 3\nnumber: 2e4\npoint: 0.5\nyes: true\ntext: crank\nquoted: \"10\"\n"
      "expression: ${2 * m}\nnothing:\nlist: [1, {a: x}]\n",
      "m.yaml");
  ASSERT_EQ(v.kind, Kind::map);
  EXPECT_EQ(v.keys.front(), "whole");
  EXPECT_EQ(entry(v, "whole").kind, Kind::whole);
  EXPECT_EQ(entry(v, "whole").whole, 3);
  EXPECT_EQ(entry(v, "number").kind, Kind::number);
  EXPECT_EQ(entry(v, "number").number, 2e4);
  EXPECT_EQ(entry(v, "point").number, 0.5);
  EXPECT_EQ(entry(v, "yes").kind, Kind::truth);
  EXPECT_TRUE(entry(v, "yes").truth);
  EXPECT_EQ(entry(v, "text").text, "crank");
  EXPECT_EQ(entry(v, "quoted").kind, Kind::text);
  EXPECT_EQ(entry(v, "quoted").text, "10");
  EXPECT_EQ(entry(v, "expression").kind, Kind::text);
  EXPECT_EQ(entry(v, "expression").text, "${2 * m}");
  EXPECT_EQ(entry(v, "nothing").kind, Kind::nothing);
  ASSERT_EQ(entry(v, "list").items.size(), 2u);
  EXPECT_EQ(entry(entry(v, "list").items[1], "a").text, "x");
}

TEST(ModelValues, SayEveryErrorOfTheSyntax) {
  try {
    model_values("a: 1\na: 2\nb: &x 3\n", "m.yaml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.errors().size(), 2u);
    EXPECT_EQ(error.errors().front().mark.line, 2);
  }
}

}  // namespace
}  // namespace floatframe::test
