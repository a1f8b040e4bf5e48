#pragma once
// A folder that one process at a time fills. The lock is of the system: it ends with the process,
// however that ends, and the file that stays behind of one that was killed means nothing.
#include <string>

namespace floatframe {

class FolderLock {
 public:
  /// The file that is there meanwhile.
  static constexpr const char* file_name = "run.lock";

  /// Throws InputError if another process has the folder, OutputError if the file cannot be made.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Gives back the space that the file has kept, so that a short file fits on a disk that became
  /// full.
  void release_space() noexcept;

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace floatframe
