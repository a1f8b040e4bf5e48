#include "floatframe/core/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <tuple>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/output_error.hpp"

namespace floatframe {
namespace {

constexpr off_t kept_space = 256 * 1024;

bool is_file_at(int file, const std::string& path) {
  struct stat open {};
  struct stat named {};
  return ::fstat(file, &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/// "process 1234", as written by the holder of the lock.
std::string holder(int file) {
  char text[32] = {};
  const ssize_t n = ::pread(file, text, sizeof text - 1, 0);
  const std::string number(text, n > 0 ? static_cast<std::size_t>(n) : 0);
  const std::size_t end = number.find_first_not_of("0123456789");
  return end == 0 || end == std::string::npos ? "another process"
                                              : "process " + number.substr(0, end);
}

/// A lock file contains a number, then zeros, or nothing, and has one link. Any other file of this
/// name belongs to another program and is not written.
bool is_lock(int file) {
  struct stat s {};
  if (::fstat(file, &s) != 0 || !S_ISREG(s.st_mode) || s.st_nlink > 1) return false;
  if (s.st_size == 0) return true;
  char text[32] = {};
  if (s.st_size > kept_space || ::pread(file, text, sizeof text - 1, 0) < 1) return false;
  const std::string found(text);
  const std::size_t end = found.find_first_not_of("0123456789");
  // Zeros alone: killed between reserving space and writing the number.
  return found.empty() || (end != 0 && end != std::string::npos && found.substr(end) == "\n");
}

[[noreturn]] void refuse_foreign(const std::string& path) {
  throw InputError(
      ErrorCode::exists,
      "the file '" + path + "' is not a lock of this program; remove it, or give another --out");
}

}  // namespace

FolderLock::FolderLock(const std::string& folder)
    : path_((std::filesystem::path(folder) / file_name).string()) {
  for (int attempt = 0; file_ < 0 && attempt < 1000; ++attempt) {
    const int file =
        ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW, 0666);
    if (file < 0 && errno == ELOOP) refuse_foreign(path_);
    if (file < 0)
      throw OutputError("the file '" + path_ + "' cannot be written: " + std::strerror(errno));
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const std::string who = holder(file);
      ::close(file);
      throw InputError(ErrorCode::in_use,
                       "the folder '" + folder + "' is in use: a run of " + who +
                           " writes there; give another --out, or wait for its end");
    }
    if (!is_lock(file)) {
      ::close(file);
      refuse_foreign(path_);
    }
    // Between the calls the former holder may have removed the file.
    if (is_file_at(file, path_))
      file_ = file;
    else
      ::close(file);
  }
  if (file_ < 0)
    throw OutputError("the file '" + path_ + "' cannot be kept: it is removed again and again");
  const std::string number = std::to_string(::getpid()) + '\n';
  std::ignore = ::ftruncate(file_, 0);
  std::ignore = ::posix_fallocate(file_, 0, kept_space);  // optional
  std::ignore = ::pwrite(file_, number.data(), number.size(), 0);
}

void FolderLock::release_space() noexcept { std::ignore = ::ftruncate(file_, 0); }

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());  // still locked: no other process holds it
  ::close(file_);
}

}  // namespace floatframe
