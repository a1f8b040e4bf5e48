#include "floatframe/core/atomic_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "floatframe/core/code_points.hpp"
#include "floatframe/core/output_place.hpp"
#include "floatframe/core/printable.hpp"

namespace floatframe {
namespace {

/// Blocks the signals that end a program; they are delivered on destruction.
class SignalHold {
 public:
  SignalHold() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) sigaddset(&set, signal);
    pthread_sigmask(SIG_BLOCK, &set, &before_);
  }
  ~SignalHold() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalHold(const SignalHold&) = delete;
  SignalHold& operator=(const SignalHold&) = delete;

 private:
  sigset_t before_;
};

std::string cannot(const std::string& kind, const std::string& path, int error) {
  return kind + " '" + path + "' cannot be written: " + std::strerror(error);
}

/// A different name for every process and every call: threads may write the same file.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> calls = 0;
  return path + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(calls++);
}

/// Files that are not regular are written in place where that can neither block forever nor destroy
/// a file system: a terminal, a null device, an open file of this process.
enum class WriteMode { replaced, in_place };

WriteMode write_mode(const std::string& name, const OutputPlace& place) {
  if (place.descriptor >= 0) return WriteMode::in_place;
  struct stat status {};
  if (::stat(place.path.c_str(), &status) != 0)
    return place.is_open ? WriteMode::in_place : WriteMode::replaced;
  if (S_ISDIR(status.st_mode)) throw OutputError(cannot("the file", name, EISDIR));
  if (S_ISREG(status.st_mode)) return place.is_open ? WriteMode::in_place : WriteMode::replaced;
  if (!S_ISCHR(status.st_mode) && !place.is_open)
    throw OutputError("the file '" + name + "' cannot be written: this is a " +
                      (S_ISFIFO(status.st_mode)  ? "named pipe"
                       : S_ISBLK(status.st_mode) ? "block device"
                                                 : "socket") +
                      ", expected a regular file");
  return WriteMode::in_place;
}

/// 0 or the system's error number.
int write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      if (errno != EAGAIN) return errno;
      pollfd ready{.fd = file, .events = POLLOUT, .revents = 0};  // a non-blocking pipe
      static_cast<void>(::poll(&ready, 1, -1));
      continue;
    }
    content.remove_prefix(written);
  }
  return 0;
}

int write_to(const std::string& path, int flags, std::string_view content, bool flush_to_disk) {
  // Non-blocking: the file may have been replaced by a pipe.
  const int file = ::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
  if (file < 0) return errno;
  ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
  int error = write_all(file, content);
  // Without this a power failure after the rename could leave an empty file under the final name.
  if (error == 0 && flush_to_disk && ::fsync(file) != 0 && errno != EINVAL) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
}

/// Writes to an open descriptor at its present position; elsewhere a regular file is truncated
/// first.
int write_in_place(const OutputPlace& place, std::string_view content) {
  if (place.descriptor < 0)
    return write_to(place.path, content.empty() ? 0 : O_TRUNC, content, false);
  const int flags = ::fcntl(place.descriptor, F_GETFL);
  if (flags < 0) return errno;
  if ((flags & O_ACCMODE) == O_RDONLY) return EBADF;
  return write_all(place.descriptor, content);
}

/// Characters beyond ASCII that are invisible or change the direction of text: they make different
/// names look alike.
bool is_blank_or_control(std::string_view character) {
  const char32_t code = code_points(character).front();
  return code < 0xA1 || code == 0xAD || code == 0x1680 || (code >= 0x2000 && code <= 0x200F) ||
         (code >= 0x2028 && code <= 0x202F) || (code >= 0x205F && code <= 0x206F) ||
         code == 0x3000 || code == 0xFEFF || (code >= 0xE000 && code <= 0xF8FF) || code >= 0xE0000;
}

}  // namespace

void make_output_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw OutputError(cannot("the output folder", path, error.value()));
  if (!std::filesystem::is_directory(path, error)) {
    throw OutputError(cannot("the output folder", path, ENOTDIR));
  }
  const SignalHold hold;
  const std::string probe = temporary_name((std::filesystem::path(path) / "floatframe").string());
  const int failed = write_to(probe, O_CREAT | O_TRUNC, "", false);
  ::unlink(probe.c_str());
  if (failed != 0) throw OutputError(cannot("the output folder", path, failed));
}

void check_writable(const std::string& path) {
  const OutputPlace place = output_place(path);
  if (write_mode(path, place) == WriteMode::in_place) {
    const int failed = write_in_place(place, "");
    if (failed != 0) throw OutputError(cannot("the file", path, failed));
    return;
  }
  const SignalHold hold;
  const std::string probe = temporary_name(place.path);
  const int failed = write_to(probe, O_CREAT | O_TRUNC, "", false);
  ::unlink(probe.c_str());
  if (failed != 0) throw OutputError(cannot("the file", path, failed));
}

void write_file(const std::string& path, std::string_view content, Flush flush) {
  const OutputPlace place = output_place(path);
  if (write_mode(path, place) == WriteMode::in_place) {  // a slow reader can be interrupted
    const int error = write_in_place(place, content);
    if (error != 0) throw OutputError(cannot("the file", path, error));
    return;
  }
  const SignalHold hold;
  const std::string temporary = temporary_name(place.path);
  int error = write_to(temporary, O_CREAT | O_TRUNC, content, flush == Flush::now);
  if (error == 0 && ::rename(temporary.c_str(), place.path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    throw OutputError(cannot("the file", path, error));
  }
}

void flush_files(const std::string& folder) {
  const int place = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const int error = place < 0 || ::syncfs(place) != 0 ? errno : 0;
  if (place >= 0) ::close(place);
  if (error != 0) throw OutputError(cannot("the output folder", folder, error));
}

void remove_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return;  // also for circular links
  const OutputPlace place = output_place(path);
  if (!place.is_open && std::filesystem::is_regular_file(place.path, ignored))
    std::filesystem::remove(place.path, ignored);
}

bool is_temporary_name(std::string_view name) noexcept {
  const std::size_t at = name.rfind(".part-");
  if (at == std::string_view::npos) return false;
  const std::string_view numbers = name.substr(at + 6);
  const std::size_t dash = numbers.find('-');
  return dash != std::string_view::npos && dash > 0 && dash + 1 < numbers.size() &&
         numbers.find_first_not_of("0123456789-") == std::string_view::npos &&
         numbers.find('-', dash + 1) == std::string_view::npos;
}

std::string file_name_from(std::string_view name) {
  std::string text;
  for (std::size_t at = 0; at < name.size();) {
    const char c = name[at];
    const std::size_t length = utf8_length(name, at);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.';
    if (plain || (length > 1 && !is_blank_or_control(name.substr(at, length))))
      text += name.substr(at, length);
    else
      text += '_';
    at += std::max<std::size_t>(1, length);
  }
  if (text.empty()) return "model";
  if (text.front() == '.') text.front() = '_';
  return text;
}

}  // namespace floatframe
