#pragma once
// Texts in files of comma-separated values (RFC 4180).
#include <string>

namespace floatframe {

/// A text as one field: quoted if it holds a comma, a quote or a line break (which becomes a
/// blank).
std::string csv_field(const std::string& text);

/// The title of a column: "name [unit]", or the name alone without a unit.
std::string csv_title(const std::string& name, const std::string& unit);

}  // namespace floatframe
