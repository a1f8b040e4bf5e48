// UDP over the loopback interface: what is used, what is refused and counted, and lock step.
#include "floatframe/realtime/udp_port.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <thread>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/simulation/simulation.hpp"
#include "support/allocation_counter.hpp"

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

/// A port and a controller's socket that know each other.
struct Loop {
  explicit Loop(bool lock_step = false, double timeout = 0.05)
      : controller(parse_udp_address("127.0.0.1:0", "test")), port(model, [&] {
          UdpPortOptions o;
          o.inputs = o.outputs = true;
          o.listen = parse_udp_address("127.0.0.1:0", "test");
          o.send = controller.local();
          o.lock_step = lock_step;
          o.timeout = timeout;
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

TEST(UdpPort, SendsOutputs) {
  Loop loop;
  loop.port.send(7, 0.25, Values{3.5}, true);
  std::vector<std::byte> bytes(1000);
  ASSERT_TRUE(loop.controller.wait(1.0));
  const long n = loop.controller.receive(bytes);
  ASSERT_EQ(n, static_cast<long>(packet_size(1)));
  PacketHeader h;
  double value = 0.0;
  ASSERT_EQ(decode_packet(std::span(bytes).first(static_cast<std::size_t>(n)), PacketKind::outputs,
                          output_layout(loop.model).hash(), h, std::span(&value, 1)),
            PacketFault::none);
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
  EXPECT_TRUE(parse_udp_address("127.1.2.3:1", "--send").loopback());
  EXPECT_TRUE(parse_udp_address("[::1]:1", "--send").loopback());
  EXPECT_FALSE(parse_udp_address("192.0.2.1:1", "--send").loopback());
  for (const char* bad : {"", "127.0.0.1", ":80", "127.0.0.1:", "127.0.0.1:70000", "127.0.0.1:-1",
                          "127.0.0.1:8a", "::1:80", "127.0.0.1:800000000000000000000"}) {
    try {
      parse_udp_address(bad, "--send");
      ADD_FAILURE() << bad;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()),
                "--send: found '" + std::string(bad) +
                    "', expected HOST:PORT, for example 127.0.0.1:47100");
    }
  }
}

TEST(UdpSocket, SaysWhenThePortIsTaken) {
  const UdpSocket first(parse_udp_address("127.0.0.1:0", "test"));
  EXPECT_THROW(UdpSocket{first.local()}, RunError);
}

}  // namespace
}  // namespace floatframe::test
