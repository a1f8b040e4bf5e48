// Texts for messages: nothing in them is a command for a terminal, and all that is text stays.
#include "floatframe/core/printable.hpp"

#include <gtest/gtest.h>

namespace floatframe {
namespace {

using std::string_literals::operator""s;

TEST(Printable, TextStays) {
  for (const std::string text :
       {"", "bodies.arm.mass", "a'b\"c\\d", "Größe 5 µm, 車体, 𝄞", "~\u00A0\u2028"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreWrittenOut) {
  EXPECT_EQ(printable("\x1b[31mred\x07"), "\\x1b[31mred\\x07");
  EXPECT_EQ(printable("a\0b"s), "a\\x00b");
  EXPECT_EQ(printable("\x7f"), "\\x7f");
  EXPECT_EQ(printable("a\tb\r"), "a\\tb\\x0d");
  EXPECT_EQ(printable("\u009bm"), "\\xc2\\x9bm") << "the one-character form of ESC [";
}

TEST(Printable, LineBreaksAreKeptOnRequest) {
  EXPECT_EQ(printable("a\nb"), "a\\nb");
  EXPECT_EQ(printable("a\n\x1b\nb", true), "a\n\\x1b\nb");
}

TEST(Printable, BytesThatAreNoUtf8) {
  EXPECT_EQ(printable("\xff\x80"), "\\xff\\x80");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "a slash, overlong";
  EXPECT_EQ(printable("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "above U+10FFFF";
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
  for (const std::string cut : {"\xc3", "\xe8\xbb", "\xf0\x9d\x84"}) {
    std::string written;
    for (const char c : cut) {
      constexpr char digits[] = "0123456789abcdef";
      const auto u = static_cast<unsigned char>(c);
      written += "\\x"s + digits[u / 16] + digits[u % 16];
    }
    EXPECT_EQ(printable(cut), written) << "cut off at the end";
    EXPECT_EQ(printable(cut + "a"), written + "a");
  }
}

TEST(Printable, EscapedTextIsPrintable) {
  std::string all;
  for (int a = 0; a < 256; ++a)
    for (const int b : {0, 10, 65, 128, 191, 255})
      all += {static_cast<char>(a), static_cast<char>(b)};
  const std::string text = printable(all);
  EXPECT_EQ(printable(text), text);
  for (std::size_t k = 0; k < text.size(); k += utf8_length(text, k)) {
    ASSERT_GT(utf8_length(text, k), 0u) << k;
    EXPECT_FALSE(is_control(text, k)) << k;
  }
}

}  // namespace
}  // namespace floatframe
