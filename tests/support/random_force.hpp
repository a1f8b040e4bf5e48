#pragma once
// A random force element of any type, made from the table of its keys: new types are covered by
// being in the list.
#include "floatframe/model/example_numbers.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe::test {

/// What the element may refer to. Laws are smooth and not odd: what they belong to shows its sense.
struct RandomForceEnds {
  AttachmentDescription a, b;  ///< on two bodies
  std::string joint, road;
  double stiffness = 100.0, damping = 5.0;  ///< of displacements [N/m], [N s/m]
  double length = 0.1;                      ///< rotational ones are smaller by its square [m]
};
ElementDescription random_force(ElementType type, const RandomForceEnds& ends,
                                ExampleNumbers& numbers);

}  // namespace floatframe::test
