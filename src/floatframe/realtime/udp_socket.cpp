#include "floatframe/realtime/udp_socket.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

const sockaddr* generic(const UdpAddress& a) noexcept {
  return reinterpret_cast<const sockaddr*>(&a.storage);
}
}  // namespace

UdpSocket::UdpSocket(const UdpAddress& local) {
  descriptor_ = socket(local.family(), SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor_ < 0 || bind(descriptor_, generic(local), local.size) != 0) {
    const int error = errno;
    if (descriptor_ >= 0) close(descriptor_);
    throw RunError(ErrorCode::in_use, fmt::format("UDP packets cannot be received at {}: {}",
                                                  local.text(), std::strerror(error)));
  }
}

UdpSocket::~UdpSocket() { close(descriptor_); }

UdpAddress UdpSocket::local() const {
  UdpAddress address;
  address.size = sizeof address.storage;
  getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address.storage), &address.size);
  return address;
}

long UdpSocket::receive(std::span<std::byte> out, UdpAddress& from) noexcept {
  // An ICMP answer to an earlier packet ("port unreachable") may be reported here once.
  for (int attempt = 0; attempt < 4; ++attempt) {
    from.size = sizeof from.storage;
    const ssize_t n = recvfrom(descriptor_, out.data(), out.size(), MSG_TRUNC,
                               reinterpret_cast<sockaddr*>(&from.storage), &from.size);
    if (n >= 0) return n;
    if (errno == EAGAIN || errno == EWOULDBLOCK) return -1;
  }
  return -1;
}

long UdpSocket::receive(std::span<std::byte> out) noexcept {
  UdpAddress any_sender;
  return receive(out, any_sender);
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
