#include "floatframe/yaml/csv_file.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "floatframe/core/ascii.hpp"
#include "floatframe/yaml/expression.hpp"

namespace floatframe {
namespace {

std::string_view csv_trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The first of `ends` that is not within quotes.
std::size_t find_unquoted(std::string_view text, std::string_view ends) {
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '"') quoted = !quoted;
    if (!quoted && ends.find(text[k]) != std::string_view::npos) return k;
  }
  return std::string_view::npos;
}

/// A blank separates like any number of blanks and tabs.
std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> out;
  const std::string_view ends =
      separator == ' ' ? std::string_view(" \t") : std::string_view(&separator, 1);
  for (;;) {
    const std::size_t end = find_unquoted(line, ends);
    std::string_view cell = csv_trimmed(line.substr(0, end));
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
      cell = csv_trimmed(cell.substr(1, cell.size() - 2));
    out.push_back(cell);
    if (end == std::string_view::npos) return out;
    line.remove_prefix(end + 1);
    if (separator == ' ') line = csv_trimmed(line);
  }
}

/// A single comma, with a digit before and behind it.
bool has_decimal_comma(std::string_view cell) {
  const std::size_t k = cell.find(',');
  return k != std::string_view::npos && k > 0 && k + 1 < cell.size() && is_digit(cell[k - 1]) &&
         is_digit(cell[k + 1]) && cell.find_first_of(",.", k + 1) == std::string_view::npos;
}

std::optional<double> csv_number(std::string_view cell, bool comma) {
  std::string text(cell);
  if (comma) {
    if (text.find('.') != std::string::npos) return std::nullopt;
    std::replace(text.begin(), text.end(), ',', '.');
  }
  const PlainScalar p = classify_plain_scalar(text);
  return p.kind == PlainScalar::Kind::number ? std::optional(p.number) : std::nullopt;
}

bool is_csv_name(std::string_view cell) {
  const PlainScalar::Kind kind = classify_plain_scalar(cell).kind;
  return kind != PlainScalar::Kind::number && kind != PlainScalar::Kind::bad_number &&
         !has_decimal_comma(cell);
}

struct CsvLine {
  std::string_view content;
  int number = 0;
};

/// Without comments and empty lines.
std::vector<CsvLine> csv_lines(std::string_view rest) {
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);
  std::vector<CsvLine> out;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    std::string_view content = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    content = csv_trimmed(content.substr(0, find_unquoted(content, "#")));
    if (!content.empty()) out.push_back({content, line});
  }
  return out;
}

class CsvParser {
 public:
  CsvParser(CsvFile& file, DecimalSign sign)
      : file_(file), sign_(sign), all_(csv_lines(file.text)) {}

  void parse() {
    if (all_.empty()) return;
    // The first row of numbers decides; above it are at most two lines, of names and of units.
    std::size_t first = 0;
    while (first < std::min<std::size_t>(all_.size(), 3) && !has_number(all_[first].content))
      ++first;
    if (first == std::min<std::size_t>(all_.size(), 3)) first = 0;
    file_.separator = separator_of(all_[first].content);
    std::size_t begin = 0;
    while (begin < std::min<std::size_t>(all_.size(), 2) && is_words(all_[begin].content)) ++begin;
    if (begin < all_.size()) file_.columns = cells_of(all_[begin].content, file_.separator).size();
    if (begin > 0) read_names(all_.front().content);
    if (begin == all_.size()) file_.columns = file_.names.size();
    for (std::size_t k = begin; k < all_.size() && file_.uneven == 0; ++k) add(all_[k]);
  }

 private:
  char separator_of(std::string_view line) const {
    if (find_unquoted(line, ";") != std::string_view::npos) return ';';
    const char blank = find_unquoted(line, "\t") != std::string_view::npos ? '\t' : ' ';
    if (sign_ == DecimalSign::comma) return blank;
    if (sign_ == DecimalSign::automatic) {
      // Decimal commas between blanks: no cell is a number otherwise.
      const std::vector<std::string_view> words = cells_of(line, blank);
      if (words.size() > 1 && std::all_of(words.begin(), words.end(), [](std::string_view word) {
            return has_decimal_comma(word) || word.find(',') == std::string_view::npos;
          }))
        return blank;
    }
    return find_unquoted(line, ",") != std::string_view::npos ? ',' : blank;
  }

  std::optional<double> number(std::string_view cell, char separator) const {
    const bool comma = sign_ == DecimalSign::comma || (sign_ == DecimalSign::automatic &&
                                                       separator != ',' && has_decimal_comma(cell));
    return csv_number(cell, comma);
  }

  bool has_number(std::string_view line) const {
    const char separator = separator_of(line);
    const std::vector<std::string_view> words = cells_of(line, separator);
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return number(word, separator).has_value(); });
  }

  bool is_words(std::string_view line) const {
    const std::vector<std::string_view> words = cells_of(line, file_.separator);
    return std::all_of(words.begin(), words.end(), is_csv_name);
  }

  /// Separated as the columns, or otherwise if that gives their number.
  void read_names(std::string_view line) {
    for (const char separator : {file_.separator, '\t', ';', ','}) {
      const std::vector<std::string_view> words = cells_of(line, separator);
      if (!file_.names.empty() && words.size() != file_.columns) continue;
      file_.names.assign(words.begin(), words.end());
      if (words.size() == file_.columns) return;
    }
  }

  void add(const CsvLine& line) {
    const std::vector<std::string_view> words = cells_of(line.content, file_.separator);
    if (words.size() != file_.columns) {
      file_.uneven_line = line.number;
      file_.uneven = words.size();
      return;
    }
    for (const std::string_view word : words) {
      const std::optional<double> x = number(word, file_.separator);
      file_.numbers.push_back(x.value_or(std::numeric_limits<double>::quiet_NaN()));
      if (!x) continue;
      file_.commas = file_.commas || word.find(',') != std::string_view::npos;
      file_.points = file_.points || word.find('.') != std::string_view::npos;
    }
    file_.lines.push_back(line.number);
    file_.starts.push_back(line.content.data() - file_.text.data());
  }

  CsvFile& file_;
  DecimalSign sign_;
  std::vector<CsvLine> all_;
};

/// "F [N]" and "F (N)" without the unit.
std::string_view without_unit(std::string_view name) {
  if (name.empty() || (name.back() != ']' && name.back() != ')')) return name;
  return csv_trimmed(name.substr(0, name.find_last_of(name.back() == ']' ? '[' : '(')));
}

}  // namespace

std::string CsvFile::cell(std::size_t row, std::size_t column) const {
  std::string_view line = std::string_view(text).substr(starts[row]);
  line = csv_trimmed(line.substr(0, line.find('\n')));
  line = line.substr(0, find_unquoted(line, "#"));
  return std::string(cells_of(csv_trimmed(line), separator)[column]);
}

std::vector<std::size_t> CsvFile::columns_of(const std::string& name) const {
  std::vector<std::size_t> exact, otherwise;
  for (std::size_t k = 0; k < std::min(names.size(), columns); ++k) {
    if (names[k] == name) exact.push_back(k);
    if (without_unit(names[k]) == name) otherwise.push_back(k);
  }
  return exact.empty() ? otherwise : exact;
}

CsvFile parse_csv(std::string text, DecimalSign sign) {
  CsvFile file;
  file.text = std::move(text);
  CsvParser(file, sign).parse();
  return file;
}

}  // namespace floatframe
