#include "floatframe/decks/ansys/ansys_fields.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

bool begins_command(std::string_view line) noexcept {
  return !line.empty() && (std::isalpha(static_cast<unsigned char>(line[0])) != 0 ||
                           line[0] == '/' || line[0] == '*' || line[0] == '!' || line[0] == '_');
}

/// Widths and counts beyond this are no format.
constexpr int widest = 1000;

std::optional<int> leading_number(std::string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && text[n] >= '0' && text[n] <= '9') ++n;
  const auto value = parse_integer(text.substr(0, n));
  text.remove_prefix(n);
  return value;
}

/// Null if the text is not a format of integers, reals and texts with their widths.
std::optional<FortranColumns> parse_fortran_columns(std::string_view text) {
  text = trimmed(text);
  if (text.size() < 2 || text.front() != '(' || text.back() != ')') return std::nullopt;
  std::vector<std::string_view> items;
  split_commas(text.substr(1, text.size() - 2), items);
  FortranColumns result;
  for (std::string_view item : items) {
    auto count = leading_number(item);
    if (!item.empty() && (item[0] == 'P' || item[0] == 'p')) {  // a scale factor
      item = trimmed(item.substr(1));
      if (item.empty()) continue;
      count = leading_number(item);
    }
    if (item.empty() || count.value_or(1) < 1 || count.value_or(1) > widest) return std::nullopt;
    const char kind = lower_case(item.substr(0, 1))[0];
    item.remove_prefix(1);
    const auto width = leading_number(item);  // followed by decimals
    if (std::string_view("iadefg").find(kind) == std::string_view::npos || !width || *width < 1 ||
        *width > widest || result.columns.size() > static_cast<std::size_t>(widest))
      return std::nullopt;
    result.columns.insert(result.columns.end(), count.value_or(1), {kind, *width});
  }
  if (result.columns.empty()) return std::nullopt;
  return result;
}

}  // namespace

bool AnsysFields::next() {
  while (true) {
    if (!waiting_.empty()) {
      const std::string command = std::move(waiting_.back());
      waiting_.pop_back();
      split(command);
      return true;
    }
    std::string_view raw;
    if (!source_.next(raw)) return false;
    at_ = source_.here();
    std::string_view text = trimmed(raw);
    // Titles may hold any character.
    if (begins_with(text, "/COM") || begins_with(text, "C***")) continue;
    if (begins_with(text, "/TIT")) {
      split("/TITLE");
      return true;
    }
    text = trimmed(text.substr(0, text.find('!')));
    if (text.empty()) continue;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('$', begin), text.size());
      if (const auto part = trimmed(text.substr(begin, end - begin)); !part.empty())
        waiting_.emplace_back(part);
      begin = end + 1;
    }
    std::reverse(waiting_.begin(), waiting_.end());
  }
}

void AnsysFields::split(std::string_view command) {
  line_ = command;
  split_commas(line_, fields_);
  command_ = upper_case(fields_.empty() ? std::string_view{} : fields_[0]);
}

bool AnsysFields::is(std::string_view name) const noexcept {
  if (name.front() == '/' || name.front() == '*' || name.size() <= 4 || command_.size() < 4)
    return command_ == name;
  return std::string_view(command_).substr(0, 4) == name.substr(0, 4);
}

std::string_view AnsysFields::text(std::size_t k) const noexcept {
  return k < fields_.size() ? fields_[k] : std::string_view{};
}

std::string AnsysFields::word(std::size_t k) const { return upper_case(text(k)); }

void AnsysFields::set_parameter(std::string_view name, std::optional<double> value) {
  parameters_[upper_case(trimmed(name))] = value;
}

std::optional<double> AnsysFields::number(std::size_t k) const {
  if (const auto value = parse_real(text(k))) return value;
  const auto it = parameters_.find(upper_case(text(k)));
  return it == parameters_.end() ? std::nullopt : it->second;
}

double AnsysFields::real(std::size_t k, const char* what, double missing) {
  if (blank(k)) return missing;
  const auto value = number(k);
  if (!value)
    stop(ErrorCode::unsupported,
         "{}: {}: {}; expressions and parameters that no *SET gives as a number are not read",
         command_, what, not_a_real(text(k)));
  return *value;
}

int AnsysFields::integer(std::size_t k, const char* what, int missing) {
  if (blank(k)) return missing;
  const double value = real(k, what);
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    stop(ErrorCode::not_a_number, "{}: {}: {}", command_, what, not_an_integer(text(k)));
  return static_cast<int>(value);
}

int AnsysFields::label(std::size_t k, const char* what) {
  const int value = integer(k, what);
  if (value < 1)
    stop(ErrorCode::missing, "{}: {}: {}, expected a number of 1 or more", command_, what,
         blank(k) ? std::string("the field is empty") : shown(text(k)));
  return value;
}

std::vector<double> AnsysFields::reals(std::size_t first, const char* what) {
  std::vector<double> values;
  for (std::size_t k = first; k < size(); ++k) values.push_back(real(k, what));
  return values;
}

Vec3 AnsysFields::three(std::size_t first, const char* what) {
  return {real(first, what), real(first + 1, what), real(first + 2, what)};
}

FortranColumns AnsysFields::columns() {
  std::string_view line;
  if (!source_.next(line))
    source_.stop(ErrorCode::damaged, at_, "the file ends where the format of {} is expected",
                 command_);
  const auto format = parse_fortran_columns(line);
  if (!format)
    source_.stop(ErrorCode::wrong_value, "{}: a format like (3i9,6e21.13e3) is expected, found {}",
                 command_, shown(trimmed(line)));
  return *format;
}

bool AnsysFields::block_line(std::string_view& line) {
  while (source_.next(line)) {
    const std::string_view text = trimmed(line);
    if (text.empty()) continue;
    if (!begins_command(text)) return true;
    source_.put_back();
    return false;
  }
  if (command_ == "NBLOCK" || command_ == "EBLOCK")
    source_.stop(
        ErrorCode::damaged,
        "the file ends within {}, which begins in line {} and ends with -1: it is cut short",
        command_, at_.line);
  return false;
}

bool AnsysFields::row(const FortranColumns& format) {
  std::string_view line;
  if (!block_line(line)) return false;
  cells_.clear();
  if (trimmed(line) == "-1") return false;
  if (!format.split(line, cells_).empty())
    source_.stop(ErrorCode::wrong_count,
                 "{}: the line is longer than its format, which has {} columns", command_,
                 format.columns.size());
  while (!cells_.empty() && cells_.back().empty()) cells_.pop_back();
  return true;
}

bool AnsysFields::loose_row() {
  std::string_view line;
  if (!block_line(line)) return false;
  const bool commas = line.find(',') != std::string_view::npos;
  (commas ? split_commas : split_blanks)(line, cells_);
  return true;
}

void AnsysFields::skip_block() {
  std::string_view line;
  while (block_line(line)) {
  }
}

template <class Value>
Value AnsysFields::cell(std::size_t k, const char* what,
                        std::optional<Value> (*parse)(std::string_view),
                        std::string (*wrong)(std::string_view)) {
  if (k >= cells_.size() || cells_[k].empty()) return 0;
  const auto value = parse(cells_[k]);
  if (!value) source_.stop(ErrorCode::not_a_number, "{}: {}: {}", command_, what, wrong(cells_[k]));
  return *value;
}

int AnsysFields::cell_integer(std::size_t k, const char* what) {
  return cell<int>(k, what, parse_integer, not_an_integer);
}

double AnsysFields::cell_real(std::size_t k, const char* what) {
  return cell<double>(k, what, parse_real, not_a_real);
}

void AnsysFields::append_cells(std::size_t first, const char* what, std::vector<int>& out) {
  for (std::size_t k = first; k < cells(); ++k) out.push_back(cell_integer(k, what));
}

void AnsysFields::append_cells(std::size_t first, const char* what, std::vector<double>& out) {
  for (std::size_t k = first; k < cells(); ++k) out.push_back(cell_real(k, what));
}

std::size_t FortranColumns::integers() const noexcept {
  std::size_t n = 0;
  while (n < columns.size() && columns[n].first == 'i') ++n;
  return n;
}

std::string_view FortranColumns::split(std::string_view line,
                                       std::vector<std::string_view>& cells) const {
  cells.clear();
  for (const auto& [kind, width] : columns) {
    if (line.empty()) break;
    cells.push_back(trimmed(line.substr(0, width)));
    line.remove_prefix(std::min<std::size_t>(width, line.size()));
  }
  return trimmed(line);
}

}  // namespace floatframe
