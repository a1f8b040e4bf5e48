#pragma once
// Where the inputs of a paced model come from and its outputs go to: UDP packets, or a
// controller in the same program. The runner calls a port once or twice per step, from the stepping
// thread: no allocation, no lock, no exception, no printing.
#include <cstdint>
#include <span>

#include "floatframe/realtime/input_buffer.hpp"

namespace floatframe {

class SignalPort {
 public:
  virtual ~SignalPort() = default;

  /// Before a step is computed: blocks until the inputs are there that belong to it. A port that
  /// takes what has come (the default) returns at once. False: they did not come in time.
  virtual bool wait() noexcept { return true; }

  /// Hands over what has come since the last call; true if there was something. Never blocks.
  virtual bool receive(InputBuffer& inputs) noexcept = 0;

  /// The outputs at `time`, after `step` steps (0: the start). `last`: the run ends here.
  virtual void send(std::uint64_t step, double time, std::span<const double> outputs,
                    bool last) noexcept = 0;

  /// False: nobody wants outputs, so that they need not be computed.
  virtual bool wants_outputs() const noexcept { return true; }

  /// False: inputs never come this way, so that nobody waits for them.
  virtual bool gives_inputs() const noexcept { return true; }
};

}  // namespace floatframe
