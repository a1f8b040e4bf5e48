// Displacements of second order in body files.
#include <gtest/gtest.h>

#include "floatframe/formats/body_file/npy.hpp"
#include "formats/bracket_file.hpp"

namespace floatframe {
namespace {

TEST(BodyFile, DisplacementsOfSecondOrder) {
  const BodyFile file = bracket();
  const std::string good = body_file_bytes(file);
  const std::string h = member(good, "second_order_h.npy");
  EXPECT_EQ(read_npy(h).shape, (std::vector<std::size_t>{9, 5, 5}));
  std::string without = good;
  for (const char* name : {"S", "Si", "nodes", "h", "theta"})
    without = with_member(without, std::string("second_order_") + name + ".npy", "");
  EXPECT_EQ(read_body_bytes(without, "x").part.body.second_order, nullptr);
  EXPECT_EQ(error_of_bytes(with_member(good, "second_order_h.npy", "")), "arm.ffb: missing");
  EXPECT_EQ(error_of_bytes(with_member(good, "second_order_nodes.npy",
                                       npy_bytes({{3}, std::vector<std::int32_t>{0, 1, 1}}))),
            "arm.ffb: duplicate");
  EXPECT_EQ(error_of_bytes(with_member(good, "second_order_nodes.npy",
                                       npy_bytes({{3}, std::vector<std::int32_t>{0, 1, 3}}))),
            "arm.ffb: out_of_range");
  std::vector<double> skewed(75, 0.0);
  skewed[26] = 0.5;
  EXPECT_EQ(error_of_bytes(with_member(good, "second_order_S.npy", npy_bytes({{3, 5, 5}, skewed}))),
            "arm.ffb: contradiction");
}

/// Symmetric matrices of a body of five modes.
SecondOrder some_integrals(double start) {
  SecondOrder s = SecondOrder::zero(5);
  for (std::size_t j = 0; j < 3; ++j) {
    const VecX x = VecX::LinSpaced(5, start + static_cast<double>(j), 3.0);
    s.S2[j] = x * x.transpose();
    for (std::size_t i = 0; i < 3; ++i) s.S2i[i][j] = s.S2[j] * (0.1 + static_cast<double>(i));
  }
  return s;
}

void expect_same_integrals(const SecondOrder& a, const SecondOrder& b) {
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_EQ(a.S2[j], b.S2[j]);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a.S2i[i][j], b.S2i[i][j]);
  }
}

BodyFile turning_bracket() {
  BodyFile file = bracket();
  FlexibleBody& body = file.part.body;
  body.turning = std::make_shared<const SecondOrder>(some_integrals(0.3));
  auto data = std::make_shared<ProjectionData>(*body.projection);
  data->turning = {{1, 1, Vec3(0.1, 0.2, 0.3)}, {3, 0, Vec3(0.0, -1.0, 0.0)}};
  data->rotations = MatX::Random(6, 5);
  data->twist = std::make_shared<const SecondOrder>(some_integrals(-0.7));
  body.projection = data;
  return file;
}

TEST(BodyFile, DisplacementsOfWhatTurns) {
  const BodyFile file = turning_bracket();
  const std::string good = body_file_bytes(file);
  const FlexibleBody read = read_body_bytes(good, "x").part.body;
  ASSERT_TRUE(read.turning);
  expect_same_integrals(*read.turning, *file.part.body.turning);
  const ProjectionData &a = *file.part.body.projection, &b = *read.projection;
  ASSERT_EQ(b.turning.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(b.turning[k].point, a.turning[k].point);
    EXPECT_EQ(b.turning[k].rotation, a.turning[k].rotation);
    EXPECT_EQ(b.turning[k].arm, a.turning[k].arm);
  }
  EXPECT_EQ(b.rotations, a.rotations);
  ASSERT_TRUE(b.twist);
  expect_same_integrals(*b.twist, *a.twist);
  // Files of earlier programs have none.
  std::string without = good;
  for (const char* name : {"turning_S", "turning_Si", "projection_turning", "projection_arms",
                           "projection_rotations", "projection_twist_S", "projection_twist_Si"})
    without = with_member(without, std::string(name) + ".npy", "");
  const FlexibleBody old = read_body_bytes(without, "x").part.body;
  EXPECT_EQ(old.turning, nullptr);
  EXPECT_EQ(old.projection->twist, nullptr);
  EXPECT_TRUE(old.projection->turning.empty());
}

TEST(BodyFile, DamagedDisplacementsOfWhatTurns) {
  const std::string good = body_file_bytes(turning_bracket());
  EXPECT_EQ(error_of_bytes(with_member(good, "turning_Si.npy", "")), "arm.ffb: missing");
  EXPECT_EQ(error_of_bytes(with_member(good, "projection_arms.npy", "")), "arm.ffb: missing");
  std::vector<double> skewed(75, 0.0);
  skewed[26] = 0.5;
  EXPECT_EQ(error_of_bytes(with_member(good, "turning_S.npy", npy_bytes({{3, 5, 5}, skewed}))),
            "arm.ffb: contradiction");
  EXPECT_EQ(error_of_bytes(with_member(good, "projection_turning.npy",
                                       npy_bytes({{2, 2}, std::vector<std::int32_t>{3, 1, 1, 0}}))),
            "arm.ffb: wrong_value");
}

}  // namespace
}  // namespace floatframe
