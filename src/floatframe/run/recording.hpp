#pragma once
// Records a simulation that a program steps, and watches its range and its energy as `run` does:
// the result is that of a run.
//
//   Simulation s(model);
//   Recording recording(s, {.every = 10});
//   while (s.time() < 8.0) s.step();
//   const RunResult result = recording.result();
//
// It begins at the present state. Where a state is restored or set, or the start again, instants
// after its time are dropped and the energy balance begins anew; with another model all begins
// anew.
#include <cstddef>
#include <memory>
#include <vector>

#include "floatframe/run/run.hpp"
#include "floatframe/stepping/stepping.hpp"

namespace floatframe {

struct StateLayout;

struct RecordingOptions {
  bool rows = true;      ///< outputs and states; false: range and energy alone
  long every = 1;        ///< steps from one instant to the next
  std::size_t keep = 0;  ///< number of instants that are kept, the last ones; 0: all
};

class Recording {
 public:
  /// Of a simulation that no other recording looks at. `keep` bounds its memory; without it steps
  /// allocate now and then. Throws InputError for options out of range.
  explicit Recording(Simulation& simulation, const RecordingOptions& options = {});
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  std::size_t instants() const noexcept;
  /// How the motion has left the range of the method so far, one sentence each. Allocates; the next
  /// steps stay the same, bit for bit.
  std::vector<RangeWarning> warnings();
  /// What a run of these steps gives: table, summary, state. The simulation may go on.
  RunResult result();
  /// The options of the simulation, with duration and interval of what was recorded.
  SimulationDescription options() const;
  /// Rows of states at the instants of the table, one after the other.
  const StateLayout& layout() const;
  std::vector<double> states() const;

 private:
  class Observer;
  std::unique_ptr<Observer> observer_;
};

}  // namespace floatframe
