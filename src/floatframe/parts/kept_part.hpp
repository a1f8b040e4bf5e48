#pragma once
// A body file that the program keeps for itself, sealed: what was changed since, packed again or
// made by something else is not taken.
#include <filesystem>

#include "floatframe/formats/body_file/body_file.hpp"

namespace floatframe {

/// Throws OutputError.
void keep_part(const std::filesystem::path& file, const BodyFile& content);

/// Throws InputError if the file cannot be read, or its content is not what was kept.
BodyFile kept_part(const std::filesystem::path& file);

}  // namespace floatframe
