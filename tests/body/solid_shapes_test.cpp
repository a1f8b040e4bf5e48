// Simple solids as triangles: closed, outward, where they are said to be.
#include "floatframe/body/solid_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace floatframe {
namespace {

constexpr double pi = std::numbers::pi;

double volume_of(const BodyShape& shape) {
  double volume = 0.0;
  for (const auto& [a, b, c] : shape.triangles)
    volume += Vec3(shape.positions.col(a))
                  .dot(Vec3(shape.positions.col(b)).cross(Vec3(shape.positions.col(c)))) /
              6.0;
  return volume;
}

/// Each edge is passed once in each direction.
bool is_closed(const BodyShape& shape) {
  std::map<std::pair<int, int>, int> passes;
  for (const auto& t : shape.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      ++passes[{t[k], t[(k + 1) % 3]}];
      --passes[{t[(k + 1) % 3], t[k]}];
    }
  for (const auto& [edge, count] : passes)
    if (count != 0) return false;
  return true;
}

struct SolidCase {
  Solid solid;
  double volume;  // exact
  Vec3 size;
};

TEST(SolidShapes, AreClosedAndHoldTheirVolume) {
  const double r = 0.3, l = 0.8, top = 0.1;
  const double ball = 4.0 / 3.0 * pi * r * r * r;
  const SolidCase cases[] = {
      {BoxSolid{Vec3(1, 2, 3)}, 6.0, {1, 2, 3}},
      {CylinderSolid{r, l}, pi * r * r * l, {2 * r, 2 * r, l}},
      {ConeSolid{r, l}, pi * r * r * l / 3.0, {2 * r, 2 * r, l}},
      {ConeSolid{r, l, top}, pi * l * (r * r + r * top + top * top) / 3.0, {2 * r, 2 * r, l}},
      {SphereSolid{r}, ball, {2 * r, 2 * r, 2 * r}},
      {CapsuleSolid{r, l}, ball + pi * r * r * l, {2 * r, 2 * r, l + 2 * r}}};
  Pose X;
  X.p = Vec3(5, 6, 7);
  X.R = Eigen::AngleAxisd(0.5 * pi, Vec3::UnitX()).toRotationMatrix();
  for (const SolidCase& c : cases) {
    const auto shape = shape_of_solids({{c.solid, Pose(), "#3a6ea5"}});
    SCOPED_TRACE(c.solid.index());
    EXPECT_TRUE(is_closed(*shape));
    EXPECT_EQ(shape->color, "#3a6ea5");
    EXPECT_TRUE(shape->paints.empty());
    // Corners lie on the surface, so that a round solid is a little smaller.
    EXPECT_LE(volume_of(*shape), c.volume * (1.0 + 1e-12));
    EXPECT_GT(volume_of(*shape), 0.97 * c.volume);
    const Vec3 low = shape->positions.rowwise().minCoeff(),
               high = shape->positions.rowwise().maxCoeff();
    EXPECT_LT((high - low - c.size).norm(), 1e-12);
    EXPECT_LT((high + low).norm(), 1e-12) << "about its origin";
    const auto placed = shape_of_solids({{c.solid, X, ""}});
    EXPECT_NEAR(volume_of(*placed), volume_of(*shape), 1e-9);
    EXPECT_LT((placed->positions - ((X.R * shape->positions).colwise() + X.p)).norm(), 1e-12);
  }
}

TEST(SolidShapes, ColoursBeginWhereTheyChange) {
  const auto shape = shape_of_solids({{BoxSolid{}, Pose(), ""},
                                      {BoxSolid{}, Pose(), ""},
                                      {BoxSolid{}, Pose(), "#112233"},
                                      {BoxSolid{}, Pose(), "#112233"},
                                      {BoxSolid{}, Pose(), ""}});
  EXPECT_EQ(shape->color, "");
  ASSERT_EQ(shape->paints.size(), 3u);
  EXPECT_EQ(shape->paints[0].first, 0);
  EXPECT_EQ(shape->paints[1].first, 24);
  EXPECT_EQ(shape->paints[1].color, "#112233");
  EXPECT_EQ(shape->paints[2].first, 48);
  EXPECT_EQ(shape->paints[2].color, "");
  EXPECT_EQ(shape->positions.cols(), 40);
}

}  // namespace
}  // namespace floatframe
