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
  /// Limits of the drive force on the vehicle [N], by those of the input.
  double lowest_force() const noexcept { return lowest_; }
  double highest_force() const noexcept { return highest_; }

  /// One step with this road-wheel angle [rad] and this drive force [N]; an angle beyond the limits
  /// of the input is the limit. Throws RunError with the cause if it fails.
  void step(double steering, double force);
  /// Time, position and heading count from here, and rows are recorded from here on.
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
  double wheel_radius_, mass_ = 0.0, lowest_ = 0.0, highest_ = 0.0, begin_ = 0.0;
  bool recording_ = false;
  long steps_ = 0, every_ = 1;
  std::array<std::ptrdiff_t, std::size(measured_names)> index_{};
  VehicleInstant now_;
};

/// Starts trimmed: drives straight on under both controllers until, for one second, the yaw rate
/// stays below 5e-5 deg/s and the speed within 5e-5 m/s. Then the record begins. Throws RunError
/// after 120 s.
struct TrimmedInputs {
  double steering = 0.0;  ///< road-wheel angle that drives straight [rad]
  double force = 0.0;     ///< against the resistance [N]
};
TrimmedInputs drive_trimmed(VehicleRun& run, PathFollower& follower, SpeedController& controller,
                            double speed);

}  // namespace floatframe
