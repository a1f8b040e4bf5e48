#pragma once
// Packets of a controller, as they come from the network: any bytes, of any length, from anybody.
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/realtime/input_buffer.hpp"
#include "floatframe/realtime/input_filter.hpp"

namespace floatframe::fuzz {

inline void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// Two inputs, one of them clamped, and the layout 0x4141414141414141, which is easy to hit.
inline Model two_inputs() {
  Model model;
  model.inputs.push_back({"a", "N", 0.5, -10.0, 10.0, true});
  model.inputs.push_back({"b", "m", 0.0, -1.0, 1.0, false});
  return model;
}

/// The first byte: lock step or not, a named peer or not. Then packets: one byte for the sender and
/// what happens before it (hand over, outputs sent), two for the length, and that many bytes.
inline void udp(std::string_view bytes) {
  const auto next = [&bytes]() -> unsigned {
    if (bytes.empty()) return 0;
    const auto c = static_cast<unsigned char>(bytes.front());
    bytes.remove_prefix(1);
    return c;
  };
  static const Model model = two_inputs();
  static const UdpAddress host = parse_udp_address("127.0.0.1:1000", "fuzz");
  const unsigned mode = next();
  const std::size_t room = packet_size(model.inputs.size());
  InputFilter filter(model.inputs.size(), 0x4141414141414141, (mode & 1) != 0,
                     (mode & 2) != 0 ? host : UdpAddress{});
  InputBuffer inputs(model);
  std::uint64_t step = 0;
  while (!bytes.empty()) {
    const unsigned control = next();
    std::size_t length = next();
    length |= std::size_t{next()} << 8;
    const std::string_view packet = bytes.substr(0, std::min(length, bytes.size()));
    bytes.remove_prefix(packet.size());
    UdpAddress from = host;
    from.set_port(static_cast<std::uint16_t>(1000 + (control & 15)));
    if ((control & 16) != 0) filter.outputs_sent(step++);
    // As the socket hands it over: no more bytes than there is room for, and the length it had.
    std::vector<std::byte> held(std::min(packet.size(), room));
    for (std::size_t i = 0; i < held.size(); ++i) held[i] = static_cast<std::byte>(packet[i]);
    filter.take(held, packet.size(), from);
    if ((control & 32) != 0 && filter.fresh()) inputs.accept(filter.hand_over());
    for (std::size_t i = 0; i < inputs.size(); ++i)
      require(std::abs(inputs.values()[i]) <= model.inputs[i].high, "an input beyond its limits");
  }
  const InputCounts& c = filter.counts();
  require(c.used + c.superseded + c.stale + c.foreign + c.mismatched + c.other +
                  (filter.fresh() ? 1 : 0) ==
              c.received,
          "a packet that is not counted once");
  long listed = 0;
  for (const OtherSender& other : filter.others()) listed += other.packets;
  require(listed <= c.other && c.largest_age >= 0, "senders or ages that cannot be");
}

}  // namespace floatframe::fuzz
