// How the figures of a benchmark are shown.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "floatframe/bench/bench_iltis.hpp"

namespace floatframe {
namespace {

BenchResult example() {
  BenchResult result;
  result.builds = {{5, 1e-3, 2e-3}, {7, 1e-3, 3e-3}};
  for (const auto coordinates : {Coordinates::absolute, Coordinates::relative}) {
    for (const int elements : {5, 7}) {
      BenchRow row;
      row.coordinates = coordinates;
      row.elements_per_bar = elements;
      row.cpu_min = 0.0125;
      row.cpu_median = 0.013;
      row.steps = 800;
      row.iterations = 2400;
      result.rows.push_back(row);
    }
  }
  result.repeats = 3;
  result.dense_llt = 30e-6;
  result.rel_p_iteration = 45e-6;
  return result;
}

TEST(BenchOutput, TextHasThePapersFiguresWhereThereAreAny) {
  const std::string text = bench_text(example());
  EXPECT_NE(text.find("Abs. + P          paper                 3.85       -"), std::string::npos)
      << text;
  EXPECT_NE(text.find("Rel. + P          paper                 0.79       -"), std::string::npos)
      << text;
  EXPECT_NE(text.find("= 1.50 LLTs"), std::string::npos) << text;
}

TEST(BenchOutput, JsonHasTheDocumentedKeys) {
  const auto json = nlohmann::ordered_json::parse(bench_json(example()));
  ASSERT_EQ(json["rows"].size(), 4u);
  std::vector<std::string> keys;
  for (const auto& [key, value] : json["rows"][0].items()) keys.push_back(key);
  EXPECT_EQ(keys,
            (std::vector<std::string>{
                "coordinates", "inertia", "elements_per_bar", "cpu_s_min", "cpu_s_median", "steps",
                "substeps", "iterations", "factorizations", "us_per_step_min", "llt_per_step_min",
                "real_time_factor", "max_position_violation_m", "max_velocity_violation_m_s"}));
  EXPECT_EQ(json["rows"][0]["coordinates"], "absolute");
  EXPECT_EQ(json["rows"][0]["inertia"], "preprocessing");
  EXPECT_NEAR(json["dense_llt_98_us"].get<double>(), 30.0, 1e-9);
  EXPECT_NEAR(json["rel_p_iteration_us"].get<double>(), 45.0, 1e-9);
  EXPECT_TRUE(json["build"].is_string());
  EXPECT_TRUE(json["cpu"].is_string());
}

}  // namespace
}  // namespace floatframe
