#include "floatframe/sweep/message_pipe.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace floatframe {
namespace {

constexpr std::size_t head_size = 1 + sizeof(std::uint64_t);
/// A corrupted process may send anything.
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 32;

bool send_all(int socket, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = ::send(socket, data, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    data += n;
    size -= n;
  }
  return true;
}

/// A descriptor from 3: standard descriptors keep their meaning if the program has none.
int raised(int file) {
  if (file > 2) return file;
  const int higher = ::fcntl(file, F_DUPFD_CLOEXEC, 3);
  ::close(file);
  return higher;
}

}  // namespace

int open_pipe(int& one, int& other) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return errno;
  one = raised(ends[0]);
  other = raised(ends[1]);
  return one < 0 || other < 0 ? EMFILE : 0;
}

bool send_message(int socket, char kind, std::string_view text) {
  const std::uint64_t size = text.size();
  std::string head(head_size, kind);
  std::memcpy(head.data() + 1, &size, sizeof size);
  if (text.size() < 4096) {  // in a single call
    head += text;
    return send_all(socket, head.data(), head.size());
  }
  return send_all(socket, head.data(), head.size()) && send_all(socket, text.data(), text.size());
}

MessageReader::State MessageReader::read(int socket, PipeMessage& message) {
  while (true) {
    std::uint64_t size = 0;
    std::size_t missing = head_size;
    if (bytes_.size() >= head_size) {
      std::memcpy(&size, bytes_.data() + 1, sizeof size);
      if (size > most_bytes) return State::closed;
      missing = head_size + size;
    }
    missing -= std::min(missing, bytes_.size());
    if (missing == 0) {
      message.kind = bytes_.front();
      message.text = bytes_.substr(head_size);
      bytes_.clear();
      return State::complete;
    }
    char piece[65536];
    const ssize_t n = ::recv(socket, piece, std::min(missing, sizeof piece), MSG_DONTWAIT);
    if (n > 0) {
      bytes_.append(piece, n);
    } else if (n == 0) {
      return State::closed;
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return State::incomplete;
    } else if (errno != EINTR) {
      return State::closed;
    }
  }
}

bool MessageReader::wait(int socket, PipeMessage& message) {
  while (true) {
    const State state = read(socket, message);
    if (state != State::incomplete) return state == State::complete;
    pollfd ready{socket, POLLIN, 0};
    ::poll(&ready, 1, -1);
  }
}

}  // namespace floatframe
