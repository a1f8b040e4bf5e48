#pragma once
// No exception leaves a function of the C interface: each becomes a status and a message.
#include <memory>
#include <utility>

#include "floatframe/c_interface/bounded_text.hpp"
#include "floatframe/c_interface/floatframe.h"
#include "floatframe/c_interface/opened_model.hpp"
#include "floatframe/c_interface/simulation_handle.hpp"

namespace floatframe {

/// The status of the exception that is being handled, and its message.
floatframe_status status_of_exception(BoundedText& message) noexcept;

/// What `action` does with a handle and returns.
template <class Action>
floatframe_status guarded(floatframe_simulation* s, Action&& action) noexcept {
  if (s == nullptr) return FLOATFRAME_INVALID;
  try {
    return action(*s);
  } catch (...) {
    return status_of_exception(s->message);
  }
}

/// A handle of what `open` opens; NULL with a message if it throws.
template <class Open>
floatframe_simulation* open_guarded(char* message, std::size_t size, Open&& open) noexcept {
  copy_text("", message, size);
  try {
    return std::make_unique<floatframe_simulation>(open()).release();
  } catch (...) {
    BoundedText text;
    status_of_exception(text);
    copy_text(text.c_str(), message, size);
    return nullptr;
  }
}

}  // namespace floatframe
