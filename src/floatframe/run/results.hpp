#pragma once
// Results of a run for writers: plain data, independent of the model.
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/loops/start_report.hpp"
#include "floatframe/run/range_warning.hpp"
#include "floatframe/run/result_table.hpp"
#include "floatframe/stepping/step_report.hpp"

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

/// How the differences of an output fall with the step.
enum class Convergence {
  regular,     ///< with an order from 0.5 to 3.5
  round_off,   ///< not at all: they are rounding
  none,        ///< with an order below 0.5, or not
  too_coarse,  ///< with an order above 3.5, which the method does not have
  unknown      ///< there are no instants at a quarter of the step
};
/// In this order.
inline constexpr std::array<const char*, 5> convergence_names{"regular", "round-off", "none",
                                                              "too coarse", "unknown"};

/// An output of a run compared with runs at half and a quarter of its step.
struct VerifiedOutput {
  Column column;
  double largest = 0, at = 0;       ///< difference to the run at half the step, and when [s]
  double first = 0, second = 0;     ///< D1 and D2 over the instants of all three runs
  double range = 0, magnitude = 0;  ///< max x - min x, max |x| of the run
  Convergence convergence = Convergence::unknown;
  double order = 0;  ///< if regular
  double error = 0;  ///< estimated for the run; without an order the difference itself
};

/// How a run depends on its step: what `verify_steps` finds.
struct Verification {
  double step = 0;                      ///< of the run [s]
  std::size_t instants = 0;             ///< of the run and of that at half the step
  double from = 0, to = 0;              ///< common span [s]
  std::vector<VerifiedOutput> outputs;  ///< in the order of the model
  /// Runs that ended early, and outputs that do not converge as the method does.
  std::vector<std::string> sentences;
  bool interrupted = false;
  double cpu = 0;  ///< of both runs [s]
};

/// The steps are the output steps that were accepted.
struct RunSummary : StepCounters {
  std::string model, coordinates, inertia;
  double step = 0, duration = 0;     ///< [s]; duration actually reached
  bool locates_edges = false;        ///< with `locate_edges`
  std::string until;                 ///< the formula that ends the run; empty: none
  std::optional<double> crossed_at;  ///< time at which it has crossed zero and ended the run [s]
  double cpu = 0;                    ///< [s] of stepping, without input and output
  double real_time_factor = 0;       ///< duration / cpu
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
  std::optional<Verification> verification;  ///< if requested
};

struct RunResult {
  ResultTable table;
  RunSummary summary;
  std::shared_ptr<SystemState> state;  ///< at the end, if requested
  std::exception_ptr thrown;           ///< by the function of a force, if the run failed by that
};

}  // namespace floatframe
