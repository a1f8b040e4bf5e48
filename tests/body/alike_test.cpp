// Bodies that look alike are found, and others are told from them.
#include "floatframe/body/alike.hpp"

#include <gtest/gtest.h>

#include "floatframe/body/body_shape.hpp"

namespace floatframe::test {
namespace {

FlexibleBody wheel() {
  FlexibleBody b;
  b.invariants = InertiaInvariants::rigid(20.0, Vec3::Zero(), Mat3::Identity());
  BodyShape shape;
  shape.positions = Mat3X::Random(3, 4);
  shape.triangles = {{0, 1, 2}, {0, 2, 3}};
  shape.bars.push_back({.from = 0, .to = 1, .width = 0.1, .height = 0.1});
  b.shape = std::make_shared<BodyShape>(shape);
  b.nodes.push_back({"hub", Vec3::UnitX(), Mat3X::Zero(3, 0), Mat3X::Zero(3, 0)});
  return b;
}

TEST(LookAlike, CopiesDoWhateverTheyWeigh) {
  const FlexibleBody a = wheel();
  FlexibleBody b = a;
  b.shape = std::make_shared<BodyShape>(*a.shape);
  b.invariants.m = 7.0;
  EXPECT_TRUE(look_alike(a, b));
}

TEST(LookAlike, EveryDifferenceCounts) {
  const FlexibleBody a = wheel();
  const auto differs = [&](auto change) {
    FlexibleBody b = a;
    auto shape = std::make_shared<BodyShape>(*a.shape);
    change(b, *shape);
    b.shape = shape;
    return !look_alike(a, b);
  };
  EXPECT_TRUE(differs([](FlexibleBody&, BodyShape& s) { s.positions(1, 2) += 1e-12; }));
  EXPECT_TRUE(differs([](FlexibleBody&, BodyShape& s) { s.positions.conservativeResize(3, 3); }));
  EXPECT_TRUE(differs([](FlexibleBody&, BodyShape& s) { s.triangles.pop_back(); }));
  EXPECT_TRUE(differs([](FlexibleBody&, BodyShape& s) { s.lines.push_back({0, 1}); }));
  EXPECT_TRUE(differs([](FlexibleBody&, BodyShape& s) { s.bars[0].inner = 0.5; }));
  EXPECT_TRUE(differs([](FlexibleBody&, BodyShape& s) { s.bars.clear(); }));
  EXPECT_TRUE(differs([](FlexibleBody&, BodyShape& s) { s.paints.push_back({0, "#3a6ea5"}); }));
  EXPECT_TRUE(differs([](FlexibleBody&, BodyShape& s) { s.color = "#ff0000"; }));
  EXPECT_TRUE(differs([](FlexibleBody& b, BodyShape&) { b.nodes[0].name = "rim"; }));
  EXPECT_TRUE(differs([](FlexibleBody& b, BodyShape&) { b.nodes[0].p.z() = 1.0; }));
  EXPECT_TRUE(differs([](FlexibleBody& b, BodyShape&) { b.nodes.clear(); }));
  EXPECT_TRUE(
      differs([](FlexibleBody& b, BodyShape&) { b.invariants = InertiaInvariants::zero(1); }));
  FlexibleBody none = a;
  none.shape = nullptr;
  EXPECT_FALSE(look_alike(a, none));
}

}  // namespace
}  // namespace floatframe::test
