// States of an instance that the importer keeps. They belong to the instance and end with it, so
// that a pointer that is none of them is found, and nothing is read through it.
#include <algorithm>

#include "fmi/instance.hpp"

namespace floatframe::fmi {

SavedState* Instance::find_state(void* state) const noexcept {
  const auto found = std::find_if(states_.begin(), states_.end(),
                                  [state](const auto& own) { return own.get() == state; });
  return state != nullptr && found != states_.end() ? found->get() : nullptr;
}

Status Instance::get_state(void** state) {
  if (state == nullptr) return fail("found NULL, expected where the state is to be written");
  if (*state != nullptr && find_state(*state) == nullptr)
    return fail("found a state that this instance does not know, expected NULL or one of its own");
  SavedState now{state_, run_, {}, {}, {}};
  if (run_.needs_start) {
    for (std::size_t k = 0; k < first_inputs_.size(); ++k)
      now.inputs.push_back(f_.input(simulation_, std::int32_t(k)));
    for (std::size_t k = 0; k < first_parameters_.size(); ++k)
      now.parameters.push_back(f_.parameter(simulation_, std::int32_t(k)));
  } else {
    std::size_t count = 0;
    if (f_.save(simulation_, &count) != FLOATFRAME_OK) return fail("%s", f_.message(simulation_));
    const auto* const bytes = static_cast<const unsigned char*>(f_.saved(simulation_));
    now.model.assign(bytes, bytes + count);
  }
  if (*state == nullptr) {
    states_.push_back(std::make_unique<SavedState>());
    *state = states_.back().get();
  }
  *find_state(*state) = std::move(now);
  return Status::ok;
}

Status Instance::set_state(void* state) {
  const SavedState* const found = find_state(state);
  if (found == nullptr) return fail("found a state that this instance does not know");
  return apply(*found);
}

Status Instance::apply(const SavedState& state) {
  if (state.run.needs_start) {
    unstart();
    indices_.clear();
    for (std::size_t k = 0; k < state.parameters.size(); ++k) indices_.push_back(std::int32_t(k));
    if (!indices_.empty() &&
        f_.set_parameters(simulation_, indices_.data(), state.parameters.data(), indices_.size()) >
            FLOATFRAME_WARNING)
      return fail("%s", f_.message(simulation_));
    // Then inputs, whose limits and first values may follow from parameters.
    for (std::size_t k = 0; k < state.inputs.size(); ++k) {
      const std::int32_t index = std::int32_t(k);
      if (f_.input(simulation_, index) != state.inputs[k] &&
          f_.set_input(simulation_, index, state.inputs[k]) > FLOATFRAME_WARNING)
        return fail("%s", f_.message(simulation_));
    }
  } else if (f_.restore(simulation_, state.model.data(), state.model.size()) != FLOATFRAME_OK) {
    return fail("%s", f_.message(simulation_));
  }
  run_ = state.run;
  state_ = state.state;
  return Status::ok;
}

Status Instance::free_state(void** state) {
  if (state == nullptr) return fail("found NULL, expected the address of a state");
  if (*state == nullptr) return Status::ok;
  SavedState* const found = find_state(*state);
  if (found == nullptr) return fail("found a state that this instance does not know");
  std::erase_if(states_, [found](const auto& own) { return own.get() == found; });
  *state = nullptr;
  return Status::ok;
}

Status Instance::size_of_state(void* state, std::size_t* size) {
  const SavedState* const found = find_state(state);
  if (found == nullptr || size == nullptr)
    return fail("found a state that this instance does not know, or no place for its size");
  *size = bytes_of(*found);
  return Status::ok;
}

Status Instance::write_state(void* state, void* bytes, std::size_t size) {
  const SavedState* const found = find_state(state);
  if (found == nullptr || bytes == nullptr)
    return fail("found a state that this instance does not know, or no place for its bytes");
  if (size != bytes_of(*found))
    return fail("found room for %zu bytes, expected %zu", size, bytes_of(*found));
  write_bytes(
      *found,
      {version_, f_.fingerprint(simulation_), first_inputs_.size(), first_parameters_.size()},
      static_cast<unsigned char*>(bytes));
  return Status::ok;
}

Status Instance::read_state(const void* bytes, std::size_t size, void** state) {
  if (bytes == nullptr || state == nullptr)
    return fail("found NULL, expected the bytes of a state and where it is to be written");
  if (*state != nullptr && find_state(*state) == nullptr)
    return fail("found a state that this instance does not know, expected NULL or one of its own");
  SavedState read;
  const char* const wrong = read_bytes(
      static_cast<const unsigned char*>(bytes), size,
      {version_, f_.fingerprint(simulation_), first_inputs_.size(), first_parameters_.size()},
      read);
  if (wrong != nullptr) return fail("%s", wrong);
  if (*state == nullptr) {
    states_.push_back(std::make_unique<SavedState>());
    *state = states_.back().get();
  }
  *find_state(*state) = std::move(read);
  return Status::ok;
}

}  // namespace floatframe::fmi
