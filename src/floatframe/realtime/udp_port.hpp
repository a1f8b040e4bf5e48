#pragma once
// Inputs and outputs of a paced model as UDP packets (packet.hpp), through one socket, so that a
// controller can simply reply to the source address of the outputs.
//
// Free running: the newest of all packets received since the last step is used; nothing ever waits.
// In lock step the model waits before each step for the inputs that answer its last outputs, and
// repeats these every 0.1 s: either side may be started first, lost packets are sent again, and a
// run with a deterministic controller gives the same results each time.
//
// input_filter.hpp decides which packets are inputs, and from which sender.
#include <atomic>
#include <vector>

#include "floatframe/realtime/input_filter.hpp"
#include "floatframe/realtime/packet.hpp"
#include "floatframe/realtime/signal_port.hpp"
#include "floatframe/realtime/udp_socket.hpp"

namespace floatframe {

struct UdpPortOptions {
  bool inputs = false, outputs = false;
  UdpAddress listen;  ///< local address for inputs
  UdpAddress send;    ///< destination of outputs
  /// The only accepted sender; port 0: any port. Without an address: the sender of the first valid
  /// packet.
  UdpAddress peer;
  bool lock_step = false;
  double timeout = 5.0;  ///< lock step: longest wait for the inputs of a step [s]
  const std::atomic<bool>* stop = nullptr;  ///< ends a wait
};

/// Numbers of packets received and sent.
struct UdpCounts : InputCounts {
  long sent = 0, send_errors = 0, repeated = 0;
};

class UdpPort final : public SignalPort {
 public:
  /// Throws RunError if the address is in use, InputError if the packets would be too large.
  UdpPort(const Model& model, const UdpPortOptions& options);

  bool wait() noexcept override;
  bool receive(InputBuffer& inputs) noexcept override;
  void send(std::uint64_t step, double time, std::span<const double> outputs,
            bool last) noexcept override;
  bool wants_outputs() const noexcept override { return options_.outputs; }
  bool gives_inputs() const noexcept override { return options_.inputs; }

  UdpCounts counts() const noexcept;
  /// The accepted sender; without an address if none was given and no packet accepted yet.
  const UdpAddress& peer() const noexcept { return filter_.peer(); }
  /// The first other senders of packets.
  std::span<const OtherSender> other_senders() const noexcept { return filter_.others(); }
  UdpAddress local() const { return socket_.local(); }
  /// The system's error for the last packet that could not be sent; 0: none.
  int send_error() const noexcept { return send_error_; }

 private:
  /// Reads all pending packets; true if there are inputs to use.
  bool drain() noexcept;
  bool stopped() const noexcept {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }
  void transmit() noexcept;

  UdpPortOptions options_;
  UdpSocket socket_;
  InputFilter filter_;
  std::uint64_t output_hash_ = 0;
  std::vector<std::byte> incoming_, outgoing_;
  int send_error_ = 0;
  long sent_ = 0, send_errors_ = 0, repeated_ = 0;
};

}  // namespace floatframe
