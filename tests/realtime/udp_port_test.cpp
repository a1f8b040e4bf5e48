// UDP over the loopback interface: what is used, what is refused and counted, and lock step.
#include "floatframe/realtime/udp_port.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/run/run.hpp"
#include "support/allocation_counter.hpp"
#include "support/error_of.hpp"

namespace floatframe::test {
namespace {

Model two_in_one_out() {
  Model m;
  m.inputs.push_back({"a", "N", 0.5, -10.0, 10.0});
  m.inputs.push_back({"b", "m", 0.0});
  Output o;
  o.name = "z";
  o.unit = "m";
  m.outputs.push_back(o);
  return m;
}

/// A port and a controller's socket; the port hears the controller only if it is named.
struct Loop {
  explicit Loop(bool lock_step = false, double timeout = 0.05, bool named = false)
      : controller(parse_udp_address("127.0.0.1:0", "test")), port(model, [&] {
          UdpPortOptions o;
          o.inputs = o.outputs = true;
          o.listen = parse_udp_address("127.0.0.1:0", "test");
          o.send = controller.local();
          o.lock_step = lock_step;
          o.timeout = timeout;
          if (named) o.peer = o.send;
          return o;
        }()) {}

  std::vector<std::byte> packet(std::uint64_t sequence, std::vector<double> values) const {
    std::vector<std::byte> bytes(packet_size(values.size()));
    encode_packet({PacketKind::inputs, input_layout(model).hash(), sequence, 0.0, 0}, values,
                  bytes);
    return bytes;
  }
  void tell(const std::vector<std::byte>& bytes) {
    ASSERT_EQ(controller.send(port.local(), bytes), 0);
  }
  void tell_from(UdpSocket& other, const std::vector<std::byte>& bytes) {
    ASSERT_EQ(other.send(port.local(), bytes), 0);
  }
  std::vector<double> values() const { return {inputs.values().begin(), inputs.values().end()}; }

  Model model = two_in_one_out();
  UdpSocket controller;
  UdpPort port;
  InputBuffer inputs{model};
};

using Values = std::vector<double>;

TEST(UdpPort, NewestPacketWins) {
  Loop loop;
  EXPECT_FALSE(loop.port.receive(loop.inputs));
  loop.tell(loop.packet(0, {1, 2}));
  loop.tell(loop.packet(0, {3, 4}));
  loop.tell(loop.packet(0, {5, 6}));
  EXPECT_TRUE(loop.port.wait());
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{5, 6}));
  EXPECT_FALSE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{5, 6}));
  EXPECT_EQ(loop.port.counts().received, 3);
  EXPECT_EQ(loop.port.counts().used, 1);
  EXPECT_EQ(loop.port.counts().superseded, 2);
}

TEST(UdpPort, AnswersToOlderOutputsAreStale) {
  Loop loop;
  const Values outputs{1.0};
  for (std::uint64_t k = 0; k <= 10; ++k) loop.port.send(k, 0.1, outputs, false);
  loop.tell(loop.packet(9, {1, 1}));
  loop.tell(loop.packet(8, {2, 2}));
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{1, 1}));
  loop.tell(loop.packet(8, {3, 3}));
  EXPECT_FALSE(loop.port.receive(loop.inputs));
  loop.tell(loop.packet(0, {4, 4}));  // answers nothing: always taken
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{4, 4}));
  EXPECT_EQ(loop.port.counts().stale, 2);
  EXPECT_EQ(loop.port.counts().largest_age, 1);
  // A number from the future does not shut out the answers to come.
  loop.tell(loop.packet(1'000'000, {5, 5}));
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  loop.port.send(11, 0.1, outputs, false);
  loop.tell(loop.packet(11, {6, 6}));
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{6, 6}));
}

TEST(UdpPort, ForeignMismatchedAndBadValuesAreCountedAndIgnored) {
  Loop loop;
  loop.tell({});
  loop.tell(std::vector<std::byte>(3));
  loop.tell(std::vector<std::byte>(4000, std::byte{0x46}));
  std::vector<std::byte> bytes(packet_size(2));
  const Values values{1, 2};
  const std::uint64_t hash = input_layout(loop.model).hash();
  encode_packet({PacketKind::outputs, hash, 0, 0, 0}, values, bytes);
  loop.tell(bytes);
  encode_packet({PacketKind::inputs, hash + 1, 0, 0, 0}, values, bytes);
  loop.tell(bytes);
  loop.tell(loop.packet(0, {1}));
  std::vector<std::byte> longer = loop.packet(0, {1, 2});
  longer.resize(longer.size() + 1);
  loop.tell(longer);
  longer.resize(longer.size() - 2);
  loop.tell(longer);
  EXPECT_FALSE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.port.counts().received, 8);
  EXPECT_EQ(loop.port.counts().foreign, 4);
  EXPECT_EQ(loop.port.counts().mismatched, 4);
  EXPECT_EQ(loop.values(), (Values{0.5, 0.0}));
  loop.tell(loop.packet(0, {11, std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{0.5, 0.0}));
  EXPECT_EQ(loop.inputs.refused(0), 1);
  EXPECT_EQ(loop.inputs.refused(1), 1);
}

TEST(UdpPort, OnlyTheFirstPeerIsAccepted) {
  Loop loop;
  UdpSocket other(parse_udp_address("127.0.0.1:0", "test"));
  EXPECT_FALSE(loop.port.peer().known());
  // Nonsense begins no exchange.
  loop.tell_from(other, {});
  loop.tell(loop.packet(0, {1, 2}));
  loop.tell_from(other, loop.packet(0, {3, 4}));
  loop.tell_from(other, loop.packet(7, {5, 6}));
  loop.tell_from(other, std::vector<std::byte>(9));
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{1, 2}));
  EXPECT_EQ(loop.port.peer().text(), loop.controller.local().text());
  const UdpCounts c = loop.port.counts();
  EXPECT_EQ(c.received, 5);
  EXPECT_EQ(c.foreign, 1);
  EXPECT_EQ(c.other, 3);
  ASSERT_EQ(loop.port.other_senders().size(), 1u);
  EXPECT_EQ(loop.port.other_senders()[0].address.text(), other.local().text());
  EXPECT_EQ(loop.port.other_senders()[0].packets, 3);
}

TEST(UdpPort, OnlyTheNamedPeerIsAccepted) {
  for (const bool lock_step : {false, true}) {
    Loop loop(lock_step, 0.05, true);
    UdpSocket other(parse_udp_address("127.0.0.1:0", "test"));
    loop.tell_from(other, loop.packet(0, {3, 4}));
    EXPECT_EQ(loop.port.wait(), !lock_step);
    EXPECT_FALSE(loop.port.receive(loop.inputs));
    loop.tell(loop.packet(0, {1, 2}));
    EXPECT_TRUE(loop.port.wait());
    EXPECT_TRUE(loop.port.receive(loop.inputs));
    EXPECT_EQ(loop.values(), (Values{1, 2}));
    EXPECT_EQ(loop.port.counts().other, 1);
  }
}

TEST(InputFilter, ListsTheFirstOfManyOtherSenders) {
  UdpAddress peer = parse_udp_address("127.0.0.1:1000", "test");
  InputFilter filter(1, 17, false, peer);
  const double value = 2.5;
  std::vector<std::byte> bytes(packet_size(1));
  encode_packet({PacketKind::inputs, 17, 0, 0.0, 0}, std::span(&value, 1), bytes);
  for (int round = 0; round < 2; ++round)
    for (std::uint16_t port = 2000; port < 2012; ++port) {
      UdpAddress from = peer;
      from.set_port(port);
      filter.take(bytes, bytes.size(), from);
    }
  EXPECT_FALSE(filter.fresh());
  EXPECT_EQ(filter.counts().other, 24);
  EXPECT_EQ(filter.others().size(), InputFilter::most_senders);
  EXPECT_EQ(filter.others().back().packets, 2);
  filter.take(bytes, bytes.size(), peer);
  EXPECT_TRUE(filter.fresh());
  EXPECT_EQ(filter.hand_over()[0], 2.5);
}

TEST(InputFilter, APeerWithoutAPortMaySendFromAny) {
  InputFilter filter(0, 17, false, parse_udp_peer("127.0.0.1", "test"));
  std::vector<std::byte> bytes(packet_size(0));
  encode_packet({PacketKind::inputs, 17, 0, 0.0, 0}, {}, bytes);
  filter.take(bytes, bytes.size(), parse_udp_address("127.0.0.2:5", "test"));
  EXPECT_FALSE(filter.fresh());
  filter.take(bytes, bytes.size(), parse_udp_address("127.0.0.1:6", "test"));
  // As a socket of both kinds shows the same host.
  filter.take(bytes, bytes.size(), parse_udp_address("[::ffff:127.0.0.1]:7", "test"));
  EXPECT_EQ(filter.counts().other, 1);
  EXPECT_EQ(filter.counts().superseded, 1);
  EXPECT_TRUE(filter.fresh());
}

TEST(InputBuffer, ClampsOnRequest) {
  Model model = two_in_one_out();
  model.inputs[0].clamp = true;
  InputBuffer inputs(model);
  const auto accept = [&](double a) {
    inputs.accept(Values{a, 1.0});
    return inputs.values()[0];
  };
  EXPECT_EQ(accept(11.0), 10.0);
  EXPECT_EQ(accept(-1e300), -10.0);
  EXPECT_EQ(accept(3.0), 3.0);
  EXPECT_EQ(accept(std::numeric_limits<double>::quiet_NaN()), 3.0);
  EXPECT_EQ(accept(std::numeric_limits<double>::infinity()), 3.0);
  EXPECT_EQ(inputs.clamped(0), 2);
  EXPECT_EQ(inputs.refused(0), 2);
}

TEST(UdpPort, SendsOutputs) {
  Loop loop;
  loop.port.send(7, 0.25, Values{3.5}, true);
  std::vector<std::byte> bytes(1000);
  ASSERT_TRUE(loop.controller.wait(1.0));
  const long n = loop.controller.receive(bytes);
  ASSERT_EQ(n, static_cast<long>(packet_size(1)));
  PacketHeader h;
  double value = 0.0;
  ASSERT_EQ(decode_packet(std::span(bytes).first(n), PacketKind::outputs,
                          output_layout(loop.model).hash(), h, std::span(&value, 1)),
            PacketError::none);
  EXPECT_EQ(h.sequence, 7u);
  EXPECT_EQ(h.time, 0.25);
  EXPECT_EQ(h.flags, last_packet_flag);
  EXPECT_EQ(value, 3.5);
  EXPECT_EQ(loop.port.counts().sent, 1);
}

TEST(UdpPort, LockStepTakesOnlyTheAnswer) {
  Loop loop(true, 5.0);
  loop.port.send(3, 0.1, Values{1.0}, false);
  loop.tell(loop.packet(0, {1, 1}));
  loop.tell(loop.packet(4, {2, 2}));
  loop.tell(loop.packet(3, {3, 3}));
  EXPECT_TRUE(loop.port.wait());
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{3, 3}));
  EXPECT_EQ(loop.port.counts().stale, 2);
}

TEST(UdpPort, LockStepRepeatsItsOutputsAndGivesUp) {
  Loop loop(true, 0.25);
  loop.port.send(0, 0.0, Values{1.0}, false);
  EXPECT_FALSE(loop.port.wait());
  EXPECT_GE(loop.port.counts().repeated, 1);
  EXPECT_EQ(loop.port.counts().sent, 1 + loop.port.counts().repeated);
}

TEST(UdpPort, LockStepWithALateController) {
  Loop loop(true, 30.0);
  loop.port.send(0, 0.0, Values{1.0}, false);
  std::thread late([&loop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    loop.tell(loop.packet(0, {7, 8}));
  });
  EXPECT_TRUE(loop.port.wait());
  late.join();
  EXPECT_TRUE(loop.port.receive(loop.inputs));
  EXPECT_EQ(loop.values(), (Values{7, 8}));
}

TEST(UdpPort, DoesNotAllocate) {
  if (!allocations_counted()) GTEST_SKIP() << "allocations are not counted in this build";
  Loop loop;
  const Values outputs{1.0};
  const std::vector<std::byte> good = loop.packet(0, {1, 2});
  const UdpAddress to = loop.port.local();
  const AllocationScope scope;
  for (std::uint64_t k = 0; k < 20; ++k) {
    loop.controller.send(to, good);
    loop.port.wait();
    loop.port.receive(loop.inputs);
    loop.port.send(k, 0.0, outputs, false);
  }
  EXPECT_EQ(scope.count(), 0u);
  EXPECT_EQ(loop.port.counts().used, 20);
}

TEST(UdpAddress, IsReadAndShown) {
  EXPECT_EQ(parse_udp_address("127.0.0.1:47100", "--send").text(), "127.0.0.1:47100");
  EXPECT_EQ(parse_udp_address("[::1]:80", "--send").text(), "[::1]:80");
  for (const char* bad : {"", "127.0.0.1", ":80", "127.0.0.1:", "127.0.0.1:70000", "127.0.0.1:-1",
                          "127.0.0.1:8a", "::1:80", "127.0.0.1:800000000000000000000"})
    EXPECT_EQ(test::error_of([&] { parse_udp_address(bad, "--send"); }), "wrong_value") << bad;
}

TEST(UdpAddress, APeerMayBeAHostAlone) {
  EXPECT_EQ(parse_udp_peer("127.0.0.1", "--peer").text(), "127.0.0.1");
  EXPECT_EQ(parse_udp_peer("[::1]", "--peer").text(), "[::1]");
  EXPECT_EQ(parse_udp_peer("127.0.0.1:80", "--peer").text(), "127.0.0.1:80");
  for (const char* bad : {"", ":80", "127.0.0.1:", "127.0.0.1:x", "::1", "[]:1"})
    EXPECT_THROW(parse_udp_peer(bad, "--peer"), InputError) << bad;
}

TEST(UdpAddress, TheWayToThisMachineStaysInside) {
  EXPECT_EQ(local_address_towards(parse_udp_address("127.0.0.1:47101", "t"), "t").text(),
            "127.0.0.1");
}

TEST(UdpSocket, APortInUseIsAnError) {
  const UdpSocket first(parse_udp_address("127.0.0.1:0", "test"));
  EXPECT_THROW(UdpSocket{first.local()}, RunError);
}

}  // namespace
}  // namespace floatframe::test
