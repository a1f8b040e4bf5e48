#pragma once
// Both formulations, for tests that hold in each, and their names.
#include <string>

#include "floatframe/description/description.hpp"

namespace floatframe::test {

inline constexpr Coordinates both_coordinates[] = {Coordinates::relative, Coordinates::absolute};

inline std::string name_of(Coordinates c) {
  return c == Coordinates::relative ? "relative" : "absolute";
}

inline SimulationDescription with(SimulationDescription s, Coordinates c) {
  s.coordinates = c;
  return s;
}
inline SimulationDescription with(SimulationDescription s, Coordinates c, double step,
                                  double duration) {
  s.coordinates = c;
  s.step = step;
  s.duration = duration;
  return s;
}

}  // namespace floatframe::test
