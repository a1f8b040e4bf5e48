#include "floatframe/yaml/read_table.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace floatframe {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The cells of a line: separated by semicolons, else by commas, else by blanks.
std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> out;
  const char separator = line.find(';') != std::string_view::npos   ? ';'
                         : line.find(',') != std::string_view::npos ? ','
                                                                    : ' ';
  for (;;) {
    const std::size_t end = separator == ' ' ? line.find_first_of(" \t") : line.find(separator);
    out.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return out;
    line.remove_prefix(end + 1);
    if (separator == ' ') line = trimmed(line);
  }
}

class TableFile {
 public:
  TableFile(const YamlValue& value, const NumberRule& rule, TableRows& out)
      : value_(value), rule_(rule), out_(out) {}

  void read(const std::string& text) {
    std::string_view rest = text;
    if (rest.substr(0, 3) == "\xEF\xBB\xBF") rest.remove_prefix(3);
    bool header = true;  // a header line may still follow
    for (int line = 1; !rest.empty(); ++line) {
      const std::size_t end = rest.find('\n');
      std::string_view content = rest.substr(0, end);
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      content = trimmed(content.substr(0, content.find('#')));
      if (content.empty()) continue;
      if (!row(content, line, header)) out_.good = false;
      header = false;
      if (stop_) return;
    }
  }

 private:
  bool row(std::string_view content, int line, bool header) {
    const std::vector<std::string_view> words = cells(content);
    const TableRow place{{}, line, 1, out_.rows.size() + 1};
    const auto is_name = [](std::string_view word) {
      return classify_plain_scalar(word).kind == PlainScalar::Kind::text;
    };
    if (header && std::all_of(words.begin(), words.end(), is_name)) return true;
    if (words.size() != 2) {
      out_.error(ErrorCode::wrong_count, place,
                 "found " + std::to_string(words.size()) +
                     (words.size() == 1 ? " column" : " columns") + ", expected two");
      stop_ = true;  // the other rows have the same number
      return false;
    }
    double x[2] = {0.0, 0.0};
    for (std::size_t k = 0; k < 2; ++k) {
      const PlainScalar p = classify_plain_scalar(words[k]);
      x[k] = p.number;
      if (p.kind == PlainScalar::Kind::number) continue;
      out_.error(ErrorCode::out_of_range, place,
                 "found '" + std::string(words[k].substr(0, 40)) +
                     "', expected a number with a decimal point" +
                     (p.complaint.empty() ? "" : " (" + p.complaint + ")") +
                     (header ? ", or names in both columns of the first line" : ""));
      return false;
    }
    for (const double v : x)
      if (!rule_.holds(v)) {
        out_.error(ErrorCode::out_of_range, place,
                   "found " + number_text(v) + ", expected " + rule_.expectation());
        return false;
      }
    stop_ = !out_.errors->take_of("rows in all CSV files of tables", 1, limits::table_rows,
                                  value_.mark(), value_.path());
    out_.rows.push_back({{x[0], x[1]}, line, 1, place.number});
    return !stop_;
  }

  const YamlValue& value_;
  const NumberRule& rule_;
  TableRows& out_;
  bool stop_ = false;
};

}  // namespace

void TableRows::error(ErrorCode code, const TableRow& row, const std::string& sentence) const {
  const std::string who = path.empty() ? "" : path + "[" + std::to_string(row.number) + "]: ";
  errors->add(code, {file, row.line, row.column}, who + sentence);
}

TableRows read_table_rows(const YamlValue& value, const NumberRule& rule, const char* point) {
  TableRows out;
  out.errors = value.context().errors;
  const std::string what = std::string("a list of points ") +
                           std::string(point).substr(std::string(point).find('[')) +
                           " or the name of a CSV file";
  if (value.is_list()) {
    out.good = true;
    out.file = *value.context().file;
    out.path = value.path();
    std::size_t number = 0;
    for (const YamlValue& item : value.list()) {
      ++number;
      const auto p = item.numbers(2, 2, rule, point);
      out.good = out.good && p;
      if (p) out.rows.push_back({{(*p)[0], (*p)[1]}, item.mark().line, item.mark().column, number});
    }
    return out;
  }
  const auto name = value.text(what.c_str());
  if (!name) return out;
  out.file = (std::filesystem::path(*value.context().file).parent_path() / *name)
                 .lexically_normal()
                 .string();
  std::string text;
  if (!read_text_file(out.file, text, *out.errors, value.mark(), value.path()) ||
      !out.errors->take_of("characters in all CSV files of tables", text.size(), limits::table_text,
                           value.mark(), value.path()))
    return out;
  out.good = true;
  TableFile(value, rule, out).read(text);
  return out;
}

}  // namespace floatframe
