#include "floatframe/sweep/program_identity.hpp"

#include <dlfcn.h>

#include <fstream>
#include <iterator>

#include "floatframe/core/build_info.hpp"
#include "floatframe/core/content_hash.hpp"

namespace floatframe {

std::string library_path() {
  Dl_info info{};
  static const char here = 0;  // an address in the library
  if (::dladdr(&here, &info) == 0 || !info.dli_fname) return "";
  return info.dli_fname;
}

std::string program_identity() {
  static const std::string identity = [] {
    std::ifstream file(library_path(), std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    return build_description() + ", " + content_hash(content);
  }();
  return identity;
}

}  // namespace floatframe
