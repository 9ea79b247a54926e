// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What needs no bus. The rest, filters and the interface's comings and goings, is tried on a real
// one in a virtual machine (can_bus_trial.cpp).
#include "firmware_io/can/socketcan_source.hpp"

#include <gmock/gmock.h>
#include <linux/can/error.h>

#include <thread>

#include "firmware_io/can/can_sender.hpp"
#include "frames.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "socket_pair.hpp"

namespace terracut::test {
namespace {

using can::CanFrame;
using can::CanId;
using can::CanSender;
using can::SocketCanConfig;
using can::SocketCanSource;
using testing::HasSubstr;

constexpr CanId kSpeed{0x123, false};
constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kLong_ns = 60'000 * kMillisecond_ns;

class SocketCanSourceTest : public testing::Test {
 protected:
  SocketCanSource adopt(std::size_t batch = 64) {
    auto source =
        SocketCanSource::adopt(std::move(bus_.here), {.ids = {kSpeed}, .batch = batch}, memory_);
    EXPECT_TRUE(source) << source.error().message;
    return *std::move(source);
  }
  void put_error(std::uint32_t kind) {
    CanFrame frame = data_frame({kind, false}, {0, 0, 0, 0, 0, 0, 0, 0});
    frame.error = true;
    ASSERT_TRUE(bus_.put(frame));
  }

  SocketPair bus_;
  memory::FixedMemory memory_;
};

TEST_F(SocketCanSourceTest, DeliversEveryKindOfFrameInOrderWithAStamp) {
  auto source = adopt();
  std::mt19937 random(5);
  std::vector<CanFrame> sent;
  while (sent.size() < 40) {
    const CanFrame frame = random_frame(random);
    if (frame.error) continue;
    ASSERT_TRUE(bus_.put(frame));
    sent.push_back(frame);
    const std::int64_t before_ns = measure::realtime_ns();
    const auto received = source.receive(kLong_ns);
    ASSERT_EQ(received.size(), 1U);
    CanFrame expected = frame;
    expected.stamp_ns = received[0].stamp_ns;
    EXPECT_EQ(received[0], expected);
    EXPECT_NEAR(static_cast<double>(received[0].stamp_ns), static_cast<double>(before_ns), 60e9);
  }
  EXPECT_EQ(source.counters().received, 40U);
  EXPECT_EQ(source.counters().delivered, 40U);
}

TEST_F(SocketCanSourceTest, ReturnsAtMostABatchAtATime) {
  auto source = adopt(4);
  std::size_t put = 0;
  for (std::uint8_t i = 0; i < 9; ++i) put += bus_.put(data_frame(kSpeed, {i}));
  ASSERT_EQ(put, 9U);
  std::size_t next = 0;
  for (const std::size_t expected : {4U, 4U, 1U}) {
    const auto received = source.receive(kLong_ns);
    ASSERT_EQ(received.size(), expected);
    for (const CanFrame& frame : received) EXPECT_EQ(frame.data[0], next++);
  }
  EXPECT_TRUE(source.receive(0).empty());
}

TEST_F(SocketCanSourceTest, CountsErrorFramesAndKnowsWhetherTheControllerGaveUp) {
  auto source = adopt();
  put_error(CAN_ERR_CRTL);
  EXPECT_TRUE(source.receive(0).empty());
  EXPECT_FALSE(source.bus_off());
  put_error(CAN_ERR_BUSOFF);
  EXPECT_TRUE(source.receive(0).empty());
  EXPECT_TRUE(source.bus_off());
  put_error(CAN_ERR_RESTARTED);
  EXPECT_TRUE(source.receive(0).empty());
  EXPECT_FALSE(source.bus_off());
  put_error(CAN_ERR_BUSOFF | CAN_ERR_CRTL);
  ASSERT_TRUE(bus_.put(data_frame(kSpeed, {1})));
  EXPECT_EQ(source.receive(kLong_ns).size(), 1U);
  EXPECT_FALSE(source.bus_off()) << "a frame came since";
  EXPECT_EQ(source.counters().error_frames, 4U);
  EXPECT_EQ(source.counters().bus_off, 2U);
  EXPECT_EQ(source.counters().restarts, 1U);
  EXPECT_EQ(source.counters().received, 5U);
  EXPECT_EQ(source.counters().delivered, 1U);
}

TEST_F(SocketCanSourceTest, CountsWhatIsNoFrame) {
  auto source = adopt();
  const std::array<std::uint8_t, 200> bytes{};
  ASSERT_EQ(::send(bus_.there.get(), bytes.data(), 3, 0), 3);
  ASSERT_EQ(::send(bus_.there.get(), bytes.data(), bytes.size(), 0), 200);
  EXPECT_TRUE(source.receive(0).empty());
  EXPECT_EQ(source.counters().malformed, 2U);
  EXPECT_EQ(source.counters().received, 2U);
  ASSERT_TRUE(bus_.put(data_frame(kSpeed, {1})));
  EXPECT_EQ(source.receive(kLong_ns).size(), 1U);
}

TEST_F(SocketCanSourceTest, CanBeWokenFromAnotherThread) {
  auto source = adopt();
  std::thread other([&] { source.wake(); });
  EXPECT_TRUE(source.receive(kLong_ns).empty());
  other.join();
  EXPECT_TRUE(source.receive(0).empty());
}

TEST_F(SocketCanSourceTest, TakesAllItsMemoryAtTheStart) {
  auto source = adopt();
  const std::size_t bytes = memory_.total_bytes();
  EXPECT_GT(bytes, 64 * (sizeof(CanFrame) + 72));
  for (std::uint8_t i = 0; i < 200; ++i) {
    ASSERT_TRUE(bus_.put(data_frame(kSpeed, {i})));
    ASSERT_EQ(source.receive(kLong_ns).size(), 1U);
  }
  EXPECT_EQ(memory_.total_bytes(), bytes);
}

TEST_F(SocketCanSourceTest, RefusesSettingsOutOfTheirRange) {
  const auto refused = [&](SocketCanConfig config) {
    const auto source = SocketCanSource::open(std::move(config), memory_);
    EXPECT_FALSE(source);
    if (source) return std::string();
    EXPECT_EQ(source.error().code, ErrorCode::kInvalidArgument);
    return source.error().message;
  };
  EXPECT_THAT(refused({.interface = "can0"}), HasSubstr("0 CAN ids"));
  EXPECT_THAT(refused({.interface = "can0", .ids = std::vector<CanId>(513, kSpeed)}),
              HasSubstr("513 CAN ids"));
  EXPECT_THAT(refused({.interface = "can0", .ids = {{0x800, false}}}), HasSubstr("11 bits"));
}

TEST_F(SocketCanSourceTest, NamesAnInterfaceThatIsNotThereOrHasNoCan) {
  const auto source =
      SocketCanSource::open({.interface = "no_such_can0", .ids = {kSpeed}}, memory_);
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(source.error().message, HasSubstr("no such interface 'no_such_can0'; there are: "));
  EXPECT_EQ(CanSender::open("no_such_can0").error().code, ErrorCode::kNotFound);

  // The loopback is there, but carries no CAN; or the kernel has none at all.
  const auto loopback = SocketCanSource::open({.interface = "lo", .ids = {kSpeed}}, memory_);
  ASSERT_FALSE(loopback);
  EXPECT_THAT(loopback.error().message,
              testing::AnyOf(HasSubstr("'lo' is no CAN interface"), HasSubstr("modprobe can_raw")));
}

TEST(CanSender, SendsWhatASourceReceives) {
  SocketPair bus;
  memory::FixedMemory memory;
  auto sender = CanSender::adopt(std::move(bus.there));
  auto source = SocketCanSource::adopt(std::move(bus.here), {.ids = {kSpeed}}, memory);
  ASSERT_TRUE(source);
  const std::array frames{data_frame(kSpeed, {1, 2, 3}),
                          data_frame({0x18FEF100, true}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})};
  EXPECT_EQ(sender.send(frames), 2U);
  const auto received = source->receive(kLong_ns);
  ASSERT_EQ(received.size(), 2U);
  EXPECT_EQ(received[0].id, kSpeed);
  EXPECT_EQ(received[1].payload().size(), 12U);
  EXPECT_TRUE(received[1].fd);
  EXPECT_EQ(sender.counters().sent, 2U);
}

TEST(CanSender, LeavesOutAndCountsWhatAFullQueueDoesNotTake) {
  SocketPair bus;
  auto sender = CanSender::adopt(std::move(bus.there));
  const std::array frames{data_frame(kSpeed, {1})};
  constexpr std::uint64_t kFrames = 10'000;  // more than any socket's queue holds
  std::uint64_t sent = 0;
  for (std::uint64_t i = 0; i < kFrames; ++i) sent += sender.send(frames);
  const auto& counters = sender.counters();
  EXPECT_GT(counters.queue_full, 0U);
  EXPECT_EQ(counters.sent, sent);
  EXPECT_EQ(counters.sent + counters.queue_full, kFrames);
  EXPECT_EQ(counters.failed, 0U);
}

TEST(CanSender, CountsWhatTheSystemRefuses) {
  SocketPair bus;
  auto sender = CanSender::adopt(std::move(bus.there));
  bus.here.close();
  const std::array frames{data_frame(kSpeed, {1})};
  EXPECT_EQ(sender.send(frames), 0U);
  EXPECT_EQ(sender.counters().failed, 1U);
  EXPECT_NE(sender.counters().last_error, 0);
}

}  // namespace
}  // namespace terracut::test
