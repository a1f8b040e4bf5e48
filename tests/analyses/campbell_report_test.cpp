// What the Campbell diagram's command says and writes, and of wrong speeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/rotor_models.hpp"

namespace floatframe::test {
namespace {

/// The command with its options set by name, as the parser does.
Analysis campbell_with(const std::string& speed, const std::string& axis = "x") {
  Analysis a = campbell_analysis();
  for (Option& o : a.options) {
    if (o.name == "--speed") *std::get<std::string*>(o.target) = speed;
    if (o.name == "--axis") *std::get<std::string*>(o.target) = axis;
    if (o.name == "--orders") *std::get<std::vector<double>*>(o.target) = {1.0, 2.0};
  }
  return a;
}

TEST(CampbellReport, TextJsonTableAndPicture) {
  const Model model = load_model(FLOATFRAME_EXAMPLES "/rotor/rotor.yaml");
  const AnalysisReport r = campbell_with("motor=0:250:50").run(model);
  EXPECT_NE(r.text.find("critical speed [rad/s]"), std::string::npos);
  const auto json = nlohmann::json::parse(r.json);
  EXPECT_EQ(json["speed_rad_s"].size(), 6u);
  EXPECT_EQ(json["modes"].size(), 12u);
  EXPECT_EQ(json["modes"][0]["kind"], "backward");
  EXPECT_EQ(json["modes"][0]["frequency_rad_s"].size(), 6u);
  // The forward line of order 1, near 180 rad/s, the backward one apart, both at half of that.
  ASSERT_EQ(json["critical_speeds"].size(), 3u);
  ASSERT_EQ(json["crossings"].size(), 1u);
  EXPECT_LT(json["crossings"][0]["whirl"].get<double>(), -0.99);
  EXPECT_EQ(json["critical_speeds"][0]["order"], 2.0);
  for (const auto& c : json["critical_speeds"])
    EXPECT_NEAR(c["speed_rad_s"].get<double>() * c["order"].get<double>(),
                c["frequency_rad_s"].get<double>(), 1e-6);
  const std::string csv = r.files.at(0)(), svg = r.files.at(1)();
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_EQ(csv.substr(0, csv.find(',')), "speed [rad/s]");
  const std::string line = csv.substr(0, csv.find('\n'));
  EXPECT_EQ(std::count(line.begin(), line.end(), ','), 36);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  std::size_t circles = 0;
  for (std::size_t at = 0; (at = svg.find("class=\"critical\" cx=\"", at)) != std::string::npos;
       ++at)
    ++circles;
  EXPECT_EQ(circles, 4u);  // and the one of the legend
}

TEST(CampbellReport, LinesThatEnd) {
  Analysis a = campbell_with("hub=0:40:5", "");
  const AnalysisReport r = a.run(model_of(blade("false")));
  EXPECT_NE(r.text.find("diverges without swinging"), std::string::npos) << r.text;
  EXPECT_NE(r.text.find("(bending) ends at"), std::string::npos) << r.text;
  const auto json = nlohmann::json::parse(r.json);
  EXPECT_TRUE(json["modes"][1]["frequency_rad_s"].back().is_null()) << r.text;
  EXPECT_NE(r.files.at(0)().find(",,,"), std::string::npos);
  EXPECT_EQ(r.files.at(1)().find("nan"), std::string::npos);
}

TEST(CampbellReport, WrongSpeeds) {
  const Model model = load_model(FLOATFRAME_EXAMPLES "/rotor/rotor.yaml");
  const auto error = [&](const char* speed) {
    return error_of([&] { campbell_with(speed).run(model); });
  };
  for (const char* speed :
       {"motor", "motor=1", "motor=0:1", "motor=0:1:x", "motor=0:1:1:1", "=0:1:1"})
    EXPECT_EQ(error(speed), "wrong_value") << speed;
  for (const char* speed : {"motor=1:0:1", "motor=0:1:0", "motor=0:1:-1", "motor=nan:1:1"})
    EXPECT_EQ(error(speed), "out_of_range") << speed;
  EXPECT_EQ(error("motor=0:1e9:1"), "too_large");
  EXPECT_EQ(error("motr=0:1:1"), "not_found");
  EXPECT_EQ(error("hub=0:1:1"), "unsupported");
}

}  // namespace
}  // namespace floatframe::test
