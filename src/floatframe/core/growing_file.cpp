#include "floatframe/core/growing_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/output_place.hpp"

namespace floatframe {
namespace {

OutputError not_written(const std::string& path, int error) {
  return OutputError("the file '" + path + "' cannot be written: " + std::strerror(error));
}

InputError not_continued(ErrorCode code, const std::string& path, const std::string& what) {
  return InputError(code, "the file '" + path + "' cannot be continued: " + what);
}

}  // namespace

GrowingFile::GrowingFile(const std::string& path, bool hashed) : path_(path), hashed_(hashed) {
  if (!is_replaceable(path))
    throw OutputError("the file '" + path + "' cannot be written: this is not a regular file");
  const std::string place = output_place(path).path;
  // Readers of the earlier file keep it open.
  if (::unlink(place.c_str()) != 0 && errno != ENOENT) throw not_written(path, errno);
  file_ = ::open(place.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOCTTY, 0666);
  if (file_ < 0) throw not_written(path, errno);
}

/// The content before the position has already been checked.
GrowingFile::GrowingFile(const std::string& path, const Position& position, int flags)
    : path_(path), hashed_(true) {
  file_ = ::open(path.c_str(), flags | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (file_ < 0) throw not_continued(ErrorCode::unreadable, path, std::strerror(errno));
  try {
    read_up_to(position);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

void GrowingFile::require(const std::string& path, const Position& position) {
  const GrowingFile checked(path, position, O_RDONLY);
}

GrowingFile::GrowingFile(const std::string& path, const Position& position)
    : path_(path), hashed_(true) {
  file_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (file_ < 0) throw not_continued(ErrorCode::unreadable, path, std::strerror(errno));
  try {
    read_up_to(position);
    if (::ftruncate(file_, static_cast<off_t>(position.bytes)) != 0 ||
        ::lseek(file_, 0, SEEK_END) < 0)
      throw not_written(path, errno);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

GrowingFile::~GrowingFile() { ::close(file_); }

void GrowingFile::read_up_to(const Position& position) {
  struct stat status {};
  if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode))
    throw not_continued(ErrorCode::unreadable, path_, "this is not a regular file");
  if (static_cast<std::uint64_t>(status.st_size) < position.bytes)
    throw not_continued(ErrorCode::damaged, path_,
                        "found " + std::to_string(status.st_size) + " bytes, expected " +
                            std::to_string(position.bytes) + " or more");
  std::vector<char> piece(std::size_t{1} << 20);
  for (std::uint64_t left = position.bytes; left > 0;) {
    const ssize_t n = ::read(file_, piece.data(), std::min<std::uint64_t>(left, piece.size()));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw not_continued(ErrorCode::unreadable, path_, "it cannot be read");
    content_.append({piece.data(), static_cast<std::size_t>(n)});
    left -= static_cast<std::uint64_t>(n);
  }
  if (content_.text() != position.content)
    throw not_continued(ErrorCode::damaged, path_, "its content is not what was written");
  bytes_ = position.bytes;
}

/// Number of bytes that could be written; `error`: why not all.
std::size_t GrowingFile::write(std::string_view bytes, int& error) {
  std::size_t done = 0;
  while (done < bytes.size() && error == 0) {
    const ssize_t n = ::write(file_, bytes.data() + done, bytes.size() - done);
    if (n >= 0)
      done += static_cast<std::size_t>(n);
    else if (errno != EINTR)
      error = errno;
  }
  return done;
}

/// Counts these bytes as written; after an error anything behind them is removed.
void GrowingFile::keep(std::string_view bytes, int error) {
  if (hashed_) content_.append(bytes);
  bytes_ += bytes.size();
  if (error == 0) return;
  static_cast<void>(::ftruncate(file_, static_cast<off_t>(bytes_)));
  static_cast<void>(::lseek(file_, 0, SEEK_END));
  throw not_written(path_, error);
}

void GrowingFile::append(std::string_view lines) {
  int error = 0;
  std::size_t done = write(lines, error);
  if (error != 0) {  // no partial line: readers would take it for a complete one
    const std::size_t end = lines.substr(0, done).rfind('\n');
    done = end == std::string_view::npos ? 0 : end + 1;
  }
  keep(lines.substr(0, done), error);
}

void GrowingFile::append_whole(std::string_view block) {
  int error = 0;
  const std::size_t done = write(block, error);
  keep(block.substr(0, error == 0 ? done : 0), error);
}

void GrowingFile::to_disk() {
  if (::fsync(file_) != 0 && errno != EINVAL) throw not_written(path_, errno);
}

}  // namespace floatframe
