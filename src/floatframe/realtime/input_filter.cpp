#include "floatframe/realtime/input_filter.hpp"

#include <algorithm>

namespace floatframe {

InputFilter::InputFilter(std::size_t count, std::uint64_t layout, bool lock_step,
                         const UdpAddress& peer)
    : layout_(layout), lock_step_(lock_step), peer_(peer), scratch_(count), newest_(count) {}

bool InputFilter::accepts(const UdpAddress& from) const noexcept {
  if (!peer_.known()) return true;
  return peer_.same_host(from) && (peer_.port() == 0 || peer_.port() == from.port());
}

void InputFilter::count_other(const UdpAddress& from) noexcept {
  ++counts_.other;
  for (std::size_t i = 0; i < listed_; ++i)
    if (others_[i].address.same_host(from) && others_[i].address.port() == from.port()) {
      ++others_[i].packets;
      return;
    }
  if (listed_ < most_senders) others_[listed_++] = {from, 1};
}

void InputFilter::take(std::span<const std::byte> bytes, std::size_t length,
                       const UdpAddress& from) noexcept {
  ++counts_.received;
  if (!accepts(from)) {
    count_other(from);
    return;
  }
  PacketHeader header;
  // A packet longer than expected was truncated: its header still identifies the protocol.
  PacketError error = decode_packet(bytes, PacketKind::inputs, layout_, header, scratch_);
  if (error == PacketError::none && length > bytes.size()) error = PacketError::layout;
  if (error == PacketError::foreign) {
    ++counts_.foreign;
    return;
  }
  if (error == PacketError::layout) {
    ++counts_.mismatched;
    return;
  }
  if (!peer_.known()) peer_ = from;
  if (lock_step_ ? header.sequence != last_sent_
                 : header.sequence != 0 && header.sequence < newest_sequence_) {
    ++counts_.stale;
    return;
  }
  if (fresh_) ++counts_.superseded;
  newest_.swap(scratch_);
  if (header.sequence != 0) {
    newest_sequence_ = std::min(header.sequence, last_sent_);
    const auto age = static_cast<long>(last_sent_ - newest_sequence_);
    counts_.largest_age = std::max(counts_.largest_age, age);
  }
  fresh_ = true;
}

std::span<const double> InputFilter::hand_over() noexcept {
  fresh_ = false;
  ++counts_.used;
  return newest_;
}

}  // namespace floatframe
