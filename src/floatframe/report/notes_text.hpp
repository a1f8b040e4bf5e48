#pragma once
// Notes on the start of a run for the terminal, and lists of names in sentences.
#include <cstddef>
#include <string>
#include <vector>

namespace floatframe {

/// One line a note, at most 20 of them; empty without notes.
std::string notes_text(const std::vector<std::string>& notes);

/// "a, b, c and 7 more"
std::string names_text(const std::vector<std::string>& names, std::size_t most);

}  // namespace floatframe
