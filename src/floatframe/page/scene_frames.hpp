#pragma once
// Poses and loads of the bodies of a scene, at instants of a run or in one state.
#include <vector>

#include "floatframe/description/system_state.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/page/scene_efforts.hpp"

namespace floatframe {

class StateHistory;

struct SceneFrames {
  std::vector<double> time;           ///< [s]
  std::vector<double> poses;          ///< frames x bodies x 7: x, y, z [m], quaternion x, y, z, w
  std::vector<double> amplitudes;     ///< frames x modes of all bodies
  Vec3 origin = Vec3::Zero();         ///< origin of positions, so that floats suffice
  std::vector<char> known;            ///< recorded bodies; others keep their start pose
  std::vector<std::size_t> instants;  ///< indices of the states of the frames
  bool whole = true;                  ///< false: more recorded instants than frames
  /// Load coefficients of the stress of bodies, in addition to amplitudes (add_replayed_values):
  /// frames x columns.
  std::vector<double> loads;
  std::vector<int> first_load;  ///< column of each body; -1: none. Empty: no body has any
  SceneEfforts efforts;         ///< may be empty

  std::size_t load_columns() const { return time.empty() ? 0 : loads.size() / time.size(); }
  double* pose(std::size_t frame, std::size_t body) {
    return poses.data() + 7 * (frame * known.size() + body);
  }
  const double* pose(std::size_t frame, std::size_t body) const {
    return poses.data() + 7 * (frame * known.size() + body);
  }
};

/// Limit of numbers in the frames of a page; longer runs are sampled evenly.
inline constexpr std::size_t most_numbers_of_frames = 600'000;
/// Limit of frames, even for few bodies.
inline constexpr std::size_t most_frames = 20'000;

/// Throws InputError if the states are not of this model.
SceneFrames scene_frames(const Model& model, const StateHistory& history);
/// One frame.
SceneFrames scene_frames(const Model& model, const SystemState& state);

/// Adds what follows from the motion of the run at each frame: what elements exert and where joints
/// stand, if all states were recorded; and the stress contribution of a body's own inertia and
/// weight, the 12 load coefficients of body_stress.hpp from the accelerations of the run, for
/// bodies that have load stress. Those of the modes' accelerations are used by gauges and
/// `floatframe stress` only. `options`: those of the run. Adds nothing if the model has no start
/// state.
void add_replayed_values(const Model& model, const StateHistory& history,
                         const SimulationDescription& options, SceneFrames& frames);

}  // namespace floatframe
