#pragma once
// What is said about wrong input.
#include <string>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe::test {

/// The text of the InputError that `action` ends with, "no error" if it ends without.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace floatframe::test
