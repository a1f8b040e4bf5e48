#pragma once
// A non-blocking UDP socket, IPv4 or IPv6, and the addresses of partners in the network: host and
// port. Making one may throw and allocate; sending and receiving never do.
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace floatframe {

/// An address with a port, as the system wants it.
struct UdpAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;  ///< 0: no address
  bool known() const noexcept { return size > 0; }
  int family() const noexcept { return storage.ss_family; }
  /// In the byte order of this machine; 0: any.
  std::uint16_t port() const noexcept;
  void set_port(std::uint16_t port) noexcept;
  /// "127.0.0.1:47100", "[::1]:47100"; without a port of its own "127.0.0.1", "[::1]".
  std::string text() const;
  /// The same host, whatever the ports. An IPv4 address is the same as its form within IPv6
  /// (::ffff:127.0.0.1), in which a socket of both kinds shows it.
  bool same_host(const UdpAddress& other) const noexcept;
};

/// "host:port", "[IPv6 address]:port". `option` names it in messages. Throws InputError if it is
/// not of that form, or the host is unknown.
UdpAddress parse_udp_address(const std::string& text, const std::string& option);

/// The same, or a host alone: then the port is 0.
UdpAddress parse_udp_peer(const std::string& text, const std::string& option);

/// The address of this machine from which packets go to `to`, with port 0. Throws InputError if
/// there is no way; `option` names `to` in the message.
UdpAddress local_address_towards(const UdpAddress& to, const std::string& option);

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
  /// -1: there is none. `from`: who sent it.
  long receive(std::span<std::byte> out, UdpAddress& from) noexcept;
  long receive(std::span<std::byte> out) noexcept;

  /// 0, or the system's error number.
  int send(const UdpAddress& to, std::span<const std::byte> bytes) noexcept;

  /// Waits until there is a packet, at most so long. False: none came, or a signal did.
  bool wait(double seconds) noexcept;

 private:
  int descriptor_ = -1;
};

}  // namespace floatframe
