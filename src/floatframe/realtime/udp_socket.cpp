#include "floatframe/realtime/udp_socket.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {
namespace {

const sockaddr* generic(const UdpAddress& a) noexcept {
  return reinterpret_cast<const sockaddr*>(&a.storage);
}
const sockaddr_in* ipv4(const UdpAddress& a) noexcept {
  return reinterpret_cast<const sockaddr_in*>(&a.storage);
}
const sockaddr_in6* ipv6(const UdpAddress& a) noexcept {
  return reinterpret_cast<const sockaddr_in6*>(&a.storage);
}

bool is_port(const std::string& text) {
  if (text.empty() || text.size() > 5) return false;
  for (const char c : text)
    if (c < '0' || c > '9') return false;
  return std::stol(text) <= 65535;
}

}  // namespace

std::string UdpAddress::text() const {
  char host[INET6_ADDRSTRLEN] = "?";
  if (family() == AF_INET6) {
    inet_ntop(AF_INET6, &ipv6(*this)->sin6_addr, host, sizeof host);
    return fmt::format("[{}]:{}", host, ntohs(ipv6(*this)->sin6_port));
  }
  inet_ntop(AF_INET, &ipv4(*this)->sin_addr, host, sizeof host);
  return fmt::format("{}:{}", host, ntohs(ipv4(*this)->sin_port));
}

bool UdpAddress::loopback() const noexcept {
  if (family() == AF_INET6) return IN6_IS_ADDR_LOOPBACK(&ipv6(*this)->sin6_addr);
  return (ntohl(ipv4(*this)->sin_addr.s_addr) >> 24) == 127;
}

UdpAddress parse_udp_address(const std::string& text, const std::string& option) {
  const std::size_t colon = text.rfind(':');
  std::string host = colon == std::string::npos ? "" : text.substr(0, colon);
  const std::string port = colon == std::string::npos ? "" : text.substr(colon + 1);
  const bool brackets = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (brackets) host = host.substr(1, host.size() - 2);
  if (host.empty() || !is_port(port) || (!brackets && host.find(':') != std::string::npos)) {
    throw InputError(fmt::format("{}: found '{}', expected HOST:PORT, for example 127.0.0.1:47100",
                                 option, text));
  }
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int fault = getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
  if (fault != 0) {
    throw InputError(fmt::format("{}: found the host '{}', expected one that is known ({})", option,
                                 host, gai_strerror(fault)));
  }
  UdpAddress address;
  std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
  address.size = found->ai_addrlen;
  freeaddrinfo(found);
  return address;
}

UdpSocket::UdpSocket(const UdpAddress& local) {
  descriptor_ = socket(local.family(), SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor_ < 0 || bind(descriptor_, generic(local), local.size) != 0) {
    const int fault = errno;
    if (descriptor_ >= 0) close(descriptor_);
    throw RunError(fmt::format("UDP packets cannot be received at {}: {}", local.text(),
                               std::strerror(fault)));
  }
}

UdpSocket::~UdpSocket() { close(descriptor_); }

UdpAddress UdpSocket::local() const {
  UdpAddress address;
  address.size = sizeof address.storage;
  getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address.storage), &address.size);
  return address;
}

long UdpSocket::receive(std::span<std::byte> out) noexcept {
  // An ICMP answer to an earlier packet ("port unreachable") may be reported here once.
  for (int attempt = 0; attempt < 4; ++attempt) {
    const ssize_t n = recv(descriptor_, out.data(), out.size(), MSG_TRUNC);
    if (n >= 0) return n;
    if (errno == EAGAIN || errno == EWOULDBLOCK) return -1;
  }
  return -1;
}

int UdpSocket::send(const UdpAddress& to, std::span<const std::byte> bytes) noexcept {
  const ssize_t n = sendto(descriptor_, bytes.data(), bytes.size(), 0, generic(to), to.size);
  return n < 0 ? errno : 0;
}

bool UdpSocket::wait(double seconds) noexcept {
  pollfd p{descriptor_, POLLIN, 0};
  return poll(&p, 1, static_cast<int>(1e3 * seconds)) > 0;
}

}  // namespace floatframe
