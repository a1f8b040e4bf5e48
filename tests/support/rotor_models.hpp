#pragma once
// Rotors of the tests of Campbell diagrams and of unbalance.
#include <string>

namespace floatframe::test {

/// A shaft of 1.5 m on two bearings with two discs.
inline std::string two_discs(int normal_modes, const std::string& more = "") {
  return R"(
gravity: [0, 0, 0]
points: {L: [0, 0, 0], D1: [0.5, 0, 0], D2: [1.0, 0, 0], R: [1.5, 0, 0]}
bodies:
  shaft:
    flexible:
      material: {young: 2.11e11, poisson: 0.3, density: 7810}
      bars:
        a: {from: L, to: D1, elements: 10, section: {round: 0.05}}
        b: {from: D1, to: D2, elements: 10, section: {round: 0.05}}
        c: {from: D2, to: R, elements: 10, section: {round: 0.05}}
      clamped: [D1]
      static_modes:
        - {point: L, dofs: [y, z]}
        - {point: D2, dofs: [y, z, ry, rz]}
        - {point: R, dofs: [y, z]}
      normal_modes: )" +
         std::to_string(normal_modes) + R"(
      mass_model: hermite
      section_inertia: true
  d1: {rigid: {mass: 32.6, centre_of_mass: D1, inertia: [0.33, 0.178, 0.178]}}
  d2: {rigid: {mass: 32.6, centre_of_mass: D2, inertia: [0.33, 0.178, 0.178]}}
joints:
  spin: {type: free, child: shaft, at: D1}
  w1: {type: weld, parent: shaft, child: d1, at: D1}
  w2: {type: weld, parent: shaft, child: d2, at: D2}
forces:
  bl: {type: bearing, from: {body: ground, at: L}, to: {body: shaft, at: L}, axis: x, axis_2: y,
    stiffness: [[1e6, 0, 0, 0, 0, 0], [0, 1e6, 0, 0, 0, 0], [0, 0, 1e5, 0, 0, 0],
      [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]]}
  br: {type: bearing, from: {body: ground, at: R}, to: {body: shaft, at: R}, axis: x, axis_2: y,
    stiffness: [[1e6, 0], [0, 1e6]]}
simulation: {step: 0.001, duration: 1}
)" + more;
}

/// A blade of 10 m on a hub that turns about z as prescribed.
inline std::string blade(const std::string& stiffening) {
  return R"(
gravity: [0, 0, 0]
points: {h: [0, 0, 0], t: [10, 0, 0]}
bodies:
  blade:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {b: {from: h, to: t, elements: 20, section: {rectangle: [0.2, 0.05]}, reference: y}}
      clamped: [h]
      static_modes: [{point: t, dofs: [x, y, z]}]
      normal_modes: 6
      mass_model: hermite
      section_inertia: true
    geometric_stiffening: )" +
         stiffening + R"(
joints:
  hub: {type: revolute, child: blade, at: h, axis: z, motion: {polynomial: [0, 0]}}
simulation: {step: 0.001, duration: 1}
)";
}

/// A rigid disc that spins about z in a bearing; `law`: its keys.
inline std::string disc_in_bearing(const std::string& law, const std::string& more = "") {
  return R"(
gravity: [0, 0, 0]
points: {c: [0, 0, 0], off: [0.24, 0, 0]}
bodies:
  disc: {position: [0, 0, 0], rigid: {mass: 2, inertia: [0.02, 0.02, 0.035]}}
joints: {motor: {type: free, child: disc, at: c}}
forces:
  housing: {type: bearing, from: {body: ground, at: c}, to: {body: disc, at: c}, )" +
         law + R"(}
simulation: {step: 0.001, duration: 1}
)" + more;
}

}  // namespace floatframe::test
