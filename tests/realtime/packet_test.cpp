// The bytes of packets, written out by hand, and packets that are wrong.
#include "floatframe/realtime/packet.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "floatframe/model/model.hpp"
#include "floatframe/realtime/input_buffer.hpp"

namespace floatframe {
namespace {

std::vector<std::byte> bytes_of(const std::vector<int>& values) {
  std::vector<std::byte> out;
  for (const int v : values) out.push_back(static_cast<std::byte>(v));
  return out;
}

const std::vector<int> example{'F',  'F',  'R',  'T',                            // magic
                               1,    0,                                          // version
                               1,    0,                                          // kind: inputs
                               0xef, 0xcd, 0xab, 0x89, 0x67, 0x45, 0x23, 0x01,   // layout
                               0x2a, 0,    0,    0,    0,    0,    0,    0,      // sequence
                               0,    0,    0,    0,    0,    0,    0xf8, 0x3f,   // time 1.5
                               2,    0,    0,    0,                              // count
                               1,    0,    0,    0,                              // flags
                               0,    0,    0,    0,    0,    0,    0,    0xc0,   // -2
                               0x9a, 0x99, 0x99, 0x99, 0x99, 0x99, 0xb9, 0x3f};  // 0.1
constexpr std::uint64_t layout = 0x0123456789abcdef;

TEST(Packet, BytesAreAsDocumented) {
  std::vector<std::byte> out(packet_size(2));
  const double values[] = {-2.0, 0.1};
  encode_packet({PacketKind::inputs, layout, 42, 1.5, last_packet_flag}, values, out);
  EXPECT_EQ(out, bytes_of(example));
}

TEST(Packet, ComesBack) {
  PacketHeader h;
  double values[2] = {};
  ASSERT_EQ(decode_packet(bytes_of(example), PacketKind::inputs, layout, h, values),
            PacketError::none);
  EXPECT_EQ(h.sequence, 42u);
  EXPECT_EQ(h.time, 1.5);
  EXPECT_EQ(h.flags, 1u);
  EXPECT_EQ(values[0], -2.0);
  EXPECT_EQ(values[1], 0.1);
}

TEST(Packet, EveryOtherByteOfTheHeaderIsRefused) {
  // Magic, version, kind: foreign; layout and count: mismatched; sequence, time, flags: free.
  for (std::size_t i = 0; i < packet_header_size; ++i) {
    std::vector<std::byte> bytes = bytes_of(example);
    bytes[i] ^= std::byte{0x40};
    PacketHeader h;
    double values[2] = {7.0, 7.0};
    const PacketError error = decode_packet(bytes, PacketKind::inputs, layout, h, values);
    const PacketError expected = i < 8                           ? PacketError::foreign
                                 : i < 16 || (i >= 32 && i < 36) ? PacketError::layout
                                                                 : PacketError::none;
    EXPECT_EQ(error, expected) << i;
    if (expected != PacketError::none) {
      EXPECT_EQ(values[0], 7.0);
    }
  }
}

TEST(Packet, EveryOtherLengthIsRefused) {
  std::vector<std::byte> bytes = bytes_of(example);
  bytes.resize(200);
  for (std::size_t n = 0; n < 200; ++n) {
    PacketHeader h;
    double values[2];
    const PacketError error =
        decode_packet(std::span(bytes).first(n), PacketKind::inputs, layout, h, values);
    EXPECT_EQ(error, n < packet_header_size ? PacketError::foreign
                     : n == packet_size(2)  ? PacketError::none
                                            : PacketError::layout)
        << n;
  }
}

TEST(Layout, HashIsFnv1aOverNamesAndUnits) {
  EXPECT_EQ(SignalLayout{}.hash(), 0xcbf29ce484222325u);
  // FNV-1a of "a\tN\n", computed by its definition.
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const char c : {'a', '\t', 'N', '\n'})
    h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  EXPECT_EQ((SignalLayout{{{"a", "N"}}}.hash()), h);
}

TEST(Layout, HashDependsOnNamesUnitsAndOrder) {
  const SignalLayout ab{{{"a", "N"}, {"b", "m"}}};
  for (const SignalLayout& other :
       {SignalLayout{{{"b", "m"}, {"a", "N"}}}, SignalLayout{{{"a", "m"}, {"b", "N"}}},
        SignalLayout{{{"a", "N"}}}, SignalLayout{{{"a", "N"}, {"b", "m"}, {"", ""}}},
        SignalLayout{{{"aN", ""}, {"b", "m"}}}})
    EXPECT_NE(ab.hash(), other.hash());
}

TEST(InputBuffer, RefusesValuesNotFiniteOrOutside) {
  Model model;
  model.inputs.push_back({"a", "N", 1.0, -5.0, 5.0});
  model.inputs.push_back({"b", "N", 2.0});
  InputBuffer buffer(model);
  const auto values = [&](std::initializer_list<double> wanted) {
    buffer.accept(std::vector<double>(wanted));
    return std::vector<double>(buffer.values().begin(), buffer.values().end());
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = HUGE_VAL;
  EXPECT_EQ(values({3.0, 4.0}), (std::vector<double>{3.0, 4.0}));
  EXPECT_EQ(values({5.1, 6.0}), (std::vector<double>{3.0, 6.0}));
  EXPECT_EQ(values({-5.0, nan}), (std::vector<double>{-5.0, 6.0}));
  EXPECT_EQ(values({nan, inf}), (std::vector<double>{-5.0, 6.0}));
  EXPECT_EQ(values({-inf, 1e300}), (std::vector<double>{-5.0, 1e300}));
  EXPECT_EQ(buffer.refused(0), 3);
  EXPECT_EQ(buffer.refused(1), 2);
  buffer.reset();
  EXPECT_EQ(buffer.values()[0], 1.0);
  EXPECT_EQ(buffer.values()[1], 2.0);
}

}  // namespace
}  // namespace floatframe
