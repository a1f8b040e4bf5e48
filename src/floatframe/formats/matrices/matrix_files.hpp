#pragma once
// The files that lie beside a stiffness matrix, and what the lines of a matrix file say.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/formats/fe_file.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {

/// `file` without .gz and without its ending.
std::filesystem::path stem_of(const std::filesystem::path& file);
std::filesystem::path with_ending(const std::filesystem::path& stem, const std::string& ending);
/// The stem of a file with the last `word` (upper case; in the file in any case) replaced; empty if
/// the word is not there.
std::filesystem::path with_word(const std::filesystem::path& file, std::string_view word,
                                std::string_view other);
/// The stem of a file up to the last `word`; empty if the word is not there.
std::filesystem::path before_word(const std::filesystem::path& file, std::string_view word);
/// Of a stem arm_K: arm_M (the case is kept); empty if it does not end with _K.
std::filesystem::path with_letter(const std::filesystem::path& stem, char letter);

/// The file with the nodes: the one given in the options, or the first that lies beside a file,
/// also with .gz. Throws InputError if there is none.
std::filesystem::path nodes_beside(const std::filesystem::path& file,
                                   const std::filesystem::path& given,
                                   const std::vector<const char*>& endings);

/// Where the files beside a stiffness may be; empty paths are none.
struct MatrixPlaces {
  std::vector<std::filesystem::path> stiffness = {};  ///< empty: it is the file itself
  std::vector<std::filesystem::path> mass = {};
  std::optional<std::vector<std::filesystem::path>> dofs = {};  ///< null: there is no map
  std::vector<std::filesystem::path> nodes = {};
};
/// `dofs` and `damping` may be null.
using ReadMatrices = std::function<FeModel(TextSource& stiffness, TextSource& mass,
                                           TextSource* dofs, FeModel nodes, TextSource* damping)>;
/// Reads those of the options, and the others where they are. Throws InputError, which says what is
/// missing: "the mass matrix is missing: ... give the mass file".
FeModel read_matrix_files(const std::filesystem::path& file, const FeReadOptions& options,
                          const MatrixPlaces& places, const ReadMatrices& read);

/// First line that is not empty and does not begin with one of `comments`.
std::string_view first_line(std::string_view text, std::string_view comments);
/// Calls `use` for each line that is neither empty nor begins with one of `comments`.
template <typename Use>
void each_line(TextSource& source, std::string_view comments, Use use) {
  std::string_view line;
  while (source.next(line)) {
    line = trimmed(line);
    if (!line.empty() && comments.find(line.front()) == std::string_view::npos) use(line);
  }
}

}  // namespace floatframe
