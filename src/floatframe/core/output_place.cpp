#include "floatframe/core/output_place.hpp"

#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "floatframe/core/output_error.hpp"

namespace floatframe {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // as the limit of the system

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The system shows open files as links in /proc; they work even if the file has no name any more.
bool is_in_proc(const fs::path& folder) {
  struct statfs status {};
  return ::statfs(folder.c_str(), &status) == 0 && status.f_type == PROC_SUPER_MAGIC;
}

/// -1: not a descriptor of this process.
int own_descriptor(const fs::path& file) {
  std::error_code error;
  const fs::path folder = fs::canonical(folder_of(file), error);
  if (error || folder.filename() != "fd") return -1;
  const fs::path own = fs::canonical("/proc/self", error);
  if (error ||
      std::mismatch(own.begin(), own.end(), folder.begin(), folder.end()).first != own.end())
    return -1;
  const std::string number = file.filename().string();
  int descriptor = -1;
  const auto [end, problem] =
      std::from_chars(number.data(), number.data() + number.size(), descriptor);
  return problem == std::errc() && end == number.data() + number.size() ? descriptor : -1;
}

}  // namespace

OutputPlace output_place(const std::string& name) {
  fs::path path(name);
  for (int links = 0; links <= most_links; ++links) {
    std::error_code error;
    if (is_in_proc(folder_of(path))) return {path.string(), true, own_descriptor(path)};
    if (!fs::is_symlink(fs::symlink_status(path, error)) || error)
      return {path.string(), false, -1};
    const fs::path target = fs::read_symlink(path, error);
    if (error) return {path.string(), false, -1};
    path = target.is_absolute() ? target : folder_of(path) / target;
  }
  throw OutputError("the file '" + name + "' cannot be written: " + std::strerror(ELOOP));
}

bool is_replaceable(const std::string& name) {
  const OutputPlace place = output_place(name);
  struct stat status {};
  return !place.is_open && (::stat(place.path.c_str(), &status) != 0 || S_ISREG(status.st_mode));
}

}  // namespace floatframe
