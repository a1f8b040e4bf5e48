#pragma once
// User text inside HTML and SVG: &, <, >, ", ' are escaped, control characters and invalid UTF-8
// become U+FFFD.
#include <string>
#include <string_view>

namespace floatframe {

std::string html_escape(std::string_view text);

/// "modal_damping" -> "modal damping"
std::string spaced_words(std::string name);

}  // namespace floatframe
