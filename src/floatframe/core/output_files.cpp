#include "floatframe/core/output_files.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <tuple>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {
namespace {

using Identity = std::tuple<dev_t, ino_t, std::string>;

/// False if it exists but is not a regular file.
bool identity(const std::string& path, Identity& out) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    out = {status.st_dev, status.st_ino, ""};
    return S_ISREG(status.st_mode);
  }
  const std::filesystem::path file(path);
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  const bool found = ::stat(folder.c_str(), &status) == 0;
  out = {found ? status.st_dev : 0, found ? status.st_ino : 0,
         found ? file.filename().string() : file.lexically_normal().string()};
  return true;
}

}  // namespace

void require_distinct(const std::vector<OutputFile>& outputs,
                      const std::vector<std::string>& inputs) {
  std::map<Identity, const OutputFile*> taken;
  Identity key;
  for (const std::string& input : inputs)
    if (!input.empty() && identity(input, key)) taken.emplace(key, nullptr);
  for (const OutputFile& output : outputs) {
    if (output.path.empty() || !identity(output.path, key)) continue;
    const auto [at, is_new] = taken.emplace(key, &output);
    if (is_new) continue;
    if (at->second == nullptr)
      throw InputError(ErrorCode::wrong_value,
                       output.option + ": found '" + output.path +
                           "', which this command reads; expected another file");
    throw InputError(ErrorCode::duplicate, at->second->option + " and " + output.option +
                                               ": found '" + output.path +
                                               "' for both, expected two files");
  }
}

}  // namespace floatframe
