#pragma once
// What tests ask of an error: its place, path and code. Its sentence goes into the golden file of
// the room (tests/sentences), so that rewording it breaks that file alone.
#include <string>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/simulation/run_error.hpp"

namespace floatframe::test {

/// "file:line:column: path: code", with what is known; " (12)" after it if it stands for so many.
std::string code_of(const ErrorEntry& error);
/// A line for each error.
std::string codes_of(const InputError& error);
std::string codes_of(const RunError& error);

/// Without the names of temporary folders.
std::string without_folders(const std::string& text);

/// The codes of the InputError or RunError that `action` ends with, "no error" if it ends without.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return codes_of(error);
  } catch (const RunError& error) {
    return codes_of(error);
  }
  return "no error";
}

}  // namespace floatframe::test
