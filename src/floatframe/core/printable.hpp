#pragma once
// Text for messages: characters that terminals or log files would interpret are escaped.
#include <string>
#include <string_view>

namespace floatframe {

/// Length of the UTF-8 sequence at text[at]; 0 if there is none (overlong forms and surrogates
/// included).
std::size_t utf8_length(std::string_view text, std::size_t at) noexcept;

/// True for the control characters of ASCII and for those of two bytes (U+0080 to U+009F).
bool is_control(std::string_view text, std::size_t at) noexcept;

/// `text` with control characters and bytes that are not UTF-8 written as \x1b; line breaks and
/// tabs as \n and \t, unless `lines` keeps line breaks.
std::string printable(std::string_view text, bool lines = false);

}  // namespace floatframe
