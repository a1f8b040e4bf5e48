#include "floatframe/sweep/sweep_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/yaml/expression.hpp"
#include "floatframe/yaml/yaml_tree.hpp"

namespace floatframe {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> number(const std::string& text) {
  const PlainScalar scalar = classify_plain_scalar(text);
  if (scalar.kind != PlainScalar::Kind::number) return std::nullopt;
  return scalar.number;
}

[[noreturn]] void refuse(ErrorCode code, const std::string& variation, const std::string& why) {
  throw InputError(code, fmt::format("--vary {}: {}", variation, why));
}

std::vector<std::string> range(const std::string& variation,
                               const std::vector<std::string>& parts) {
  const bool logarithmic = parts.size() == 4 && parts[3] == "log";
  if (parts.size() != 3 && !logarithmic)
    refuse(ErrorCode::wrong_value, variation,
           "expected NAME=LO:HI:N, NAME=LO:HI:N:log or NAME=A,B,C");
  const auto lo = number(parts[0]), hi = number(parts[1]), n = number(parts[2]);
  if (!lo || !hi)
    refuse(ErrorCode::out_of_range, variation,
           fmt::format("found '{}', expected a number", parts[lo ? 1 : 0]));
  if (!n || *n < 1.0 || *n != std::floor(*n) || *n > static_cast<double>(most_sweep_runs))
    refuse(ErrorCode::out_of_range, variation,
           fmt::format("found '{}', expected a number of values from 1 to {}", parts[2],
                       most_sweep_runs));
  if (*lo == *hi && *n > 1.0)
    refuse(ErrorCode::contradiction, variation, "both ends are the same, expected different ones");
  if (logarithmic && !(*lo * *hi > 0.0))
    refuse(ErrorCode::wrong_value, variation,
           "equal ratios need two ends of the same sign, neither of them zero");
  std::vector<std::string> values;
  const std::size_t count = *n;
  if (count == 1) return {number_text(*lo)};
  for (std::size_t k = 0; k < count; ++k) {
    const double s = static_cast<double>(k) / (*n - 1.0);
    double x = logarithmic ? *lo * std::pow(*hi / *lo, s) : *lo + (*hi - *lo) * s;
    if (k == 0) x = *lo;
    if (k + 1 == count) x = *hi;
    values.push_back(number_text(x));
  }
  return values;
}

std::vector<std::string> values_of(const std::string& variation, const std::string& text) {
  if (text.find(':') != std::string::npos && text.find(',') == std::string::npos)
    return range(variation, split(text, ':'));
  std::vector<std::string> values;
  for (const std::string& part : split(text, ',')) {
    values.push_back(trimmed(part));
    if (values.back().empty())
      refuse(ErrorCode::missing, variation, "found nothing, expected a value");
  }
  return values;
}

/// The fields of one line and their starting columns; false if a quote is not closed.
bool fields_of(const std::string& line, std::vector<std::string>& fields,
               std::vector<int>& columns) {
  fields.clear();
  columns.clear();
  std::size_t k = 0;
  while (true) {
    while (k < line.size() && (line[k] == ' ' || line[k] == '\t')) ++k;
    columns.push_back(static_cast<int>(k) + 1);
    std::string field;
    if (k < line.size() && line[k] == '"') {
      for (++k;; ++k) {
        if (k >= line.size()) return false;
        if (line[k] != '"')
          field += line[k];
        else if (k + 1 < line.size() && line[k + 1] == '"')
          field += line[k++];
        else
          break;
      }
      const std::size_t next = line.find(',', k);
      if (!trimmed(line.substr(k + 1, next == std::string::npos ? next : next - k - 1)).empty())
        return false;
      k = next == std::string::npos ? line.size() : next;
    } else {
      const std::size_t next = std::min(line.find(',', k), line.size());
      field = trimmed(line.substr(k, next - k));
      k = next;
    }
    fields.push_back(field);
    if (k >= line.size()) return true;
    ++k;
  }
}

void check_names(const std::vector<std::string>& names, const SourceMark& mark,
                 const std::string& subject) {
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k].empty())
      throw InputError(ErrorCode::missing, mark,
                       subject + "found nothing, expected the name of a parameter");
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(k), names[k]) !=
        names.begin() + static_cast<std::ptrdiff_t>(k))
      throw InputError(ErrorCode::duplicate, mark,
                       fmt::format("{}'{}' is varied twice", subject, names[k]));
  }
}

}  // namespace

SweepPlan grid_plan(const std::vector<std::string>& variations) {
  SweepPlan plan;
  std::vector<std::vector<std::string>> values;
  double count = 1.0;
  for (const std::string& variation : variations) {
    const std::size_t equal = variation.find('=');
    if (equal == std::string::npos || equal == 0)
      refuse(ErrorCode::wrong_value, variation,
             "expected NAME=LO:HI:N, NAME=LO:HI:N:log or NAME=A,B,C");
    plan.names.push_back(trimmed(variation.substr(0, equal)));
    values.push_back(values_of(variation, trimmed(variation.substr(equal + 1))));
    count *= static_cast<double>(values.back().size());
  }
  check_names(plan.names, {}, "--vary: ");
  if (count > static_cast<double>(most_sweep_runs))
    throw InputError(ErrorCode::too_large,
                     fmt::format("--vary: found {:.6g} combinations, expected at most {}", count,
                                 most_sweep_runs));
  std::vector<std::size_t> at(values.size(), 0);
  for (bool more = !values.empty(); more;) {
    std::vector<std::string> run;
    for (std::size_t k = 0; k < values.size(); ++k) run.push_back(values[k][at[k]]);
    plan.runs.push_back(std::move(run));
    more = false;
    for (std::size_t k = values.size(); k-- > 0 && !more;) {
      more = ++at[k] < values[k].size();
      if (!more) at[k] = 0;
    }
  }
  plan.origins.assign(plan.runs.size(), "--vary");
  return plan;
}

SweepPlan table_plan(const std::string& file) {
  ErrorList errors;
  std::string text;
  if (!read_text_file(file, text, errors, {}, "")) throw InputError(errors.take());
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
  if (text.find('\0') != std::string::npos)
    throw InputError(ErrorCode::wrong_file, {file, 1, 1}, "this is not a text file");
  SweepPlan plan;
  std::vector<std::string> fields;
  std::vector<int> columns;
  int number_of_line = 0;
  for (std::string line : split(text, '\n')) {
    ++number_of_line;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (trimmed(line).empty()) continue;
    if (!fields_of(line, fields, columns)) {
      errors.add(ErrorCode::out_of_range, {file, number_of_line, columns.back()},
                 "a quoted field does not end here");
      continue;
    }
    if (plan.names.empty()) {
      check_names(fields, {file, number_of_line, 1}, "");
      plan.names = fields;
      continue;
    }
    if (fields.size() != plan.names.size()) {
      errors.add(ErrorCode::wrong_count, {file, number_of_line, 1},
                 fmt::format("found {} fields, expected {}: one for each name in the first line",
                             fields.size(), plan.names.size()));
      continue;
    }
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (fields[k].empty())
        errors.add(ErrorCode::missing, {file, number_of_line, columns[k]},
                   fmt::format("found nothing, expected a value of '{}'", plan.names[k]));
    plan.runs.push_back(fields);
    plan.origins.push_back(fmt::format("{}:{}", file, number_of_line));
    if (plan.runs.size() > most_sweep_runs)
      throw InputError(ErrorCode::too_large, {file, number_of_line, 1},
                       fmt::format("expected at most {} runs", most_sweep_runs));
  }
  errors.throw_if_any();
  if (plan.runs.empty())
    throw InputError(ErrorCode::missing, {file, 1, 1},
                     "expected a line of names and at least one line of values");
  return plan;
}

}  // namespace floatframe
