#include "floatframe/core/csv_field.hpp"

#include <charconv>

namespace floatframe {
namespace {

constexpr std::string_view formula_beginnings = "=+-@\t\r";

bool is_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error != std::errc::invalid_argument && end == text.data() + text.size();
}

bool begins_as_formula(std::string_view text) {
  return !text.empty() && formula_beginnings.find(text.front()) != std::string_view::npos;
}

}  // namespace

std::string csv_field(const std::string& given) {
  const std::string text = begins_as_formula(given) && !is_number(given) ? "'" + given : given;
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += (c == '\n' || c == '\r') ? ' ' : c;
  }
  return quoted + '"';
}

std::string csv_title(const std::string& name, const std::string& unit) {
  return csv_field(unit.empty() ? name : name + " [" + unit + "]");
}

std::string csv_text(const std::string& field) {
  const bool marked = field.starts_with('\'') && begins_as_formula(field.substr(1));
  return marked ? field.substr(1) : field;
}

}  // namespace floatframe
