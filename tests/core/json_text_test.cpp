// JSON that was made to break its reader.
#include "floatframe/core/json_text.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace floatframe {
namespace {

std::string nested(int levels) {
  return std::string(static_cast<std::size_t>(levels), '[') +
         std::string(static_cast<std::size_t>(levels), ']');
}

TEST(JsonText, DepthIsBounded) {
  std::string why;
  EXPECT_TRUE(read_json(nested(deepest_json), why).is_array());
  EXPECT_EQ(why, "");
  for (const int levels : {deepest_json + 1, 1'000'000}) {
    EXPECT_TRUE(read_json(nested(levels), why).is_discarded());
    EXPECT_EQ(why, "nests deeper than 64 levels");
  }
  // Brackets of texts do not nest, with or without marks of quotation in them.
  why.clear();
  EXPECT_TRUE(read_json("[\"" + nested(1000) + "\\\"[[" + nested(1000) + "\"]", why).is_array());
  EXPECT_EQ(why, "");
  std::string objects;
  for (int k = 0; k < 100; ++k) objects += "{\"a\":";
  EXPECT_TRUE(read_json(objects, why).is_discarded());
  EXPECT_EQ(why, "nests deeper than 64 levels");
}

TEST(JsonText, InvalidTextIsDiscarded) {
  for (const char* text : {"", "[", "]", "{\"a\" 1}", "[1e999]", "\"\xff\"", "1 2"}) {
    std::string why;
    EXPECT_TRUE(read_json(text, why).is_discarded()) << text;
    EXPECT_TRUE(why.starts_with("damaged")) << text << ": " << why;
  }
}

TEST(JsonText, ExcerptsAreShort) {
  EXPECT_EQ(excerpt("short"), "short");
  EXPECT_EQ(excerpt(std::string(1'000'000, 'a')), std::string(60, 'a') + "...");
  EXPECT_EQ(excerpt(std::string(59, 'a') + "\u00e9\u00e9"), std::string(59, 'a') + "...");
  EXPECT_EQ(json_excerpt(nlohmann::ordered_json({1, 2})), "[1,2]");
}

}  // namespace
}  // namespace floatframe
