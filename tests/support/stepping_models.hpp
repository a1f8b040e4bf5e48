#pragma once
// A machine with all that a saved simulation has to hold, and what drives it.
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "floatframe/stepping/stepping.hpp"
#include "support/model_text.hpp"

namespace floatframe::test {

/// A driven crank with a slider behind it (a loop) and a flexible beam on a hinge: lists open
/// for more bodies and joints.
inline const std::string machine_bodies = R"(points:
  a: [0, 0, 0]
  b: [0.1, 0, 0]
  c: [0.5, 0, 0]
  p: [0, 1, 0]
  tip: [0.6, 1, 0]
bodies:
  crank: {rigid: {mass: 1, centre_of_mass: [0.05, 0, 0], inertia: [0.001, 0.002, 0.002]}}
  rod: {rigid: {mass: 0.5, centre_of_mass: [0.3, 0, 0], inertia: [0.0001, 0.007, 0.007]}}
  slider: {rigid: {mass: 2, centre_of_mass: c, inertia: [0.01, 0.01, 0.01]}}
  beam:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: tip, elements: 4, section: {round: 0.01}}}
      clamped: [p]
      static_modes: [{point: tip, dofs: [y, z]}]
      normal_modes: 2
      damping: 0.01
)";
inline const std::string machine_joints = R"(joints:
  drive: {type: revolute, child: crank, at: a, axis: z, motion: {polynomial: [0.3, 40]}}
  pin: {type: revolute, parent: crank, child: rod, at: b, axis: z}
  eye: {type: revolute, parent: rod, child: slider, at: c, axis: z}
  guide: {type: prismatic, child: slider, at: c, axis: x}
  hinge: {type: revolute, child: beam, at: p, axis: y, position: 0.4}
)";

/// A driven crank with a slider behind it (a loop), a flexible beam, an element with states, discs
/// on springs that count turns (`spin` in the tree, `cut` where a loop would be cut), two gears of
/// which one is cut, free bodies, inputs of each kind.
inline const std::string stepped_machine =
    R"(
inputs:
  push: {unit: N, min: -50, max: 50}
  aim: {unit: rad, initial: 0.1, min: -1, max: 1, clamp: true}
  shove: {}
)" + machine_bodies +
    R"(  disc: {rigid: {mass: 1, centre_of_mass: [0, 2, 0], inertia: [0.02, 0.02, 0.02]}}
  wheel: {rigid: {mass: 1, centre_of_mass: [0, 3, 0], inertia: [0.02, 0.02, 0.02]}}
  stone: {rigid: {mass: 1, centre_of_mass: [0, 4, 0], inertia: [0.02, 0.03, 0.04]}}
  pinion: {rigid: {mass: 1, centre_of_mass: [0, 5, 0], inertia: [0.02, 0.02, 0.02]}}
  gear: {rigid: {mass: 1, centre_of_mass: [0, 6, 0], inertia: [0.05, 0.05, 0.05]}}
)" + machine_joints +
    R"(  spin: {type: revolute, child: disc, at: [0, 2, 0], axis: z, position: 14}
  cut: {type: revolute, child: wheel, at: [0, 3, 0], axis: x, position: 14, cut: true}
  loose: {type: free, child: stone, at: [0, 4, 0], velocity: [1, 0, 2, 1, 9, 2]}
  pinion: {type: revolute, child: pinion, at: [0, 5, 0], axis: z, position: 14, velocity: 60}
  gear: {type: revolute, child: gear, at: [0, 6, 0], axis: x, cut: true}
couplings:
  mesh:
    terms: [{joint: pinion}, {joint: gear, factor: 3}]
    value: {sine: {amplitude: 0.2, frequency: 3}}
forces:
  coil: {type: joint_spring, joint: spin, spring: 3, target: {input: aim}}
  twin: {type: joint_spring, joint: cut, spring: 3, target: {input: aim}}
  load: {type: force, body: slider, at: c, direction: x, magnitude: {input: push}}
  blow: {type: force, body: stone, at: [0, 4, 0], direction: z, magnitude: {input: shove}}
  creep: {type: maxwell, from: {body: ground, at: [0.5, 1, 0.5]}, to: {body: beam, node: tip},
          branches: [[300, 20], [50, 1]]}
outputs:
  spin: {joint_position: spin}
  cut: {joint_position: cut}
  eye: {joint_position: eye}
  drive: {joint_position: drive}
  gear: {joint_position: gear}
  coil: {force: coil}
  tip: {acceleration: {body: beam, node: tip}, axis: z}
  stone: {position: stone}
  turn: {rotation: stone, angle: pitch}
  y1: {modal_amplitude: beam, mode: 1}
simulation: {step: 2.0e-3, duration: 0.4, spectral_radius: 0.8}
)";

/// Inputs before step k.
inline void drive_inputs(Simulation& s, int k) {
  s.set_input("push", 30.0 * std::sin(0.3 * k));
  s.set_input("aim", 1.2 * std::cos(0.1 * k));  // at times clamped
}

/// All outputs, inputs and counters of the steps from `from` up to `to`.
inline std::vector<double> trace(Simulation& s, int from, int to) {
  std::vector<double> all;
  for (int k = from; k < to; ++k) {
    drive_inputs(s, k);
    const StepReport r = s.step();
    all.push_back(static_cast<double>(r.status));
    all.push_back(s.time());
    all.push_back(r.position_violation);
    all.insert(all.end(), s.outputs().begin(), s.outputs().end());
    all.insert(all.end(), s.inputs().begin(), s.inputs().end());
    const StepCounters c = s.counters();
    for (const long n : {c.steps, c.substeps, c.iterations, c.factorizations})
      all.push_back(static_cast<double>(n));
  }
  return all;
}

inline bool equal_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace floatframe::test
