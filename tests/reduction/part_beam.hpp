#pragma once
// A beam of bricks with a bore at each end.
#include "floatframe/reduction/part.hpp"
#include "support/fe_parts.hpp"

namespace floatframe::test {

/// 0.6 m x 30 x 30 mm; the reference points are in the middle of the ends.
inline FeModel beam() { return brick_beam(12, 2, 2, 0.6, 0.03); }

inline PartOptions both_ends(int modes = 8) {
  PartOptions options;
  options.interfaces = {bore("A"), bore("B")};
  options.modes = modes;
  return options;
}

}  // namespace floatframe::test
