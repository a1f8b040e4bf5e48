#pragma once
// A body file kept by the program for its own use, with a seal: a file changed, repacked or made by
// other means is rejected.
#include <filesystem>

#include "floatframe/formats/body_file/body_file.hpp"

namespace floatframe {

/// Throws OutputError.
void keep_part(const std::filesystem::path& file, const BodyFile& content);

/// Throws InputError if the file cannot be read, or its content has changed.
BodyFile kept_part(const std::filesystem::path& file);

}  // namespace floatframe
