#include "floatframe/realtime/packet.hpp"

#include <bit>
#include <cstring>

#include "floatframe/model/model.hpp"

namespace floatframe {
namespace {

constexpr char magic[4] = {'F', 'F', 'R', 'T'};
constexpr std::uint16_t version = 1;

// Byte by byte: independent of the byte order of the machine; compiles to a single move.
template <class T>
void put(std::byte* at, T value) noexcept {
  for (std::size_t i = 0; i < sizeof(T); ++i) at[i] = static_cast<std::byte>(value >> (8 * i));
}
template <class T>
T get(const std::byte* at) noexcept {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    value = static_cast<T>(value | (static_cast<T>(std::to_integer<T>(at[i])) << (8 * i)));
  return value;
}
void put(std::byte* at, double value) noexcept { put(at, std::bit_cast<std::uint64_t>(value)); }
double get_double(const std::byte* at) noexcept {
  return std::bit_cast<double>(get<std::uint64_t>(at));
}

}  // namespace

std::uint64_t SignalLayout::hash() const noexcept {
  std::uint64_t h = 0xcbf29ce484222325;
  const auto add = [&h](const std::string& text, char end) {
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    h = (h ^ static_cast<unsigned char>(end)) * 0x100000001b3;
  };
  for (const SignalName& s : signals) {
    add(s.name, '\t');
    add(s.unit, '\n');
  }
  return h;
}

SignalLayout input_layout(const Model& model) {
  SignalLayout layout;
  for (const Input& input : model.inputs) layout.signals.push_back({input.name, input.unit});
  return layout;
}

SignalLayout output_layout(const Model& model) {
  SignalLayout layout;
  for (const Output& output : model.outputs) layout.signals.push_back({output.name, output.unit});
  return layout;
}

void encode_packet(const PacketHeader& header, std::span<const double> values,
                   std::span<std::byte> out) noexcept {
  std::byte* at = out.data();
  std::memcpy(at, magic, sizeof magic);
  put(at + 4, version);
  put(at + 6, static_cast<std::uint16_t>(header.kind));
  put(at + 8, header.layout);
  put(at + 16, header.sequence);
  put(at + 24, header.time);
  put(at + 32, static_cast<std::uint32_t>(values.size()));
  put(at + 36, header.flags);
  for (std::size_t i = 0; i < values.size(); ++i) put(at + packet_header_size + 8 * i, values[i]);
}

PacketError decode_packet(std::span<const std::byte> bytes, PacketKind kind, std::uint64_t layout,
                          PacketHeader& header, std::span<double> values) noexcept {
  const std::byte* at = bytes.data();
  if (bytes.size() < packet_header_size || std::memcmp(at, magic, sizeof magic) != 0 ||
      get<std::uint16_t>(at + 4) != version ||
      get<std::uint16_t>(at + 6) != static_cast<std::uint16_t>(kind))
    return PacketError::foreign;
  if (get<std::uint64_t>(at + 8) != layout || get<std::uint32_t>(at + 32) != values.size() ||
      bytes.size() != packet_size(values.size()))
    return PacketError::layout;
  header.kind = kind;
  header.layout = layout;
  header.sequence = get<std::uint64_t>(at + 16);
  header.time = get_double(at + 24);
  header.flags = get<std::uint32_t>(at + 36);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = get_double(at + packet_header_size + 8 * i);
  return PacketError::none;
}

}  // namespace floatframe
