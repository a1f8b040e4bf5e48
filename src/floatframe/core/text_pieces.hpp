#pragma once
// Splitting texts of options, and lists of names in sentences.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace floatframe {

/// The text split at a character.
std::vector<std::string> pieces_of(const std::string& text, char at);
/// The number if the whole text is a finite number; else nothing.
std::optional<double> finite_number(const std::string& text);
/// "a, b, c and 7 more"
std::string names_text(const std::vector<std::string>& names, std::size_t most);

}  // namespace floatframe
