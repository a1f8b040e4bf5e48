#pragma once
// Arguments of the command line taken apart.
#include <optional>
#include <string>
#include <vector>

namespace floatframe {

/// The text taken apart at a character.
std::vector<std::string> pieces_of(const std::string& text, char at);
/// The number that all of the text is; nothing if it is none, or not finite.
std::optional<double> finite_number(const std::string& text);

}  // namespace floatframe
