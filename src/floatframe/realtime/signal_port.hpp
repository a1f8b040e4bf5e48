#pragma once
// Source of the inputs and destination of the outputs of a paced model: UDP packets, or a
// controller in the same program. The runner calls a port once or twice per step, from the stepping
// thread: no allocation, no lock, no exception, no printing.
#include <cstdint>
#include <span>

#include "floatframe/realtime/input_buffer.hpp"

namespace floatframe {

class SignalPort {
 public:
  virtual ~SignalPort() = default;

  /// Before a step: blocks until its inputs are available. A free-running port (the default)
  /// returns at once. False: they did not arrive in time.
  virtual bool wait() noexcept { return true; }

  /// Passes on inputs received since the last call; true if there were any. Never blocks.
  virtual bool receive(InputBuffer& inputs) noexcept = 0;

  /// The outputs at `time`, after `step` steps (0: the start). `last`: the run ends with these.
  virtual void send(std::uint64_t step, double time, std::span<const double> outputs,
                    bool last) noexcept = 0;

  /// False: outputs are not used and need not be computed.
  virtual bool wants_outputs() const noexcept { return true; }

  /// False: this port never provides inputs, so that none are expected.
  virtual bool gives_inputs() const noexcept { return true; }
};

}  // namespace floatframe
