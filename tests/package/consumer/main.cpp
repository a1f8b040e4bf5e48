// Includes every installed header (all_headers.hpp is written by the test) and calls the library.
#include <cstdio>

#include "all_headers.hpp"

int main() {
  const auto steel_ball =
      floatframe::InertiaInvariants::rigid(2.0, {0.1, 0, 0}, 0.01 * floatframe::Mat3::Identity());
  std::printf("Floatframe %s, mass %.1f kg\n", floatframe::version().c_str(), steel_ball.m);
  return floatframe::version() == FLOATFRAME_VERSION && steel_ball.modes() == 0 ? 0 : 1;
}
