// What a body looks like follows its mirror image and the choice of its modes.
#include "floatframe/body/body_shape.hpp"

#include <gtest/gtest.h>

#include "floatframe/body/mirrored.hpp"
#include "floatframe/body/with_modes.hpp"

namespace floatframe::test {
namespace {

FlexibleBody shaped_body() {
  FlexibleBody body;
  body.invariants = InertiaInvariants::zero(3);
  body.K = body.D = MatX::Identity(3, 3);
  BodyShape shape;
  shape.positions = Mat3X::Random(3, 4);
  shape.modes = MatX::Random(12, 3);
  shape.triangles = {{0, 1, 2}, {0, 2, 3}};
  shape.bars.push_back({0, 1, Vec3(0.6, 0.8, 0.0), true, 0.1, 0.2, 0.5});
  body.shape = std::make_shared<const BodyShape>(shape);
  return body;
}

Vec3 normal(const BodyShape& s, std::size_t triangle) {
  const auto& t = s.triangles[triangle];
  const Vec3 a = s.positions.col(t[0]), b = s.positions.col(t[1]), c = s.positions.col(t[2]);
  return (b - a).cross(c - a);
}

TEST(BodyShape, MirrorImagesKeepNormalsOutward) {
  const FlexibleBody body = shaped_body();
  for (const Vec3& s : {Vec3(1, -1, 1), Vec3(-1, -1, 1), Vec3(-1, -1, -1)}) {
    const FlexibleBody image = mirrored(body, s.asDiagonal());
    for (Eigen::Index k = 0; k < 4; ++k) {
      EXPECT_EQ(image.shape->positions.col(k), s.cwiseProduct(Vec3(body.shape->positions.col(k))));
      EXPECT_EQ(image.shape->modes.middleRows<3>(3 * k),
                s.asDiagonal() * body.shape->modes.middleRows<3>(3 * k));
    }
    for (std::size_t t = 0; t < 2; ++t)
      EXPECT_LT((normal(*image.shape, t) - s.cwiseProduct(normal(*body.shape, t))).norm(), 1e-15);
    EXPECT_EQ(image.shape->bars[0].y, s.cwiseProduct(body.shape->bars[0].y));
  }
}

TEST(BodyShape, ModesThatAreLeftOutAreLeftOutOfTheSurface) {
  const FlexibleBody body = shaped_body();
  const FlexibleBody fewer = with_modes(body, {0, 2});
  ASSERT_EQ(fewer.shape->modes.cols(), 2);
  EXPECT_EQ(fewer.shape->modes.col(1), body.shape->modes.col(2));
  EXPECT_EQ(fewer.shape->positions, body.shape->positions);
  EXPECT_EQ(with_modes(body, {}).shape->modes.cols(), 0);
  EXPECT_EQ(body.shape->modes.cols(), 3);
}

}  // namespace
}  // namespace floatframe::test
