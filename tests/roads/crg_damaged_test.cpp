// OpenCRG files as text and as binary numbers, what they may leave out, and damaged ones.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "floatframe/roads/crg_file.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

const std::string road_block =
    "$ROAD_CRG  ! of a test\nREFERENCE_LINE_INCREMENT = 0.5 ! step\n* a comment\n"
    "long_section_v_increment = 1.0\n$\n";

std::string header_text(const std::string& format, const std::string& channels,
                        const std::string& more = "") {
  return "$CT\nmade for a test, $ROAD_CRG has no meaning here\n$\n" + road_block + more +
         "$KD_Definition\n#:" + format + "\n" + channels + "$\n$$$$ ! numbers\n";
}
const std::string three_sections = "D:long section 1,m\nD:long section 2,m\nD:long section 3,m\n";

template <class Float, class Bits>
std::string big_endian(const std::vector<double>& numbers) {
  std::string out;
  for (const double x : numbers) {
    const Bits bits = std::bit_cast<Bits>(static_cast<Float>(x));
    for (int k = sizeof(Bits) - 1; k >= 0; --k) out += static_cast<char>(bits >> (8 * k) & 0xff);
  }
  return out;
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> heights = {0.125, 0.25, 0.5, none, -1.0, 2.0, 0.75, 0.5, none};

void expect_heights(const CrgRoad& road) {
  ASSERT_EQ(road.rows(), 3u);
  ASSERT_EQ(road.columns(), 3u);
  const double expected[] = {0.125, 0.25, 0.5, -1.0, -1.0, 2.0, 0.75, 0.5, 0.5};
  for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(road.grid(k / 3, k % 3), expected[k]);
  EXPECT_EQ(road.v, (std::vector<double>{-1.0, 0.0, 1.0}));
  EXPECT_EQ(road.line.last(), 1.0);
  ASSERT_EQ(road.notes.size(), 1u);
  EXPECT_TRUE(contains(road.notes[0], "2 heights are missing"));
}

TEST(CrgFile, FourFormats) {
  const std::string text = header_text("LRFI", three_sections) +
                           " 0.1250000 0.2500000 0.5000000\r\n"
                           " *missing*-1.0000000 2.0000000\n0.75      5.0D-1    **unused**\n\n";
  expect_heights(read_crg(text, "a.crg"));
  const std::string wide = header_text("LDFI", three_sections) +
                           "               0.125                0.25                0.50\n"
                           "           *missing*                -1.0               2.0E0\n"
                           "                0.75                 0.5                   *\n";
  expect_heights(read_crg(wide, "a.crg"));
  // Filled with NaN up to 80 bytes.
  std::vector<double> padded = heights;
  padded.resize(20, none);
  const CrgRoad single = read_crg(
      header_text("KRBI", three_sections) + big_endian<float, std::uint32_t>(padded), "a.crg");
  expect_heights(single);
  EXPECT_TRUE(single.doubles.empty());
  padded.resize(10);
  expect_heights(read_crg(
      header_text("KDBI", three_sections) + big_endian<double, std::uint64_t>(padded), "a.crg"));
}

TEST(CrgFile, SectionsByPositionInAnyOrder) {
  const CrgRoad road = read_crg(
      header_text("LRFI",
                  "D:long section at v = 0.5,m\nD:long section at v = -2.0,m\n"
                  "D:long section at v = 3,m\nD:quality,-\nU:reference line u,m,4.0,0.25\n") +
          "       2.0       1.0       3.0       9.0\n       2.0       1.0       3.0       9.0\n",
      "a.crg");
  EXPECT_EQ(road.v, (std::vector<double>{-2.0, 0.5, 3.0}));
  EXPECT_TRUE(road.uniform);
  EXPECT_EQ(road.line.first(), 4.0);
  EXPECT_EQ(road.line.step(), 0.25);
  EXPECT_NEAR(crg_height(road, 4.1, -0.75).z, 1.5, 1e-15);
  ASSERT_EQ(road.notes.size(), 1u);
  EXPECT_TRUE(contains(road.notes[0], "quality"));
}

TEST(CrgFile, UnevenSections) {
  const CrgRoad road =
      read_crg(header_text("LRFI",
                           "D:long section at v = -2,m\nD:long section at v = "
                           "0.5,m\nD:long section at v = 1.5,m\n") +
                   "       0.0       2.5       2.0\n       0.0       2.5       2.0\n",
               "a.crg");
  EXPECT_FALSE(road.uniform);
  for (const double v : {-1.7, 0.1, 0.5, 1.4}) {
    const double z = v < 0.5 ? v + 2.0 : 2.5 - 0.5 * (v - 0.5);
    EXPECT_NEAR(crg_height(road, 0.2, v).z, z, 1e-15) << v;
  }
}

TEST(CrgFile, ModifiersAreSaidAndNotApplied) {
  const std::string numbers = "       1.0       1.0       1.0\n       1.0       1.0       1.0\n";
  const CrgRoad plain = read_crg(header_text("LRFI", three_sections) + numbers, "a.crg");
  const CrgRoad road =
      read_crg(header_text("LRFI", three_sections,
                           "$ROAD_CRG_MODS\nSCALE_Z_GRID = 3\nREFLINE_OFFSET_X = 7.0\n$\n"
                           "$ROAD_CRG_OPTS\nBORDER_MODE_U = 4\nBORDER_OFFSET_V = 0.5\n"
                           "BORDER_SMOOTH_UBEG = 2.0\nCURV_MODE = 1\n$\n") +
                   numbers,
               "a.crg");
  EXPECT_TRUE(plain.notes.empty());
  ASSERT_EQ(road.notes.size(), 2u);
  EXPECT_TRUE(contains(road.notes[0], "SCALE_Z_GRID"));
  EXPECT_TRUE(contains(road.notes[1], "BORDER_SMOOTH_UBEG"));
  EXPECT_TRUE(contains(road.notes[1], "CURV_MODE"));
  EXPECT_EQ(road.edge_u.mode, CrgBorder::reflect);
  EXPECT_EQ(crg_surface(road, 0.2, 0.3).z, 1.0);
  EXPECT_EQ(crg_surface(road, 0.2, 3.0).z, 1.5);
}

/// The line is as long as the numbers say although its end is given 0.1 m further.
TEST(CrgFile, TheLineEndsWhereTheHeaderSays) {
  std::string text = header_text("LRFI", "D:reference line phi,rad\n" + three_sections);
  text.insert(text.find("long_section"), "REFERENCE_LINE_END_X = 5.1\nREFERENCE_LINE_END_Y = 0\n");
  text += "**unused**       0.0       0.0       0.0\n";
  for (int k = 0; k < 10; ++k) text += "       0.0       0.0       0.0       0.0\n";
  const CrgRoad road = read_crg(text, "a.crg");
  EXPECT_NEAR(road.line.node(10).x, 5.1, 1e-14);
  ASSERT_EQ(road.notes.size(), 1u);
  EXPECT_TRUE(contains(road.notes[0], "0.1 m"));
}

TEST(CrgFile, DamagedOnes) {
  const std::string good = header_text("LRFI", three_sections);
  const std::string row = "       1.0       1.0       1.0\n";
  ASSERT_EQ(error_of([&] { read_crg(good + row + row, "a.crg"); }), "no error");
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string text = good + row + row;
    text.replace(text.find(old), old.size(), now);
    return text;
  };
  const std::string phi = header_text("LRFI", "D:reference line phi,rad\n" + three_sections);
  const std::pair<std::string, std::string> files[] = {
      {"", "a.crg: damaged"},
      {with("$$$$ ! numbers\n", ""), "a.crg:16: damaged"},
      {with("$\n$$", "$$"), "a.crg:14:1: damaged"},
      {with("$\n$KD", "$KD"), "a.crg:8:1: damaged"},
      {with("$CT", "$"), "a.crg:1:1: damaged"},
      {with("LRFI", "LRFX"), "a.crg:10:3: unsupported"},
      {with("#:LRFI\n", ""), "a.crg:14: missing"},
      {with("= 0.5", "= half"), "a.crg:5:28: not_a_number"},
      {with("= 0.5", "= -0.5"), "a.crg:5:28: out_of_range"},
      {with("= 0.5", ": 0.5"), "a.crg:5:1: wrong_value"},
      {with("* a comment", "REFERENCE_LINE_INCREMENT = 1"), "a.crg:6:1: duplicate"},
      {with("* a comment", "REFERENCE_LINE_END_U = 9.5"), "a.crg:6:24: mismatch"},
      {with("* a comment", "LONG_SECTION_V_LEFT = 5.0\nLONG_SECTION_V_RIGHT = -5"),
       "a.crg:8:28: contradiction"},
      {with("* a comment", "LONG_SECTION_V_LEFT = -1.0\nLONG_SECTION_V_RIGHT = 1"),
       "a.crg:7:24: contradiction"},
      {with("section 3", "section 4"), "a.crg:13:3: wrong_value"},
      {with("section 3", "section 2"), "a.crg:13:3: duplicate"},
      {with("section 3", "section at v = 2"), "a.crg:13:3: contradiction"},
      {with("section 3,m", "section 3,mm"), "a.crg:13:3: wrong_value"},
      {with("D:long section 2,m\nD:long section 3,m\n", ""), "a.crg:13: missing"},
      {with("D:long section 3,m", "D:reference line x,m"), "a.crg:13:3: unsupported"},
      {header_text("LRFI", three_sections, "$ROAD_CRG_FILE\nother.crg\n$\n") + row + row,
       "a.crg:10:1: unsupported"},
      {header_text("LRFI", three_sections, "$ROAD_CRG_OPTS\nBORDER_MODE_U = 5\n$\n") + row,
       "a.crg:10:17: wrong_value"},
      {good + row, "a.crg:17: missing"},
      {good + "       1.0       1.0       1.0       1.0\n" + row, "a.crg:16:31: damaged"},
      {good + row + "       1.0       1.0\n", "a.crg:17:21: missing"},
      {good + row + "       1.0       1,0       1.0\n", "a.crg:17:11: not_a_number"},
      {good + row + " *missing* *missing* *missing*\n", "a.crg:17:1: missing"},
      {good + row + row + "\n" + row, "a.crg:19:1: damaged"},
      {phi + " *missing*" + row + " *missing*" + row, "a.crg:18:1: missing"},
      {header_text("KDBI", three_sections) + big_endian<double, std::uint64_t>({1, 1, 1, 1}),
       "a.crg: damaged"},
      {header_text("KDBI", three_sections) +
           big_endian<double, std::uint64_t>({1, 1, 1, none, none, none, 1, 1, 1}),
       "a.crg: missing"},
      {header_text("KDBI", three_sections) + big_endian<double, std::uint64_t>({1, HUGE_VAL, 1}),
       "a.crg: not_finite"}};
  for (const auto& [text, expected] : files)
    EXPECT_EQ(error_of([&] { read_crg(text, "a.crg"); }), expected) << text;
}

}  // namespace
}  // namespace floatframe::test
