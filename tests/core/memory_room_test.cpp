#include "floatframe/core/memory_room.hpp"

#include <gtest/gtest.h>

namespace floatframe::test {
namespace {

TEST(MemoryRoom, OfThisMachine) {
  EXPECT_GT(memory_room(), 1e7);
  EXPECT_EQ(memory_complaint(0.0), "");
  EXPECT_EQ(memory_complaint(9e7), "");
  const std::string complaint = memory_complaint(1e18);
  EXPECT_EQ(complaint.find("takes about 1e+09 GB of memory, of which "), 0u) << complaint;
}

}  // namespace
}  // namespace floatframe::test
