#include "floatframe/tyres/tir_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <set>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/tyres/tir_keywords.hpp"

namespace floatframe {

namespace {

using Dim = TirDimension;
constexpr std::size_t most_tir_errors = 20, most_tir_notes = 50, longest_keyword = 40;

std::string in_capitals(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
  return out;
}

std::string in_small(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return out;
}

constexpr std::string_view tir_blanks = " \t\r\f\v";

std::string_view trimmed_right(std::string_view text) {
  const std::size_t last = text.find_last_not_of(tir_blanks);
  return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

/// At most thirty characters of what was found.
std::string shown(std::string_view text) {
  constexpr std::size_t most = 30;
  return text.size() <= most ? printable(text) : printable(text.substr(0, most)) + "...";
}

/// A line without its comment: what follows ! or $ outside of quotes.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '!' || c == '$') {
      return line.substr(0, k);
    }
  }
  return line;
}

/// A number as these files write it: also +1.0 and 1.0D+03.
std::errc tir_number(std::string_view text, double& value) {
  std::string plain(text);
  for (char& c : plain)
    if (c == 'd' || c == 'D') c = 'e';
  std::string_view digits = plain;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  const char* const end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc()) return error;
  if (rest != end) return std::errc::invalid_argument;
  return std::isfinite(value * value) ? std::errc() : std::errc::result_out_of_range;
}

class TirReader {
 public:
  TirReader(std::string_view text, const std::string& path) : text_(text) {
    file_.mark.file = path;
  }

  TirFile read() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    if (text_.find('\0') != std::string_view::npos)
      throw InputError(ErrorCode::wrong_file, file_.mark,
                       "found bytes that are no text, expected a tyre property file (.tir)");
    for (std::size_t at = 0; at < text_.size() && errors_.size() < most_tir_errors;) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      ++line_;
      read_line(text_.substr(at, end - at));
      at = end + 1;
    }
    if (errors_.empty() && !sections_.contains("MODEL"))
      error(ErrorCode::wrong_file, file_.mark,
            "found no section [MODEL], expected a tyre property file (.tir)");
    errors_.throw_if_any();
    convert_units();
    check_ranges();
    errors_.throw_if_any();
    return std::move(file_);
  }

 private:
  SourceMark mark(std::size_t column) const {
    return {file_.mark.file, line_, static_cast<int>(column) + 1};
  }
  void error(ErrorCode code, const SourceMark& where, std::string sentence) {
    errors_.add(code, where, std::move(sentence));
  }
  void note(std::string sentence) {
    if (file_.notes.size() < most_tir_notes) file_.notes.push_back(std::move(sentence));
  }

  void read_line(std::string_view raw) {
    const std::string_view line = trimmed_right(without_comment(raw));
    const std::size_t begin = line.find_first_not_of(tir_blanks);
    if (begin == std::string_view::npos) return;
    if (line[begin] == '[') return read_section(line, begin);
    if (line[begin] == '{') {
      in_table_ = true;
      return note(fmt::format("line {}: the table of section [{}] is ignored", line_, section_));
    }
    if (in_table_ && line.find('=') == std::string_view::npos) return;
    read_entry(line, begin);
  }

  void read_section(std::string_view line, std::size_t begin) {
    in_table_ = false;
    const std::size_t end = line.find(']', begin);
    if (end == std::string_view::npos)
      return error(
          ErrorCode::wrong_value, mark(begin),
          fmt::format("found the section {}, expected a ] behind it", shown(line.substr(begin))));
    section_ = in_capitals(line.substr(begin + 1, end - begin - 1));
    if (end + 1 != line.size())
      return error(ErrorCode::wrong_value, mark(end + 1),
                   fmt::format("found {} behind a section, expected the end of the line",
                               shown(line.substr(end + 1))));
    if (section_.empty()) {
      section_ = "[]";  // what follows is in it
      return error(ErrorCode::missing, mark(begin), "found [], expected the name of a section");
    }
    if (!sections_.insert(section_).second)
      note(fmt::format("line {}: section [{}] continues", line_, printable(section_)));
  }

  void read_entry(std::string_view line, std::size_t begin) {
    const std::size_t equals = line.find('=', begin);
    if (equals == std::string_view::npos)
      return error(ErrorCode::wrong_value, mark(begin),
                   fmt::format("found '{}', expected a section [NAME] or KEYWORD = value",
                               shown(line.substr(begin))));
    const std::string_view name = trimmed_right(line.substr(begin, equals - begin));
    const std::string keyword = in_capitals(name);
    if (!is_identifier(keyword) || keyword.size() > longest_keyword)
      return error(ErrorCode::wrong_value, mark(begin),
                   fmt::format("found '{}' before =, expected a keyword", shown(name)));
    if (section_.empty())
      return error(ErrorCode::wrong_file, mark(begin),
                   fmt::format("found {} before any section, expected [MDI_HEADER] or another",
                               shown(keyword)));
    const std::size_t at = line.find_first_not_of(tir_blanks, equals + 1);
    if (at == std::string_view::npos)
      return error(ErrorCode::missing, mark(line.size()),
                   fmt::format("{}: found no value, expected one behind =", shown(keyword)));
    TirEntry entry;
    entry.mark = mark(at);
    if (!read_value(line.substr(at), keyword, entry)) return;
    keep(keyword, entry);
  }

  /// A word in quotes, a number, or a word without quotes.
  bool read_value(std::string_view value, const std::string& keyword, TirEntry& entry) {
    if (value[0] == '\'' || value[0] == '"') {
      const std::size_t end = value.find(value[0], 1);
      if (end == std::string_view::npos || end + 1 != value.size()) {
        error(ErrorCode::wrong_value, entry.mark,
              end == std::string_view::npos
                  ? fmt::format("{}: found {}, expected a quote behind it", keyword, shown(value))
                  : fmt::format("{}: found {} behind the quote, expected the end of the line",
                                keyword, shown(value.substr(end + 1))));
        return false;
      }
      entry.is_word = true;
      entry.word = value.substr(1, end - 1);
      return true;
    }
    const std::errc failed = tir_number(value, entry.number);
    if (failed == std::errc()) return true;
    entry.is_word = true;
    entry.word = value;
    return true;
  }

  void keep(const std::string& keyword, TirEntry& entry) {
    if (section_ == "UNITS") {
      units_[keyword] = entry;
      return;
    }
    if (section_ == "MDI_HEADER") return;
    const std::optional<TirKeyword> known = tir_keyword(keyword);
    if (!known) {
      // A keyword is looked up a hundred times at most: what is no tyre file has many.
      const std::string hint =
          suggestions_++ < most_suggestions ? did_you_mean(keyword, tir_keyword_names()) : "";
      return note(
          fmt::format("line {}: the unknown keyword {} is ignored{}", line_, shown(keyword), hint));
    }
    if (known->dimension != Dim::word && entry.is_word) {
      double x = 0.0;
      const bool large = tir_number(entry.word, x) == std::errc::result_out_of_range;
      return error(large ? ErrorCode::not_finite : ErrorCode::not_a_number, entry.mark,
                   fmt::format("{}: found {}, expected a {}number", keyword, shown(entry.word),
                               large ? "finite " : ""));
    }
    if (known->dimension == Dim::word && !entry.is_word)
      return error(ErrorCode::wrong_value, entry.mark,
                   fmt::format("{}: found {}, expected a word in quotes", keyword,
                               number_text(entry.number)));
    const auto [it, fresh] = file_.entries.emplace(keyword, entry);
    if (fresh) return;
    if (it->second.number == entry.number && it->second.word == entry.word)
      return note(fmt::format("line {}: {} is given twice", line_, keyword));
    error(ErrorCode::duplicate, entry.mark,
          fmt::format("{}: found it again with another value than in line {}, expected it once",
                      keyword, it->second.mark.line));
  }

  /// Value of the unit of a quantity; SI where the file does not say it.
  double unit(const char* keyword, Dim quantity) {
    const auto it = units_.find(keyword);
    if (it == units_.end()) return 1.0;
    const std::optional<double> value = tir_unit(quantity, in_small(it->second.word));
    if (value) return *value;
    error(ErrorCode::wrong_value, it->second.mark,
          fmt::format("{}: found the unit {}, expected one of {}", keyword,
                      it->second.is_word ? "'" + shown(it->second.word) + "'"
                                         : number_text(it->second.number),
                      tir_unit_words(quantity)));
    return 1.0;
  }

  void convert_units() {
    if (units_.empty()) note("no section [UNITS]: m, N, rad, kg and s are assumed");
    const double length = unit("LENGTH", Dim::length), force = unit("FORCE", Dim::force);
    const double angle = unit("ANGLE", Dim::angle), mass = unit("MASS", Dim::mass);
    const double time = unit("TIME", Dim::speed);
    const double pressure =
        units_.contains("PRESSURE") ? unit("PRESSURE", Dim::pressure) : force / (length * length);
    for (auto& [keyword, entry] : file_.entries) {
      switch (tir_keyword(keyword)->dimension) {
        case Dim::none:
        case Dim::word:
          break;
        case Dim::length:
          entry.number *= length;
          break;
        case Dim::speed:
          entry.number *= length / time;
          break;
        case Dim::angle:
          entry.number *= angle;
          break;
        case Dim::mass:
          entry.number *= mass;
          break;
        case Dim::inertia:
          entry.number *= mass * length * length;
          break;
        case Dim::force:
          entry.number *= force;
          break;
        case Dim::stiffness:
          entry.number *= force / length;
          break;
        case Dim::damping:
          entry.number *= force * time / length;
          break;
        case Dim::pressure:
          entry.number *= pressure;
          break;
        case Dim::per_length:
          entry.number /= length;
          break;
      }
    }
  }

  void check_ranges() {
    for (const char* quantity : {"FZ", "KPU", "ALP", "CAM", "PRES"}) {
      const std::string least = std::string(quantity) + "MIN", most = std::string(quantity) + "MAX";
      if (!file_.has(least) || !file_.has(most) || file_.number(least) < file_.number(most))
        continue;
      error(ErrorCode::contradiction, file_.place(most),
            fmt::format("{}: found {}, expected a number above {}, {}", most,
                        number_text(file_.number(most)), least, number_text(file_.number(least))));
    }
  }

  std::string_view text_;
  TirFile file_;
  ErrorList errors_;
  std::map<std::string, TirEntry> units_;
  std::set<std::string> sections_;
  std::string section_;
  bool in_table_ = false;
  int line_ = 0;
  std::size_t suggestions_ = 0;
};

}  // namespace

double TirFile::number(std::string_view keyword) const {
  const auto it = entries.find(keyword);
  if (it != entries.end()) return it->second.number;
  const std::optional<TirKeyword> known = tir_keyword(keyword);
  return known ? known->fallback : 0.0;
}

std::string TirFile::word(std::string_view keyword) const {
  const auto it = entries.find(keyword);
  return it == entries.end() ? "" : in_capitals(it->second.word);
}

const SourceMark& TirFile::place(std::string_view keyword) const {
  const auto it = entries.find(keyword);
  return it == entries.end() ? mark : it->second.mark;
}

TirFile parse_tir(std::string_view text, const std::string& path) {
  return TirReader(text, path).read();
}

std::string tir_text(const std::string& path) { return regular_file(path, std::uint64_t{1} << 20); }

TirFile read_tir(const std::string& path) { return parse_tir(tir_text(path), path); }

bool is_tir_scale(std::string_view keyword) {
  const std::optional<TirKeyword> known = tir_keyword(keyword);
  return known && known->scale;
}

std::vector<std::string> tir_scales() {
  std::vector<std::string> scales;
  for (const std::string& name : tir_keyword_names())
    if (is_tir_scale(name)) scales.push_back(name);
  return scales;
}

}  // namespace floatframe
