#include "floatframe/core/library_path.hpp"

#include <dlfcn.h>

namespace floatframe {

std::string library_path() {
  Dl_info info{};
  static const char here = 0;  // an address in the library
  if (::dladdr(&here, &info) == 0 || !info.dli_fname) return "";
  return info.dli_fname;
}

}  // namespace floatframe
