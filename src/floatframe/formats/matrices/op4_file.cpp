// A matrix is a header (columns, rows, form, type, name; rows negative: large strings), records of
// columns in ascending order, and one of a column after the last. A column: its number, its first
// row, how many words follow, and values; with row 0 strings of values, each headed by
//   one number   first row + 65536 (words + 1), or
//   two numbers  words + 1, first row         where strings are large.
// A value has one word, two in double precision, twice as many if it is complex.
#include "floatframe/formats/matrices/op4_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>

#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"

namespace floatframe {
namespace {

constexpr std::uint32_t op4_header_bytes = 24;
constexpr int most_op4_rows = 10'000'000;

int words_of(int type) { return type == 1 ? 1 : type == 4 ? 4 : 2; }

/// True if the matrix has large strings.
bool check_header(Op4Matrix& m, const SourceMark& at) {
  const bool large = m.rows < 0;
  m.rows = large ? -std::max(m.rows, -most_op4_rows) : m.rows;
  if (m.columns < 1 || m.columns > most_op4_rows || m.rows < 1 || m.rows > most_op4_rows ||
      m.type < 1 || m.type > 4)
    throw InputError(ErrorCode::wrong_count, at,
                     fmt::format("a matrix has {} columns, {} rows and type {}, expected positive "
                                 "numbers and a type of 1 to 4",
                                 m.columns, m.rows, m.type));
  return large;
}

/// Keeps values of a column from a row on.
template <class Value>
void keep(Op4Matrix& m, int column, int row, int count, const SourceMark& at, Value&& value) {
  if (row < 1 || count > m.rows || row - 1 > m.rows - count)
    throw InputError(ErrorCode::wrong_count, at,
                     fmt::format("column {} of {} has {} values from row {} on, but {} rows",
                                 column, m.name, count, row, m.rows));
  if (!m.real_square()) return;
  for (int i = 0; i < count; ++i)
    if (const double x = value(i); x != 0.0) m.entries.emplace_back(row - 1 + i, column - 1, x);
}

class BinaryOp4 {
 public:
  BinaryOp4(std::string_view bytes, bool swapped, std::string file)
      : bytes_(bytes), swapped_(swapped), at_{std::move(file)} {}

  std::vector<Op4Matrix> read() {
    std::vector<Op4Matrix> out;
    while (place_ < bytes_.size()) {
      record();
      if (record_.size() != op4_header_bytes)
        fail(ErrorCode::damaged, "the header of a matrix has another length than 24");
      Op4Matrix m{upper_case(trimmed(record_.substr(16, 8))),
                  integer(1),
                  integer(0),
                  integer(2),
                  integer(3),
                  {}};
      large_ = check_header(m, at_);
      while (column(m)) {
      }
      out.push_back(std::move(m));
    }
    return out;
  }

 private:
  [[noreturn]] void fail(ErrorCode code, const std::string& what) const {
    throw InputError(code, at_, fmt::format("byte {}: {}", place_, what));
  }
  std::uint32_t word(std::string_view from, std::size_t at) const {
    if (at + 4 > from.size()) fail(ErrorCode::damaged, "the file ends within a record");
    std::uint32_t w = 0;
    std::memcpy(&w, from.data() + at, 4);
    return swapped_ ? __builtin_bswap32(w) : w;
  }
  int integer(std::size_t i) const { return std::bit_cast<int>(word(record_, 4 * i)); }
  void record() {
    const std::size_t length = word(bytes_, place_);
    if (length > bytes_.size() - place_ - 4)
      fail(ErrorCode::damaged, "the file ends within a record");
    record_ = bytes_.substr(place_ + 4, length);
    if (word(bytes_, place_ + 4 + length) != length)
      fail(ErrorCode::damaged, "a record does not end as it began");
    place_ += length + 8;
  }
  double value(int type, std::size_t first_word, int i) const {
    if (type == 1) return std::bit_cast<float>(word(record_, 4 * (first_word + i)));
    const std::size_t at = 4 * (first_word + 2 * i);
    std::uint64_t a = word(record_, at), b = word(record_, at + 4);
    if (swapped_ != (std::endian::native == std::endian::big)) std::swap(a, b);
    return std::bit_cast<double>(a | b << 32);
  }
  /// False at the record behind the last column.
  bool column(Op4Matrix& m) {
    record();
    const int number = integer(0), row = integer(1);
    if (number > m.columns) return false;
    if (number < 1)
      fail(ErrorCode::out_of_range, fmt::format("a column has the number {}", number));
    const int words = std::min<int>(most_op4_rows, std::ssize(record_) / 4);
    const auto values = [&](int first, int count, int from) {
      keep(m, number, from, count / words_of(m.type), at_,
           [&](int i) { return value(m.type, first, i); });
    };
    if (row > 0) {
      values(3, words - 3, row);
      return true;
    }
    for (int at = 3; at < words;) {
      const int head = integer(at++);
      const int length = large_ ? std::max(head, 0) - 1 : head / 65536 - 1;
      const int from = large_ ? integer(at++) : head % 65536;
      if (length < 1 || length > words - at)
        fail(ErrorCode::damaged,
             fmt::format("a string of column {} is longer than its record", number));
      values(at, length, from);
      at += length;
    }
    return true;
  }

  std::string_view bytes_, record_;
  bool swapped_, large_ = false;
  std::size_t place_ = 0;
  SourceMark at_;
};

class TextOp4 {
 public:
  TextOp4(std::string_view text, std::string file) : text_(text), at_{std::move(file)} {}

  std::vector<Op4Matrix> read() {
    std::vector<Op4Matrix> out;
    while (next()) {
      const std::array<int, 4> size = integers<4>();
      if (line_.size() < 40) fail(ErrorCode::damaged, "the header of a matrix is too short");
      Op4Matrix m{upper_case(trimmed(line_.substr(32, 8))), size[1], size[0], size[2], size[3], {}};
      // 1P,5E16.9
      const std::string_view format = trimmed(line_.substr(40));
      const std::size_t e = format.find_first_of("EDed"), dot = format.find('.');
      const auto width = e < dot && dot != std::string_view::npos
                             ? parse_label(format.substr(e + 1, dot - e - 1))
                             : std::optional<int>(16);
      if (!width)
        fail(ErrorCode::wrong_value, fmt::format("{} is no format of numbers", shown(format)));
      width_ = *width;
      large_ = check_header(m, at_);
      while (column(m)) {
      }
      out.push_back(std::move(m));
    }
    return out;
  }

 private:
  [[noreturn]] void fail(ErrorCode code, const std::string& what) const {
    throw InputError(code, at_, what);
  }
  /// The next line that is not empty.
  bool next() {
    for (line_ = {}; line_.empty(); ++at_.line) {
      if (rest_ >= text_.size()) return false;
      const std::size_t end = std::min(text_.find('\n', rest_), text_.size());
      line_ = text_.substr(rest_, end - rest_);
      while (!line_.empty() && (line_.back() == '\r' || line_.back() == ' '))
        line_.remove_suffix(1);
      rest_ = end + 1;
    }
    return true;
  }
  /// In fields of eight columns; a number by itself may be wider.
  template <std::size_t n>
  std::array<int, n> integers() const {
    constexpr std::size_t width = n == 1 ? std::string_view::npos : 8;
    std::array<int, n> out{};
    for (std::size_t i = 0; i < n; ++i) {
      const std::string_view field =
          trimmed(line_.substr(std::min(8 * i, line_.size())).substr(0, width));
      const auto value = parse_integer(field);
      if (!value) fail(ErrorCode::not_a_number, not_an_integer(field));
      out[i] = *value;
    }
    return out;
  }
  /// The values of the following lines, up to one without a decimal point.
  void values() {
    values_.clear();
    while (rest_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', rest_), text_.size());
      const std::string_view ahead = text_.substr(rest_, end - rest_);
      const bool header = ahead.find(',') != std::string_view::npos;
      if (header || ahead.find('.') == std::string_view::npos || !next()) return;
      for (std::size_t i = 0; i < line_.size(); i += width_) {
        const std::string_view field = trimmed(line_.substr(i, width_));
        const auto value = parse_real(field);
        if (!value) fail(ErrorCode::not_a_number, not_a_real(field));
        values_.push_back(*value);
      }
    }
  }
  bool column(Op4Matrix& m) {
    if (!next()) fail(ErrorCode::damaged, "the file ends within a matrix");
    const auto [number, row, words] = integers<3>();
    const SourceMark at = at_;
    const auto take = [&, number = number](int from, int count) {
      values();
      const int found = static_cast<int>(values_.size()) / (m.type > 2 ? 2 : 1);
      if (number <= m.columns && count != found)
        throw InputError(ErrorCode::wrong_count, at,
                         fmt::format("column {} of {} has {} values, expected {}", number, m.name,
                                     found, count));
      if (number <= m.columns) keep(m, number, from, count, at, [&](auto i) { return values_[i]; });
    };
    if (number < 1)
      fail(ErrorCode::out_of_range, fmt::format("a column has the number {}", number));
    if (row > 0) {  // counts real numbers, and real and imaginary parts
      take(row, std::max(words, 0) / (m.type > 2 ? 2 : 1));
      return number <= m.columns;
    }
    for (int left = words; left > 0;) {
      if (!next()) fail(ErrorCode::damaged, "the file ends within a matrix");
      const auto head = large_ ? integers<2>() : std::array<int, 2>{integers<1>()[0], 0};
      const int length = large_ ? std::max(head[0], 0) - 1 : head[0] / 65536 - 1;
      if (length < 1)
        fail(ErrorCode::damaged, fmt::format("a string of column {} has {} words", number, length));
      left -= length + (large_ ? 2 : 1);
      take(large_ ? head[1] : head[0] % 65536, length / words_of(m.type));
    }
    return number <= m.columns;
  }

  std::string_view text_, line_;
  std::size_t rest_ = 0, width_ = 16;
  bool large_ = false;
  SourceMark at_;
  std::vector<double> values_;
};

/// For a binary file its first word: the length of the first record. Else 0.
std::uint32_t first_length(std::string_view bytes) {
  std::uint32_t first = 0;
  if (bytes.size() > op4_header_bytes + 8) std::memcpy(&first, bytes.data(), 4);
  return first == op4_header_bytes || first == __builtin_bswap32(op4_header_bytes) ? first : 0;
}

using Row = std::pair<int, int>;  // node, component; scalar point, 0

/// Components as bits; none: a scalar point.
void add_rows(std::set<Row>& rows, int id, unsigned components) {
  if (id <= 0) return;
  if (components == 0) rows.insert({id, 0});
  for (int c = 1; components != 0; ++c, components >>= 1u)
    if ((components & 1u) != 0) rows.insert({id, c});
}

/// The degrees of freedom that the cards of a superelement give its matrices.
std::vector<DofLabel> rows_of_cards(TextSource& source) {
  std::set<Row> external, analysis, all;
  NastranCards cards(source, has_begin_bulk(source.first_text()), NastranBegin::any);
  NastranCard card;
  while (cards.next(card)) {
    NastranFields f(source, card);
    const std::string& name = card.name;
    const auto add_list = [&](std::set<Row>& rows, std::size_t i, unsigned components) {
      for (; i < f.size(); ++i) {
        if (f.blank(i)) continue;
        const auto [first, last] = f.range(i, "a node or scalar point");
        for (int k = 0; k <= std::min(last - first, 100000); ++k)
          add_rows(rows, first + k, components);
      }
    };
    if (name == "GRID") add_rows(all, f.label(0, "the number of the node"), 63u);
    if (name == "SPOINT") add_list(all, 0, 0);
    if (name == "ASET1" || name == "QSET1")
      add_list(analysis, 1, f.components(0, "the components"));
    if (name != "EXTRN" && name != "ASET" && name != "QSET") continue;
    for (std::size_t i = 0; i < f.size(); i += 2)
      if (!f.blank(i))
        add_rows(name == "EXTRN" ? external : analysis, f.label(i, "a node"),
                 f.components(i + 1, "the components"));
  }
  source.throw_if_any();
  std::vector<DofLabel> labels;
  for (const auto& [id, component] : !external.empty()   ? external
                                     : !analysis.empty() ? analysis
                                                         : all)
    labels.push_back({id, component, {0, 0}});
  return labels;
}

/// The candidate matrices of one letter: real and square, of `size` rows if it is not 0;
/// those with one row represent none. Names used for superelements come first.
const Op4Matrix* choose_op4(const std::vector<Op4Matrix>& matrices, char letter, int size,
                            const std::string& file) {
  std::vector<const Op4Matrix*> found;
  for (const Op4Matrix& m : matrices)
    if (m.name.starts_with(letter) && !m.name.starts_with("K4") && m.real_square() && m.rows > 1 &&
        (size == 0 || m.rows == size))
      found.push_back(&m);
  if (found.empty()) return nullptr;
  for (const char* rest : {"XX", "AA", "AAX"})
    for (const Op4Matrix* m : found)
      if (m->name == letter + std::string(rest)) return m;
  if (found.size() == 1) return found.front();
  std::vector<std::string> names;
  for (const Op4Matrix* m : found) names.push_back(m->name);
  throw InputError(ErrorCode::wrong_value, {file},
                   fmt::format("the file has the matrices {}; expected one whose name begins with "
                               "{}, or {}XX, {}AA or {}AAX",
                               fmt::join(names, ", "), letter, letter, letter, letter));
}

/// Both halves, also of a matrix stored as one.
SparseMatrix whole(const Op4Matrix& m) {
  SparseMatrix A(m.rows, m.rows);
  A.setFromTriplets(m.entries.begin(), m.entries.end());
  const SparseMatrix lower = A.triangularView<Eigen::Lower>(),
                     upper = A.triangularView<Eigen::Upper>();
  if (lower.nonZeros() == A.nonZeros()) return A.selfadjointView<Eigen::Lower>();
  if (upper.nonZeros() == A.nonZeros()) return A.selfadjointView<Eigen::Upper>();
  return A;
}

}  // namespace

bool looks_like_op4(std::string_view beginning) {
  if (first_length(beginning) != 0) return true;
  const std::string_view line = beginning.substr(0, beginning.find('\n'));
  if (line.size() < 42 || !begins_with(trimmed(line.substr(40)), "1P,")) return false;
  for (std::size_t i = 0; i < 32; i += 8)
    if (!parse_integer(trimmed(line.substr(i, 8)))) return false;
  return true;
}

std::vector<Op4Matrix> read_op4_matrices(const std::string& bytes, const std::string& file) {
  if (const std::uint32_t first = first_length(bytes))
    return BinaryOp4(bytes, first != op4_header_bytes, file).read();
  return TextOp4(bytes, file).read();
}

FeModel read_op4(const std::filesystem::path& file, const FeReadOptions& options) {
  const std::string name = file.string();
  const std::vector<Op4Matrix> matrices = read_op4_matrices(read_whole_file(file), name);
  const Op4Matrix* K = choose_op4(matrices, 'K', 0, name);
  const Op4Matrix* M = K == nullptr ? nullptr : choose_op4(matrices, 'M', K->rows, name);
  std::vector<std::string> names;
  for (const Op4Matrix& m : matrices)
    if (m.rows > 1) names.push_back(m.name);  // a single row represents none
  if (M == nullptr)
    throw InputError(
        ErrorCode::missing, {name},
        fmt::format("the file has no real, square {}; its matrices: {}",
                    K == nullptr ? "stiffness K" : "mass M of the size of the stiffness",
                    names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  const Op4Matrix* B = choose_op4(matrices, 'B', K->rows, name);
  const std::filesystem::path nodes = nodes_beside(
      file, options.nodes, {".pch", ".asm", ".bdf", ".dat", ".nas", ".blk", "_nodes.csv"});
  std::filesystem::path dofs = options.dofs;
  if (const auto table = with_ending(stem_of(file), "_dofs.csv");
      dofs.empty() && std::filesystem::exists(table))
    dofs = table;
  TextSource source(dofs.empty() ? nodes : dofs);
  const std::vector<DofLabel> labels =
      dofs.empty() ? rows_of_cards(source) : read_dof_labels(source);
  source.throw_if_any();
  if (std::ssize(labels) != K->rows)
    source.stop(ErrorCode::wrong_count, {0, 0},
                "{} degrees of freedom for matrices of {} rows ({} of {}); give them as the dofs "
                "file, lines \"node,dir\"",
                labels.size(), K->rows, K->name, name);
  FeModel model = matrix_model(read_nodes(nodes), labels, whole(*K), whole(*M), source, {name});
  if (B != nullptr) add_matrix_damping(model, whole(*B), source);
  std::erase_if(names, [&](const std::string& n) {
    return n == K->name || n == M->name || (B != nullptr && n == B->name);
  });
  note_other_matrices(model, name, names);
  return model;
}

}  // namespace floatframe
