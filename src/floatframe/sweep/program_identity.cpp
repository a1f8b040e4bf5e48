#include "floatframe/sweep/program_identity.hpp"

#include <fstream>
#include <iterator>

#include "floatframe/core/build_info.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/library_path.hpp"

namespace floatframe {

std::string program_identity() {
  static const std::string identity = [] {
    std::ifstream file(library_path(), std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    return build_description() + ", " + content_hash(content);
  }();
  return identity;
}

}  // namespace floatframe
