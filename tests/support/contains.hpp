#pragma once
// Texts and lists of notes: is there a part in them? A failure shows them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe::test {

inline testing::AssertionResult contains(std::string_view text, std::string_view part) {
  const bool found = text.find(part) != std::string_view::npos;
  return (found ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "'" << part << "' in:\n"
         << text;
}

/// A line for each note or warning.
inline std::string joined(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += note + '\n';
  return text;
}

inline testing::AssertionResult contains(const std::vector<std::string>& notes,
                                         std::string_view part) {
  return contains(joined(notes), part);
}

/// Of so many notes or warnings it is a part.
inline int count_with(const std::vector<std::string>& notes, std::string_view part) {
  return static_cast<int>(std::count_if(notes.begin(), notes.end(), [&](const std::string& note) {
    return note.find(part) != std::string::npos;
  }));
}

}  // namespace floatframe::test
