#pragma once
// A folder for the files of one test, with a name of its own, so that any number of tests may run
// side by side; it goes with the object.
#include <filesystem>
#include <string>
#include <string_view>

namespace floatframe::test {

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  /// Path of a file in the folder, as text.
  std::string file(const std::string& name) const { return (path_ / name).string(); }

  /// Writes a file, with the folders it lies in, and returns its path.
  std::string write(const std::string& name, std::string_view content) const;
  std::string read(const std::string& name) const;
  /// `text` with the names of files in the folder relative to it.
  std::string without(std::string text) const;

 private:
  std::filesystem::path path_;
};

}  // namespace floatframe::test
