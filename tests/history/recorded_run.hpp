#pragma once
// Runs whose states are kept in a file.
#include <string>

#include "floatframe/history/history_content.hpp"
#include "floatframe/history/state_history.hpp"
#include "floatframe/run/run.hpp"
#include "support/model_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {

/// A crank drives a slider over a rod (a loop); a flexible beam swings; a disc on a spring counts
/// turns; a stone flies. Outputs are to follow.
inline const char* const recorded_machine = R"(
points: {p: [0, 1, 0], tip: [0.6, 1, 0]}
inputs:
  push: {unit: N, initial: 3}
bodies:
  crank: {rigid: {mass: 1, centre_of_mass: [0.05, 0, 0], inertia: [0.001, 0.002, 0.002]}}
  slider: {rigid: {mass: 2, centre_of_mass: [0.5, 0, 0], inertia: [0.01, 0.01, 0.01]}}
  beam:
    flexible:
      material: {young: 7e10, poisson: 0.3, density: 2700}
      bars: {one: {from: p, to: tip, elements: 4, section: {rectangle: [0.02, 0.01]}}}
      clamped: [p]
      static_modes: [{point: tip, dofs: [y, z]}]
      normal_modes: 2
      damping: 0.01
  disc: {rigid: {mass: 1, centre_of_mass: [0, 2, 0], inertia: [0.02, 0.02, 0.02]}}
  stone: {rigid: {mass: 1, centre_of_mass: [0, 4, 0], inertia: [0.02, 0.03, 0.04]}}
joints:
  drive: {type: revolute, child: crank, at: [0, 0, 0], axis: z, motion: {polynomial: [0.3, 40]}}
  guide: {type: prismatic, child: slider, at: [0.5, 0, 0], axis: x}
  hinge: {type: revolute, child: beam, at: p, axis: y, position: 0.4}
  spin: {type: revolute, child: disc, at: [0, 2, 0], axis: z, position: 14}
  loose: {type: free, child: stone, at: [0, 4, 0], velocity: [1, 0, 2, 1, 9, 2]}
rods:
  tie: {from: {body: crank, at: [0.1, 0, 0]}, to: {body: slider, at: [0.5, 0, 0]}}
forces:
  coil: {type: joint_spring, joint: spin, spring: 3}
  load: {type: force, body: slider, at: [0.5, 0, 0], direction: x, magnitude: {input: push}}
simulation: {step: 2.0e-3, duration: 0.3, spectral_radius: 0.8}
)";

struct Recorded {
  RunResult result;
  std::string path;
};

/// `path`: of the file to write.
inline Recorded recorded_run(const Model& model, const SimulationDescription& o,
                             const std::string& path, const HistoryOrigin& origin = {}) {
  std::optional<StatesFile> file;
  RunOptions options;
  options.states = [&](const StateLayout& layout, std::span<const double> numbers) {
    if (!file) file.emplace(path, history_content(model, o, layout, origin), false);
    file->append(numbers);
  };
  Recorded out{run(model, o, options), path};
  file->finish(out.result.summary.status, out.result.summary.message);
  return out;
}

}  // namespace floatframe::test
