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
  EXPECT_EQ(error_of_bytes(with_member(good, "second_order_h.npy", "")),
            "arm.ffb: member 'second_order_h.npy': is missing");
  EXPECT_EQ(error_of_bytes(with_member(good, "second_order_nodes.npy",
                                       npy_bytes({{3}, std::vector<std::int32_t>{0, 1, 1}}))),
            "arm.ffb: member 'second_order_nodes.npy': expected markers in ascending order, each "
            "once");
  EXPECT_EQ(
      error_of_bytes(with_member(good, "second_order_nodes.npy",
                                 npy_bytes({{3}, std::vector<std::int32_t>{0, 1, 3}}))),
      "arm.ffb: member 'second_order_nodes.npy': found 3 as value 3, expected a number from 0 "
      "to 2");
  std::vector<double> skewed(75, 0.0);
  skewed[26] = 0.5;
  EXPECT_EQ(error_of_bytes(with_member(good, "second_order_S.npy", npy_bytes({{3, 5, 5}, skewed}))),
            "arm.ffb: member 'second_order_S.npy': matrix 2 is not symmetric: two of its entries "
            "differ by 0.5");
}

}  // namespace
}  // namespace floatframe
