#pragma once
// What tests ask of an error: its place, path and code. Its sentence goes into the golden file of
// the room (tests/sentences), so that rewording it breaks that file alone.
#include <string>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/loops/run_error.hpp"
#include "support/contains.hpp"

namespace floatframe::test {

/// "file:line:column: path: code", with what is known; " (12)" after it if it stands for so many.
std::string code_of(const ErrorEntry& error);
/// A line for each error.
std::string codes_of(const InputError& error);
std::string codes_of(const RunError& error);

/// Without the names of temporary folders.
std::string without_folders(const std::string& text);

/// What `text` makes of the InputError or RunError that `action` ends with, "no error" if it ends
/// without.
template <class Action, class Text>
std::string error_as(Action&& action, Text&& text) {
  try {
    action();
  } catch (const InputError& error) {
    return text(error);
  } catch (const RunError& error) {
    return text(error);
  }
  return "no error";
}

/// The codes of the error.
template <class Action>
std::string error_of(Action&& action) {
  return error_as(action, [](const auto& error) { return codes_of(error); });
}

/// Its sentences, for tests of what they carry: characters that are written out, the same words
/// from two places. Not for comparison with a sentence: that stands in the golden file.
template <class Action>
std::string sentences_of(Action&& action) {
  return error_as(action, [](const auto& error) { return std::string(error.what()); });
}

}  // namespace floatframe::test
