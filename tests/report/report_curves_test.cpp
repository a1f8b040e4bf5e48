// What a report shows is the same whether the rows are in memory or in a file.
#include "floatframe/report/report_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "floatframe/core/output_error.hpp"
#include "floatframe/report/report_html.hpp"
#include "floatframe/report/results_csv.hpp"
#include "floatframe/report/results_file.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

ResultTable rough_table(std::size_t rows) {
  ResultTable table{{{"time", "s"}, {"a.x", "m"}, {"b, \"y\"", "N"}, {"c", ""}}, {}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(),
                        -std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity(),
                        5e-324,
                        -1e-310,
                        1.7976931348623157e308,
                        -0.0};
  for (std::size_t k = 0; k < rows; ++k) {
    table.data.push_back(1e-3 * static_cast<double>(k));
    table.data.push_back(any(random) * std::pow(10.0, 20.0 * any(random)));
    table.data.push_back(std::round(3.0 * any(random)));  // many equal values
    table.data.push_back(random() % 5 == 0 ? odd[random() % std::size(odd)] : any(random));
  }
  return table;
}

/// Rows of a column to be drawn, by looking them up in the table.
std::vector<std::size_t> rows_to_draw(const ResultTable& table, std::size_t column) {
  const std::size_t rows = table.rows(), limit = max_points_per_curve;
  std::vector<std::size_t> kept;
  if (rows <= limit) {
    for (std::size_t row = 0; row < rows; ++row) kept.push_back(row);
    return kept;
  }
  const std::size_t stretches = (limit - 2) / 2, inner = rows - 2;
  kept.push_back(0);
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t from = 1 + s * inner / stretches, to = 1 + (s + 1) * inner / stretches;
    std::size_t smallest = from, largest = from;
    for (std::size_t row = from; row < to; ++row) {
      const double value = table.at(row, column);
      if (!std::isfinite(value)) continue;
      if (!(table.at(smallest, column) <= value)) smallest = row;
      if (!(table.at(largest, column) >= value)) largest = row;
    }
    kept.push_back(std::min(smallest, largest));
    if (smallest != largest) kept.push_back(std::max(smallest, largest));
  }
  kept.push_back(rows - 1);
  return kept;
}

bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}
bool same_points(const CurvePoint& a, const CurvePoint& b) {
  return same_bits(a.time, b.time) && same_bits(a.value, b.value);
}

TEST(ReportCurves, OfAFileAreThoseOfTheTable) {
  const TemporaryFolder folder;
  for (const std::size_t rows : {0u, 1u, 2u, 3u, 1999u, 2000u, 2001u, 2999u, 3998u, 10007u}) {
    const ResultTable table = rough_table(rows);
    const std::string path = folder.file("results.csv");
    {
      ResultsFile file(path, table.columns, false);
      std::size_t at = 0;
      for (std::size_t block = 1; at < rows; block = 3 * block + 1) {
        const std::size_t n = std::min(block, rows - at);
        file.append(std::span(table.data).subspan(4 * at, 4 * n));
        at += n;
        EXPECT_EQ(file.last_time(), table.at(at - 1, 0));
      }
      EXPECT_EQ(file.rows(), rows);
    }
    ASSERT_EQ(folder.read("results.csv"), results_csv(table));
    const ReportCurves a = report_curves(table);
    const ReportCurves b = report_curves(path, table.columns, rows);
    ASSERT_EQ(a.rows, rows);
    for (std::size_t c = 1; c < 4; ++c) {
      const std::vector<std::size_t> drawn = rows_to_draw(table, c);
      ASSERT_EQ(a.points[c].size(), drawn.size()) << rows;
      ASSERT_EQ(b.points[c].size(), drawn.size()) << rows;
      for (std::size_t k = 0; k < drawn.size(); ++k) {
        const CurvePoint expected{table.at(drawn[k], 0), table.at(drawn[k], c)};
        ASSERT_TRUE(same_points(a.points[c][k], expected)) << rows << " " << c << " " << k;
        ASSERT_TRUE(same_points(b.points[c][k], expected)) << rows << " " << c << " " << k;
      }
    }
    Report report;
    report.result.table = table;
    const std::string page = report_html(report);
    report.result.table.data.clear();
    report.curves = b;
    EXPECT_EQ(report_html(report), page);
  }
}

TEST(ReportCurves, OfAFileThatSomebodyChanged) {
  const TemporaryFolder folder;
  const std::vector<Column> columns{{"time", "s"}, {"x", "m"}};
  for (const char* content : {"", "time [s],x [m]\n0,1\n", "time [s],x [m]\n0,1\n1\n",
                              "time [s],x [m]\n0,1\n1,2,3\n", "time [s],x [m]\n0,1\n1,x\n"}) {
    const std::string path = folder.write("results.csv", content);
    EXPECT_THROW(report_curves(path, columns, 2), OutputError) << content;
  }
  const std::string path = folder.write("results.csv", "time [s],x [m]\n0,1\n1,2\ntorn");
  EXPECT_EQ(report_curves(path, columns, 2).extremes[1].last.value, 2.0);
}

TEST(Report, OfAnInterruptedRunSaysSoOnTop) {
  Report report;
  report.result.summary.status = "interrupted";
  report.result.summary.message = "interrupted at t = 3 s of 8 s";
  report.result.summary.duration = 3.0;
  const std::string page = report_html(report);
  EXPECT_NE(page.find("This run was interrupted: the results are partial."), std::string::npos);
  EXPECT_NE(page.find("interrupted at t = 3 s of 8 s"), std::string::npos);
}

}  // namespace
}  // namespace floatframe::test
