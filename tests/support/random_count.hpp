#pragma once
// How many cases a long random suite has: its own number in `make test`, FLOATFRAME_RANDOM of them
// in `make test-nightly`.
#include <cstdlib>

namespace floatframe::test {

inline int random_count(int otherwise = 50) {
  const char* const text = std::getenv("FLOATFRAME_RANDOM");
  return text ? std::atoi(text) : otherwise;
}

}  // namespace floatframe::test
