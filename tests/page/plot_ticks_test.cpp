// Ticks of pictures; text of users inside HTML.
#include "floatframe/page/plot_ticks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "floatframe/page/html_text.hpp"

namespace floatframe {
namespace {

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

TEST(NiceTicks, AreRoundAndInside) {
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{{0, 2.587},
                                                                        {0, 8},
                                                                        {-0.2466, 0.6454},
                                                                        {1e-12, 3e-12},
                                                                        {-5e6, 3e7},
                                                                        {0.56291, 0.56295}}) {
    const Ticks ticks = nice_ticks(low, high, 5);
    // Inside, and no tick more would be.
    EXPECT_GE(ticks.first, low - 1e-6 * ticks.step);
    EXPECT_LT(ticks.first, low + 1.000001 * ticks.step);
    EXPECT_LE(ticks.at(ticks.count - 1), high + 1e-6 * ticks.step);
    EXPECT_GT(ticks.at(ticks.count), high - 1e-6 * ticks.step);
    EXPECT_GE(ticks.count, 2);
    EXPECT_LE(ticks.count, 6);
    const double mantissa =
        ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step * 1.0000001)));
    EXPECT_LT(std::min({std::abs(mantissa - 1), std::abs(mantissa - 2), std::abs(mantissa - 5)}),
              1e-9);
  }
  const Ticks inside = nice_ticks(0.3, 7.9, 8);
  EXPECT_DOUBLE_EQ(inside.first, 1.0);
  EXPECT_DOUBLE_EQ(inside.at(inside.count - 1), 7.0);
}

}  // namespace
}  // namespace floatframe
