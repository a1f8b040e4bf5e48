#pragma once
// The network address of a peer: host and port, IPv4 or IPv6.
#include <sys/socket.h>

#include <cstdint>
#include <string>

namespace floatframe {

/// An address with a port, as a socket address.
struct UdpAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;  ///< 0: no address
  bool known() const noexcept { return size > 0; }
  int family() const noexcept { return storage.ss_family; }
  /// In host byte order; 0: any.
  std::uint16_t port() const noexcept;
  void set_port(std::uint16_t port) noexcept;
  /// "127.0.0.1:47100", "[::1]:47100"; if the port is 0, "127.0.0.1", "[::1]".
  std::string text() const;
  /// The same host, with any port. An IPv4 address equals its IPv4-mapped IPv6 address
  /// (::ffff:127.0.0.1), which a dual-stack socket reports.
  bool same_host(const UdpAddress& other) const noexcept;
};

/// "host:port", "[IPv6 address]:port". `option` names it in messages. Throws InputError if it has
/// another form, or the host is unknown.
UdpAddress parse_udp_address(const std::string& text, const std::string& option);

/// The same, or a host without a port: then the port is 0.
UdpAddress parse_udp_peer(const std::string& text, const std::string& option);

/// The local address from which packets to `to` are sent, with port 0. Throws InputError if there
/// is no route; `option` names `to` in the message.
UdpAddress local_address_towards(const UdpAddress& to, const std::string& option);

}  // namespace floatframe
