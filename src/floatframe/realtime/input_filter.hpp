#pragma once
// Decides which received packets are inputs of the model, and counts all others. Pure logic without
// a socket, so that it can be tested and fuzzed.
//
// Packets are accepted from a single address, the *peer*: the one given, or the sender of the first
// valid packet. A packet from any other sender is counted per sender and not decoded.
//
// Free running: the newest of all valid packets since the last step is used. In lock step only the
// answer to the last outputs is used.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "floatframe/realtime/packet.hpp"
#include "floatframe/realtime/udp_address.hpp"

namespace floatframe {

/// Counts of received packets; every packet is in one of the six numbers below `received`.
struct InputCounts {
  long received = 0;
  long used = 0;         ///< passed to the model
  long superseded = 0;   ///< valid, but a newer one arrived before the step
  long stale = 0;        ///< answers older outputs than a packet already used
  long foreign = 0;      ///< not a packet of inputs in this protocol and version
  long mismatched = 0;   ///< another layout: hash, count or length
  long other = 0;        ///< from a sender other than the peer
  long largest_age = 0;  ///< steps between outputs and the inputs answering them
};

/// A sender that is not the peer.
struct OtherSender {
  UdpAddress address;
  long packets = 0;
};

class InputFilter {
 public:
  /// Number of senders listed by address; packets of others count in `InputCounts::other` only.
  static constexpr std::size_t most_senders = 8;

  /// `count` values in packets of the layout `layout`. `peer`: the accepted sender, with any port
  /// if its port is 0; without an address, the sender of the first valid packet.
  InputFilter(std::size_t count, std::uint64_t layout, bool lock_step, const UdpAddress& peer);

  /// A packet of `length` bytes; `bytes` are the first ones (all, if it is not too long).
  void take(std::span<const std::byte> bytes, std::size_t length, const UdpAddress& from) noexcept;

  /// True if there are inputs that were not yet passed to the model.
  bool fresh() const noexcept { return fresh_; }
  /// The inputs to use; resets `fresh`.
  std::span<const double> hand_over() noexcept;
  /// The outputs of step `step` have been sent: inputs can answer these at the latest.
  void outputs_sent(std::uint64_t step) noexcept { last_sent_ = step; }

  const InputCounts& counts() const noexcept { return counts_; }
  /// No address: none was given and no packet accepted yet.
  const UdpAddress& peer() const noexcept { return peer_; }
  std::span<const OtherSender> others() const noexcept { return std::span(others_).first(listed_); }

 private:
  bool accepts(const UdpAddress& from) const noexcept;
  void count_other(const UdpAddress& from) noexcept;

  std::uint64_t layout_;
  bool lock_step_;
  UdpAddress peer_;
  std::vector<double> scratch_, newest_;
  bool fresh_ = false;
  std::uint64_t newest_sequence_ = 0, last_sent_ = 0;
  InputCounts counts_;
  std::array<OtherSender, most_senders> others_{};
  std::size_t listed_ = 0;
};

}  // namespace floatframe
