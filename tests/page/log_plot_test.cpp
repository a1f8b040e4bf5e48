// Plots over a logarithmic axis as SVG.
#include "floatframe/page/log_plot.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace floatframe::test {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(LogPlot, HasPanelsCurvesAndUnits) {
  const std::vector<double> f{0.1, 1.0, 10.0, 100.0};
  const std::string svg =
      log_plots("a & b", "frequency [Hz]", f,
                {{"Magnitude",
                  "[m per N]",
                  LogPanel::Scale::logarithmic,
                  {{"one", {1.0, 10.0, 5.0, 0.1}}, {"two", {2.0, 2.0, 2.0, 2.0}}}},
                 {"Phase", "", LogPanel::Scale::degrees, {{"one", {0.0, -90.0, -170.0, -180.0}}}}});
  EXPECT_EQ(svg.find("<svg xmlns=\"http://www.w3.org/2000/svg\""), 0u);
  EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
  EXPECT_NE(svg.find("[m per N]"), std::string::npos);
  EXPECT_NE(svg.find("-180\xC2\xB0"), std::string::npos);
  EXPECT_EQ(count_of(svg, "frequency [Hz]"), 2u);
  EXPECT_EQ(count_of(svg, "class=\"curve c0\""), 4u);  // two curves, two keys
  EXPECT_EQ(count_of(svg, "class=\"curve c1\""), 2u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(LogPlot, LeavesOutWhatHasNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> f{1.0, 2.0, 3.0, 4.0, 5.0};
  const std::string svg =
      log_plots("t", "f", f,
                {{"M",
                  "",
                  LogPanel::Scale::logarithmic,
                  {{"gap", {1.0, 0.0, nan, 1.0, 2.0}}, {"none", {0, 0, 0, 0, 0}}}}});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_NE(svg.find("d=\"\""), std::string::npos);
  EXPECT_NE(log_plots("t", "f", {}, {}).find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace floatframe::test
