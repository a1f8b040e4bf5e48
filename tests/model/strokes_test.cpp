// Lines that show what couplings and constraints hold: they touch where the parts do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/loop_mobility.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {
namespace {

const std::string stroke_bodies = R"(
gravity: [0, 0, 0]
bodies:
  a: {rigid: {mass: 1, centre_of_mass: [0, 0, 0], inertia: [0.01, 0.01, 0.01]}}
  b: {rigid: {mass: 1, centre_of_mass: [0.3, 0, 0], inertia: [0.01, 0.01, 0.01]}}
joints:
  a: {type: revolute, child: a, at: [0, 0, 0], axis: y}
)";
const std::string turning = "  b: {type: revolute, child: b, at: [0.3, 0, 0], axis: y}\n";

/// The lines of the only coupling or constraint, in the world.
std::vector<std::vector<Vec3>> lines_of(const std::string& text) {
  const Model model = model_of(stroke_bodies + text);
  std::vector<std::vector<Vec3>> out;
  for (const Element& e : model.elements)
    for (const Stroke& s : strokes_of(model, e)) {
      const Pose at = design_pose(model, s.marker);
      std::vector<Vec3> line;
      for (const Vec3& p : s.points) line.push_back(at * p);
      out.push_back(std::move(line));
    }
  return out;
}

/// Least and largest distance of the places of a line from a point.
std::pair<double, double> reach(const std::vector<Vec3>& line, const Vec3& from) {
  double least = 1e300, most = 0.0;
  for (const Vec3& p : line) {
    least = std::min(least, (p - from).norm());
    most = std::max(most, (p - from).norm());
  }
  return {least, most};
}

const Vec3 first = Vec3::Zero(), second(0.3, 0.0, 0.0);

TEST(Strokes, WheelsOfAGearMesh) {
  for (const bool internal : {false, true}) {
    const auto lines =
        lines_of(turning + "couplings: {g: {type: gear, driver: a, driven: b, teeth: [20, 50]" +
                 (internal ? ", internal: true}}\n" : "}}\n"));
    ASSERT_EQ(lines.size(), 2u);
    const auto [in_1, out_1] = reach(lines[0], first);
    const auto [in_2, out_2] = reach(lines[1], second);
    const double r_1 = 0.5 * (in_1 + out_1), r_2 = 0.5 * (in_2 + out_2);
    EXPECT_NEAR(r_2 / r_1, 2.5, 0.02);
    EXPECT_NEAR(internal ? r_2 - r_1 : r_1 + r_2, 0.3, 0.003);
  }
}

TEST(Strokes, StrandsOfABeltTouchBothPulleys) {
  for (const bool crossed : {false, true}) {
    const auto lines =
        lines_of(turning + "couplings: {g: {type: belt, driver: a, driven: b, radii: [0.08, 0.05]" +
                 (crossed ? ", crossed: true}}\n" : "}}\n"));
    ASSERT_EQ(lines.size(), 4u);
    for (std::size_t k : {2u, 3u}) {
      const Vec3 from = lines[k].front(), to = lines[k].back();
      EXPECT_NEAR((from - first).norm(), 0.08, 1e-12);
      EXPECT_NEAR((to - second).norm(), 0.05, 1e-12);
      EXPECT_NEAR((to - from).dot(from - first), 0.0, 1e-12);
      EXPECT_NEAR((to - from).dot(to - second), 0.0, 1e-12);
    }
  }
}

TEST(Strokes, ARackLiesOnTheSideWhereItGoesWithItsPinion) {
  const auto lines = lines_of(
      "  b: {type: prismatic, child: b, at: [0.3, 0, 0], axis: x}\n"
      "couplings: {g: {type: rack_and_pinion, rack: b, pinion: a, radius: 0.06}}\n");
  ASSERT_EQ(lines.size(), 2u);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : lines[1]) mean += p / static_cast<double>(lines[1].size());
  EXPECT_NEAR(mean[2], 0.06, 1e-3);  // y x (0, 0, r) = (r, 0, 0)
  EXPECT_NEAR(mean[1], 0.0, 1e-12);
}

TEST(Strokes, ACamReachesItsFollower) {
  const auto lines = lines_of(
      "  b: {type: prismatic, child: b, at: [0.3, 0, 0], axis: x}\n"
      "couplings: {g: {type: cam, follower: b, cam: a, formula: 0.02 * sin(x) + 0.01}}\n");
  ASSERT_EQ(lines.size(), 1u);
  double nearest = 1e300;
  for (const Vec3& p : lines[0]) nearest = std::min(nearest, (p - second).norm());
  EXPECT_LT(nearest, 1e-9);
  // A quarter of a turn against the sense of the cam comes to the follower when it has turned.
  const auto at = std::ranges::max_element(lines[0], {}, [](const Vec3& p) { return p.norm(); });
  EXPECT_NEAR(at->norm(), 0.3 + 0.02, 1e-4);
  EXPECT_GT((*at)[2], 0.3);  // about y by -90 degrees from x
}

TEST(Strokes, ACurveIsDrawnWhereItIs) {
  const auto lines = lines_of(
      "constraints: {g: {type: point_on_curve, from: {body: ground, at: [0, 0, 1]}, to: {body: "
      "b, at: [0.3, 0, 1]}, x: 0.3 * cos(u), z: 0.3 * sin(u), range: [0, 6.283185307179586], "
      "closed: true}}\n");
  ASSERT_EQ(lines.size(), 1u);
  const auto [least, most] = reach(lines[0], Vec3(0.0, 0.0, 1.0));
  EXPECT_NEAR(least, 0.3, 1e-9);
  EXPECT_NEAR(most, 0.3, 1e-9);
  EXPECT_LT((lines[0].front() - lines[0].back()).norm(), 1e-9);
}

TEST(Strokes, EachKindThatDrawsSomethingHasFinitePoints) {
  const std::string both = "  b: {type: cylindrical, child: b, at: [0, 0, 0], axis: y}\n";
  for (const char* entry :
       {"couplings: {g: {type: screw, joint: b, lead: -0.01}}\n",
        "couplings: {g: {type: planetary, sun: a, carrier: b, teeth: [20, 60]}}\n",
        "couplings: {g: {type: bevel_gear, driver: a, driven: b, ratio: 3}}\n",
        "couplings: {g: {type: gear, driver: a, driven: b, ratio: 1, internal: true}}\n",
        "constraints: {g: {type: in_line, from: {body: a}, to: {body: b}, axis: x}}\n",
        "constraints: {g: {type: in_plane, from: {body: a}, to: {body: b}, axis: x}}\n"}) {
    const auto lines = lines_of(both + entry);
    EXPECT_FALSE(lines.empty()) << entry;
    for (const auto& line : lines) {
      EXPECT_GE(line.size(), 2u);
      for (const Vec3& p : line) EXPECT_LT(p.norm(), 10.0) << entry;
    }
  }
}

}  // namespace
}  // namespace floatframe::test
