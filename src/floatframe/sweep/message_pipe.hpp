#pragma once
// Messages between two processes over a stream socket: a letter for the kind, the length, the
// bytes.
#include <string>
#include <string_view>

namespace floatframe {

struct PipeMessage {
  char kind = 0;
  std::string text;
};

/// Two connected sockets, not inherited by programs started later; descriptors from 3. Returns 0 or
/// the system's error number.
int open_pipe(int& one, int& other);

/// Sends all of it; false if the other end is closed.
bool send_message(int socket, char kind, std::string_view text);

/// Assembles a message that arrives in pieces.
class MessageReader {
 public:
  enum class State { incomplete, complete, closed };
  /// Reads the available bytes without blocking. `complete`: `message` was set; `closed`: the other
  /// end is closed, or the bytes are not a message.
  State read(int socket, PipeMessage& message);
  /// Waits for a whole message; false if the other end is closed.
  bool wait(int socket, PipeMessage& message);

 private:
  std::string bytes_;
};

}  // namespace floatframe
