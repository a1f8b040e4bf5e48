#include "floatframe/core/histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace floatframe {
namespace {

TEST(Histogram, BinsFollowEachOtherAndAreNarrow) {
  std::size_t last = 0;
  for (std::uint64_t x = 0; x < 100'000; ++x) {
    const std::size_t bin = Histogram::bin_of(x);
    ASSERT_TRUE(bin == last || bin == last + 1) << x;
    last = bin;
    ASSERT_LE(Histogram::lower(bin), 1e-9 * static_cast<double>(x) * (1 + 1e-12)) << x;
    ASSERT_GT(Histogram::upper(bin), 1e-9 * static_cast<double>(x)) << x;
    ASSERT_LE(Histogram::upper(bin) - Histogram::lower(bin),
              std::max(1.001e-9, Histogram::lower(bin) / 32 * (1 + 1e-12)));
  }
}

TEST(Histogram, LongestDurationsStayInTheLastBin) {
  Histogram h;
  h.add(std::numeric_limits<Nanoseconds>::max());
  EXPECT_EQ(h.count(Histogram::bins - 1), 1u);
  EXPECT_NEAR(h.max(), 9.22e9, 1e7);
}

TEST(Histogram, EmptyAndNegative) {
  Histogram h;
  EXPECT_EQ(h.percentile(0.5), 0.0);
  EXPECT_EQ(h.mean(), 0.0);
  h.add(-5);
  EXPECT_EQ(h.count(0), 1u);
  EXPECT_EQ(h.max(), 0.0);
}

TEST(Histogram, FiguresOfKnownValues) {
  std::mt19937_64 random(1);
  std::lognormal_distribution<double> spread(std::log(8e4), 0.7);
  std::vector<Nanoseconds> values(20'001);
  Histogram h;
  double sum = 0.0;
  for (Nanoseconds& x : values) {
    x = static_cast<Nanoseconds>(spread(random));
    h.add(x);
    sum += static_cast<double>(x);
  }
  std::sort(values.begin(), values.end());
  EXPECT_EQ(h.count(), values.size());
  EXPECT_NEAR(h.mean(), 1e-9 * sum / 20'001, 1e-15);
  EXPECT_DOUBLE_EQ(h.min(), 1e-9 * static_cast<double>(values.front()));
  EXPECT_DOUBLE_EQ(h.max(), 1e-9 * static_cast<double>(values.back()));
  for (const double p : {0.01, 0.5, 0.9, 0.99, 0.999}) {
    const auto exact = 1e-9 * static_cast<double>(values[p * 20'000]);
    EXPECT_GE(h.percentile(p), 0.999 * exact) << p;
    EXPECT_LE(h.percentile(p), 1.04 * exact) << p;
  }
  EXPECT_DOUBLE_EQ(h.percentile(1.0), h.max());
  EXPECT_EQ(h.count_above(0.0), h.count());
  EXPECT_EQ(h.count_above(1.0), 0u);
  const double middle = Histogram::lower(Histogram::bin_of(80'000));
  const auto above = std::count_if(values.begin(), values.end(), [middle](Nanoseconds x) {
    return 1e-9 * static_cast<double>(x) >= middle;
  });
  EXPECT_EQ(h.count_above(middle), static_cast<std::uint64_t>(above));
}

/// Takes what is walked through, and gives it back.
struct Tape {
  std::vector<double> numbers;
  std::size_t at = 0;
  bool reads = false;
  template <class T>
  void operator()(T& x) {
    if (!reads)
      numbers.push_back(static_cast<double>(x));
    else
      x = static_cast<T>(numbers[at++]);
  }
};

TEST(Histogram, ContinuesAfterSerialization) {
  Histogram h, other;
  for (const Nanoseconds x : {5, 700, 90'000, 90'100, 3'000'000}) h.add(x);
  Tape tape;
  h.serialize(tape);
  tape.reads = true;
  other.serialize(tape);
  EXPECT_TRUE(other.holds(5));
  EXPECT_FALSE(other.holds(6));
  EXPECT_EQ(other.percentile(0.5), h.percentile(0.5));
  EXPECT_EQ(other.max(), h.max());
  EXPECT_EQ(other.mean(), h.mean());
  tape.numbers[0] += 1.0;
  tape.at = 0;
  other.serialize(tape);
  EXPECT_FALSE(other.holds(5)) << "a count too many";
}

}  // namespace
}  // namespace floatframe
