// Includes the one header and calls the library.
#include <cstdio>
#include <floatframe/floatframe.hpp>

int main() {
  const auto steel_ball =
      floatframe::InertiaInvariants::rigid(2.0, {0.1, 0, 0}, 0.01 * floatframe::Mat3::Identity());
  std::printf("Floatframe %s, mass %.1f kg\n", floatframe::version().c_str(), steel_ball.m);
  return floatframe::version() == FLOATFRAME_VERSION && steel_ball.modes() == 0 ? 0 : 1;
}
