#pragma once
// What a run, a check and an equilibrium computation hand to writers: plain data, no dependence on
// the model.
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "floatframe/formulation/counts.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

struct SystemState;

struct Column {
  std::string name;  ///< "chassis.z"
  std::string unit;  ///< "m"
};

/// Sampled outputs: row-major, one row a sample; column 0 is time.
struct ResultTable {
  std::vector<Column> columns;
  std::vector<double> data;
  std::size_t rows() const { return columns.empty() ? 0 : data.size() / columns.size(); }
  double at(std::size_t row, std::size_t column) const {
    return data[row * columns.size() + column];
  }
};

struct EnergySummary {  ///< [J]
  double kinetic_start = 0, potential_start = 0, elastic_start = 0, total_start = 0;
  double kinetic_end = 0, potential_end = 0, elastic_end = 0, total_end = 0;
};

struct RunSummary {
  std::string model, coordinates, inertia;
  double step = 0, duration = 0;  ///< [s]; duration actually reached
  long steps = 0, substeps = 0;   ///< accepted output steps; extra steps by halving
  long iterations = 0, factorizations = 0;
  double cpu = 0;                     ///< [s] of stepping, without input and output
  double real_time_factor = 0;        ///< duration / cpu
  double max_position_violation = 0;  ///< [m] after steps
  double max_velocity_violation = 0;  ///< [m/s] after the projections
  EnergySummary energy;
  std::string status = "completed";  ///< "completed" or "failed"
  std::string message;               ///< why it failed: time, culprit
};

struct RunResult {
  ResultTable table;
  RunSummary summary;
  std::shared_ptr<SystemState> state;  ///< at the end, if it was asked for
};

struct ModelCounts {
  int bodies = 0, flexible_bodies = 0, joints = 0, cut_joints = 0;
  CoordinateCounts relative, absolute;
  int degrees_of_freedom = 0;
  int redundant_constraints = 0;
  std::vector<std::string> cut_joint_names;
  std::vector<std::string> redundant_constraint_names;  ///< owners of rows that repeat earlier ones
};

struct StaticsForce {
  std::string name, type;
  double force = 0;   ///< tension positive [N]; torque [N m] for joint springs on revolutes;
                      ///< vertical force of tyres
  double length = 0;  ///< measure of the element: length, deflection, angle
};
struct StaticsJoint {
  std::string name, type;
  Vec3 force = Vec3::Zero();   ///< on the child, world axes [N]
  Vec3 torque = Vec3::Zero();  ///< on the child about the joint point, world axes [N m]
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
};

}  // namespace floatframe
