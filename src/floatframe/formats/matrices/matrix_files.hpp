#pragma once
// The files that lie beside a stiffness matrix, and what the first line of a matrix file says.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

/// `file` without .gz and without its ending.
std::filesystem::path stem_of(const std::filesystem::path& file);
std::filesystem::path with_ending(const std::filesystem::path& stem, const char* ending);
/// The stem of a file with the last `word` (upper case; in the file in any case) replaced; empty if
/// the word is not there.
std::filesystem::path with_word(const std::filesystem::path& file, std::string_view word,
                                std::string_view other);

/// The stem of a file up to the last `word`; empty if the word is not there.
std::filesystem::path before_word(const std::filesystem::path& file, std::string_view word);

/// The file given in the options, or the first candidate that is there, also with .gz. Empty paths
/// are no candidates. If there is none: an error "`what` not there: ... give the `option` file".
std::filesystem::path companion(const std::filesystem::path& file,
                                const std::filesystem::path& given,
                                const std::vector<std::filesystem::path>& candidates,
                                std::string_view what, std::string_view option, ErrorList& errors);

/// Of a stiffness arm_K.ending: its beginning arm, and arm_M.ending (the case is kept); the file's
/// own stem and an empty path if its name does not end with _K.
struct NamedMatrices {
  std::filesystem::path begin, mass;
};
NamedMatrices named_matrices(const std::filesystem::path& file, const char* ending);

/// First line that is not empty and does not begin with one of `comments`.
std::string_view first_line(std::string_view text, std::string_view comments);
/// "row column value".
bool is_triple(std::string_view line);

}  // namespace floatframe
