#pragma once
// The states of a run as rows of numbers, for storage (history/states_file.hpp). A row is one
// instant: the time, the coordinates q and velocities v of the formulation, its accelerations, the
// angles that count turns of joint springs, the inputs, and, for readers without a formulation, the
// pose of each body. From them (`StateSampler`, history/recorded_motion) the formulation is
// restored, bit for bit.
//
// Accelerations are those of the integrator: they are computed before velocities and positions are
// projected at the end of a step, so (q, v) determine them to its tolerance only.
#include <string>
#include <vector>

#include "floatframe/formulation/formulation.hpp"
#include "floatframe/integrator/step.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

/// One health value of a run at a recorded instant (health.hpp).
struct HealthColumn {
  std::string name, unit;
  std::string group;   ///< "constraints", "effort", "energy", "range"
  std::string body{};  ///< of "range"
  double size = 0.0;   ///< of this body [m]
};

struct StateLayout {
  struct Group {
    std::string name;
    int first = 0, count = 0;  ///< columns
  };
  /// time, q, v, accelerations, spring_angles, inputs, poses: x, y, z [m] of the body frame and its
  /// quaternion (w, x, y, z), body to world; for a monitored run the health columns.
  std::vector<Group> groups;
  int columns = 0;
  std::vector<int> q, v;  ///< the stored coordinates, as numbered by the formulation
  int configurations = 0, velocities = 0;  ///< total numbers
  std::vector<std::string> owners;         ///< of each velocity: "joint 'hinge'"

  /// First columns; -1: not stored.
  struct BodyColumns {
    int pose = -1;
    int amplitudes = -1, rates = -1;  ///< of its modes, among q and v; without modes -1
  };
  std::vector<BodyColumns> bodies;
  std::vector<HealthColumn> health;

  bool complete() const noexcept {
    return q.size() == static_cast<std::size_t>(configurations) &&
           v.size() == static_cast<std::size_t>(velocities);
  }
  const Group* find(const std::string& name) const noexcept;
};

inline constexpr const char* health_group = "health";

/// Interval of states among the recorded rows, for a run that records this number of rows.
long states_every(const RecordDescription& record, long rows) noexcept;

/// Writes the states of one formulation as rows.
class StateSampler {
 public:
  /// `health`: columns reserved for other writers. Throws InputError for a body that does not exist
  /// in the model.
  StateSampler(const Formulation& formulation, const RecordDescription& record,
               std::vector<HealthColumn> health = {});

  const StateLayout& layout() const noexcept { return layout_; }
  /// The formulation is at the state. Does not allocate.
  void sample(const State& state, double* row) const noexcept;

 private:
  void keep_bodies(const RecordDescription& record);
  void find_coordinates();
  void place_columns(const RecordDescription& record);

  const Formulation& f_;
  StateLayout layout_;
  std::vector<char> kept_;  ///< bodies
};

}  // namespace floatframe
