// The OpenCRG file that docs/vehicle-models.md gives to copy.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "floatframe/roads/crg_file.hpp"

namespace floatframe::test {
namespace {

TEST(CrgFile, OfTheDocumentationIsAThreeCentimetreBump) {
  std::ifstream file(FLOATFRAME_EXAMPLES "/../docs/vehicle-models.md");
  std::stringstream document;
  document << file.rdbuf();
  const std::string all = document.str(), fence = "```\n";
  const std::size_t begin = all.find(fence + "$CT\n");
  ASSERT_NE(begin, std::string::npos);
  const std::size_t from = begin + fence.size();
  const CrgRoad road = read_crg(all.substr(from, all.find(fence, from) - from), "bump.crg");
  ASSERT_EQ(road.rows(), 6u);
  ASSERT_EQ(road.columns(), 3u);
  EXPECT_EQ(road.v, (std::vector<double>{-1.0, 0.0, 1.0}));
  EXPECT_EQ(road.line.last(), 5.0);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_EQ(road.grid(i, j), j == 2 && (i == 2 || i == 3) ? 0.03 : 0.0);
  EXPECT_TRUE(road.notes.empty());
}

}  // namespace
}  // namespace floatframe::test
