// Arrays of body files as NumPy writes them, and numbers of the health report.
#include <gtest/gtest.h>

#include <string>

#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/formats/body_file/npy.hpp"

namespace floatframe {
namespace {

/// A copy with the first `from` replaced by a `to` of equal length.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Npy, FortranOrderAndOtherVersions) {
  const std::string c = npy_bytes({{2, 3}, std::vector<double>{1, 2, 3, 4, 5, 6}});
  EXPECT_EQ(c.size() % 64, (6 * sizeof(double)) % 64);  // values aligned as by NumPy
  std::string f =
      with(npy_bytes({{2, 3}, std::vector<double>{1, 4, 2, 5, 3, 6}}), "False,", "True, ");
  EXPECT_EQ(std::get<0>(read_npy(f).values), std::get<0>(read_npy(c).values));
  std::string two = c;  // version 2: four bytes for the length of the header
  two[6] = 2;
  two.insert(10, std::string(2, '\0'));
  EXPECT_EQ(std::get<0>(read_npy(two).values), std::get<0>(read_npy(c).values));
}

TEST(Health, FrequenciesHaveFourDigits) {
  EXPECT_EQ(hertz_text(1234.5678), "1234.568");
  EXPECT_EQ(hertz_text(1.0), "1.000");
  EXPECT_EQ(hertz_text(0.123456), "0.1235");
  EXPECT_EQ(hertz_text(1.234567e-6), "1.235e-06");
  EXPECT_EQ(hertz_text(0.0), "-");
}

}  // namespace
}  // namespace floatframe
