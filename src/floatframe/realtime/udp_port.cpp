#include "floatframe/realtime/udp_port.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/realtime/clocks.hpp"

namespace floatframe {
namespace {

/// Packets looked at in one step at most: a flood must not stop the model.
constexpr int most_packets = 256;

}  // namespace

UdpPort::UdpPort(const Model& model, const UdpPortOptions& options)
    : options_(options), socket_(options.listen) {
  const SignalLayout inputs = input_layout(model), outputs = output_layout(model);
  for (const auto* layout : {&inputs, &outputs})
    if (layout->signals.size() > largest_count)
      throw InputError(fmt::format("the model has {} {}, a UDP packet carries at most {}",
                                   layout->signals.size(), layout == &inputs ? "inputs" : "outputs",
                                   largest_count));
  input_hash_ = inputs.hash();
  output_hash_ = outputs.hash();
  scratch_.resize(inputs.signals.size());
  newest_.resize(inputs.signals.size());
  incoming_.resize(packet_size(inputs.signals.size()));
  outgoing_.resize(packet_size(outputs.signals.size()));
}

bool UdpPort::drain() noexcept {
  for (int k = 0; k < most_packets; ++k) {
    const long n = socket_.receive(incoming_);
    if (n < 0) break;
    ++counts_.received;
    const auto length = static_cast<std::size_t>(n);
    PacketHeader header;
    // A packet longer than expected was cut: its header still tells whether it is one of ours.
    PacketFault fault =
        decode_packet(std::span(incoming_).first(std::min(length, incoming_.size())),
                      PacketKind::inputs, input_hash_, header, scratch_);
    if (fault == PacketFault::none && length > incoming_.size()) fault = PacketFault::layout;
    if (fault == PacketFault::foreign) {
      ++counts_.foreign;
    } else if (fault == PacketFault::layout) {
      ++counts_.mismatched;
    } else if (options_.lock_step ? header.sequence != last_sent_
                                  : header.sequence != 0 && header.sequence < newest_sequence_) {
      ++counts_.stale;
    } else {
      if (fresh_) ++counts_.superseded;
      newest_.swap(scratch_);
      if (header.sequence != 0) {
        newest_sequence_ = std::min(header.sequence, last_sent_);
        counts_.largest_age =
            std::max(counts_.largest_age, static_cast<long>(last_sent_ - newest_sequence_));
      }
      fresh_ = true;
    }
  }
  return fresh_;
}

bool UdpPort::wait() noexcept {
  if (!options_.lock_step) return true;
  const Nanoseconds until = wall_clock() + static_cast<Nanoseconds>(1e9 * options_.timeout);
  constexpr Nanoseconds resend_after = 100'000'000;
  Nanoseconds resend = wall_clock() + resend_after;
  while (!drain()) {
    const Nanoseconds now = wall_clock();
    if (stopped()) return true;  // the runner sees it too
    if (now >= until) return false;
    if (now >= resend) {
      transmit();
      ++counts_.repeated;
      resend = now + resend_after;
    }
    socket_.wait(1e-9 * static_cast<double>(std::min(resend, until) - now) + 1e-3);
  }
  return true;
}

bool UdpPort::receive(InputBuffer& inputs) noexcept {
  if (!options_.inputs || !(options_.lock_step ? fresh_ : drain())) return false;
  inputs.accept(newest_);
  fresh_ = false;
  ++counts_.used;
  return true;
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
  last_sent_ = step;
  transmit();
}

void UdpPort::transmit() noexcept {
  const int fault = socket_.send(options_.send, outgoing_);
  ++(fault == 0 ? counts_.sent : counts_.send_errors);
  if (fault != 0) send_error_ = fault;
}

}  // namespace floatframe
