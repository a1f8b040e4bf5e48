#include "floatframe/parts/kept_part.hpp"

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/formats/body_file/archive_seal.hpp"

namespace floatframe {

void keep_part(const std::filesystem::path& file, const BodyFile& content) {
  write_file(file.string(), sealed_archive(body_file_bytes(content)));
}

BodyFile kept_part(const std::filesystem::path& file) {
  const std::string bytes = regular_file(file);
  BodyFile found = read_body_bytes(bytes, file.string());
  if (!is_sealed_archive(bytes))
    throw InputError(ErrorCode::damaged, {file.string(), 0, 0},
                     "its content is not what was written");
  return found;
}

}  // namespace floatframe
