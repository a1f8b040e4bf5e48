#include "floatframe/core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace floatframe {
namespace {

/// Holds back the signals that end a program; they are delivered when the object goes.
class SignalHold {
 public:
  SignalHold() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, signal);
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

/// One of its own for every process and every call: threads may write the same file.
std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> calls = 0;
  return path + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(calls++);
}

/// What is not a regular file is written to in place, where that cannot wait for somebody without
/// end or destroy a file system: a terminal, a null device, a pipe that this process already holds.
enum class Place { regular, special };

Place place_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return Place::regular;
  if (S_ISDIR(status.st_mode)) throw OutputError(cannot("the file", path, EISDIR));
  std::error_code nameless;  // a pipe behind /dev/stdout or /dev/fd/N
  if (S_ISFIFO(status.st_mode)) static_cast<void>(std::filesystem::canonical(path, nameless));
  if (!S_ISCHR(status.st_mode) && !nameless)
    throw OutputError("the file '" + path + "' cannot be written: this is a " +
                      (S_ISFIFO(status.st_mode)  ? "named pipe"
                       : S_ISBLK(status.st_mode) ? "block device"
                                                 : "socket") +
                      ", expected a regular file");
  return Place::special;
}

/// 0 or the system's error number.
int write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    content.remove_prefix(written);
  }
  return 0;
}

int write_to(const std::string& path, int flags, std::string_view content, bool flush_to_disk) {
  // Not blocking: what the name stands for may have become a pipe.
  const int file = ::open(path.c_str(), flags | O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
  if (file < 0) return errno;
  ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
  int error = write_all(file, content);
  // Without this a power failure after the rename could leave an empty file under the final name.
  if (error == 0 && flush_to_disk && ::fsync(file) != 0 && errno != EINVAL) error = errno;
  if (::close(file) != 0 && error == 0) error = errno;
  return error;
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
  if (place_of(path) == Place::special) {
    const int failed = write_to(path, 0, "", false);
    if (failed != 0) throw OutputError(cannot("the file", path, failed));
    return;
  }
  const SignalHold hold;
  const std::string probe = temporary_name(path);
  const int failed = write_to(probe, O_CREAT | O_TRUNC, "", false);
  ::unlink(probe.c_str());
  if (failed != 0) throw OutputError(cannot("the file", path, failed));
}

void write_file(const std::string& path, std::string_view content, Flush flush) {
  if (place_of(path) == Place::special) {  // a slow reader can be interrupted
    const int error = write_to(path, 0, content, false);
    if (error != 0) throw OutputError(cannot("the file", path, error));
    return;
  }
  const SignalHold hold;
  const std::string temporary = temporary_name(path);
  int error = write_to(temporary, O_CREAT | O_TRUNC, content, flush == Flush::now);
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
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
  if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::remove(path, ignored);
}

std::string file_name_from(std::string_view name) {
  std::string text;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.';
    text += plain ? c : '_';
  }
  if (text.empty()) return "model";
  if (text.front() == '.') text.front() = '_';
  return text;
}

}  // namespace floatframe
