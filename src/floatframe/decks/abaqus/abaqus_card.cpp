#include "floatframe/decks/abaqus/abaqus_card.hpp"

#include <algorithm>

#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {

void AbaqusCard::allow_only(std::string_view known) {
  for (const Parameter& p : parameters)
    if (!is_abaqus_word(known, p.name))
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
  if (found.empty() || is_abaqus_word(values, upper_case(found))) return true;
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
