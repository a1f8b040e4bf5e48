// Pages of the viewer as the program writes them: numbers come back as they went in, no text ends
// its element.
#include "floatframe/page/page_writer.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "floatframe/core/base64.hpp"
#include "floatframe/core/output_error.hpp"
#include "floatframe/page/run_page.hpp"

namespace floatframe::test {
namespace {

using Json = nlohmann::ordered_json;

double value_of_half(std::uint16_t h) {
  const int exponent = (h >> 10) & 31, mantissa = h & 1023;
  const double sign = (h & 0x8000) != 0 ? -1.0 : 1.0;
  if (exponent == 31) return mantissa != 0 ? std::nan("") : sign * INFINITY;
  if (exponent == 0) return sign * std::ldexp(mantissa, -24);
  return sign * std::ldexp(1024 + mantissa, exponent - 25);
}

TEST(HalfFloat, EveryOneIsItself) {
  for (unsigned h = 0; h < 0x10000u; ++h) {
    const double v = value_of_half(static_cast<std::uint16_t>(h));
    if (std::isnan(v))
      EXPECT_TRUE(std::isnan(value_of_half(half_of(static_cast<float>(v)))));
    else
      ASSERT_EQ(half_of(static_cast<float>(v)), h) << v;
  }
}

TEST(HalfFloat, RoundsToTheNearestAndEven) {
  for (unsigned h = 0; h < 0x7bffu; ++h) {
    const auto low = static_cast<std::uint16_t>(h), high = static_cast<std::uint16_t>(h + 1);
    const auto middle = static_cast<float>(0.5 * (value_of_half(low) + value_of_half(high)));
    ASSERT_EQ(half_of(middle), h % 2 == 0 ? low : high) << middle;
    ASSERT_EQ(half_of(std::nextafter(middle, 0.0f)), low) << middle;
    ASSERT_EQ(half_of(std::nextafter(middle, INFINITY)), high) << middle;
    ASSERT_EQ(half_of(-middle), 0x8000u | (h % 2 == 0 ? low : high));
  }
  EXPECT_EQ(half_of(65519.0f), 0x7bff);
  EXPECT_EQ(half_of(65520.0f), 0x7c00);
  EXPECT_EQ(half_of(1e30f), 0x7c00);
}

TEST(Base64, OfTheStandard) {
  const char* texts[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t n = 0; n < 7; ++n)
    EXPECT_EQ(base64(std::string("foobar").substr(0, n)), texts[n]);
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

/// The page object and the bytes of the buffer, as a browser finds them.
struct ReadPage {
  Json page;
  std::string buffer;
};

std::string between(const std::string& html, const std::string& begin) {
  const std::size_t at = html.find(begin);
  EXPECT_NE(at, std::string::npos);
  const std::size_t from = html.find('>', at) + 1;
  return html.substr(from, html.find("</script>", from) - from);
}

ReadPage read_page(const std::string& html) {
  ReadPage out;
  out.page = Json::parse(between(html, "<script type=\"application/json\" id=\"floatframe-page\""));
  const std::string text =
      between(html, "<script type=\"application/octet-stream;base64\" id=\"floatframe-buffer\"");
  std::string packed;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const auto digit = static_cast<std::uint32_t>(
        std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c));
    bits = bits << 6 | digit;
    if ((count += 6) >= 8) packed += static_cast<char>(bits >> (count -= 8) & 255u);
  }
  out.buffer.resize(1 << 20);
  uLongf size = out.buffer.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(out.buffer.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  out.buffer.resize(size);
  return out;
}

template <class T>
std::vector<T> numbers(const ReadPage& p, const Json& view) {
  std::size_t count = 1;
  for (const auto& n : view["shape"]) count *= n.get<std::size_t>();
  const auto offset = view["offset"].get<std::size_t>();
  EXPECT_EQ(offset % 8, 0u);
  EXPECT_LE(offset + count * sizeof(T), p.buffer.size());
  std::vector<T> out(count);
  std::memcpy(out.data(), p.buffer.data() + offset, count * sizeof(T));
  return out;
}

TEST(PageBuffer, NumbersComeBack) {
  PageBuffer buffer;
  const std::vector<double> d{1.0, -0.1, 1e300};
  const std::vector<float> f{1.5f, -2.25f, 1e-8f, 70000.0f, 0.1f};
  const std::vector<std::uint32_t> narrow{0, 65535, 7}, wide{0, 65536};
  Json page{{"f", buffer.add(std::span<const float>(f), {5})},
            {"d", buffer.add(std::span<const double>(d), {3, 1})},
            {"h", buffer.add_half(f, {5})},
            {"n", buffer.add(std::span<const std::uint32_t>(narrow), {3})},
            {"w", buffer.add(std::span<const std::uint32_t>(wide), {2})}};
  const std::string html = page_html("<p><!--FLOATFRAME-DATA--></p>", page, buffer);
  EXPECT_EQ(html.substr(0, 3), "<p>");
  EXPECT_EQ(html.substr(html.size() - 4), "</p>");
  const ReadPage p = read_page(html);
  EXPECT_EQ(numbers<double>(p, p.page["d"]), d);
  EXPECT_EQ(p.page["d"]["shape"], Json({3, 1}));
  EXPECT_EQ(numbers<float>(p, p.page["f"]), f);
  EXPECT_EQ(numbers<std::uint16_t>(p, p.page["h"])[1], half_of(-2.25f));
  EXPECT_EQ(p.page["n"]["type"], "u16");
  EXPECT_EQ(numbers<std::uint16_t>(p, p.page["n"]), (std::vector<std::uint16_t>{0, 65535, 7}));
  EXPECT_EQ(numbers<std::uint32_t>(p, p.page["w"]), wide);
}

TEST(PageHtml, NoTextEndsItsElement) {
  const Json page{{"title", "</script><script>alert(1)</script><!--"}, {"bad", "\xff"}};
  const std::string html = page_html("<!--FLOATFRAME-DATA-->", page, {});
  EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(read_page(html).page["title"], page["title"]);
  EXPECT_THROW(page_html("no place", page, {}), OutputError);
}

TEST(PageCurvesOfResults, AllRowsOrThePeaks) {
  const auto table_of = [](std::size_t rows) {
    ResultTable t{{{"time", "s"}, {"wave", "m"}, {"still", "m"}, {"noise", "m"}, {"gap", "N"}}, {}};
    for (std::size_t k = 0; k < rows; ++k) {
      const double x = 1e-3 * static_cast<double>(k);
      t.data.insert(t.data.end(), {x, 1e3 + std::sin(x), 2.0, 1e-9 * std::sin(7 * x),
                                   k % 3 == 0      ? std::nan("")
                                   : k == rows / 2 ? 50.0
                                                   : x});
    }
    return t;
  };
  PageBuffer buffer;
  const ResultTable small = table_of(501);
  const PageCurves all = page_curves(small);
  EXPECT_FALSE(all.thinned());
  const Json json = curves_json(all, {{"arm", "position"}}, buffer);
  const ReadPage p = read_page(page_html("<!--FLOATFRAME-DATA-->", json, buffer));
  const auto time = numbers<double>(p, p.page["time"]);
  ASSERT_EQ(time.size(), 501u);
  const Json& wave = p.page["channels"][0];
  EXPECT_EQ(wave["body"], "arm");
  const auto values = numbers<float>(p, wave["data"]);
  for (std::size_t k = 0; k < 501; ++k) {
    EXPECT_EQ(time[k], small.at(k, 0));
    EXPECT_NEAR(wave["offset"].get<double>() + static_cast<double>(values[k]), small.at(k, 1),
                1e-7);
  }
  EXPECT_FALSE(wave["constant"].get<bool>());
  EXPECT_TRUE(p.page["channels"][1]["constant"].get<bool>());
  EXPECT_TRUE(p.page["channels"][2]["noise"].get<bool>());
  EXPECT_FALSE(p.page["channels"][3]["noise"].get<bool>());

  const std::size_t rows = most_numbers_of_curves;
  const PageCurves thin = page_curves(table_of(rows));
  EXPECT_TRUE(thin.thinned());
  EXPECT_LE(thin.time.size(), most_instants_of_curves);
  EXPECT_GT(thin.time.size() + 4, most_instants_of_curves);
  for (std::size_t k = 1; k < thin.time.size(); ++k) ASSERT_LT(thin.time[k - 1], thin.time[k]);
  EXPECT_EQ(thin.time.front(), 0.0);
  EXPECT_EQ(thin.time.back(), 1e-3 * static_cast<double>(rows - 1));
  // A peak of one row is there, at its place to within a stretch.
  const double stretch = 2e-3 * static_cast<double>(rows) / most_instants_of_curves;
  bool found = false;
  for (std::size_t k = 0; k < thin.time.size(); ++k)
    found = found || (thin.values[3][k] == 50.0 &&
                      std::abs(thin.time[k] - 5e-4 * static_cast<double>(rows)) < stretch);
  EXPECT_TRUE(found);
}

TEST(RunPage, OfARunThatDidNotStart) {
  Report report;
  report.result.summary.status = "failed";
  PageBuffer buffer;
  const Json page = run_page(report, page_curves(report.result.table), buffer);
  EXPECT_TRUE(page["curves"]["channels"].empty());
}

TEST(RunPage, ShowsHowTheRunEnded) {
  Report report;
  report.result.table = {{{"time", "s"}, {"x", "m"}}, {0.0, 1.0, 0.1, 2.0}};
  RunSummary& s = report.result.summary;
  s.model = "crane";
  s.status = "failed";
  s.message = "step failed at t = 0.1 s";
  s.duration = 0.1;
  s.warnings.push_back({});
  s.warnings.back().sentence = "the boom bends too far";
  report.facts.push_back({"Model", {{"bodies", "3"}}});
  PageBuffer buffer;
  const Json page = run_page(report, page_curves(report.result.table), buffer);
  EXPECT_EQ(page["schema"], 1);
  EXPECT_EQ(page["title"], "crane");
  EXPECT_EQ(page["status"]["state"], "failed");
  EXPECT_EQ(page["status"]["sentences"][1], s.message);
  EXPECT_EQ(page["status"]["warnings"][0], "the boom bends too far");
  EXPECT_EQ(page["facts"][0]["rows"][0][1], "3");
  EXPECT_EQ(page["curves"]["channels"].size(), 1u);
}

}  // namespace
}  // namespace floatframe::test
