#pragma once
// The address of a partner in the network: host and port, IPv4 or IPv6.
#include <sys/socket.h>

#include <cstdint>
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

}  // namespace floatframe
