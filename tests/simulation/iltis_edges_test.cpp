// The Iltis on its stairs, 3.8 to 4.6 s: order of convergence with edges located and without. By
// default the rigid vehicle in relative coordinates; with FLOATFRAME_STAIRS=1 also the flexible one
// and absolute coordinates, which takes minutes (make test-all).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "simulation/iltis.hpp"

namespace floatframe::test {
namespace {

constexpr const char* stair_columns[] = {"chassis.z", "chassis.pitch", "front_left.wheel.z",
                                         "rear_left.wheel.z"};

struct StairsCase {
  bool flexible;
  Coordinates coordinates;
};

class IltisStairs : public ::testing::TestWithParam<StairsCase> {};

TEST_P(IltisStairs, OrderTwoWithEdgesLocated) {
  const auto [flexible, coordinates] = GetParam();
  const bool first_case = !flexible && coordinates == Coordinates::relative;
  if (!first_case && std::getenv("FLOATFRAME_STAIRS") == nullptr)
    GTEST_SKIP() << "set FLOATFRAME_STAIRS=1 for it";
  const ModelDescription d = iltis({{"spectral_radius", "1"},
                                    {"tolerance", "1e-11"},
                                    {"flexible", flexible ? "true" : "false"}});
  const Model model = build_model(d);
  SimulationDescription o = d.simulation;
  o.step = 5e-4;
  o.duration = 3.8;
  o.output_interval = 0.01;
  RunOptions keep;
  keep.keep_state = true;
  const RunResult start = run(model, o, keep);
  ASSERT_EQ(start.summary.status, "completed") << start.summary.message;
  o.start = Start::state;
  o.state = start.state;
  o.velocity = Vec3::Zero();
  o.coordinates = coordinates;
  o.duration = 0.8;
  const auto made = [&](double step, bool locate) {
    o.step = step;
    o.locate_edges = locate;
    const RunResult r = run(model, o);
    EXPECT_EQ(r.summary.status, "completed") << r.summary.message;
    EXPECT_EQ(r.summary.edges > 0, locate);
    EXPECT_EQ(r.summary.edges_passed, 0);
    return r;
  };
  const RunResult reference = made(3.90625e-6, true);
  for (const bool locate : {false, true}) {
    double before[4] = {}, first[4] = {}, last[4] = {};
    for (const double h : {5e-4, 1.25e-4, 6.25e-5, 3.125e-5}) {
      if (locate && h > 2e-4) continue;
      const RunResult r = made(h, locate);
      figure(std::string(locate ? "located" : "not located") + ", step [us]", 1e6 * h);
      figure("  edges", static_cast<double>(r.summary.edges));
      figure("  largest remainder of the energy [J]", r.summary.energy.largest_remainder);
      for (int k = 0; k < 4; ++k) {
        const double error = difference(r.table, reference.table, stair_columns[k]);
        figure(std::string("  error of ") + stair_columns[k] + " [m, rad]", error);
        if (first[k] == 0.0) first[k] = error;
        last[k] = error;
        if (locate && before[k] > 0.0) {
          const double order = std::log2(before[k] / error);
          figure("    order", order);
          // The modes of the bars (to 2.8 kHz) are not resolved yet: see below.
          if (!flexible) {
            EXPECT_GT(order, 1.8) << stair_columns[k] << " at " << h;
            EXPECT_LT(order, 2.2) << stair_columns[k] << " at " << h;
          }
        }
        before[k] = error;
      }
    }
    if (locate) {
      // Of the largest error, over both halvings.
      const double mean =
          0.5 * std::log2(*std::max_element(first, first + 4) / *std::max_element(last, last + 4));
      figure("mean order located", mean);
      EXPECT_GT(mean, 1.8);
      EXPECT_LT(mean, 2.2);
      continue;
    }
    // From 500 to 31 us: where in a step an edge lies is chance, single halvings say little.
    for (int k = 0; k < 4; ++k) {
      const double order = std::log2(first[k] / last[k]) / 4.0;
      figure(std::string("mean order without, ") + stair_columns[k], order);
      EXPECT_LT(order, 1.5) << stair_columns[k];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, IltisStairs,
                         ::testing::Values(StairsCase{false, Coordinates::relative},
                                           StairsCase{false, Coordinates::absolute},
                                           StairsCase{true, Coordinates::relative},
                                           StairsCase{true, Coordinates::absolute}),
                         [](const auto& x) {
                           return std::string(x.param.flexible ? "flexible" : "rigid") +
                                  (x.param.coordinates == Coordinates::relative ? "_relative"
                                                                                : "_absolute");
                         });

}  // namespace
}  // namespace floatframe::test
