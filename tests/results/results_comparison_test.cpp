// Differences of two results against those that are known.
#include "floatframe/results/results_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/page/comparison_report.hpp"
#include "floatframe/results/results_csv.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

using Channel = std::function<double(double)>;

class Comparing : public ::testing::Test {
 protected:
  /// Channels x, y, ... at `count` + 1 instants from `start`.
  std::string results(const std::string& name, double start, double step, int count,
                      const std::vector<Channel>& channels, const std::string& unit = "m") {
    ResultTable table{{{"time", "s"}}, {}};
    for (std::size_t c = 0; c < channels.size(); ++c)
      table.columns.push_back({std::string(1, static_cast<char>('x' + c)), unit});
    for (int k = 0; k <= count; ++k) {
      const double t = start + k * step;
      table.data.push_back(t);
      for (const Channel& f : channels) table.data.push_back(f(t));
    }
    const std::string path = (folder_.path() / name).string();
    std::ofstream(path, std::ios::binary) << results_csv(table);
    return path;
  }
  static ResultsComparison compared(const std::string& a, const std::string& b,
                                    const std::vector<std::string>& names = {}) {
    ResultsReader first(a), second(b);
    return compare_results(first, second, names);
  }
  TemporaryFolder folder_;
};

TEST_F(Comparing, EqualInstants) {
  const auto a =
      results("a", 0, 0.1, 10, {[](double t) { return 3.0 * t; }, [](double) { return 0.0; }});
  const auto b = results("b", 0, 0.1, 10,
                         {[](double t) { return 3.0 * t + (t > 0.45 && t < 0.55 ? 0.5 : 0.0); },
                          [](double) { return 0.0; }});
  const ResultsComparison c = compared(a, b);
  ASSERT_EQ(c.channels.size(), 2u);
  EXPECT_EQ(c.instants, 11u);
  EXPECT_FALSE(c.interpolated);
  EXPECT_FALSE(c.spans_differ());
  EXPECT_NEAR(c.channels[0].largest, 0.5, 1e-15);
  EXPECT_NEAR(c.channels[0].at, 0.5, 1e-15);
  EXPECT_NEAR(c.channels[0].rms, 0.5 / std::sqrt(11.0), 1e-15);
  EXPECT_NEAR(c.channels[0].size, 3.0, 1e-15);
  EXPECT_EQ(c.channels[1].largest, 0.0);
  EXPECT_EQ(c.channels[1].relative(), 0.0);
  EXPECT_TRUE(agrees(c.channels[0], {0.17, 0.0}));
  EXPECT_FALSE(agrees(c.channels[0], {0.16, 0.0}));
  EXPECT_TRUE(agrees(c.channels[0], {0.16, 0.1}));
}

// One has all instants of the other: only these count, whichever comes first, and a parabola
// between them makes no difference.
TEST_F(Comparing, InstantsOfTheCoarserOne) {
  const Channel parabola = [](double t) { return t * t; };
  const auto fine = results("fine", 0, 0.01, 300, {parabola});
  const auto coarse = results("coarse", 0, 0.1, 30, {parabola});
  for (const auto& [a, b] : {std::pair{fine, coarse}, {coarse, fine}}) {
    const ResultsComparison c = compared(a, b);
    EXPECT_EQ(c.instants, 31u);
    EXPECT_FALSE(c.interpolated);
    EXPECT_LT(c.channels[0].largest, 1e-14);
  }
}

TEST_F(Comparing, BetweenInstantsOfTheOther) {
  const auto a = results("a", 0, 0.3, 10, {[](double t) { return t * t; }});
  const auto b = results("b", 0, 0.2, 15, {[](double t) { return t * t; }});
  const ResultsComparison c = compared(a, b);
  EXPECT_TRUE(c.interpolated);
  EXPECT_EQ(c.instants, 11u);
  EXPECT_NEAR(c.channels[0].largest, 0.01, 1e-12);  // h^2/8 f'' of h = 0.2 at the middle
  const auto line_a = results("line_a", 0, 0.3, 10, {[](double t) { return 2.0 * t; }});
  const auto line_b = results("line_b", 0, 0.2, 15, {[](double t) { return 2.0 * t; }});
  EXPECT_LT(compared(line_a, line_b).channels[0].largest, 1e-14);
}

TEST_F(Comparing, SpansThatDiffer) {
  const Channel one = [](double t) { return t; };
  const auto a = results("a", 0, 0.1, 50, {one});
  const auto b = results("b", 2, 0.1, 60, {one});
  const ResultsComparison c = compared(a, b);
  EXPECT_TRUE(c.spans_differ());
  EXPECT_NEAR(c.from, 2.0, 1e-12);
  EXPECT_NEAR(c.to, 5.0, 1e-12);
  EXPECT_EQ(c.instants, 31u);
  EXPECT_NEAR(c.end_b, 8.0, 1e-12);
  EXPECT_NEAR(compared(b, a).end_a, 8.0, 1e-12);
  EXPECT_EQ(compared(b, a).instants, 31u);
  ComparedResults r{a, b, c, ComparisonTolerance{1e-9, 1e-9}, false};
  EXPECT_EQ(disagreements(r).size(), 1u);
  r.overlap = true;
  EXPECT_TRUE(disagreements(r).empty());
  const auto later = results("later", 10, 0.1, 5, {one});
  EXPECT_THROW(compared(a, later), InputError);
  EXPECT_THROW(compared(later, a), InputError);
}

TEST_F(Comparing, NumbersThatAreNotFinite) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  const auto a = results("a", 0, 1, 3, {[&](double t) {
                           return t == 1.0 ? nan : t == 2.0 ? inf : t;
                         }});
  const auto b = results("b", 0, 1, 3, {[&](double t) { return t == 3.0 ? nan : t; }});
  EXPECT_EQ(compared(a, a).channels[0].largest, 0.0);
  const ResultsComparison c = compared(a, b);
  EXPECT_TRUE(std::isinf(c.channels[0].largest));
  EXPECT_EQ(c.channels[0].at, 1.0);
  EXPECT_EQ(c.channels[0].rms, 0.0);
  EXPECT_FALSE(agrees(c.channels[0], {1e300, 1e300}));
}

TEST_F(Comparing, ChannelsThatOnlyOneHas) {
  const Channel one = [](double t) { return t; };
  const auto a = results("a", 0, 1, 3, {one, one, one});
  const auto b = results("b", 0, 1, 3, {one});
  const ResultsComparison c = compared(a, b);
  EXPECT_EQ(c.only_a, (std::vector<std::string>{"y", "z"}));
  EXPECT_TRUE(c.only_b.empty());
  EXPECT_FALSE(disagreements({a, b, c, ComparisonTolerance{}, false}).empty());
  EXPECT_TRUE(disagreements({a, b, c, std::nullopt, false}).empty());
  EXPECT_TRUE(compared(a, b, {"x"}).same_channels());
  EXPECT_THROW(compared(a, b, {"y"}), InputError);
  const auto mm = results("mm", 0, 1, 3, {one}, "mm");
  // Nothing to compare is no agreement.
  const auto error = [&](const std::string& first, const std::string& second) {
    return test::error_of([&] { compared(first, second); });
  };
  EXPECT_EQ(test::without_folders(error(b, mm)), "mm:1: missing") << error(b, mm);
  const auto none = results("none", 0, 1, 3, {});
  EXPECT_EQ(test::without_folders(error(a, none)), "none:1: missing") << error(a, none);
  EXPECT_EQ(test::without_folders(error(none, none)), "none:1: missing");
}

}  // namespace
}  // namespace floatframe::test
