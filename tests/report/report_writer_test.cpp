// The report: grouping of curves, ticks, thinning that keeps peaks, escaping of user text, banner
// of a failed run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/report/html_text.hpp"
#include "floatframe/report/report_html.hpp"
#include "floatframe/report/svg_plot.hpp"

namespace floatframe {
namespace {

int count_of(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(HtmlEscape, MarkupControlCharactersAndBrokenUtf8) {
  EXPECT_EQ(html_escape("<a href=\"x\">'&'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(html_escape("L\xC3\xBCgr\xC3\xADs \xE2\x88\x92 \xF0\x9F\x9A\x99"),
            "L\xC3\xBCgr\xC3\xADs \xE2\x88\x92 \xF0\x9F\x9A\x99");
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(html_escape(std::string("a\0b\x1B", 4)), "a" + bad + "b" + bad);
  EXPECT_EQ(html_escape("\xFF"), bad);
  EXPECT_EQ(html_escape("\xC3"), bad);                      // cut
  EXPECT_EQ(html_escape("\xC0\xAF"), bad + bad);            // overlong
  EXPECT_EQ(html_escape("\xED\xA0\x80"), bad + bad + bad);  // surrogate
}

TEST(PlotGroups, QuantityAndUnitDecide) {
  const std::vector<Column> columns{
      {"time", "s"},
      {"chassis.z", "m"},
      {"front_left.wheel.z", "m"},
      {"chassis.pitch", "rad"},
      {"rear_left.wheel.z", "m"},
      {"crank.z", "m"},
      {"front_left.tyre.force", "N"},
      {"tip_x", "m"},
      {"tip_y", "m"},
  };
  const auto groups = group_columns(columns);
  ASSERT_EQ(groups.size(), 5u);
  EXPECT_EQ(groups[0].columns, (std::vector<std::size_t>{1, 5}));
  EXPECT_EQ(groups[0].title, "z");
  EXPECT_EQ(groups[1].columns, (std::vector<std::size_t>{2, 4}));
  EXPECT_EQ(groups[1].title, "wheel.z");
  EXPECT_EQ(groups[1].quantity, "z");
  EXPECT_EQ(groups[2].title, "chassis.pitch");
  EXPECT_EQ(groups[2].unit, "rad");
  EXPECT_EQ(groups[3].title, "front_left.tyre.force");
  EXPECT_EQ(groups[4].title, "tip_x, tip_y");
}

TEST(PlotGroups, ManyCurvesAreSpreadEvenly) {
  std::vector<Column> columns{{"time", "s"}};
  for (int i = 0; i < 9; ++i) columns.push_back({"b" + std::to_string(i) + ".z", "m"});
  const auto groups = group_columns(columns);
  ASSERT_EQ(groups.size(), 3u);
  for (const PlotGroup& group : groups) EXPECT_EQ(group.columns.size(), 3u);
}

TEST(NiceTicks, AreRoundAndCover) {
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{{0, 2.587},
                                                                        {0, 8},
                                                                        {-0.2466, 0.6454},
                                                                        {1e-12, 3e-12},
                                                                        {-5e6, 3e7},
                                                                        {0.56291, 0.56295}}) {
    const Ticks ticks = nice_ticks(low, high, 5, true);
    EXPECT_LE(ticks.first, low + 0.011 * ticks.step);
    EXPECT_GE(ticks.last(), high - 0.011 * ticks.step);
    EXPECT_GE(ticks.count, 3);
    EXPECT_LE(ticks.count, 8);
    const double mantissa =
        ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step * 1.0000001)));
    EXPECT_LT(std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 5)}),
              1e-9);
  }
  const Ticks inside = nice_ticks(0.3, 7.9, 8, false);
  EXPECT_DOUBLE_EQ(inside.first, 1.0);
  EXPECT_DOUBLE_EQ(inside.last(), 7.0);
}

ResultTable long_table(std::size_t rows) {
  ResultTable table{{{"time", "s"}, {"a.x", "m"}}, {}};
  for (std::size_t i = 0; i < rows; ++i) {
    table.data.push_back(1e-3 * static_cast<double>(i));
    table.data.push_back(std::sin(0.01 * static_cast<double>(i)));
  }
  return table;
}

/// Of column 1.
std::vector<std::size_t> drawn_rows(const ResultTable& table) {
  const ReportCurves curves = report_curves(table);
  std::vector<std::size_t> rows;
  for (const CurvePoint& p : curves.points[1])
    rows.push_back(static_cast<std::size_t>(std::lround(1e3 * p.time)));
  return rows;
}

TEST(Thinning, KeepsPeaksEndsAndOrder) {
  ResultTable table = long_table(100000);
  table.data[2 * 43211 + 1] = 99.0;
  table.data[2 * 77777 + 1] = -99.0;
  table.data[2 * 500 + 1] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> rows = drawn_rows(table);
  EXPECT_LE(rows.size(), max_points_per_curve);
  EXPECT_GE(rows.size(), max_points_per_curve / 2);
  EXPECT_EQ(rows.front(), 0u);
  EXPECT_EQ(rows.back(), 99999u);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 43211u));
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 77777u));
  EXPECT_EQ(drawn_rows(long_table(2000)).size(), 2000u);
}

TEST(SvgPlot, DrawsOneCurveAColumnAndBreaksAtNotFinite) {
  ResultTable table = long_table(10);
  table.data[2 * 4 + 1] = std::numeric_limits<double>::infinity();
  const std::string svg = svg_plot(report_curves(table), group_columns(table.columns)[0]);
  EXPECT_EQ(count_of(svg, "<path class=\"curve"), 1);
  const std::size_t curve = svg.find("class=\"curve");
  EXPECT_EQ(count_of(svg.substr(curve), "M"), 2);
  EXPECT_EQ(count_of(svg, "inf"), 0);
  EXPECT_NE(svg.find("time [s]"), std::string::npos);
  EXPECT_NE(svg.find("x [m]"), std::string::npos);
}

TEST(SvgPlot, RoundingNoiseIsNotBlownUp) {
  ResultTable table{{{"time", "s"}, {"v", "m/s"}}, {0, 5.0, 1, 5.0 + 1e-12, 2, 5.0 - 1e-12}};
  const std::string svg = svg_plot(report_curves(table), group_columns(table.columns)[0]);
  EXPECT_NE(svg.find(">5.0<"), std::string::npos) << svg;
  EXPECT_EQ(svg.find(">5.000000"), std::string::npos) << svg;
}

TEST(SvgPlot, SmallAndLargeValuesTakeThePowerIntoTheAxisTitle) {
  ResultTable table{{{"time", "s"}, {"f", "N"}}, {0, -3e6, 1, 5e6}};
  const std::string svg = svg_plot(report_curves(table), group_columns(table.columns)[0]);
  EXPECT_NE(svg.find("font-size=\"10\">6</tspan>"), std::string::npos) << svg;
  EXPECT_NE(svg.find(">4<"), std::string::npos) << svg;
}

TEST(Report, IsSelfContainedAndEscapesTheUsersText) {
  Report report;
  report.result.table = long_table(50);
  report.result.table.columns[1].name = "<script>alert(1)</script>.x";
  report.result.summary.model = "a<b>&\"c\"";
  report.facts = {{"Model <1>", {{"k<", "v>"}}}};
  const std::string page = report_html(report);
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0u);
  for (const char* outside : {"<script", "http", "src=", "<link", "@import", "url("}) {
    EXPECT_EQ(count_of(page, outside), 0) << outside;
  }
  EXPECT_NE(page.find("<h1>a&lt;b&gt;&amp;&quot;c&quot;</h1>"), std::string::npos);
  EXPECT_NE(page.find("Model &lt;1&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<div class=\"failed\""), std::string::npos);
}

TEST(Report, OfAFailedRunSaysSoOnTop) {
  Report report;
  report.result.summary.status = "failed";
  report.result.summary.message = "step at t = 3.8 s: joint <rod>";
  report.result.summary.duration = 3.8;
  for (const std::size_t rows : {std::size_t{0}, std::size_t{1}, std::size_t{20}}) {
    report.result.table = long_table(rows);
    const std::string page = report_html(report);
    EXPECT_NE(page.find("the results are partial"), std::string::npos);
    EXPECT_NE(page.find("joint &lt;rod&gt;"), std::string::npos);
    EXPECT_EQ(count_of(page, "<figure>"), rows == 0 ? 0 : 1);
    EXPECT_EQ(count_of(page, "nan"), 0);
  }
}

}  // namespace
}  // namespace floatframe
