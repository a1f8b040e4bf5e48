// The curves of a page that say whether a run can be trusted, and the tables of its model.
#include "floatframe/page/page_trust.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "floatframe/page/page_tables.hpp"
#include "floatframe/start/check.hpp"
#include "history/recorded_run.hpp"

namespace floatframe::test {
namespace {

using Json = nlohmann::ordered_json;

struct TrustPage {
  RunResult result;
  PageBuffer buffer;
  Json trust = Json::object();
  const Json* find(const std::string& name) const {
    for (const Json& c : trust["channels"])
      if (c["name"] == name) return &c;
    return nullptr;
  }
  template <class Number>
  std::vector<Number> numbers(const Json& view) const {
    std::vector<Number> out(view["shape"][0].get<std::size_t>());
    std::memcpy(out.data(), buffer.bytes().data() + view["offset"].get<std::size_t>(),
                out.size() * sizeof(Number));
    return out;
  }
};

void page_of(const Model& model, const SimulationDescription& o, TrustPage& out) {
  const TemporaryFolder folder;
  Recorded r = recorded_run(model, o, folder.file("x.ffr"));
  out.result = std::move(r.result);
  add_trust_curves(StateHistory(r.path), out.trust, out.buffer);
}

TEST(PageTrust, CurvesOfARun) {
  const Model model = model_of(recorded_machine);
  TrustPage page;
  page_of(model, model.simulation, page);
  const auto time = page.numbers<double>(page.trust["time"]);
  ASSERT_EQ(time.size(), page.result.table.rows());
  const Json* iterations = page.find("iterations");
  ASSERT_NE(iterations, nullptr);
  const auto n = page.numbers<float>((*iterations)["data"]);
  EXPECT_TRUE(std::isnan(n[0])) << "no step before the start";
  double sum = 0.0;
  for (std::size_t k = 1; k < n.size(); ++k) sum += static_cast<double>(n[k]);
  EXPECT_NEAR(sum, static_cast<double>(page.result.summary.iterations), 1e-6 * sum);
  const auto violation = page.numbers<float>((*page.find("position_violation"))["data"]);
  float most = 0.0f;
  for (const float v : violation)
    if (v > most) most = v;
  EXPECT_NEAR(most, page.result.summary.max_position_violation, 1e-6 * most);
  const auto kinetic = page.numbers<float>((*page.find("energy.kinetic"))["data"]);
  EXPECT_EQ(kinetic[0], 0.0f) << "changes since the start";
  const EnergySummary& e = page.result.summary.energy;
  EXPECT_NEAR(kinetic.back(), e.kinetic_end - e.kinetic_start, 1e-5 * e.kinetic_end);
  // The terms are the balance.
  for (std::size_t k = 0; k < time.size(); ++k) {
    double left = 0.0, size = 0.0;
    for (const Json& c : page.trust["channels"]) {
      if (c["group"] != "energy" || c["name"] == "energy.remainder") continue;
      const double v = page.numbers<float>(c["data"])[k];
      left += c["name"].get<std::string>().starts_with("energy.work") ? -v : v;
      size = std::max(size, std::abs(v));
    }
    ASSERT_NEAR(left, page.numbers<float>((*page.find("energy.remainder"))["data"])[k],
                1e-5 * size + 1e-12)
        << time[k];
  }
  const Json* bent = page.find("beam.displacement");
  ASSERT_NE(bent, nullptr);
  EXPECT_EQ((*bent)["unit"], "%");
  EXPECT_EQ((*bent)["limit"], 10.0);
  EXPECT_EQ((*bent)["label"], "beam");
  EXPECT_TRUE((*page.find("energy.tyres"))["constant"]);
  EXPECT_EQ(page.find("steps"), nullptr);
}

TEST(PageTrust, LongRunsAreThinned) {
  const Model model = model_of(recorded_machine);
  SimulationDescription o = model.simulation;
  o.step = 1e-4;
  o.duration = 2.0;
  o.record.every = 1;
  TrustPage page;
  page_of(model, o, page);
  ASSERT_EQ(page.result.table.rows(), 20001u);
  const std::size_t channels = page.trust["channels"].size();
  const auto time = page.numbers<double>(page.trust["time"]);
  EXPECT_LE(time.size() * channels, most_numbers_of_trust + 2 * channels);
  EXPECT_GT(time.size() * channels, most_numbers_of_trust / 2);
  // Peaks survive.
  double most = 0.0;
  for (const float v : page.numbers<float>((*page.find("velocity_violation"))["data"]))
    if (static_cast<double>(v) > most) most = static_cast<double>(v);
  EXPECT_NEAR(most, page.result.summary.max_velocity_violation, 1e-6 * most);
}

TEST(PageTables, BodiesModesCoordinatesAndCutJoints) {
  const Model model = model_of(recorded_machine);
  const std::vector<PageTable> bodies = body_tables(model);
  ASSERT_EQ(bodies.size(), 2u);
  ASSERT_EQ(bodies[0].rows.size(), 5u);
  EXPECT_EQ(bodies[0].rows[0][1], "rigid");
  EXPECT_EQ(bodies[0].rows[2][0], "beam");
  EXPECT_EQ(bodies[0].rows[2][1], "flexible, bars");
  EXPECT_EQ(bodies[0].rows[2][3], "4: 2 static, 2 normal");
  ASSERT_EQ(bodies[1].rows.size(), 4u);
  EXPECT_GT(std::stod(bodies[1].rows[0][3]), 1.0) << "Hz";
  const ModelCounts counts = check(model);
  const std::vector<PageTable> tables = coordinate_tables(model, counts);
  ASSERT_GE(tables.size(), 1u);
  EXPECT_EQ(tables[0].rows[2][1], std::to_string(counts.relative.total));
  EXPECT_EQ(tables[0].rows[3][2], std::to_string(counts.absolute.constraints));
  EXPECT_EQ(tables.size(), counts.cut_joint_names.empty() ? 1u : 2u);
}

}  // namespace
}  // namespace floatframe::test
