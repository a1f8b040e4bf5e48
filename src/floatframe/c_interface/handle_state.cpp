// Saved states of a handle: those of the simulation, with the parameters that it steps with and the
// values that its start was found with.
#include <cmath>
#include <cstring>
#include <string_view>

#include "floatframe/c_interface/simulation_handle.hpp"
#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/stepping/state_bytes.hpp"

namespace floatframe {
namespace {

constexpr std::string_view handle_magic = "ffhandle";
constexpr std::uint64_t handle_version = 1;
constexpr std::size_t digits = 32;  ///< of the checksum

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

struct SimulationHandle::Saved {
  std::string fingerprint;
  StartValues start;
  std::vector<double> running;
  std::string state;

  template <class Stream, class Self>
  static void serialize(Stream& s, Self& self) {
    s(self.fingerprint);
    s(self.start.inputs);
    s(self.start.parameters);
    s(self.running);
    s(self.state);
  }
};

floatframe_status SimulationHandle::save() {
  require_start("a state to save");
  if (failed_)
    throw WrongOrder(
        "found a state to save after a failed step, expected one that can go on: restore an "
        "earlier state, or start again");
  const std::vector<std::byte> state = simulation_->save().to_bytes();
  const Saved saved{fingerprint_, start_, running_, std::string(text_of(state))};
  StateWriter out;
  out.raw(handle_magic);
  out(handle_version);
  Saved::serialize(out, saved);
  out.raw(content_hash(text_of(out.bytes)));
  saved_ = std::move(out.bytes);
  return FLOATFRAME_OK;
}

SimulationHandle::Saved SimulationHandle::read(std::span<const std::byte> bytes) const {
  const std::string_view text = text_of(bytes);
  if (!text.starts_with(handle_magic))
    throw InputError(ErrorCode::wrong_file,
                     "this is not a saved state: expected the bytes of floatframe_saved");
  if (text.size() < handle_magic.size() + 8 + digits ||
      content_hash(text.substr(0, text.size() - digits)) != text.substr(text.size() - digits))
    throw InputError(ErrorCode::damaged,
                     "the saved state is damaged: its checksum does not fit its content");
  StateReader in(bytes.subspan(handle_magic.size(), bytes.size() - handle_magic.size() - digits),
                 "the saved state");
  std::uint64_t version = 0;
  in(version);
  if (version != handle_version)
    throw InputError(ErrorCode::mismatch,
                     fmt::format("the saved state has version {}, this library reads version {}",
                                 version, handle_version));
  Saved saved;
  Saved::serialize(in, saved);
  if (!in.at_end())
    throw InputError(ErrorCode::damaged, "the saved state is damaged: there is data after its end");
  if (saved.fingerprint != fingerprint_ || saved.start.inputs.size() != inputs_.size() ||
      saved.start.parameters.size() != parameters_.size() ||
      saved.running.size() != parameters_.size())
    throw InputError(ErrorCode::mismatch, "the saved state is of another model");
  return saved;
}

floatframe_status SimulationHandle::restore(std::span<const std::byte> bytes) {
  Saved saved = read(bytes);
  const SimulationState state =
      SimulationState::from_bytes(std::as_bytes(std::span<const char>(saved.state)));
  const bool same_start = simulation_ && saved.start == start_;
  std::vector<std::string> notes;
  std::unique_ptr<Simulation> other;  // where the present one cannot return to the state
  if (!same_start || (failed_ && saved.running != running_)) {
    Model model = built(saved.start.parameters);
    other = begun(model, saved.start.inputs);
    if (saved.running != saved.start.parameters) other->change_model(built(saved.running));
    other->restore(state);
    notes = other->start_report().notes;
  } else if (saved.running != running_) {
    const Model model = built(saved.running);
    const SimulationState before = simulation_->save();
    simulation_->change_model(model);
    try {
      simulation_->restore(state);
    } catch (...) {
      simulation_->change_model(built(running_));
      simulation_->restore(before);
      throw;
    }
  } else {
    simulation_->restore(state);
  }
  std::optional<Model> next;  // to judge inputs by
  std::vector<std::string> expected;
  if (stale_ || saved.running != parameters_) {
    next = built(saved.running);
    expected = expectations(*next);
  }
  // Nothing throws from here on.
  if (other) notes_ = std::move(notes);
  take(other ? std::move(other) : std::move(simulation_), std::move(saved.start));
  std::ranges::copy(simulation_->inputs(), inputs_.begin());
  given_.assign(inputs_.size(), true);
  if (next) adopt(std::move(*next), std::move(expected));
  parameters_ = saved.running;
  running_ = std::move(saved.running);
  return FLOATFRAME_OK;
}

}  // namespace floatframe
