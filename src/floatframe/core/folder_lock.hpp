#pragma once
// A folder that only one process at a time writes to. It is a system lock: it ends with the
// process, however that ends; a lock file left behind by a killed process has no effect.
#include <string>

namespace floatframe {

class FolderLock {
 public:
  /// Name of the lock file.
  static constexpr const char* file_name = "run.lock";

  /// Throws InputError if another process has the lock, OutputError if it cannot be created.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Releases the space reserved in the file, so that a short file fits on a disk that became full.
  void release_space() noexcept;

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace floatframe
