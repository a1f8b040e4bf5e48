#include "floatframe/stepping/simulation_state.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string_view>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/stepping/simulation_memory.hpp"
#include "floatframe/stepping/state_bytes.hpp"

namespace floatframe {
namespace {

constexpr std::string_view state_magic = "ffstate\n";
constexpr std::uint64_t state_version = 5;
constexpr const char* saved_state = "the saved state";
constexpr std::size_t checksum_size = 32;

std::string checksum(std::span<const std::byte> bytes) {
  return content_hash({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// The content in one order, for writing and for reading.
template <class Stream, class Data>
void serialize(Stream& s, Data& d) {
  s(d.fingerprint);
  for (auto* n : {&d.coordinates, &d.inertia, &d.max_iterations, &d.locate_edges, &d.input}) s(*n);
  for (auto* x : {&d.step, &d.spectral_radius, &d.tolerance, &d.min_step, &d.penalty,
                  &d.position_tolerance, &d.velocity_tolerance, &d.joints_time})
    s(*x);
  for (auto* v : {&d.inputs, &d.row, &d.joints}) s(*v);
  serialize_steps(s, d.steps);
}

}  // namespace

double SimulationState::time() const noexcept { return data_ ? data_->steps.state.t : 0.0; }

std::vector<std::byte> SimulationState::to_bytes() const {
  if (!data_)
    throw InputError(ErrorCode::missing,
                     "found a saved state that is empty, expected one of a simulation");
  StateWriter out;
  out.raw(state_magic);
  out(state_version);
  serialize(out, *data_);
  out.raw(checksum(out.bytes));
  return std::move(out.bytes);
}

SimulationState SimulationState::from_bytes(std::span<const std::byte> bytes) {
  if (bytes.size() < state_magic.size() ||
      std::memcmp(bytes.data(), state_magic.data(), state_magic.size()) != 0)
    throw InputError(ErrorCode::wrong_file,
                     "this is not the saved state of a simulation: expected bytes of to_bytes()");
  if (bytes.size() < state_magic.size() + 8 + checksum_size)
    throw InputError(ErrorCode::damaged, "the saved state is damaged: it ends too early");
  std::uint64_t version = 0;
  StateReader(bytes.subspan(state_magic.size()), saved_state)(version);
  if (version != state_version)
    throw InputError(ErrorCode::mismatch,
                     fmt::format("the saved state has version {}, this program reads version {}",
                                 version, state_version));
  const auto content = bytes.first(bytes.size() - checksum_size);
  if (std::memcmp(bytes.last(checksum_size).data(), checksum(content).data(), checksum_size) != 0)
    throw InputError(ErrorCode::damaged,
                     "the saved state is damaged: its checksum does not fit its content");
  auto data = std::make_shared<Data>();
  StateReader in(content.subspan(state_magic.size() + 8), saved_state);
  serialize(in, *data);
  if (!in.at_end())
    throw InputError(ErrorCode::damaged, "the saved state is damaged: there is data after its end");
  return SimulationState(std::move(data));
}

}  // namespace floatframe
