#pragma once
// Texts in files of comma-separated values (RFC 4180).
#include <string>

namespace floatframe {

/// A text as one field: quoted if it contains a comma, a quote or a line break (which becomes a
/// blank). Text that spreadsheets would interpret as a formula - it begins with =, +, -, @ or a tab
/// and is not a number - is prefixed with an apostrophe, which marks it as text.
std::string csv_field(const std::string& text);

/// The text of an unquoted field, without that apostrophe.
std::string csv_text(const std::string& field);

/// The title of a column: "name [unit]", or the name alone without a unit.
std::string csv_title(const std::string& name, const std::string& unit);

}  // namespace floatframe
