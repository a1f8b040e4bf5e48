#pragma once
// Inputs and outputs of a paced model as UDP packets (packet.hpp), through one socket, so that a
// controller may simply answer the address that the outputs come from.
//
// Free running: of all packets that have come since the last step the newest counts; nothing ever
// waits. In lock step the model waits before each step for the inputs that answer its last outputs,
// and sends these again every 0.1 s: either side may be started first, no packet is lost for good,
// and a run with a deterministic controller gives the same results each time.
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "floatframe/realtime/packet.hpp"
#include "floatframe/realtime/signal_port.hpp"
#include "floatframe/realtime/udp_socket.hpp"

namespace floatframe {

struct UdpPortOptions {
  bool inputs = false, outputs = false;
  UdpAddress listen;  ///< where inputs come in
  UdpAddress send;    ///< where outputs go to
  bool lock_step = false;
  double timeout = 5.0;  ///< lock step: longest wait for the inputs of a step [s]
  const std::atomic<bool>* stop = nullptr;  ///< ends a wait
};

/// What came and went; every packet that came is in one of the five numbers below `received`.
struct UdpCounts {
  long received = 0;
  long used = 0;        ///< handed over
  long superseded = 0;  ///< good, but a newer one came before the step
  long stale = 0;       ///< answers older outputs than one that was used before
  long foreign = 0;     ///< not a packet of inputs in this protocol and version
  long mismatched = 0;  ///< another layout: hash, count or length
  long sent = 0, send_errors = 0, repeated = 0;
  long largest_age = 0;  ///< steps between the outputs and the inputs that answer them
};

class UdpPort final : public SignalPort {
 public:
  /// Throws RunError if the address is taken, InputError if the packets would be too large.
  UdpPort(const Model& model, const UdpPortOptions& options);

  bool wait() noexcept override;
  bool receive(InputBuffer& inputs) noexcept override;
  void send(std::uint64_t step, double time, std::span<const double> outputs,
            bool last) noexcept override;
  bool wants_outputs() const noexcept override { return options_.outputs; }

  const UdpCounts& counts() const noexcept { return counts_; }
  UdpAddress local() const { return socket_.local(); }
  /// The system's error of the last packet that could not be sent; 0: none.
  int send_error() const noexcept { return send_error_; }

 private:
  /// Reads all packets that are there; true if `newest_` holds good inputs.
  bool drain() noexcept;
  bool stopped() const noexcept {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }
  void transmit() noexcept;

  UdpPortOptions options_;
  UdpSocket socket_;
  std::uint64_t input_hash_ = 0, output_hash_ = 0;
  std::vector<double> scratch_, newest_;
  bool fresh_ = false;  ///< `newest_` has not been handed over yet
  std::uint64_t newest_sequence_ = 0, last_sent_ = 0;
  std::vector<std::byte> incoming_, outgoing_;
  int send_error_ = 0;
  UdpCounts counts_;
};

}  // namespace floatframe
