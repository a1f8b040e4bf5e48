#include "floatframe/core/library_path.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace floatframe {

std::string library_path() {
  Dl_info info{};
  static const char here = 0;  // an address in the library
  if (::dladdr(&here, &info) == 0 || !info.dli_fname) return "";
  return info.dli_fname;
}

std::string module_path(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(library_path()).parent_path();
  for (const auto& where : {folder, folder.parent_path().parent_path()}) {
    std::error_code ignored;
    if (std::filesystem::exists(where / name, ignored)) return (where / name).string();
  }
  return "";
}

}  // namespace floatframe
