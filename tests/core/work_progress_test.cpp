#include "floatframe/core/work_progress.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace floatframe::test {
namespace {

TEST(WorkProgress, ReachesTheInnermostListenerOfThisThread) {
  std::vector<std::string> outer, inner;
  tell_progress("nobody", 0.5);
  {
    const ListenToProgress listen([&](const char* work, double) { outer.emplace_back(work); });
    tell_progress("a", 0.1);
    {
      const ListenToProgress closer([&](const char* work, double) { inner.emplace_back(work); });
      tell_progress("b", 0.2);
    }
    std::thread([] { tell_progress("elsewhere", 0.3); }).join();
    tell_progress("c", 0.4);
  }
  tell_progress("nobody", 1.0);
  EXPECT_EQ(outer, (std::vector<std::string>{"a", "c"}));
  EXPECT_EQ(inner, std::vector<std::string>{"b"});
}

}  // namespace
}  // namespace floatframe::test
