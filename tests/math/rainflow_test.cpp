// Rainflow counting against the example of the standard and what holds for any history.
#include "floatframe/math/rainflow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

std::map<double, double> counts_of(const std::vector<double>& values) {
  std::map<double, double> out;
  for (const RainflowCycle& c : rainflow(values)) out[c.range] += c.count;
  return out;
}

TEST(Rainflow, ExampleOfTheStandard) {
  const std::vector<double> history{-2, 1, -3, 5, -1, 3, -4, 4, -2};
  EXPECT_EQ(counts_of(history),
            (std::map<double, double>{{3, 0.5}, {4, 1.5}, {6, 0.5}, {8, 1.0}, {9, 0.5}}));
  // The one full cycle is E-F: 5th and 6th point.
  for (const RainflowCycle& c : rainflow(history))
    if (c.count == 1.0) {
      EXPECT_EQ(c.begin, 4u);
      EXPECT_EQ(c.end, 5u);
      EXPECT_EQ(c.mean, 1.0);
    }
}

TEST(Rainflow, PlateausSlopesAndNothing) {
  EXPECT_TRUE(rainflow({}).empty());
  EXPECT_TRUE(rainflow(std::vector<double>{3.0}).empty());
  EXPECT_TRUE(rainflow(std::vector<double>{3.0, 3.0, 3.0}).empty());
  EXPECT_EQ(counts_of({0, 1, 2, 3}), (std::map<double, double>{{3, 0.5}}));
  EXPECT_EQ(counts_of({0, 0, 2, 2, 2, -1, -1}), (std::map<double, double>{{2, 0.5}, {3, 0.5}}));
  EXPECT_EQ(turning_points(std::vector<double>{1, 1, 2, 3, 3, 0}),
            (std::vector<std::size_t>{0, 3, 5}));
}

// Half cycles and cycles use up all turning points; stretching in time, a shift and a change of
// sign do not matter; the largest range is that of the history.
TEST(Rainflow, OfAnyHistory) {
  Random random(11);
  for (int k = 0; k < 50; ++k) {
    std::vector<double> history, slow, other;
    for (int i = 0; i < 40 + k; ++i) history.push_back(std::round(random(0.0, 8.0)));
    for (const double x : history) {
      slow.insert(slow.end(), 3, x);
      other.push_back(5.0 - x);
    }
    const std::vector<RainflowCycle> found = rainflow(history);
    double points = 0.0, largest = 0.0;
    for (const RainflowCycle& c : found) {
      points += 2.0 * c.count;
      largest = std::max(largest, c.range);
      EXPECT_EQ(c.range, std::abs(history[c.begin] - history[c.end]));
    }
    EXPECT_EQ(points + 1.0, static_cast<double>(turning_points(history).size()));
    const auto [low, high] = std::minmax_element(history.begin(), history.end());
    EXPECT_EQ(largest, *high - *low);
    EXPECT_EQ(counts_of(history), counts_of(slow));
    EXPECT_EQ(counts_of(history), counts_of(other));
  }
}

TEST(Rainflow, EquivalentRange) {
  const std::vector<double> history{0, 2, 0, 2, 0, 2, 0, 2, 0};
  EXPECT_NEAR(equivalent_range(rainflow(history), 5.0, 4.0), 2.0, 1e-14);
  EXPECT_NEAR(equivalent_range(rainflow(history), 3.0, 1.0), 2.0 * std::cbrt(4.0), 1e-14);
  const std::vector<double> large{0, 1e200, 0};
  EXPECT_NEAR(equivalent_range(rainflow(large), 9.0, 1.0) / 1e200, 1.0, 1e-14);
  EXPECT_EQ(equivalent_range({}, 3.0, 1.0), 0.0);
}

}  // namespace
}  // namespace floatframe::test
