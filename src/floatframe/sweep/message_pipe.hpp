#pragma once
// Texts between two processes over a stream socket: a letter that says what it is, the length, the
// bytes.
#include <string>
#include <string_view>

namespace floatframe {

struct PipeMessage {
  char kind = 0;
  std::string text;
};

/// Two sockets that are connected and that programs started later do not inherit; numbers from 3.
/// Returns 0 or the system's error number.
int open_pipe(int& one, int& other);

/// Sends all of it; false if nobody is at the other end any more.
bool send_message(int socket, char kind, std::string_view text);

/// Puts together a message that arrives in pieces.
class MessageReader {
 public:
  enum class State { incomplete, complete, closed };
  /// Takes what has arrived and does not wait. `complete`: `message` was set; `closed`: the other
  /// end is gone, or what it sent is no message.
  State read(int socket, PipeMessage& message);
  /// Waits for a whole message; false if the other end is gone.
  bool wait(int socket, PipeMessage& message);

 private:
  std::string bytes_;
};

}  // namespace floatframe
