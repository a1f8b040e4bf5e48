// What `response` says and writes of unbalance, `check` of pairs of modes that are cut, and wrong
// options.
#include "floatframe/analyses/unbalance_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floatframe/analyses/analysis.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/rotor_models.hpp"

namespace floatframe::test {
namespace {

const char* const round_bearing = "stiffness: [[8e4, 0], [0, 8e4]], damping: [[20, 0], [0, 20]]";
const char* const centre_output = "outputs: {c: {position: disc}}\n";

Analysis response_with(const std::string& rotor, const std::vector<std::string>& unbalances,
                       const std::string& axis = "z") {
  Analysis a = response_analysis();
  for (Option& o : a.options) {
    if (o.name == "--rotor") *std::get<std::string*>(o.target) = rotor;
    if (o.name == "--axis") *std::get<std::string*>(o.target) = axis;
    if (o.name == "--unbalance") *std::get<std::vector<std::string>*>(o.target) = unbalances;
  }
  return a;
}

TEST(UnbalanceReport, TextJsonTableAndPicture) {
  const Model model = model_of(disc_in_bearing(round_bearing, centre_output));
  const AnalysisReport r = response_with("motor=0:400:10", {"disc=1e-4@90"}).run(model);
  EXPECT_NE(r.text.find("unbalance 0.0001 kg m at 'disc', 90 degrees"), std::string::npos);
  const auto json = nlohmann::json::parse(r.json);
  EXPECT_EQ(json["speed_rad_s"].size(), 41u);
  EXPECT_EQ(json["outputs"][0]["name"], "c.x");
  // Far above the critical speed of 200 rad/s the disc turns about its centre of mass: U / m.
  EXPECT_NEAR(json["outputs"][0]["amplitude"].back().get<double>(), 1e-4 / 2.0 * 4.0 / 3.0, 2e-6);
  EXPECT_NEAR(json["outputs"][0]["phase_deg"][1].get<double>(), 90.0, 1.0);
  const std::string csv = r.files.at(0)(), svg = r.files.at(1)();
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 42);
  EXPECT_NE(csv.find("c.x amplitude [m]"), std::string::npos);
  EXPECT_NE(svg.find("speed of &#39;motor&#39; [rad/s]"), std::string::npos) << svg.substr(0, 600);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(UnbalanceReport, WrongOptions) {
  const Model model = model_of(disc_in_bearing(round_bearing, centre_output));
  const auto error = [&](const char* rotor, const std::vector<std::string>& unbalances) {
    return error_of([&] { response_with(rotor, unbalances).run(model); });
  };
  EXPECT_EQ(error("motor=0:1", {"disc=1"}), "wrong_value");
  EXPECT_EQ(error("", {"disc=1"}), "incomplete");
  EXPECT_EQ(error("motor=0:9:1", {}), "incomplete");
  for (const char* text : {"disc", "disc=", "=1", "disc=x", "disc=1@x", "disc=nan"})
    EXPECT_EQ(error("motor=0:9:1", {text}), "wrong_value") << text;
  const Unbalance u = unbalance_of("a@b:node=2e-3@-45");
  EXPECT_EQ(u.body, "a@b");
  EXPECT_EQ(u.node, "node");
  EXPECT_EQ(u.moment, 2e-3);
  EXPECT_NEAR(u.angle, -std::numbers::pi / 4.0, 1e-15);
}

TEST(CheckReport, NotesAPairThatIsCut) {
  int cut = 0;
  for (int n = 5; n <= 7; ++n) {
    const AnalysisReport r = check_analysis().run(model_of(two_discs(n)));
    const std::string text = "body 'shaft': normal_modes: " + std::to_string(n) +
                             " cuts a pair of modes of equal frequency";
    const bool found = r.text.find(text) != std::string::npos;
    EXPECT_EQ(nlohmann::json::parse(r.json)["flexible"][0].contains("note"), found);
    cut += found ? 1 : 0;
  }
  EXPECT_EQ(cut, 1);
}

}  // namespace
}  // namespace floatframe::test
