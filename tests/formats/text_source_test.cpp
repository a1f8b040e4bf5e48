// Texts of finite-element programs: numbers, gzip, includes.
#include "floatframe/formats/text/text_source.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "support/error_of.hpp"

namespace floatframe {
namespace {

std::string gzip(const std::string& text) {
  z_stream z{};
  deflateInit2(&z, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&z, text.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  z.avail_in = static_cast<uInt>(text.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  deflate(&z, Z_FINISH);
  out.resize(out.size() - z.avail_out);
  deflateEnd(&z);
  return out;
}

std::string error_of_gzip(const std::string& bytes) {
  return test::error_of([&] { decompressed(bytes, "a.inp.gz"); });
}

TEST(Gzip, AFileThatIsDamagedFromItsBeginningIsNotEmpty) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "damaged_from_its_beginning.inp.gz";
  const auto said = [&](const std::string& bytes) -> std::string {
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      read_fe_file(file);
    } catch (const InputError& error) {
      return error_code_name(error.errors().front().code);
    }
    return "no error";
  };
  EXPECT_EQ(said("\x1f\x8b\x08 broken"), "damaged");
  EXPECT_EQ(said(gzip("")), "missing");
  EXPECT_EQ(said(""), "missing");
  std::filesystem::remove(file);
}

TEST(TextFields, RealsOfFortranAndNastran) {
  EXPECT_EQ(parse_real("1."), 1.0);
  EXPECT_EQ(parse_real(" .5 "), 0.5);
  EXPECT_EQ(parse_real("-12"), -12.0);
  EXPECT_EQ(parse_real("+1.5"), 1.5);
  EXPECT_EQ(parse_real("1e5"), 1e5);
  EXPECT_EQ(parse_real("1d5"), 1e5);
  EXPECT_EQ(parse_real("1.5D+03"), 1500.0);
  EXPECT_EQ(parse_real("-2.5d-3"), -2.5e-3);
  EXPECT_EQ(parse_real("3.+5"), 3e5);
  EXPECT_EQ(parse_real("-1.2-3"), -1.2e-3);
  EXPECT_EQ(parse_real("7-3"), 7e-3);
  EXPECT_EQ(parse_real("+.1D+1"), 1.0);
  EXPECT_EQ(parse_real("1e-400"), 0.0);
  EXPECT_EQ(parse_real("4.9406564584124654e-324"), 4.9406564584124654e-324);
  for (const char* text :
       {"",      " ",     ".",     "+",    "-",        "e5",    "1e",     "1d+",  "1..2",
        "1.2.3", "nan",   "inf",   "-inf", "infinity", "1e999", "-1d999", "0x10", "1,5",
        "1 2",   "1+2+3", "1e5-3", "--1",  "+-1",      "1_0",   "1f",     "1e+-5"}) {
    EXPECT_FALSE(parse_real(text).has_value()) << text;
  }
  EXPECT_EQ(not_a_real("1e999"), "'1e999' is too large");
  EXPECT_EQ(not_a_real("1.+999"), "'1.+999' is too large");
  EXPECT_EQ(not_a_real("inf"), "'inf' is not a number");
  EXPECT_EQ(not_a_real(" "), "a number is missing");
}

TEST(TextFields, WholeNumbers) {
  EXPECT_EQ(parse_integer(" +12 "), 12);
  EXPECT_EQ(parse_integer("-3"), -3);
  EXPECT_EQ(parse_integer("2147483647"), 2147483647);
  for (const char* text : {"", "2147483648", "1.", "1e3", "+-1", "+", "0x1", "12a"}) {
    EXPECT_FALSE(parse_integer(text).has_value()) << text;
  }
  EXPECT_FALSE(parse_label("0").has_value());
  EXPECT_FALSE(parse_label("-1").has_value());
  EXPECT_EQ(not_an_integer("1.5"), "'1.5' is not a whole number");
  EXPECT_EQ(not_an_integer("-4"), "'-4' is not positive");
  EXPECT_EQ(not_an_integer("99999999999"), "'99999999999' is too large");
  EXPECT_EQ(shown(std::string("a\0\x80z", 4)), "'a??z'");
}

TEST(TextFields, FieldsAreShownAsUtf8) {
  const std::string a = "\xc3\xa4", latin = "\xe4";  // a with dots, and in Latin-1
  EXPECT_EQ(shown("Tr" + a + "ger"), "'Tr" + a + "ger'");
  EXPECT_EQ(shown("Tr" + latin + "ger"), "'Tr" + a + "ger'");
  EXPECT_EQ(shown(latin + a), "'" + a + a + "'");
  std::string long_one, long_latin, forty;
  for (int i = 0; i < 40; ++i) forty += a;
  for (int i = 0; i < 500; ++i) {
    long_one += a;
    long_latin += latin;
  }
  EXPECT_EQ(shown(forty), "'" + forty + "'");
  EXPECT_EQ(shown(forty + "b"), "'" + forty + "...'");
  EXPECT_EQ(shown(long_one), "'" + forty + "...'");
  EXPECT_EQ(shown(long_latin), "'" + forty + "...'");
  EXPECT_EQ(shown("b" + long_one), "'b" + forty.substr(2) + "...'");
  EXPECT_EQ(message_text("a\xff\xc3"), "a\xc3\xbf\xc3\x83");
}

// Words of a file in Latin-1, in quotes or not.
TEST(TextSource, ErrorsAreUtf8) {
  const auto error = [](bool stops) {
    return test::sentences_of([&] {
      TextSource source("x\n", "a.inp");
      if (stops)
        source.stop(ErrorCode::not_found, {0, 1}, "the set Tr\xe4ger holds " + shown("\xe4"));
      source.error(ErrorCode::not_found, {0, 1}, "the set Tr\xe4ger holds " + shown("\xe4"));
      source.throw_if_any();
    });
  };
  EXPECT_EQ(error(false), "a.inp:1: the set Tr\xc3\xa4ger holds '\xc3\xa4'");
  EXPECT_EQ(error(true), error(false));
}

TEST(TextSource, LinesEndingsAndPlaces) {
  TextSource source(
      "\xef\xbb\xbf"
      "one\r\n\ntwo",
      "a.inp");
  std::string_view line;
  ASSERT_TRUE(source.next(line));
  EXPECT_EQ(line, "one");
  ASSERT_TRUE(source.next(line));
  EXPECT_EQ(line, "");
  ASSERT_TRUE(source.next(line));
  EXPECT_EQ(line, "two");
  EXPECT_EQ(source.here().line, 3);
  source.put_back();
  EXPECT_EQ(source.here().line, 2);
  ASSERT_TRUE(source.next(line));
  EXPECT_EQ(line, "two");
  EXPECT_EQ(source.here().line, 3);
  EXPECT_FALSE(source.next(line));
  EXPECT_EQ(source.mark(source.here()).line, 3);
}

TEST(TextSource, ErrorsHaveAnEnd) {
  TextSource source("x\n", "a.inp");
  try {
    for (int k = 0; k < 1000; ++k) source.error(ErrorCode::duplicate, "again");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.errors().size(), TextSource::most_errors + 1);
    EXPECT_EQ(test::code_of(error.errors().back()), "too_large (0)");
  }
}

TEST(Gzip, WholeAndInMembers) {
  std::string text;
  for (int k = 0; k < 100000; ++k) text += std::to_string(k) + "\n";
  EXPECT_EQ(decompressed(gzip(text), "a"), text);
  EXPECT_EQ(decompressed(gzip(text) + gzip("more\n"), "a"), text + "more\n");
  EXPECT_EQ(decompressed("no gzip", "a"), "no gzip");
}

TEST(Gzip, DamagedAndTruncated) {
  std::string text;
  for (int k = 0; k < 100000; ++k) text += std::to_string(k * 7919 % 10007) + "\n";
  const std::string bytes = gzip(text);
  for (const std::size_t size :
       {std::size_t{2}, std::size_t{12}, bytes.size() / 2, bytes.size() - 5}) {
    EXPECT_EQ(error_of_gzip(bytes.substr(0, size)), "a.inp.gz: damaged") << size;
  }
  std::string damaged = bytes;
  damaged[damaged.size() - 6] = static_cast<char>(damaged[damaged.size() - 6] ^ 0x55);
  EXPECT_EQ(error_of_gzip(damaged), "a.inp.gz: damaged");
}

TEST(Gzip, BombsAreNotRead) {
  // 70 MiB of zeros in 70 kB; of digits that repeat less in a hundredth, of which 16 MB would be
  // more than a gigabyte.
  std::string digits;
  for (int i = 0; digits.size() < std::size_t{70} << 20; ++i)
    digits += std::to_string(i / 4) + std::string(60, ' ') + '\n';
  const std::string packed = gzip(digits);
  EXPECT_GT(digits.size(), 40 * packed.size());
  EXPECT_LT(digits.size(), 200 * packed.size());
  EXPECT_EQ(error_of_gzip(packed), "a.inp.gz: unsupported");
  EXPECT_EQ(error_of_gzip(gzip(std::string(std::size_t{70} << 20, '0'))), "a.inp.gz: unsupported");
}

}  // namespace
}  // namespace floatframe
