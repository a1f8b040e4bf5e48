#pragma once
// A non-blocking UDP socket, IPv4 or IPv6. Construction may throw and allocate; sending and
// receiving never do.
#include <cstddef>
#include <span>

#include "floatframe/realtime/udp_address.hpp"

namespace floatframe {

class UdpSocket {
 public:
  /// Bound to `local`; port 0: the system chooses one. Throws RunError if it is in use.
  explicit UdpSocket(const UdpAddress& local);
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// The address it is bound to.
  UdpAddress local() const;

  /// Length of the next packet, even if it exceeds `out`, which then contains its beginning; -1:
  /// there is none. `from`: the sender.
  long receive(std::span<std::byte> out, UdpAddress& from) noexcept;
  long receive(std::span<std::byte> out) noexcept;

  /// 0, or the system's error number.
  int send(const UdpAddress& to, std::span<const std::byte> bytes) noexcept;

  /// Waits for a packet, at most the given time. False: none arrived, or a signal did.
  bool wait(double seconds) noexcept;

 private:
  int descriptor_ = -1;
};

}  // namespace floatframe
