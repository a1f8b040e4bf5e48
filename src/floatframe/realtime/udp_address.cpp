#include "floatframe/realtime/udp_address.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

const sockaddr_in* ipv4(const UdpAddress& a) noexcept {
  return reinterpret_cast<const sockaddr_in*>(&a.storage);
}
const sockaddr_in6* ipv6(const UdpAddress& a) noexcept {
  return reinterpret_cast<const sockaddr_in6*>(&a.storage);
}

/// 16 bytes, IPv4 as an IPv4-mapped IPv6 address.
std::array<unsigned char, 16> host_bytes(const UdpAddress& a) noexcept {
  std::array<unsigned char, 16> bytes{};
  if (a.family() == AF_INET6) {
    std::memcpy(bytes.data(), &ipv6(a)->sin6_addr, 16);
  } else {
    bytes[10] = bytes[11] = 0xff;
    std::memcpy(bytes.data() + 12, &ipv4(a)->sin_addr, 4);
  }
  return bytes;
}

bool is_port(const std::string& text) {
  if (text.empty() || text.size() > 5) return false;
  for (const char c : text)
    if (c < '0' || c > '9') return false;
  return std::stol(text) <= 65535;
}

UdpAddress resolve(const std::string& host, const std::string& port, const std::string& option) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (error != 0)
    throw InputError(ErrorCode::unreadable,
                     fmt::format("{}: found the host '{}', expected one that is known ({})", option,
                                 host, gai_strerror(error)));
  UdpAddress address;
  std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
  address.size = found->ai_addrlen;
  freeaddrinfo(found);
  return address;
}

/// Splits "HOST:PORT" or "[HOST]:PORT"; false for any other form.
bool split(const std::string& text, std::string& host, std::string& port) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return false;
  host = text.substr(0, colon);
  port = text.substr(colon + 1);
  const bool brackets = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (brackets) host = host.substr(1, host.size() - 2);
  return !host.empty() && is_port(port) && (brackets || host.find(':') == std::string::npos);
}

}  // namespace

std::uint16_t UdpAddress::port() const noexcept {
  return ntohs(family() == AF_INET6 ? ipv6(*this)->sin6_port : ipv4(*this)->sin_port);
}

void UdpAddress::set_port(std::uint16_t port) noexcept {
  if (family() == AF_INET6)
    reinterpret_cast<sockaddr_in6*>(&storage)->sin6_port = htons(port);
  else
    reinterpret_cast<sockaddr_in*>(&storage)->sin_port = htons(port);
}

std::string UdpAddress::text() const {
  char host[INET6_ADDRSTRLEN] = "?";
  const bool long_form = family() == AF_INET6;
  if (long_form)
    inet_ntop(AF_INET6, &ipv6(*this)->sin6_addr, host, sizeof host);
  else
    inet_ntop(AF_INET, &ipv4(*this)->sin_addr, host, sizeof host);
  const std::string shown = long_form ? fmt::format("[{}]", host) : std::string(host);
  return port() == 0 ? shown : fmt::format("{}:{}", shown, port());
}

bool UdpAddress::same_host(const UdpAddress& other) const noexcept {
  return known() && other.known() && host_bytes(*this) == host_bytes(other);
}

UdpAddress parse_udp_address(const std::string& text, const std::string& option) {
  std::string host, port;
  if (!split(text, host, port))
    throw InputError(ErrorCode::wrong_value,
                     fmt::format("{}: found '{}', expected HOST:PORT, for example 127.0.0.1:47100",
                                 option, text));
  return resolve(host, port, option);
}

UdpAddress parse_udp_peer(const std::string& text, const std::string& option) {
  std::string host, port;
  // A host without a port is valid if it is valid with a port appended.
  if (!split(text, host, port) && !split(text + ":0", host, port))
    throw InputError(
        ErrorCode::wrong_value,
        fmt::format("{}: found '{}', expected HOST or HOST:PORT, for example 127.0.0.1:47101",
                    option, text));
  return resolve(host, port, option);
}

UdpAddress local_address_towards(const UdpAddress& to, const std::string& option) {
  UdpAddress local;
  local.size = sizeof local.storage;
  // Connecting a UDP socket sends nothing: the system only selects the route.
  const int probe = socket(to.family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool found =
      probe >= 0 && connect(probe, reinterpret_cast<const sockaddr*>(&to.storage), to.size) == 0 &&
      getsockname(probe, reinterpret_cast<sockaddr*>(&local.storage), &local.size) == 0;
  const int error = errno;
  if (probe >= 0) close(probe);
  if (!found)
    throw InputError(
        ErrorCode::unreadable,
        fmt::format("{}: found no way to {} ({}); --listen names an address of this machine",
                    option, to.text(), std::strerror(error)));
  local.set_port(0);
  return local;
}

}  // namespace floatframe
