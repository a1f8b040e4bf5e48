// The page of a study: which runs are best and worst, what the page holds of them.
#include "floatframe/sweep/sweep_page.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "floatframe/core/regular_file.hpp"
#include "floatframe/page/page_writer.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

// Falls from rest for 0.2 s: z = z0 - g t^2 / 2.
const char* const falling = R"(
floatframe: 1
parameters: {g: 10, from: 1}
gravity: [0, 0, "${-g}"]
bodies:
  ball: {rigid: {mass: 2, centre_of_mass: [0, 0, 0], inertia: [0.01, 0.01, 0.01]}}
joints:
  guide: {type: prismatic, child: ball, at: [0, 0, "${from}"], axis: z}
outputs:
  ball.z: {position: {body: ball, at: [0, 0, 0]}, axis: z}
simulation: {step: 0.01, duration: 0.2}
)";

nlohmann::json page_in(const std::string& file) {
  std::string text;
  EXPECT_EQ(read_regular_file(file, 100'000'000, text), "");
  const std::string mark = "id=\"floatframe-page\">";
  const std::size_t from = text.find(mark) + mark.size();
  return nlohmann::json::parse(text.substr(from, text.find("</script>", from) - from));
}

class SweepPage : public testing::Test {
 protected:
  void SetUp() override {
    if (page_template().empty()) GTEST_SKIP() << "built without the viewer";
    options_.model = folder_.write("falling.yaml", falling);
    options_.folder = folder_.file("out");
    options_.report = folder_.file("pages/study.html");
    std::filesystem::create_directories(folder_ / "pages");
    options_.plan = grid_plan({"g=5,20,10"});
    options_.keep_results = true;
  }
  nlohmann::json run() {
    report_ = run_sweep(options_, stop_, [](const SweepProgress&) {});
    return page_in(options_.report);
  }

  test::TemporaryFolder folder_;
  SweepOptions options_;
  SweepReport report_;
  std::atomic<bool> stop_{false};
};

SweepRow row_with(const std::string& value, const std::string& status = "completed") {
  return {status, "", {{"steps", "4"}, {"ball.z final [m]", value}}};
}

TEST(RankedRuns, BestAndWorstOfCompletedRuns) {
  const std::vector<SweepRow> rows{row_with("3"), row_with("-1", "failed"), row_with("nan"),
                                   row_with("1"), row_with("2")};
  SweepRanking ranking{{"ball.z", "final"}, false};
  EXPECT_EQ(ranked_runs(ranking, rows)->best, 3u);
  EXPECT_EQ(ranked_runs(ranking, rows)->worst, 0u);
  ranking.largest = true;
  EXPECT_EQ(ranked_runs(ranking, rows)->best, 0u);
  EXPECT_FALSE(ranked_runs(std::nullopt, rows));
  EXPECT_FALSE(ranked_runs(SweepRanking{{"ball.z", "max"}, false}, rows));
}

TEST(RankedRuns, EvenlyChosenWithBothEnds) {
  EXPECT_EQ(evenly_chosen({4, 7, 1}, 5), (std::vector<std::size_t>{4, 7, 1}));
  EXPECT_EQ(evenly_chosen({0, 1, 2, 3, 4, 5, 6}, 3), (std::vector<std::size_t>{0, 3, 6}));
}

TEST_F(SweepPage, HoldsFiguresAndCurvesOfAllRuns) {
  const nlohmann::json page = run();
  EXPECT_EQ(report_.page, options_.report);
  EXPECT_EQ(page["kind"], "sweep");
  const nlohmann::json& study = page["study"];
  EXPECT_EQ(study["variables"][0]["values"], (nlohmann::json{"5", "20", "10"}));
  EXPECT_EQ(study["curves"]["runs"].size(), 3u);
  EXPECT_EQ(study["curves"]["channels"][0]["name"], "ball.z");
  EXPECT_EQ(study["curves"]["runs"][0]["values"]["shape"], (nlohmann::json{1, 21}));
  EXPECT_TRUE(study["ranking"].is_null());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/best"));
}

TEST_F(SweepPage, OpensBestAndWorstRun) {
  options_.ranking = SweepRanking{{"ball.z", "final"}, false};
  const nlohmann::json pages = run()["study"]["pages"];
  // Most gravity falls deepest.
  EXPECT_EQ(pages["best"]["run"], 1);
  EXPECT_EQ(pages["best"]["address"], "../out/best/report.html");
  EXPECT_EQ(pages["worst"]["run"], 0);
  const nlohmann::json best = page_in(folder_.file("out/best/report.html"));
  EXPECT_EQ(best["kind"], "run");
  EXPECT_FALSE(best["scene"].is_null());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/worst/report.html"));
}

TEST_F(SweepPage, RefusesAnUnknownOutputBeforeTheFirstRun) {
  options_.ranking = SweepRanking{{"bal.z", "final"}, false};
  EXPECT_EQ(test::error_of([&] { run(); }), "not_found");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace floatframe
