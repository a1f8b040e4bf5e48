// Matrices as text: of CalculiX (*FREQUENCY, SOLVER=MATRIXSTORAGE), of Abaqus (*MATRIX GENERATE and
// *MATRIX OUTPUT), and Matrix Market (coordinate real or integer, symmetric or general).
#include "floatframe/formats/matrices/read_matrices.hpp"

#include <algorithm>

#include "floatframe/formats/matrices/matrix_model.hpp"

namespace floatframe {
namespace {

using Fields = std::vector<std::string_view>;

/// A line of integers and one real number.
bool is_entry(std::string_view line, std::size_t count,
              std::optional<int> (*whole)(std::string_view)) {
  Fields fields;
  split_blanks(line, fields);
  return fields.size() == count + 1 && parse_real(fields.back()) &&
         std::all_of(fields.begin(), fields.end() - 1,
                     [whole](std::string_view field) { return whole(field).has_value(); });
}
bool is_triple(std::string_view line) { return is_entry(line, 2, parse_label); }
bool is_quintuple(std::string_view line) { return is_entry(line, 4, parse_integer); }

/// Adds the entry of a line "row column value" with blanks or commas between, rows and columns from
/// 1 to n; `limit` describes the source of n.
void add_triple(SymmetricEntries& entries, TextSource& source, std::string_view line,
                Fields& fields, int n, const std::string& limit) {
  split_blanks(line, fields);
  if (fields.size() != 3)
    return source.error(ErrorCode::wrong_count, "the line is not row, column and value");
  const std::optional<int> row = parse_label(fields[0]), column = parse_label(fields[1]);
  const std::optional<double> value = parse_real(fields[2]);
  if (!row || !column)
    source.error(ErrorCode::not_a_number, "{}: {}", !row ? "row" : "column",
                 not_an_integer(!row ? fields[0] : fields[1]));
  if (!value) source.error(ErrorCode::not_a_number, "value: " + not_a_real(fields[2]));
  if (!row || !column || !value) return;
  if (*row > n || *column > n)
    return source.error(ErrorCode::out_of_range, "row {}, column {} is outside: {}", *row, *column,
                        limit);
  entries.add(*row - 1, *column - 1, *value);
}

/// Lines that begin with % or * are ignored.
SymmetricEntries read_triples(TextSource& source, const std::string& what, int n,
                              const std::string& map) {
  SymmetricEntries entries(source, what);
  const std::string limit = fmt::format("{} has {} degrees of freedom", map, n);
  Fields fields;
  each_line(source, "%*",
            [&](std::string_view line) { add_triple(entries, source, line, fields, n, limit); });
  if (entries.size() == 0)
    source.error(ErrorCode::missing, FeSource{0, 0}, "the {} has no entries", what);
  return entries;
}

/// Degrees of freedom in the order in which they are met.
class LabelTable {
 public:
  int row(int node, int direction, const FeSource& at) {
    const auto [it, added] =
        row_.emplace(std::pair(node, direction), static_cast<int>(labels.size()));
    if (added) labels.push_back({node, direction, at});
    return it->second;
  }
  std::vector<DofLabel> labels;

 private:
  std::map<std::pair<int, int>, int> row_;
};

/// Adds the entry of a line "node, direction, node, direction, value".
void add_quintuple(SymmetricEntries& entries, TextSource& source, const Fields& fields,
                   LabelTable& table) {
  if (fields.size() != 5)
    return source.error(ErrorCode::wrong_count,
                        "the line has {} fields, expected node, direction, node, direction, value",
                        fields.size());
  std::array<int, 4> number{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::optional<int> value = parse_integer(fields[k]);
    if (!value)
      return source.error(ErrorCode::not_a_number, "label {}: {}", k + 1,
                          not_an_integer(fields[k]));
    number[k] = *value;
  }
  const std::optional<double> value = parse_real(fields[4]);
  if (!value) return source.error(ErrorCode::not_a_number, "value: " + not_a_real(fields[4]));
  for (const std::size_t k : {0, 2}) {
    if (number[k] < 1)
      source.stop(ErrorCode::unsupported, source.here(),
                  "node {} is internal to Abaqus (Lagrange multipliers of distributing couplings, "
                  "connectors or hybrid elements): write the matrices without them and give the "
                  "interfaces here",
                  number[k]);
    if (number[k + 1] < 1 || number[k + 1] > 6)
      return source.error(ErrorCode::out_of_range, "direction {} of node {}: expected 1 to 6",
                          number[k + 1], number[k]);
  }
  const FeSource at = source.here();
  const int row = table.row(number[0], number[1], at);
  entries.add(row, table.row(number[2], number[3], at), *value);
}

SymmetricEntries read_quintuples(TextSource& source, const std::string& what, LabelTable& table) {
  SymmetricEntries entries(source, what);
  Fields fields;
  each_line(source, "*", [&](std::string_view line) {
    split_blanks(line, fields);
    add_quintuple(entries, source, fields, table);
  });
  if (entries.size() == 0 && what != "damping")
    source.error(ErrorCode::missing, FeSource{0, 0}, "the {} has no entries", what);
  source.throw_if_any();
  return entries;
}

/// The banner of Matrix Market; an error if the matrix cannot be read.
void read_banner(TextSource& source) {
  std::string_view line;
  Fields words;
  if (source.next(line)) split_blanks(line, words);
  if (words.size() != 5 || !same_word(words[0], "%%MatrixMarket"))
    source.stop(ErrorCode::wrong_file, source.here(),
                "the first line is not '%%MatrixMarket matrix coordinate real symmetric'");
  const std::vector<std::string_view> known[] = {
      {"matrix"}, {"coordinate"}, {"real", "integer"}, {"symmetric", "general"}};
  for (std::size_t k = 0; k < 4; ++k)
    if (std::none_of(known[k].begin(), known[k].end(),
                     [&](std::string_view word) { return same_word(words[k + 1], word); }))
      source.stop(ErrorCode::wrong_value, source.here(), "the banner gives {}, expected {}",
                  shown(words[k + 1]), fmt::join(known[k], " or "));
}

SymmetricEntries read_market(TextSource& source, const std::string& what, int n,
                             const std::string& map) {
  SymmetricEntries entries(source, what);
  read_banner(source);
  const std::string limit = fmt::format("the matrix is {} x {}", n, n);
  Fields fields;
  std::optional<int> count;
  int found = 0;
  FeSource at;
  each_line(source, "%", [&](std::string_view line) {
    if (count) {
      ++found;
      return add_triple(entries, source, line, fields, n, limit);
    }
    split_blanks(line, fields);
    std::array<std::optional<int>, 3> size;
    for (std::size_t k = 0; k < 3 && fields.size() == 3; ++k) size[k] = parse_integer(fields[k]);
    if (!size[0] || !size[1] || !size[2])
      source.stop(
          ErrorCode::wrong_count, source.here(),
          "the line is not rows, columns and number of entries, whole numbers up to 2147483647");
    if (size[0] != n || size[1] != n)
      source.stop(ErrorCode::wrong_count, source.here(),
                  "the {} is {} x {}, but {} has {} degrees of freedom", what, *size[0], *size[1],
                  map, n);
    count = size[2];
    at = source.here();
  });
  if (!count)
    source.error(ErrorCode::missing,
                 "the line with rows, columns and number of entries is missing");
  if (count && found != *count)
    source.error(ErrorCode::wrong_count, at, "the {} has {} entries, expected {}", what, found,
                 *count);
  return entries;
}

/// The entries of a matrix of n rows; `map` is the file that defines n.
using ReadEntries = SymmetricEntries (*)(TextSource& source, const std::string& what, int n,
                                         const std::string& map);

/// With `mass_diagonal` the mass must have its whole diagonal.
FeModel read_with_map(const MatrixTexts& texts, FeModel nodes, bool mass_diagonal,
                      ReadEntries read) {
  const std::vector<DofLabel> labels = read_dof_labels(texts.rows);
  texts.rows.throw_if_any();
  const int n = static_cast<int>(labels.size());
  const std::vector<std::string> names = dof_names(labels);
  return matrix_model_of(
      texts, std::move(nodes), labels, [&](TextSource& source, const std::string& what) {
        SymmetricEntries entries = read(source, what, n, texts.rows.files().front());
        source.throw_if_any();
        return entries.finish(n, names, what == "stiffness" || (what == "mass" && mass_diagonal));
      });
}

}  // namespace

bool looks_like_calculix_matrix(std::string_view beginning) {
  const std::string_view line = first_line(beginning, "");
  std::string_view rest = line;
  return is_triple(line) && line.find(',') == std::string_view::npos && next_word(rest) == "1" &&
         next_word(rest) == "1";
}

bool looks_like_abaqus_matrix(std::string_view beginning) {
  const std::string_view line = first_line(beginning, "*");
  return is_quintuple(line) || (is_triple(line) && !looks_like_calculix_matrix(beginning));
}

bool looks_like_matrix_market(std::string_view beginning) {
  return begins_with(beginning, "%%MatrixMarket");
}

FeModel read_calculix_matrices(TextSource& stiffness, TextSource& mass, TextSource& dofs,
                               FeModel nodes, TextSource* damping) {
  return read_with_map({stiffness, mass, damping, dofs}, std::move(nodes), true, read_triples);
}

FeModel read_matrix_market(TextSource& stiffness, TextSource& mass, TextSource& dofs, FeModel nodes,
                           TextSource* damping) {
  return read_with_map({stiffness, mass, damping, dofs}, std::move(nodes), false, read_market);
}

FeModel read_abaqus_matrices(TextSource& stiffness, TextSource& mass, TextSource* dofs,
                             FeModel nodes, TextSource* damping) {
  if (dofs != nullptr)
    return read_with_map({stiffness, mass, damping, *dofs}, std::move(nodes), false, read_triples);
  LabelTable table;
  std::vector<std::string> names;
  return matrix_model_of({stiffness, mass, damping, stiffness}, std::move(nodes), table.labels,
                         [&](TextSource& source, const std::string& what) {
                           SymmetricEntries entries = read_quintuples(source, what, table);
                           if (what == "stiffness") names = dof_names(table.labels);
                           if (table.labels.size() > names.size()) {
                             const DofLabel& label = table.labels[names.size()];
                             source.stop(ErrorCode::not_found, label.at,
                                         "degree of freedom {}.{} is not in the stiffness",
                                         label.node, label.direction);
                           }
                           return entries.finish(static_cast<int>(names.size()), names,
                                                 what == "stiffness");
                         });
}

FeModel read_calculix_matrices(const std::filesystem::path& file, const FeReadOptions& options) {
  const std::filesystem::path stem = stem_of(file);
  return read_matrix_files(file, options,
                           {.stiffness = {with_ending(stem, ".sti")},
                            .mass = {with_ending(stem, ".mas")},
                            .dofs = {{with_ending(stem, ".dof")}},
                            .nodes = {with_ending(stem, ".inp"), with_ending(stem, ".csv")}},
                           [](TextSource& stiffness, TextSource& mass, TextSource* dofs,
                              FeModel nodes, TextSource* damping) {
                             return read_calculix_matrices(stiffness, mass, *dofs, std::move(nodes),
                                                           damping);
                           });
}

FeModel read_abaqus_matrices(const std::filesystem::path& file, const FeReadOptions& options) {
  // arm_STIF2.mtx goes with arm_MASS2.mtx, optionally arm_DMPV2.mtx, and arm.inp.
  const std::filesystem::path job = before_word(file, "_STIF");
  MatrixPlaces places{.mass = {with_ending(with_word(file, "STIF", "MASS"), ".mtx")},
                      .nodes = {with_ending(job, ".inp"), with_ending(job, "_nodes.csv")}};
  if (is_triple(first_line(read_beginning(file, 65536), "*")))
    places.dofs = {with_ending(job, "_dofs.csv")};
  FeModel (*const read)(TextSource&, TextSource&, TextSource*, FeModel, TextSource*) =
      read_abaqus_matrices;
  return read_matrix_files(file, options, places, read);
}

FeModel read_matrix_market(const std::filesystem::path& file, const FeReadOptions& options) {
  const std::filesystem::path stem = stem_of(file), mass = with_letter(stem, 'M');
  std::string begin = stem.string();
  if (!mass.empty()) begin.resize(begin.size() - 2);
  return read_matrix_files(
      file, options,
      {.mass = {with_ending(mass, ".mtx")},
       .dofs = {{with_ending(begin, "_dofs.csv"), with_ending(stem, ".mapping")}},
       .nodes = {with_ending(begin, "_nodes.csv"), with_ending(begin, ".inp")}},
      [](TextSource& stiffness, TextSource& mass_source, TextSource* dofs, FeModel nodes,
         TextSource* damping) {
        return read_matrix_market(stiffness, mass_source, *dofs, std::move(nodes), damping);
      });
}

}  // namespace floatframe
