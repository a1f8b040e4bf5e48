// Order and error estimated from the rows of three runs, with rows whose error is known.
#include "floatframe/run/step_differences.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace floatframe::test {
namespace {

constexpr double h = 0.1;

/// Rows at the instants of steps h, every `every`-th, up to `end`: `value`(t, step) of each output.
template <class Value>
ResultTable rows(const std::vector<Column>& outputs, double step, double end, const Value& value) {
  ResultTable table;
  table.columns = {{"time", "s"}};
  table.columns.insert(table.columns.end(), outputs.begin(), outputs.end());
  for (int k = 0; k * h < end + 1e-9; ++k) {
    table.data.push_back(k * h);
    for (std::size_t c = 0; c < outputs.size(); ++c) table.data.push_back(value(c, k * h, step));
  }
  return table;
}

/// Of rows up to three ends.
template <class Value>
Verification compared(const std::vector<Column>& outputs, const Value& value, double end = 1.0,
                      double half_end = 1.0, double quarter_end = 1.0) {
  const ResultTable one = rows(outputs, h, end, value),
                    half = rows(outputs, h / 2, half_end, value),
                    quarter = rows(outputs, h / 4, quarter_end, value);
  StepDifferences d(rows_of(one), half, 1e-6 * h);
  const std::size_t width = outputs.size() + 1, first = 3 * width;
  const std::span<const double> all(quarter.data);
  d.take(all.first(std::min(first, all.size())));
  if (all.size() > first) d.take(all.subspan(first));
  return d.result();
}

TEST(StepDifferences, ErrorsOfKnownOrder) {
  // x = sin t + C t h^p: the largest error, C h^p, is at the end.
  for (const double p : {0.6, 1.0, 2.0, 3.4}) {
    const Verification v = compared({{"x", "m"}}, [p](std::size_t, double t, double step) {
      return std::sin(t) + 0.3 * t * std::pow(step, p);
    });
    EXPECT_EQ(v.instants, 11u);
    EXPECT_EQ(v.from, 0.0);
    EXPECT_NEAR(v.to, 1.0, 1e-12);
    ASSERT_EQ(v.outputs.size(), 1u);
    const VerifiedOutput& o = v.outputs[0];
    ASSERT_EQ(o.convergence, Convergence::regular);
    EXPECT_NEAR(o.order, p, 1e-9);
    EXPECT_NEAR(o.error, 0.3 * std::pow(h, p), 1e-9 * o.error);
    EXPECT_NEAR(o.largest, 0.3 * (std::pow(h, p) - std::pow(h / 2, p)), 1e-12);
    EXPECT_NEAR(o.at, 1.0, 1e-12);
    EXPECT_NEAR(o.range, std::sin(1.0) + 0.3 * std::pow(h, p), 1e-12);
  }
}

TEST(StepDifferences, RoundingIsNoOrder) {
  const std::vector<Column> outputs{
      {"same", "m"}, {"noise", "m"}, {"small", "rad"}, {"zero", "N"}, {"nothing else", "m"}};
  const Verification v = compared(outputs, [](std::size_t c, double t, double step) {
    const double noise = std::cos(17.0 * t / step);
    if (c == 0) return 5.0 + t;
    if (c == 1) return 1e-13 * noise;               // beside one of 6 m
    if (c == 2) return 1e-6 * (t + 1e-11 * noise);  // relative to its own range
    if (c == 3) return 0.0;
    return 1e-9 * t * step;  // the whole of it
  });
  for (const VerifiedOutput& o : v.outputs)
    EXPECT_EQ(o.convergence, Convergence::round_off) << o.column.name;
}

TEST(StepDifferences, SmallOutputsConvergeToo) {
  // Another unit than that of large ones, or far above rounding of these.
  const Verification v = compared(
      {{"x", "m"}, {"angle", "rad"}, {"bend", "m"}}, [](std::size_t c, double t, double step) {
        return (c == 0 ? 1.0 : c == 1 ? 1e-12 : 1e-6) * (t + t * step * step);
      });
  for (const VerifiedOutput& o : v.outputs) {
    EXPECT_EQ(o.convergence, Convergence::regular) << o.column.name;
    EXPECT_NEAR(o.order, 2.0, 1e-6) << o.column.name;
  }
}

TEST(StepDifferences, WhatDoesNotConvergeHasNoOrder) {
  const auto of = [](double at_half, double at_quarter) {
    const Verification v = compared({{"x", "m"}}, [=](std::size_t, double t, double step) {
      return t * (step == h ? 1.0 : step == h / 2 ? 1.0 + at_half : 1.0 + at_half + at_quarter);
    });
    return v.outputs[0];
  };
  EXPECT_EQ(of(0.1, 0.1).convergence, Convergence::none);
  EXPECT_EQ(of(0.1, -0.3).convergence, Convergence::none);
  EXPECT_NEAR(of(0.1, 0.3).error, 0.3, 1e-12) << "the larger difference";
  EXPECT_EQ(of(0.1, 0.005).convergence, Convergence::too_coarse);
  EXPECT_EQ(of(0.1, 0.0).convergence, Convergence::too_coarse);
  EXPECT_NEAR(of(0.1, 0.005).error, 0.1, 1e-12);
}

TEST(StepDifferences, RunsThatEndEarly) {
  const auto square = [](std::size_t, double t, double step) { return t + t * step * step; };
  const Verification half = compared({{"x", "m"}}, square, 1.0, 0.5, 0.5);
  EXPECT_EQ(half.instants, 6u);
  EXPECT_NEAR(half.to, 0.5, 1e-12);
  EXPECT_NEAR(half.outputs[0].order, 2.0, 1e-9);
  EXPECT_NEAR(half.outputs[0].error, 0.5 * h * h, 1e-12);
  // The order of the instants of all three, the error of those of two.
  const Verification quarter = compared({{"x", "m"}}, square, 1.0, 1.0, 0.2);
  EXPECT_EQ(quarter.instants, 11u);
  EXPECT_NEAR(quarter.outputs[0].order, 2.0, 1e-9);
  EXPECT_NEAR(quarter.outputs[0].error, h * h, 1e-12);
  const Verification none = compared({{"x", "m"}}, square, 1.0, 1.0, -1.0);
  EXPECT_EQ(none.outputs[0].convergence, Convergence::unknown);
  EXPECT_NEAR(none.outputs[0].error, 0.75 * h * h, 1e-12);
}

TEST(StepDifferences, NumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Verification v =
      compared({{"both", "m"}, {"one", "m"}}, [=](std::size_t c, double t, double step) {
        if (t < 0.5) return t;
        return c == 0 || step == h ? nan : t;
      });
  EXPECT_EQ(v.outputs[0].largest, 0.0);
  EXPECT_EQ(v.outputs[0].convergence, Convergence::round_off);
  EXPECT_TRUE(std::isinf(v.outputs[1].largest));
  EXPECT_NE(v.outputs[1].convergence, Convergence::regular);
}

// The time of a crossing at 0.4 + step^2 / 40 s, which is beside a row.
TEST(StepDifferences, NumbersThatAreThereOneRowLater) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto compare = [&](const auto& value) {
    const std::vector<Column> outputs{{"crossing", "s"}, {"never", "s"}, {"x", "s"}};
    const ResultTable one = rows(outputs, h, 1.0, value), half = rows(outputs, h / 2, 1.0, value),
                      quarter = rows(outputs, h / 4, 1.0, value);
    StepDifferences d(rows_of(one), half, 1e-6 * h, {1, 1, 0});
    d.take(quarter.data);
    return d.result();
  };
  const Verification v = compare([&](std::size_t c, double t, double step) {
    const double crossing = 0.4 - h * h / 100 + step * step / 40;
    if (c == 2) return t + t * step * step;
    return c == 0 && t >= crossing ? crossing : none;
  });
  EXPECT_EQ(v.outputs[0].convergence, Convergence::regular);
  EXPECT_NEAR(v.outputs[0].order, 2.0, 1e-9);
  EXPECT_NEAR(v.outputs[0].error, h * h / 40, 1e-12);
  EXPECT_EQ(v.outputs[1].convergence, Convergence::round_off);
  EXPECT_EQ(v.outputs[1].range, 0.0);
  EXPECT_NEAR(v.outputs[2].order, 2.0, 1e-9);
  // The run does not cross at all, the others do.
  const Verification missed = compare([&](std::size_t c, double t, double step) {
    return c == 0 && t >= 0.5 && step < h ? 0.5 : c == 2 ? t : none;
  });
  EXPECT_EQ(missed.outputs[0].convergence, Convergence::none);
  EXPECT_EQ(missed.outputs[0].largest, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(missed.outputs[0].at, 0.5, 1e-12);
}

}  // namespace
}  // namespace floatframe::test
