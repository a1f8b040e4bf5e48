#include "fmi/saved_state.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

static_assert(std::endian::native == std::endian::little);

namespace floatframe::fmi {
namespace {

constexpr std::uint64_t magic = 0x3145544154534646;  // "FFSTATE1"

std::uint64_t fnv(const unsigned char* bytes, std::size_t count) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (std::size_t k = 0; k < count; ++k) hash = (hash ^ bytes[k]) * 0x100000001b3;
  return hash;
}

std::uint64_t hash_of(const char* text) {
  unsigned char bytes[256] = {};
  const std::size_t length = std::strlen(text) < sizeof bytes ? std::strlen(text) : sizeof bytes;
  std::memcpy(bytes, text, length);
  return fnv(bytes, length);
}

/// Of fixed size, before the arrays.
struct Head {
  std::uint64_t magic = 0, fingerprint = 0, version = 0, state = 0, needs_start = 0;
  double start = 0.0, stop = 0.0, shift = 0.0, overruns = 0.0, largest_share = 0.0;
  std::uint64_t inputs = 0, parameters = 0, model = 0;
};
static_assert(sizeof(Head) == 8 * 13);  // without gaps

}  // namespace

std::size_t bytes_of(const SavedState& state) {
  return sizeof(Head) + 8 * (state.inputs.size() + state.parameters.size()) + state.model.size() +
         8;
}

void write_bytes(const SavedState& state, const StateOwner& owner, unsigned char* bytes) {
  const Head head{magic,
                  hash_of(owner.fingerprint),
                  std::uint64_t(owner.version),
                  std::uint64_t(state.state),
                  state.run.needs_start ? 1u : 0u,
                  state.run.start,
                  state.run.stop,
                  state.run.shift,
                  state.run.overruns,
                  state.run.largest_share,
                  state.inputs.size(),
                  state.parameters.size(),
                  state.model.size()};
  unsigned char* to = bytes;
  const auto put = [&to](const void* from, std::size_t count) {
    if (count > 0) std::memcpy(to, from, count);
    to += count;
  };
  put(&head, sizeof head);
  put(state.inputs.data(), 8 * state.inputs.size());
  put(state.parameters.data(), 8 * state.parameters.size());
  put(state.model.data(), state.model.size());
  const std::uint64_t sum = fnv(bytes, std::size_t(to - bytes));
  put(&sum, 8);
}

const char* read_bytes(const unsigned char* bytes, std::size_t size, const StateOwner& owner,
                       SavedState& state) {
  Head head;
  if (size < sizeof head + 8) return "the bytes are too few for a state";
  std::memcpy(&head, bytes, sizeof head);
  if (head.magic != magic) return "the bytes are not those of a state";
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes + size - 8, 8);
  if (sum != fnv(bytes, size - 8)) return "the bytes are damaged: their checksum differs";
  if (head.fingerprint != hash_of(owner.fingerprint)) return "the state is of another model";
  if (head.version != std::uint64_t(owner.version)) return "the state is of another version of FMI";
  const std::uint64_t room = size - sizeof head - 8;
  const bool both = head.needs_start != 0;
  if (head.inputs != (both ? owner.inputs : 0) ||
      head.parameters != (both ? owner.parameters : 0) || head.model > room ||
      8 * (head.inputs + head.parameters) + head.model != room)
    return "the sizes in the state are not those of this model";
  if (head.state > std::uint64_t(State::failed) ||
      head.state == std::uint64_t(State::intermediate) ||
      (owner.version == 3 && head.state == std::uint64_t(State::failed)) || head.needs_start > 1 ||
      (both && head.state == std::uint64_t(State::stepping)) || !std::isfinite(head.start) ||
      !std::isfinite(head.shift) || !(head.stop >= head.start))
    return "the state has values that no instance has";
  state.state = State(head.state);
  state.run = {head.start, head.stop, head.shift, both, head.overruns, head.largest_share};
  const unsigned char* from = bytes + sizeof head;
  const auto take = [&from](void* to, std::size_t count) {
    if (count > 0) std::memcpy(to, from, count);
    from += count;
  };
  state.inputs.resize(head.inputs);
  state.parameters.resize(head.parameters);
  state.model.resize(head.model);
  take(state.inputs.data(), 8 * state.inputs.size());
  take(state.parameters.data(), 8 * state.parameters.size());
  take(state.model.data(), state.model.size());
  return nullptr;
}

}  // namespace floatframe::fmi
