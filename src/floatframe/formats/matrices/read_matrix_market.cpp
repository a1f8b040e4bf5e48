// Matrix Market: coordinate real (or integer), symmetric or general.
#include <fmt/format.h>

#include "floatframe/formats/matrices/matrix_entries.hpp"
#include "floatframe/formats/matrices/matrix_files.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// The banner; false and an error if the matrix cannot be read.
bool read_banner(TextSource& source) {
  std::string_view line;
  std::vector<std::string_view> words;
  if (source.next(line)) split_blanks(line, words);
  if (words.size() != 5 || !same_word(words[0], "%%MatrixMarket")) {
    source.error(ErrorCode::wrong_file,
                 "the first line is not '%%MatrixMarket matrix coordinate real symmetric'");
    return false;
  }
  const auto one_of = [&](std::size_t k, std::initializer_list<const char*> known) {
    for (const char* word : known) {
      if (same_word(words[k], word)) return true;
    }
    source.error(ErrorCode::wrong_value, "the banner says {}, expected {}", shown(words[k]),
                 fmt::join(known, " or "));
    return false;
  };
  return one_of(1, {"matrix"}) && one_of(2, {"coordinate"}) && one_of(3, {"real", "integer"}) &&
         one_of(4, {"symmetric", "general"});
}

SymmetricEntries read_entries(TextSource& source, const std::string& what, int n,
                              const std::string& map) {
  SymmetricEntries entries(source, what);
  if (!read_banner(source)) source.throw_if_any();
  std::string_view line;
  std::vector<std::string_view> fields;
  bool sized = false;
  int count = 0, found = 0;
  FeSource at;
  while (source.next(line)) {
    line = trimmed(line);
    if (line.empty() || line.front() == '%') continue;
    if (!sized) {
      split_blanks(line, fields);
      const auto number = [&](std::size_t k) {
        return k < fields.size() ? parse_integer(fields[k]) : std::optional<int>{};
      };
      if (fields.size() != 3 || !number(0) || !number(1) || !number(2)) {
        source.stop(
            ErrorCode::wrong_count, source.here(),
            "the line is not rows, columns and number of entries, whole numbers up to 2147483647");
      }
      if (*number(0) != n || *number(1) != n) {
        source.stop(ErrorCode::wrong_count, source.here(),
                    "the {} is {} x {}, but {} has {} degrees of freedom", what, *number(0),
                    *number(1), map, n);
      }
      count = *number(2);
      at = source.here();
      sized = true;
      continue;
    }
    ++found;
    int row = 0, column = 0;
    double value = 0.0;
    if (!read_matrix_line(source, line, row, column, value)) continue;
    if (row >= n || column >= n) {
      source.error(ErrorCode::out_of_range, "row {}, column {} is outside: the matrix is {} x {}",
                   row + 1, column + 1, n, n);
      continue;
    }
    entries.add(row, column, value);
  }
  if (!sized)
    source.error(ErrorCode::missing,
                 "the line with rows, columns and number of entries is missing");
  if (sized && found != count) {
    source.error(ErrorCode::wrong_count, at, "the {} has {} entries, expected {}", what, found,
                 count);
  }
  source.throw_if_any();
  return entries;
}

}  // namespace

bool looks_like_matrix_market(std::string_view beginning) {
  return begins_with(beginning, "%%MatrixMarket");
}

FeModel read_matrix_market(TextSource& stiffness, TextSource& mass, TextSource& dofs, FeModel nodes,
                           TextSource* damping) {
  return matrix_model_of(stiffness, mass, dofs, std::move(nodes), false, read_entries, damping);
}

FeModel read_matrix_market(const std::filesystem::path& file, const FeReadOptions& options) {
  const auto [begin, named_mass] = named_matrices(file, ".mtx");
  ErrorList errors;
  const std::filesystem::path mass =
      companion(file, options.mass, {named_mass}, "the mass matrix is", "mass", errors);
  const std::filesystem::path dofs = companion(
      file, options.dofs, {with_ending(begin, "_dofs.csv"), with_ending(stem_of(file), ".mapping")},
      "the map of degrees of freedom is", "dofs", errors);
  const std::filesystem::path nodes =
      companion(file, options.nodes, {with_ending(begin, "_nodes.csv"), with_ending(begin, ".inp")},
                "the coordinates of the nodes are", "nodes", errors);
  errors.throw_if_any();
  TextSource stiffness_source(file), mass_source(mass), dof_source(dofs);
  std::optional<TextSource> damping;
  if (const auto found = damping_matrix_of(file, options); !found.empty()) damping.emplace(found);
  return read_matrix_market(stiffness_source, mass_source, dof_source, read_nodes(nodes),
                            damping ? &*damping : nullptr);
}

}  // namespace floatframe
