#pragma once
// A vehicle that is driven: inputs are set before each step and constant during it, outputs are
// read after it.
#include <array>
#include <cstddef>
#include <iterator>

#include "floatframe/run/result_table.hpp"
#include "floatframe/stepping/stepping.hpp"
#include "floatframe/vehicle/driver.hpp"
#include "floatframe/vehicle/vehicle_setup.hpp"

namespace floatframe {

/// Measures of the vehicle at one instant.
struct VehicleInstant {
  double time = 0.0;                  ///< since the start of the record [s]
  DriverView view;                    ///< of the driver's point
  double path_speed = 0.0;            ///< horizontal speed [m/s]
  double lateral_acceleration = 0.0;  ///< horizontal, across the heading [m/s2]
  double sideslip = 0.0;              ///< atan(v_y/v_x) in the axes of the heading [rad]
  double roll = 0.0;                  ///< [rad]
  double steering = 0.0;              ///< road-wheel angle by the input [rad]
};

class VehicleRun {
 public:
  /// Throws InputError and RunError as `Simulation`.
  explicit VehicleRun(const VehicleSetup& setup);

  const VehicleDescription& vehicle() const noexcept { return vehicle_; }
  const AxleDistances& axles() const noexcept { return axles_; }
  const Model& model() const noexcept { return simulation_.model(); }
  const SimulationDescription& options() const noexcept { return simulation_.options(); }
  const StartReport& start_report() const noexcept { return simulation_.start_report(); }
  StepCounters counters() const noexcept { return simulation_.counters(); }
  double step_size() const noexcept { return simulation_.options().step; }
  double mass() const noexcept { return mass_; }
  const VehicleInstant& now() const noexcept { return now_; }
  double wheel_radius() const noexcept { return wheel_radius_; }
  /// Limits of the force on the vehicle [N], by those of the inputs: that of the drive alone, and
  /// that of drive and brakes together.
  double lowest_drive() const noexcept { return lowest_drive_; }
  double lowest_force() const noexcept { return lowest_drive_ - highest_braking_; }
  double highest_force() const noexcept { return highest_; }
  /// Of the brakes [N]; zero without.
  double highest_braking() const noexcept { return highest_braking_; }

  /// One step with this road-wheel angle [rad] and this force along the vehicle [N]. What of it
  /// the drive cannot do, below its lower limit, the brakes do if there are any, and `braking` [N]
  /// more. An angle or force beyond the limits of its input is the limit. Throws RunError with the
  /// cause if it fails.
  void step(double steering, double force, double braking = 0.0);
  /// The state, and the return to one. Inputs of the steps in between leave no trace.
  SimulationState save() const { return simulation_.save(); }
  void restore(const SimulationState& state);
  /// Time, position and heading count from here, and rows are recorded from here on;
  /// those of before are forgotten.
  void begin_record();
  /// Time, the outputs of the model, the values of the inputs as "inputs.NAME".
  ResultTable table;

 private:
  void set(const VehicleInput& input, double value);
  void read();
  void record();
  double measured(Measured which) const { return simulation_.output(index_[int(which)]); }

  Simulation simulation_;
  VehicleDescription vehicle_;
  AxleDistances axles_;
  double wheel_radius_, mass_ = 0.0, begin_ = 0.0;
  double lowest_drive_ = 0.0, highest_ = 0.0, highest_braking_ = 0.0;
  bool recording_ = false;
  long steps_ = 0, every_ = 1;
  std::array<std::ptrdiff_t, std::size(measured_names)> index_{};
  VehicleInstant now_;
};

/// Starts trimmed: drives straight on under both controllers until, for one second, the yaw rate
/// stays below 5e-5 deg/s and the speed within 5e-5 m/s, at most 1e-3 m/s from the one asked for.
/// Then the record begins. Throws InputError if an input does not act (input_probe.hpp), RunError
/// after 120 s, or earlier where the force is at its limit and the speed another one, and at once
/// where the vehicle is 0.5 rad off its heading, or slower than 0.05 or faster than 4 times the
/// speed asked for.
struct TrimmedInputs {
  double steering = 0.0;  ///< road-wheel angle that drives straight [rad]
  double force = 0.0;     ///< against the resistance [N]
};
TrimmedInputs drive_trimmed(VehicleRun& run, PathFollower& follower, SpeedController& controller,
                            double speed);

}  // namespace floatframe
