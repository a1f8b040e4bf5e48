#include "floatframe/realtime/udp_port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/realtime/clocks.hpp"
#include "floatframe/realtime/realtime_options.hpp"
#include "floatframe/realtime/realtime_rules.hpp"

namespace floatframe {
namespace {

/// Limit of packets read in one step: a flood must not stop the model.
constexpr int most_packets = 256;

}  // namespace

UdpPort::UdpPort(const Model& model, const UdpPortOptions& options)
    : options_(options),
      socket_(options.listen),
      filter_(model.inputs.size(), input_layout(model).hash(), options.lock_step, options.peer),
      output_hash_(output_layout(model).hash()) {
  if (const auto complaint = realtime_rules::timeout.complaint(options.timeout))
    throw InputError(ErrorCode::out_of_range, "timeout: " + *complaint);
  const std::size_t inputs = model.inputs.size(), outputs = model.outputs.size();
  for (const auto& [count, what] : {std::pair(inputs, "inputs"), std::pair(outputs, "outputs")})
    if (count > largest_count)
      throw InputError(ErrorCode::out_of_range,
                       fmt::format("the model has {} {}, a UDP packet carries at most {}", count,
                                   what, largest_count));
  incoming_.resize(packet_size(inputs));
  outgoing_.resize(packet_size(outputs));
}

UdpCounts UdpPort::counts() const noexcept {
  UdpCounts counts;
  static_cast<InputCounts&>(counts) = filter_.counts();
  counts.sent = sent_;
  counts.send_errors = send_errors_;
  counts.repeated = repeated_;
  return counts;
}

bool UdpPort::drain() noexcept {
  UdpAddress from;
  for (int k = 0; k < most_packets; ++k) {
    const long n = socket_.receive(incoming_, from);
    if (n < 0) break;
    const std::size_t length = n;
    filter_.take(std::span(incoming_).first(std::min(length, incoming_.size())), length, from);
  }
  return filter_.fresh();
}

bool UdpPort::wait() noexcept {
  if (!options_.lock_step) return true;
  const Nanoseconds until = wall_clock() + static_cast<Nanoseconds>(1e9 * options_.timeout);
  constexpr Nanoseconds resend_after = 100'000'000;
  Nanoseconds resend = wall_clock() + resend_after;
  while (!drain()) {
    const Nanoseconds now = wall_clock();
    if (stopped()) return true;  // the runner checks it too
    if (now >= until) return false;
    if (now >= resend) {
      transmit();
      ++repeated_;
      resend = now + resend_after;
    }
    socket_.wait(1e-9 * static_cast<double>(std::min(resend, until) - now) + 1e-3);
  }
  return true;
}

bool UdpPort::receive(InputBuffer& inputs) noexcept {
  if (!options_.inputs || !(options_.lock_step ? filter_.fresh() : drain())) return false;
  return inputs.accept(filter_.hand_over());
}

void UdpPort::send(std::uint64_t step, double time, std::span<const double> outputs,
                   bool last) noexcept {
  if (!options_.outputs) return;
  PacketHeader header;
  header.layout = output_hash_;
  header.sequence = step;
  header.time = time;
  header.flags = last ? last_packet_flag : 0;
  encode_packet(header, outputs, outgoing_);
  filter_.outputs_sent(step);
  transmit();
}

void UdpPort::transmit() noexcept {
  const int error = socket_.send(options_.send, outgoing_);
  ++(error == 0 ? sent_ : send_errors_);
  if (error != 0) send_error_ = error;
}

}  // namespace floatframe
