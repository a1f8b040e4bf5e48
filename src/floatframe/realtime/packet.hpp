#pragma once
// The packets that a paced model exchanges with controllers and test rigs. All numbers are little
// endian on any machine:
//
//   offset  bytes  field
//        0      4  magic "FFRT"
//        4      2  version, unsigned: 1
//        6      2  kind, unsigned: 1 inputs of the model, 2 outputs of the model
//        8      8  hash of the layout, unsigned (names, units and order of the values)
//       16      8  sequence number, unsigned
//       24      8  time [s], IEEE 754 double
//       32      4  count of values, unsigned
//       36      4  flags, unsigned: bit 0: the last packet of the run
//       40  8 * n  values, IEEE 754 doubles, in the order of the layout
//
// A packet is exactly 40 + 8 count bytes long. Outputs: the sequence number is the number of the
// step they follow (0: the start), the time is that of the model. Inputs: the sequence number is
// that of the outputs they answer, or 0 if they answer none; their time is ignored.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace floatframe {

struct Model;

struct SignalName {
  std::string name, unit;
};

/// Names, units and order of the values in the packets of one direction.
struct SignalLayout {
  std::vector<SignalName> signals;
  /// FNV-1a, 64 bits, over "name TAB unit LF" of all signals in UTF-8.
  std::uint64_t hash() const noexcept;
};
SignalLayout input_layout(const Model& model);
SignalLayout output_layout(const Model& model);

enum class PacketKind : std::uint16_t { inputs = 1, outputs = 2 };

inline constexpr std::size_t packet_header_size = 40;
inline constexpr std::size_t largest_packet = 65507;  ///< limit of UDP over IPv4
inline constexpr std::size_t largest_count = (largest_packet - packet_header_size) / 8;
inline constexpr std::uint32_t last_packet_flag = 1;

constexpr std::size_t packet_size(std::size_t count) noexcept {
  return packet_header_size + 8 * count;
}

struct PacketHeader {
  PacketKind kind = PacketKind::outputs;
  std::uint64_t layout = 0, sequence = 0;
  double time = 0.0;
  std::uint32_t flags = 0;
};

/// Writes packet_size(values.size()) bytes to `out`, which must have that size.
void encode_packet(const PacketHeader& header, std::span<const double> values,
                   std::span<std::byte> out) noexcept;

/// foreign: not a packet of this protocol, version and direction. layout: valid, but with a hash,
/// count or length of another model.
enum class PacketError { none, foreign, layout };

/// Checks everything and reads the values; the size of `values` is the expected count, and its
/// contents change only if the packet is valid.
PacketError decode_packet(std::span<const std::byte> bytes, PacketKind kind, std::uint64_t layout,
                          PacketHeader& header, std::span<double> values) noexcept;

}  // namespace floatframe
