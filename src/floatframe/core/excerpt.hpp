#pragma once
// The beginning of a text.
#include <string>
#include <string_view>

namespace floatframe {

/// `text` for a sentence, truncated with "..." if it is long.
std::string excerpt(std::string_view text);

}  // namespace floatframe
