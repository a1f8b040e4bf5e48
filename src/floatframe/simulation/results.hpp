#pragma once
// Results of a run, a check and an equilibrium computation for writers: plain data, independent of
// the model.
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/formulation/counts.hpp"
#include "floatframe/math/types.hpp"
#include "floatframe/simulation/range_warning.hpp"
#include "floatframe/simulation/result_table.hpp"
#include "floatframe/simulation/start_report.hpp"
#include "floatframe/simulation/step_report.hpp"

namespace floatframe {

struct SystemState;

/// Sources and sinks of the energy of a system.
enum class EnergyFlow : std::size_t {
  loads,          ///< applied forces and torques
  actuators,      ///< actuators and moving targets of force elements
  dampers,        ///< of force elements
  tyres,          ///< their dampers, and the motion of the road below them
  modal_damping,  ///< of flexible bodies
  motions         ///< prescribed motions of joints
};
inline constexpr std::array<const char*, 6> energy_flow_names{"loads", "actuators",     "dampers",
                                                              "tyres", "modal_damping", "motions"};

/// Power [W] or work [J] of each, positive into the system.
struct EnergyFlows {
  std::array<double, energy_flow_names.size()> value{};
  double& operator[](EnergyFlow k) noexcept { return value[index_of(k)]; }
  double operator[](EnergyFlow k) const noexcept { return value[index_of(k)]; }
  static constexpr std::size_t size() noexcept { return energy_flow_names.size(); }
  double total() const noexcept {
    double sum = 0.0;
    for (const double x : value) sum += x;
    return sum;
  }
};

struct EnergySummary {  ///< [J]
  double kinetic_start = 0, potential_start = 0, elastic_start = 0, total_start = 0;
  double kinetic_end = 0, potential_end = 0, elastic_end = 0, total_end = 0;
  bool balanced = false;  ///< the run monitored the balance: the following values are valid
  EnergyFlows work;       ///< over the run
  double remainder = 0;   ///< change of the total minus all work, at the end
  double largest_remainder = 0, largest_remainder_at = 0;  ///< by magnitude [J], and when [s]
  double exchanged = 0;                                    ///< reference value of remainders
  double present = 0;  ///< the most in motion and modes together: weight and springs have no zero
  /// The largest change of the remainder between two consecutive checks, and their times [s].
  double largest_growth = 0, largest_growth_from = 0, largest_growth_to = 0;
};

/// The processor time of steps with their outputs [s], counted in bins of about equal ratio.
struct StepTimes {
  std::uint64_t steps = 0;
  double median = 0, percent_99 = 0, largest = 0;
  std::vector<double> edges;          ///< of the bins, one more than there are
  std::vector<std::uint64_t> counts;  ///< from the first bin with a step to the last
};

/// The steps are the output steps that were accepted.
struct RunSummary : StepCounters {
  std::string model, coordinates, inertia;
  double step = 0, duration = 0;  ///< [s]; duration actually reached
  bool locates_edges = false;     ///< with `locate_edges`
  double cpu = 0;                 ///< [s] of stepping, without input and output
  double real_time_factor = 0;    ///< duration / cpu
  StepTimes step_times;
  EnergySummary energy;
  /// "completed", "failed" or "interrupted"; "running" in a summary that is written at the start.
  std::string status = "completed";
  std::string message;  ///< cause of the failure: its time and the place to check
  StartReport start;
  /// Departures of the run from the range of the method: one sentence each (docs/range.md).
  std::vector<RangeWarning> warnings;
  bool strict = false;  ///< failed only because warnings count as errors: the results are complete
  /// Inputs of the run: parameters set, as NAME=VALUE, and every file read with the hash of its
  /// content. Empty unless the caller fills them.
  std::vector<std::string> settings;
  std::map<std::string, std::string> files;
};

struct RunResult {
  ResultTable table;
  RunSummary summary;
  std::shared_ptr<SystemState> state;  ///< at the end, if requested
};

struct ModelCounts {
  int bodies = 0, flexible_bodies = 0, joints = 0, cut_joints = 0;
  CoordinateCounts relative, absolute;
  int degrees_of_freedom = 0;
  int redundant_constraints = 0;
  std::vector<std::string> cut_joint_names;
  StartReport start;
};

/// With redundant constraints some reactions are not unique: any multiple of self-balancing forces
/// may be added. Then all reactions are those of minimum norm: the sum of the squares of the forces
/// and of the torques divided by the length of the child.
struct StaticsForce {
  std::string name, type;
  double force = 0;   ///< tension positive [N]; torque [N m] for joint springs on revolutes;
                      ///< vertical force of tyres
  double length = 0;  ///< measure of the element: length, deflection, angle
  bool unique = true;
};
struct StaticsJoint {
  std::string name, type;
  Vec3 force = Vec3::Zero();   ///< on the child, world axes [N]
  Vec3 torque = Vec3::Zero();  ///< on the child about the joint point, world axes [N m]
  std::array<bool, 3> unique_force{true, true, true}, unique_torque{true, true, true};
  bool unique() const;
};
struct StaticsBody {
  std::string name;
  Vec3 position = Vec3::Zero();        ///< body-frame origin [m]
  Vec3 roll_pitch_yaw = Vec3::Zero();  ///< relative to the design pose [rad]
  VecX amplitudes;                     ///< modal amplitudes
};
struct StaticsResult {
  int iterations = 0;
  double residual = 0;  ///< largest unbalanced generalised force
  std::vector<StaticsForce> forces;
  std::vector<StaticsJoint> joints;
  std::vector<StaticsBody> bodies;
  std::shared_ptr<SystemState> state;  ///< the equilibrium, at rest
  std::vector<RedundantDirection> redundant;
  std::vector<std::string> notes;  ///< other notes about the equilibrium: it is unstable
};

}  // namespace floatframe
