#include "floatframe/results/notes_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace floatframe {

std::string notes_text(const std::vector<std::string>& notes) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, notes.size()); ++k)
    text += "  note: " + notes[k] + '\n';
  if (notes.size() > most) text += fmt::format("  note: and {} more\n", notes.size() - most);
  return text;
}

}  // namespace floatframe
