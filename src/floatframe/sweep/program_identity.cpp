#include "floatframe/sweep/program_identity.hpp"

#include <tuple>

#include "floatframe/core/build_info.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/library_path.hpp"
#include "floatframe/core/regular_file.hpp"

namespace floatframe {

std::string program_identity() {
  static const std::string identity = [] {
    std::string content;
    std::ignore = read_regular_file(library_path(), largest_file_read, content);
    return build_description() + ", " + content_hash(content);
  }();
  return identity;
}

}  // namespace floatframe
