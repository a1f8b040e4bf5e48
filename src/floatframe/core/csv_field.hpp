#pragma once
// Texts in files of comma-separated values (RFC 4180).
#include <string>

namespace floatframe {

/// A text as one field: quoted if it holds a comma, a quote or a line break (which becomes a
/// blank). What spreadsheets would take for a formula - it begins with =, +, -, @ or a tab and is
/// no number - has an apostrophe in front, which they understand as "this is text".
std::string csv_field(const std::string& text);

/// The text of such a field that is not quoted any more: without that apostrophe.
std::string csv_text(const std::string& field);

/// The title of a column: "name [unit]", or the name alone without a unit.
std::string csv_title(const std::string& name, const std::string& unit);

}  // namespace floatframe
