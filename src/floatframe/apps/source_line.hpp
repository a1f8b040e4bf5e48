#pragma once
// The line of a file that an error is about, with a caret below its place:
//    12 |   arm: {rigid: {mas: 3}}
//       |                 ^
#include <cstddef>
#include <string>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

/// Two lines of at most `width` characters, each with its line break; of a long line the part
/// around the place. Tabs become blanks up to the next of every eighth column, other control
/// characters and bytes that are not UTF-8 a question mark. Empty if the place has no line and
/// column, or the file is not one of text, cannot be read or is too large.
std::string source_line(const SourceMark& mark, std::size_t width);

}  // namespace floatframe
