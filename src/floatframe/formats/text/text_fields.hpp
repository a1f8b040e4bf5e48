#pragma once
// Fields of a line: splitting, numbers in the ways of Fortran programs, upper case, and how a field
// is shown in an error.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

/// Without blanks and tabs at both ends.
std::string_view trimmed(std::string_view text) noexcept;
/// ASCII letters in upper, lower case.
std::string upper_case(std::string_view text);
std::string lower_case(std::string_view text);
/// Equal except for the case of ASCII letters.
bool same_word(std::string_view a, std::string_view b) noexcept;
/// Does `text` begin with `head`, case ignored?
bool begins_with(std::string_view text, std::string_view head) noexcept;

/// Fields between commas, trimmed; replaces `fields`. "1, 2," has the fields "1", "2", "".
void split_commas(std::string_view line, std::vector<std::string_view>& fields);
/// Words between blanks, tabs or commas; replaces `fields`.
void split_blanks(std::string_view line, std::vector<std::string_view>& fields);
/// The next line of a text; `rest` moves behind it.
std::string_view next_line(std::string_view& rest) noexcept;
/// The next word between blanks; `rest` moves behind it. Empty at the end.
std::string_view next_word(std::string_view& rest) noexcept;
/// Is it one of some words separated by blanks?
bool has_word(std::string_view words, std::string_view word) noexcept;

/// A finite real number in the notation of Fortran and Nastran: 1., .5, 1e5, 1d5, 1.5D+03, 3.+5,
/// -1.2-3, and nothing else in the field; too large, nan and inf are invalid; too small is zero.
std::optional<double> parse_real(std::string_view field);
/// A whole number of 32 bits: 12, +12, -3.
std::optional<int> parse_integer(std::string_view field) noexcept;
/// A whole number that can name a node or an element: 1 to 2147483647.
std::optional<int> parse_label(std::string_view field) noexcept;

/// Error of a field that is no real: "'abc' is not a number", "a number is missing",
/// "'1e999' is too large".
std::string not_a_real(std::string_view field);
/// "'1.5' is not a whole number", "a number is missing".
std::string not_an_integer(std::string_view field);
/// In quotes, at most 40 characters as UTF-8, control characters as '?'.
std::string shown(std::string_view field);
/// UTF-8 of a text with words of a file: bytes that are not UTF-8 are interpreted as
/// Latin-1, also next to others that are UTF-8 (`utf8_text` converts all or none).
std::string message_text(std::string_view text);

}  // namespace floatframe
