#pragma once
// Where the bodies of a scene are, at instants of a run or in one state, and what loads them there.
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/model/system_state.hpp"

namespace floatframe {

class StateHistory;

struct SceneFrames {
  std::vector<double> time;        ///< [s]
  std::vector<double> poses;       ///< frames x bodies x 7: x, y, z [m], quaternion x, y, z, w
  std::vector<double> amplitudes;  ///< frames x modes of all bodies
  Vec3 origin = Vec3::Zero();      ///< what positions are measured from, so that floats are enough
  std::vector<char> known;         ///< bodies that were recorded; others stay where they begin
  std::vector<std::size_t> instants;  ///< of the states that the frames are
  bool whole = true;                  ///< false: more instants were recorded than there are frames
  /// What the stress of bodies has beside their amplitudes (add_load_coefficients): frames x
  /// columns.
  std::vector<double> loads;
  std::vector<int> first_load;  ///< column of each body; -1: none. Empty: of no body

  std::size_t load_columns() const { return time.empty() ? 0 : loads.size() / time.size(); }
  double* pose(std::size_t frame, std::size_t body) {
    return poses.data() + 7 * (frame * known.size() + body);
  }
  const double* pose(std::size_t frame, std::size_t body) const {
    return poses.data() + 7 * (frame * known.size() + body);
  }
};

/// Numbers in the frames of a page; of a longer run so many instants are taken, evenly.
inline constexpr std::size_t most_numbers_of_frames = 600'000;
/// However few bodies there are.
inline constexpr std::size_t most_frames = 20'000;

/// Throws InputError if the states are not of this model.
SceneFrames scene_frames(const Model& model, const StateHistory& history);
/// One frame.
SceneFrames scene_frames(const Model& model, const SystemState& state);

/// What a body's own inertia and weight add to its stress: the 12 load coefficients of
/// body_stress.hpp at each frame, from the accelerations of the run, of the bodies that know what
/// these loads do. Those of the modes' accelerations are left to gauges and `floatframe stress`.
/// `options`: those of the run. Without a state to start from, as of a model that cannot start,
/// nothing is added.
void add_load_coefficients(const Model& model, const StateHistory& history,
                           const SimulationDescription& options, SceneFrames& frames);

}  // namespace floatframe
