#pragma once
// Notes on the start of a run for the terminal.
#include <string>
#include <vector>

namespace floatframe {

/// One line per note, at most 20 of them; empty without notes.
std::string notes_text(const std::vector<std::string>& notes);

}  // namespace floatframe
