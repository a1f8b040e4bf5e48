#include "floatframe/decks/abaqus/abaqus_card.hpp"

#include <algorithm>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

constexpr int most_continuations = 100;
// With its continuations; Abaqus reads 256 of a line.
constexpr std::size_t longest_keyword_line = 65536;

bool is_comment(std::string_view line) noexcept { return line.starts_with("**"); }

std::string without_blanks(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t') result += c;
  return upper_case(result);
}

/// Parts between commas that are not in quotes.
std::vector<std::string_view> split_outside_quotes(std::string_view text) {
  std::vector<std::string_view> parts;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '"') quoted = !quoted;
    if (i == text.size() || (text[i] == ',' && !quoted)) {
      parts.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
  return parts;
}

}  // namespace

bool AbaqusKeyword::has(std::string_view parameter) const noexcept {
  return std::any_of(parameters.begin(), parameters.end(),
                     [&](const Parameter& p) { return p.name == parameter; });
}

std::string_view AbaqusKeyword::value(std::string_view parameter) const noexcept {
  for (const Parameter& p : parameters)
    if (p.name == parameter) return p.value;
  return {};
}

std::string abaqus_name(std::string_view text) {
  text = trimmed(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    return std::string(text.substr(1, text.size() - 2));
  return without_blanks(text);
}

bool AbaqusLines::next_line(std::string_view& line) {
  while (source_.next(line)) {
    line = trimmed(line);
    if (line.empty() || is_comment(line)) continue;
    if (line.front() != '*') return true;
    const std::string_view name = line.substr(1, 40);
    if (without_blanks(name.substr(0, name.find(','))) != "INCLUDE") return true;
    AbaqusKeyword keyword;
    parse_keyword(line, keyword);
    if (keyword.value("INPUT").empty())
      source_.stop(ErrorCode::incomplete, keyword.at, "*INCLUDE needs the parameter INPUT");
    source_.include(keyword.value("INPUT"), keyword.at);
  }
  return false;
}

void AbaqusLines::parse_keyword(std::string_view line, AbaqusKeyword& keyword) {
  keyword = AbaqusKeyword{};
  keyword.at = source_.here();
  const auto limit = [&](std::size_t length) {
    if (length <= longest_keyword_line) return;
    source_.stop(ErrorCode::too_large, keyword.at,
                 "the keyword line {} has more than {} characters", shown(line),
                 longest_keyword_line);
  };
  limit(line.size());
  std::string whole(line);
  for (int k = 0; whole.back() == ',' && k < most_continuations; ++k) {
    std::string_view more;
    if (!source_.next(more)) break;
    more = trimmed(more);
    if (is_comment(more)) continue;
    if (more.empty() || more.front() == '*') {
      source_.put_back();
      break;
    }
    limit(whole.size() + more.size());
    whole += more;
  }
  const std::vector<std::string_view> parts = split_outside_quotes(whole);
  keyword.name = without_blanks(parts.front().substr(1));
  const std::string_view head = parts.front().substr(0, 40);
  for (const char c : head) keyword.shown += c >= ' ' && c <= '~' ? c : '?';
  keyword.shown = upper_case(keyword.shown);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].empty()) continue;
    const std::size_t equals = parts[i].find('=');
    AbaqusKeyword::Parameter parameter;
    parameter.name = without_blanks(parts[i].substr(0, equals));
    if (equals != std::string_view::npos) parameter.value = trimmed(parts[i].substr(equals + 1));
    keyword.parameters.push_back(std::move(parameter));
  }
}

bool AbaqusLines::next_keyword(AbaqusKeyword& keyword) {
  std::string_view line;
  while (next_line(line)) {
    if (line.front() != '*') continue;
    parse_keyword(line, keyword);
    return true;
  }
  return false;
}

bool AbaqusLines::next_data(std::string_view& line) {
  if (!next_line(line)) return false;
  if (line.front() != '*') return true;
  source_.put_back();
  return false;
}

void AbaqusCard::allow_only(std::string_view known) {
  for (const Parameter& p : parameters)
    if (!has_word(known, p.name))
      error(ErrorCode::unsupported, "has the parameter {}, which is not supported",
            floatframe::shown(p.name));
  start();
}

std::string_view AbaqusCard::required(std::string_view parameter) {
  const std::string key = abaqus_name(parameter);
  if (value(key).empty()) error(ErrorCode::incomplete, "needs the parameter {}", parameter);
  if (std::count_if(parameters.begin(), parameters.end(),
                    [&](const Parameter& p) { return p.name == key; }) > 1)
    error(ErrorCode::duplicate, "has the parameter {} twice", parameter);
  return value(key);
}

bool AbaqusCard::is_one_of(std::string_view parameter, std::string_view values,
                           fmt::format_string<std::string> text, ErrorCode code) {
  const std::string_view found = value(parameter);
  if (found.empty() || has_word(values, upper_case(found))) return true;
  error(code, text, floatframe::shown(found));
  return false;
}

AbaqusSet* AbaqusCard::set(std::map<AbaqusContent::Key, AbaqusSet>& sets,
                           std::string_view parameter) {
  if (value(parameter).empty()) return nullptr;
  AbaqusSet& out = sets[{content.scope, content.intern(word(parameter))}];
  if (out.at.line == 0) out.at = at;
  return &out;
}

void AbaqusCard::take_input() {
  if (!value("INPUT").empty()) source.include(value("INPUT"), at);
}

bool AbaqusCard::next() {
  std::string_view line;
  fields.clear();
  if (!lines.next_data(line)) return false;
  errors_before_line_ = source.errors();
  split_commas(line, fields);
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return true;
}

bool AbaqusCard::needs_line() {
  if (next()) return true;
  error(ErrorCode::missing, "has no data line");
  return false;
}

double AbaqusCard::real(std::size_t k, std::string_view what) {
  const std::optional<double> value = parse_real(field(k));
  if (!value) error_in_line(ErrorCode::not_a_number, "{}: {}", what, not_a_real(field(k)));
  return value.value_or(0.0);
}

double AbaqusCard::positive(std::size_t k, std::string_view what) {
  const std::size_t before = source.errors();
  const double value = real(k, what);
  if (!(value > 0.0) && source.errors() == before)
    error_in_line(ErrorCode::out_of_range, "{} is {:g}, expected more than 0", what, value);
  return value;
}

Vec3 AbaqusCard::vector(std::size_t k, std::string_view what) {
  Vec3 v;
  for (double& x : v) x = real_or(k++, 0.0, what);
  return v;
}

int AbaqusCard::integer(std::string_view text, std::string_view what) {
  const std::optional<int> value = parse_integer(text);
  if (!value) error_in_line(ErrorCode::not_a_number, "{}: {}", what, not_an_integer(text));
  return value.value_or(0);
}

unsigned AbaqusCard::dofs(std::size_t k, std::string_view what) {
  const std::optional<int> first = parse_integer(field(k));
  const std::optional<int> last = field(k + 1).empty() ? first : parse_integer(field(k + 1));
  if (first && last && *first >= 1 && *last <= 6 && *last >= *first)
    return (63u >> (6 - *last)) & (63u << (*first - 1));
  error_in_line(field(k).empty() ? ErrorCode::missing : ErrorCode::out_of_range,
                "{}: the degrees of freedom are {}{}{}, expected numbers from 1 to 6", what,
                field(k).empty() ? "missing" : floatframe::shown(field(k)),
                last != first ? " to " : "", last != first ? floatframe::shown(field(k + 1)) : "");
  return 0;
}

void AbaqusCard::no_more(std::size_t count) {
  for (std::size_t k = count; k < fields.size(); ++k) {
    if (fields[k].empty()) continue;
    error_in_line(ErrorCode::wrong_count, "{} has the entry {} behind {}, expected no more", shown,
                  floatframe::shown(fields[k]),
                  count == 1 ? "its number" : fmt::format("its {} numbers", count));
    break;
  }
  std::string_view more;
  if (lines.next_data(more))
    error_in_line(ErrorCode::unsupported, "{} has a second line, which is not supported", shown);
}

}  // namespace floatframe
