#pragma once
// Texts of options taken apart, and lists of names in sentences.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace floatframe {

/// The text taken apart at a character.
std::vector<std::string> pieces_of(const std::string& text, char at);
/// The number that all of the text is; nothing if it is none, or not finite.
std::optional<double> finite_number(const std::string& text);
/// "a, b, c and 7 more"
std::string names_text(const std::vector<std::string>& names, std::size_t most);

}  // namespace floatframe
