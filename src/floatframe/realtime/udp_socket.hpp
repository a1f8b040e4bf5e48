#pragma once
// A non-blocking UDP socket, IPv4 or IPv6. Making one may throw and allocate; sending and receiving
// never do.
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstddef>
#include <span>
#include <string>

namespace floatframe {

/// An address with a port, as the system wants it.
struct UdpAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
  int family() const noexcept { return storage.ss_family; }
  /// "127.0.0.1:47100", "[::1]:47100"
  std::string text() const;
  bool loopback() const noexcept;
};

/// "host:port", "[IPv6 address]:port". `option` names it in messages. Throws InputError if it is
/// not of that form, or the host is unknown.
UdpAddress parse_udp_address(const std::string& text, const std::string& option);

class UdpSocket {
 public:
  /// Bound to `local`; port 0: the system chooses one. Throws RunError if it is taken.
  explicit UdpSocket(const UdpAddress& local);
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// The address it is bound to.
  UdpAddress local() const;

  /// Length of the next packet, even if it is longer than `out`, which then holds its beginning;
  /// -1: there is none.
  long receive(std::span<std::byte> out) noexcept;

  /// 0, or the system's error number.
  int send(const UdpAddress& to, std::span<const std::byte> bytes) noexcept;

  /// Waits until there is a packet, at most so long. False: none came, or a signal did.
  bool wait(double seconds) noexcept;

 private:
  int descriptor_ = -1;
};

}  // namespace floatframe
