// Harwell-Boeing: columns of a real assembled matrix, symmetric (lower triangle) or not, as HBMAT
// of ANSYS writes it. Title; numbers of lines; type and size; formats; then where the columns
// begin, the rows and the values, in the columns of these formats.
#include <fmt/format.h>

#include <limits>

#include "floatframe/formats/matrices/matrix_entries.hpp"
#include "floatframe/formats/matrices/matrix_files.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
#include "floatframe/formats/text/fortran_columns.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

bool is_matrix_type(std::string_view word) {
  return word.size() == 3 && std::string_view("RPCrpc").find(word[0]) != std::string_view::npos &&
         std::string_view("SUHZRsuhzr").find(word[1]) != std::string_view::npos &&
         std::string_view("AEae").find(word[2]) != std::string_view::npos;
}

class HarwellBoeing {
 public:
  HarwellBoeing(TextSource& source, std::string what) : in_(source), what_(std::move(what)) {}

  SymmetricEntries read(int n, const std::string& map) {
    header(n, map);
    SymmetricEntries entries(in_, what_);
    std::vector<int> begins, rows;
    whole_numbers(formats_[0], static_cast<std::size_t>(n) + 1, "where a column begins", begins);
    for (std::size_t k = 0; k + 1 < begins.size(); ++k)
      if (begins[k] < 1 || begins[k + 1] < begins[k] || begins[k + 1] - 1 > count_)
        in_.stop(in_.here(),
                 fmt::format("column {} has the entries from {} to {}, expected ascending "
                             "numbers from 1 to {}",
                             k + 1, begins[k], begins[k + 1] - 1, count_));
    if (begins.front() != 1 || begins.back() - 1 != count_)
      in_.stop(in_.here(), fmt::format("the columns have {} entries, the header says {}",
                                       begins.back() - begins.front(), count_));
    whole_numbers(formats_[1], count_, "a row", rows);
    std::size_t k = 0;
    int column = 0;
    values(formats_[2], count_, [&](double value) {
      while (static_cast<int>(k) + 1 >= begins[column + 1]) ++column;
      if (rows[k] < 1 || rows[k] > n)
        in_.stop(in_.here(), fmt::format("row {} of column {} is outside: the matrix is {} x {}",
                                         rows[k], column + 1, n, n));
      entries.add(rows[k] - 1, column, value);
      ++k;
    });
    return entries;
  }

 private:
  std::string_view line(const char* what) {
    std::string_view text;
    if (!in_.next(text)) in_.stop(in_.here(), fmt::format("the file ends where {} expected", what));
    return text;
  }

  void header(int n, const std::string& map) {
    static_cast<void>(line("the title is"));
    std::vector<std::string_view> words;
    split_blanks(line("the numbers of lines are"), words);
    const bool right_side = words.size() > 4 && words[4] != "0";
    const std::string_view text = line("the type of the matrix is");
    split_blanks(text, words);
    if (words.size() < 4 || !is_matrix_type(words[0]))
      in_.stop(in_.here(), fmt::format("expected a type like RSA, rows, columns and entries, found "
                                       "{}",
                                       shown(trimmed(text))));
    const std::string type = upper_case(words[0]);
    if (type != "RSA" && type != "RUA")
      in_.stop(in_.here(), fmt::format("the matrix is of type {}, expected RSA (real, symmetric, "
                                       "assembled) or RUA",
                                       type));
    const auto rows = parse_integer(words[1]), columns = parse_integer(words[2]),
               entries = parse_integer(words[3]);
    if (!rows || !columns || !entries || *entries < 1 ||
        *entries == std::numeric_limits<int>::max())
      in_.stop(in_.here(), fmt::format("rows, columns and entries are expected behind {}, found {}",
                                       type, shown(trimmed(text))));
    if (*rows != n || *columns != n)
      in_.stop(in_.here(), fmt::format("the {} is {} x {}, but {} has {} degrees of freedom", what_,
                                       *rows, *columns, map, n));
    count_ = *entries;
    formats(line("the formats are"));
    if (right_side) static_cast<void>(line("the format of the right sides is"));
  }

  /// Texts in parentheses, in columns of 16, 16 and 20; they may hold blanks.
  void formats(std::string_view text) {
    for (FortranColumns& format : formats_) {
      const std::size_t begin = text.find('('), end = text.find(')');
      const auto found =
          begin == std::string_view::npos || end == std::string_view::npos || end < begin
              ? std::nullopt
              : parse_fortran_columns(text.substr(begin, end - begin + 1));
      if (!found) in_.stop(in_.here(), "expected three formats like (10I8) (10I8) (3D25.16)");
      format = *found;
      text.remove_prefix(end + 1);
    }
  }

  template <typename Use>
  void cells(const FortranColumns& format, std::size_t count, const char* what, Use use) {
    std::vector<std::string_view> cells;
    for (std::size_t k = 0; k < count;) {
      std::string_view text;
      if (!in_.next(text))
        in_.stop(in_.here(),
                 fmt::format("the file ends with {} of {} numbers of {}", k, count, what));
      if (!format.split(text, cells).empty())
        in_.stop(in_.here(), "the line is longer than its format");
      for (const std::string_view cell : cells) {
        if (cell.empty() || k == count) continue;
        use(cell);
        ++k;
      }
    }
  }

  void whole_numbers(const FortranColumns& format, std::size_t count, const char* what,
                     std::vector<int>& out) {
    cells(format, count, what, [&](std::string_view cell) {
      const auto value = parse_integer(cell);
      if (!value) in_.stop(in_.here(), fmt::format("{}: {}", what, not_an_integer(cell)));
      out.push_back(*value);
    });
  }

  template <typename Use>
  void values(const FortranColumns& format, std::size_t count, Use use) {
    cells(format, count, "the values", [&](std::string_view cell) {
      const auto value = parse_real(cell);
      if (!value) in_.stop(in_.here(), fmt::format("value: {}", not_a_real(cell)));
      use(*value);
    });
  }

  TextSource& in_;
  std::string what_;
  int count_ = 0;
  FortranColumns formats_[3];
};

SymmetricEntries read_harwell_boeing_entries(TextSource& source, const std::string& what, int n,
                                             const std::string& map) {
  return HarwellBoeing(source, what).read(n, map);
}

}  // namespace

bool looks_like_harwell_boeing(std::string_view beginning) {
  for (int k = 0; k < 2; ++k) {
    const std::size_t end = beginning.find('\n');
    if (end == std::string_view::npos) return false;
    beginning.remove_prefix(end + 1);
  }
  std::vector<std::string_view> words;
  split_blanks(beginning.substr(0, beginning.find('\n')), words);
  return words.size() >= 4 && is_matrix_type(words[0]) && parse_integer(words[1]) &&
         parse_integer(words[2]) && parse_integer(words[3]);
}

FeModel read_harwell_boeing(TextSource& stiffness, TextSource& mass, TextSource& dofs,
                            FeModel nodes, TextSource* damping) {
  return matrix_model_of(stiffness, mass, dofs, std::move(nodes), false,
                         read_harwell_boeing_entries, damping);
}

FeModel read_harwell_boeing(const std::filesystem::path& file, const FeReadOptions& options) {
  const std::string ending =
      lower_case(file.string()).ends_with(".gz")
          ? std::filesystem::path(file).replace_extension().extension().string()
          : file.extension().string();
  const auto [begin, named_mass] = named_matrices(file, ending.c_str());
  ErrorList errors;
  const std::filesystem::path mass =
      companion(file, options.mass, {named_mass}, "the mass matrix is", "mass", errors);
  const std::filesystem::path dofs =
      companion(file, options.dofs,
                {with_ending(stem_of(file), ".mapping"), with_ending(begin, ".mapping"),
                 with_ending(begin, "_dofs.csv")},
                "the map of degrees of freedom is", "dofs", errors);
  const std::filesystem::path nodes =
      companion(file, options.nodes, {with_ending(begin, "_nodes.csv"), with_ending(begin, ".cdb")},
                "the coordinates of the nodes are", "nodes", errors);
  errors.throw_if_any();
  TextSource stiffness_source(file), mass_source(mass), dof_source(dofs);
  std::optional<TextSource> damping;
  if (const auto found = damping_matrix_of(file, options); !found.empty()) damping.emplace(found);
  return read_harwell_boeing(stiffness_source, mass_source, dof_source, read_nodes(nodes),
                             damping ? &*damping : nullptr);
}

}  // namespace floatframe
