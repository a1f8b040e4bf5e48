#include "floatframe/results/results_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>

#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/regular_file.hpp"

namespace floatframe {
namespace {

/// Four times the length of a row with ten thousand channels.
constexpr std::size_t longest_line = std::size_t{1} << 20;  ///< [byte]

bool blank(char c) noexcept { return c == ' ' || c == '\t'; }

/// Reads one field of a header and moves `at` to its end; false: a quote is not closed.
bool read_title(const std::string& line, std::size_t& at, std::string& title) {
  title.clear();
  if (at < line.size() && line[at] == '"') {
    for (++at; at < line.size(); ++at) {
      if (line[at] == '"' && (at + 1 == line.size() || line[at + 1] != '"')) {
        ++at;
        return at == line.size() || line[at] == ',';
      }
      if (line[at] == '"') ++at;
      title += line[at];
    }
    return false;
  }
  while (at < line.size() && line[at] != ',') title += line[at++];
  while (!title.empty() && blank(title.back())) title.pop_back();
  title.erase(0, title.find_first_not_of(" \t"));
  return true;
}

/// "chassis.z [m]"
Column column_of(const std::string& title) {
  const std::size_t bracket = title.rfind(" [");
  if (bracket == std::string::npos || title.back() != ']') return {title, ""};
  return {title.substr(0, bracket), title.substr(bracket + 2, title.size() - bracket - 3)};
}

/// The next number of a line and its comma or end; false if there is none.
bool read_number(const std::string& line, std::size_t& at, bool last, double& value) {
  while (at < line.size() && blank(line[at])) ++at;
  const char* const begin = line.data() + at;
  const char* const end = line.data() + line.size();
  const auto [next, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range)  // denormal numbers: strtod accepts them
    value = std::strtod(begin, nullptr);
  else if (error != std::errc())
    return false;
  std::size_t after = at + static_cast<std::size_t>(next - begin);
  while (after < line.size() && blank(line[after])) ++after;
  if (last) return after == line.size();
  if (after == line.size() || line[after] != ',') return false;
  at = after + 1;
  return true;
}

std::string found_at(const std::string& line, std::size_t at) {
  if (at >= line.size()) return "the end of the line";
  const std::string text = line.substr(at, line.find(',', at) - at);
  return "'" + (text.size() > 40 ? text.substr(0, 40) + "..." : text) + "'";
}

}  // namespace

bool read_numbers(const std::string& line, std::vector<double>& row, std::size_t& column,
                  std::size_t& at) {
  at = 0;
  for (column = 0; column < row.size(); ++column)
    if (!read_number(line, at, column + 1 == row.size(), row[column])) return false;
  return true;
}

ResultsReader::ResultsReader(const std::string& file) : file_(file) {
  std::string beginning;
  if (const std::string why = read_regular_beginning(file, 1, beginning); !why.empty())
    throw InputError(ErrorCode::unreadable, {file_, 0, 0}, why);
  in_.reset(std::fopen(file.c_str(), "rb"));
  if (!in_) throw InputError(ErrorCode::unreadable, {file_, 0, 0}, "the file cannot be opened");
  read_header();
}

void ResultsReader::refuse(ErrorCode code, std::size_t at, const std::string& message) const {
  throw InputError(code, {file_, number_, static_cast<int>(at) + 1}, message);
}

void ResultsReader::read_header() {
  if (!read_line())
    throw InputError(ErrorCode::missing, {file_, 0, 0}, "the file is empty, expected results");
  std::set<std::string> names;
  std::size_t at = line_.starts_with("\xEF\xBB\xBF") ? 3 : 0;  // byte order mark
  while (true) {
    const std::size_t begin = at;
    std::string title;
    if (!read_title(line_, at, title))
      refuse(ErrorCode::damaged, begin, "found a quote that is not closed");
    columns_.push_back(column_of(csv_text(title)));
    const std::string& name = columns_.back().name;
    if (columns_.size() == 1 && name != "time")
      refuse(
          ErrorCode::wrong_value, begin,
          fmt::format("found '{}' as the first column, expected 'time [s]'", name.substr(0, 40)));
    if (!names.insert(name).second)
      refuse(ErrorCode::duplicate, begin,
             fmt::format("found a second column '{}', expected each once", name.substr(0, 100)));
    if (at >= line_.size()) break;
    ++at;
  }
  row_.assign(columns_.size(), 0.0);
}

bool ResultsReader::read_line() {
  line_.clear();
  ++number_;
  ended_ = false;
  for (int c = std::getc(in_.get()); c != EOF; c = std::getc(in_.get())) {
    if (c == '\n') {
      ended_ = true;
      if (!line_.empty() && line_.back() == '\r') line_.pop_back();
      return true;
    }
    if (line_.size() == longest_line)
      refuse(ErrorCode::too_large, 0,
             "found a line of more than 1 MiB, expected comma-separated numbers");
    line_ += static_cast<char>(c);
  }
  if (std::ferror(in_.get()) != 0)
    throw InputError(ErrorCode::unreadable, {file_, 0, 0}, "the file cannot be read");
  return !line_.empty();
}

bool ResultsReader::next() {
  const double before = row_.front();
  do {
    if (!read_line()) return false;
  } while (line_.empty());
  std::size_t at = 0, c = 0;
  if (!read_numbers(line_, row_, c, at)) {
    row_.front() = before;
    torn_ = !ended_;
    if (torn_) return false;
    refuse(ErrorCode::out_of_range, at,
           fmt::format("found {}, expected a number for '{}'{}", found_at(line_, at),
                       columns_[c].name.substr(0, 100),
                       c + 1 == columns_.size() ? " and the end of the line" : ""));
  }
  if (!std::isfinite(time()) || (rows_ > 0 && !(time() > before)))
    refuse(ErrorCode::contradiction, 0,
           fmt::format("found the time {:g}{}, expected {}", time(),
                       rows_ > 0 ? fmt::format(" after {:g}", before) : "",
                       rows_ > 0 ? "a later one" : "a number of seconds"));
  ++rows_;
  return true;
}

}  // namespace floatframe
