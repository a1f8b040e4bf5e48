#include "floatframe/core/regular_file.hpp"

#include "floatframe/core/diagnostics.hpp"

#ifdef _WIN32
// The runtime of FMUs is all there is on Windows; it reads packed models and, for programs, tyres.
#include <fstream>

namespace floatframe {

std::string regular_file(const std::filesystem::path& file, std::uint64_t largest) {
  const auto wrong = [&](const char* why) {
    return InputError(ErrorCode::unreadable, {file.string(), 0, 0}, why);
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw wrong("the file does not exist, or is not a regular file");
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error || size >= largest) throw wrong("the file is too large, or cannot be read");
  std::string content(size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in.read(content.data(), std::ssize(content))) throw wrong("the file cannot be read");
  return content;
}

}  // namespace floatframe

#else

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

namespace floatframe {
namespace {

constexpr std::uint64_t piece = std::uint64_t{1} << 20;

class OpenFile {
 public:
  // Non-blocking: opening a pipe would wait for its other end.
  explicit OpenFile(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {}
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int number() const noexcept { return number_; }

 private:
  int number_;
};

std::string size_text(std::uint64_t bytes) {
  for (const auto& [unit, shift] : {std::pair{"GiB", 30}, std::pair{"MiB", 20}})
    if (bytes >> shift > 0) return std::to_string(bytes >> shift) + " " + unit;
  return std::to_string(bytes) + " bytes";
}

std::string not_opened(int error) {
  if (error == ENOENT || error == ENOTDIR) return "the file does not exist";
  if (error == ENXIO) return "this is not a regular file";  // a socket
  return std::string("the file cannot be opened (") + std::strerror(error) + ")";
}

/// Empty if the file is open and a regular one.
std::string why_not_regular(int number, struct stat& status) {
  if (number < 0) return not_opened(errno);
  if (::fstat(number, &status) != 0) return "the file cannot be read";
  if (S_ISDIR(status.st_mode)) return "this is a folder, not a file";
  if (!S_ISREG(status.st_mode)) return "this is not a regular file";
  return {};
}

/// Reads the first `most` bytes of a regular file; returns empty or the reason. With `whole` a
/// larger file is an error.
std::string read_up_to(const std::filesystem::path& path, std::uint64_t most, bool whole,
                       std::string& content) {
  content.clear();
  // The system would truncate the name there.
  if (path.native().find('\0') != std::string::npos) return "the name of the file holds a NUL";
  const OpenFile file(path);
  struct stat status {};
  if (const std::string why = why_not_regular(file.number(), status); !why.empty()) return why;
  const std::string too_large =
      "the file is larger than " + size_text(most) + ", which is not read";
  if (whole && status.st_size > 0 && static_cast<std::uint64_t>(status.st_size) > most)
    return too_large;
  if (whole) ++most;  // the size is an estimate: files of /proc have none, others may grow
  content.reserve(std::min(static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0)), most));
  while (content.size() < most) {
    const std::size_t before = content.size();
    const auto left = static_cast<std::uint64_t>(
        std::max<off_t>(status.st_size - static_cast<off_t>(before), 4096));
    content.resize(before + static_cast<std::size_t>(std::min({most - before, piece, left})));
    const ssize_t count = ::read(file.number(), content.data() + before, content.size() - before);
    content.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count == 0) break;
    if (count < 0 && errno != EINTR) {
      const int error = errno;
      content.clear();
      return std::string("the file cannot be read (") + std::strerror(error) + ")";
    }
  }
  if (whole && content.size() == most) {
    content.clear();
    return too_large;
  }
  return {};
}

}  // namespace

std::string read_regular_file(const std::filesystem::path& file, std::uint64_t largest,
                              std::string& content) {
  try {
    return read_up_to(file, largest, true, content);
  } catch (const std::bad_alloc&) {
    content = {};
    return "the file needs more memory than is available";
  }
}

std::string read_regular_beginning(const std::filesystem::path& file, std::size_t bytes,
                                   std::string& content) {
  return read_up_to(file, bytes, false, content);
}

RegularFile::RegularFile(const std::filesystem::path& file) : name_(file.string()) {
  struct stat status {};
  const bool whole = file.native().find('\0') == std::string::npos;
  if (whole) number_ = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  const std::string why =
      whole ? why_not_regular(number_, status) : "the name of the file holds a NUL";
  if (!why.empty()) {
    if (number_ >= 0) ::close(number_);
    throw InputError(ErrorCode::unreadable, {name_, 0, 0}, why);
  }
  size_ = std::max<off_t>(status.st_size, 0);
}

RegularFile::~RegularFile() { ::close(number_); }

std::size_t RegularFile::read(char* to, std::size_t count) {
  for (;;) {
    const ssize_t got = ::read(number_, to, count);
    if (got >= 0) return got;
    if (errno != EINTR)
      throw InputError(ErrorCode::unreadable, {name_, 0, 0},
                       std::string("the file cannot be read (") + std::strerror(errno) + ")");
  }
}

std::string regular_file(const std::filesystem::path& file, std::uint64_t largest) {
  std::string content;
  const std::string why = read_regular_file(file, largest, content);
  if (!why.empty()) throw InputError(ErrorCode::unreadable, {file.string(), 0, 0}, why);
  return content;
}

}  // namespace floatframe

#endif
