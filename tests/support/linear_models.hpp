#pragma once
// Models that are linearised in more than one way.
#include "support/model_text.hpp"

namespace floatframe::test {

inline const char* const oscillator = R"(
bodies: {box: {position: [0, 0, 0], rigid: {mass: 3}}}
joints: {slide: {type: prismatic, child: box, at: [0, 0, 0], axis: x}}
forces: {s: {type: joint_spring, joint: slide, spring: 40, damper: 7}}
simulation: {step: 0.001, duration: 1}
)";

/// A flexible crank, a rod and a slider on a spring, sunk under their weights.
inline const char* const flexible_loop = R"(
points: {a: [0, 0, 0], b: [0.3, 0, 0], c: [0.8, 0, 0.3]}
bodies:
  crank:
    flexible:
      material: {young: 2e9, poisson: 0.3, density: 2700}
      bars: {one: {from: a, to: b, elements: 4, section: {round: 0.02}}}
      clamped: [a]
      static_modes: [{point: b, dofs: [x, y, z]}]
      normal_modes: 2
  rod: {rigid: {mass: 0.5, centre_of_mass: [0.55, 0, 0.15], inertia: [0.001, 0.01, 0.01]}}
  slider: {rigid: {mass: 2, centre_of_mass: c, inertia: [0.01, 0.01, 0.01]}}
joints:
  hinge: {type: revolute, child: crank, at: a, axis: y}
  pin: {type: spherical, parent: crank, child: rod, at: b}
  eye: {type: universal, parent: rod, child: slider, at: c, axis: y, axis_2: x}
  guide: {type: prismatic, child: slider, at: c, axis: x}
forces:
  turn: {type: joint_spring, joint: hinge, spring: 60, damper: 0.1}
  push: {type: joint_spring, joint: guide, spring: 900, damper: 3}
simulation: {step: 0.001, duration: 1, start: equilibrium}
)";

/// Two point masses on an arm that turns at 12 rad/s: the outer one slides along the arm on a
/// spring, which balances it.
inline Model arm_and_bead(const std::string& inertia, const std::string& pin,
                          const std::string& outputs = "") {
  return model_of(R"(
gravity: [0, 0, 0]
bodies:
  arm: {position: [0, 0, 0], rigid: {mass: 1, inertia: )" +
                  inertia + R"(}}
  bead: {position: [0.5, 0, 0], rigid: {mass: 0.2}}
joints:
  pin: {type: revolute, child: arm, at: [0, 0, 0], axis: z, )" +
                  pin + R"(}
  slide: {type: prismatic, parent: arm, child: bead, at: [0.5, 0, 0], axis: x}
forces: {s: {type: joint_spring, joint: slide, spring: {linear: {stiffness: 90, preload: -14.4}}}}
simulation: {step: 0.001, duration: 1}
)" + outputs);
}

}  // namespace floatframe::test
