// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// SocketCanSource and CanSender on a real CAN interface, vcan0, which these tests take down, remove
// and flood. Not for a machine that needs it: can_bus_vm.cmake runs them in a virtual one.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <linux/can/error.h>

#include <cstdlib>
#include <thread>

#include "firmware_io/can/can_sender.hpp"
#include "firmware_io/can/socketcan_source.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "frames.hpp"
#include "pipeline/health/health_frames.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::test {
namespace {

using can::CanFrame;
using can::CanId;
using can::CanSender;
using can::SocketCanConfig;
using can::SocketCanSource;
using net::LinkState;

constexpr CanId kSpeed{0x123, false}, kYaw{0x18FEF100, true}, kOther{0x456, false};
constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kLong_ns = 60'000 * kMillisecond_ns;
constexpr const char* kPlugIn =
    "ip link add dev vcan0 type vcan && ip link set vcan0 mtu 72 && ip link set vcan0 up";

bool run(const char* command) {
  return std::system(command) == 0;
}

class CanBus : public testing::Test {
 protected:
  SocketCanSource open(SocketCanConfig config = {}) {
    config.interface = "vcan0";
    if (config.ids.empty()) config.ids = {kSpeed, kYaw};
    auto source = SocketCanSource::open(std::move(config), memory_);
    EXPECT_TRUE(source) << source.error().message;
    return *std::move(source);
  }
  static CanSender sender() {
    auto sender = CanSender::open("vcan0");
    EXPECT_TRUE(sender) << sender.error().message;
    return *std::move(sender);
  }
  static bool send(CanSender& sender, const CanFrame& frame) {
    return sender.send({&frame, 1}) == 1;
  }
  /// What comes until `count` frames did, or nothing for a long time.
  static std::vector<CanFrame> receive(SocketCanSource& source, std::size_t count) {
    std::vector<CanFrame> frames;
    while (frames.size() < count) {
      const auto received = source.receive(kLong_ns);
      if (received.empty()) break;
      frames.insert(frames.end(), received.begin(), received.end());
    }
    return frames;
  }
  static bool wait_for(SocketCanSource& source, LinkState state) {
    for (int i = 0; i < 100 && source.link() != state; ++i) {
      EXPECT_TRUE(source.receive(600 * kMillisecond_ns).empty());
    }
    return source.link() == state;
  }
  /// Sends until the sender's interface is there again and the source hears the newest frame.
  static bool heard_again(SocketCanSource& source, CanSender& sender) {
    for (std::uint8_t i = 0; i < 100; ++i) {
      send(sender, data_frame(kSpeed, {i}));
      const auto received = source.receive(600 * kMillisecond_ns);
      if (!received.empty() && received.back().data[0] == i) return true;
    }
    return false;
  }

  memory::FixedMemory memory_;
};

TEST_F(CanBus, DeliversExactlyTheMessagesAskedFor) {
  auto source = open();
  EXPECT_EQ(source.link(), LinkState::kUp);
  auto car = sender();
  CanFrame request = data_frame(kSpeed, {});
  request.remote = true;
  const CanFrame long_one = [] {
    CanFrame frame = data_frame(kSpeed, {0xFD});
    frame.fd = frame.bit_rate_switch = true;
    frame.length = 64;
    frame.data[63] = 0x63;
    return frame;
  }();
  for (const CanFrame& frame :
       {data_frame({kSpeed.number, true}, {1}), data_frame(kOther, {2}), request,
        data_frame({kYaw.number & 0x7FF, false}, {3}), data_frame(kSpeed, {4, 5}),
        data_frame(kYaw, {6}), long_one, data_frame({0x124, false}, {8})}) {
    ASSERT_TRUE(send(car, frame)) << car.counters().last_error;
  }
  auto received = receive(source, 3);
  EXPECT_TRUE(source.receive(0).empty());
  ASSERT_EQ(received.size(), 3U);
  for (CanFrame& frame : received) frame.stamp_ns = 0;
  EXPECT_EQ(received[0], data_frame(kSpeed, {4, 5}));
  EXPECT_EQ(received[1], data_frame(kYaw, {6}));
  EXPECT_EQ(received[2], long_one);
  EXPECT_EQ(source.counters().received, 3U) << "the kernel sorts out the others";
}

TEST_F(CanBus, StampsWhenAFrameCame) {
  auto source = open();
  auto car = sender();
  std::int64_t newest_ns = 0;
  for (std::uint8_t i = 0; i < 50; ++i) {
    const std::int64_t before_ns = measure::realtime_ns();
    ASSERT_TRUE(send(car, data_frame(kSpeed, {i})));
    const auto received = receive(source, 1);
    const std::int64_t after_ns = measure::realtime_ns();
    ASSERT_EQ(received.size(), 1U);
    EXPECT_GE(received[0].stamp_ns, before_ns);
    EXPECT_LE(received[0].stamp_ns, after_ns);
    EXPECT_GE(received[0].stamp_ns, newest_ns);
    newest_ns = received[0].stamp_ns;
  }
  EXPECT_EQ(source.counters().unstamped, 0U);
}

TEST_F(CanBus, CountsErrorFramesAndBusOff) {
  auto source = open();
  auto controller = sender();
  for (const std::uint32_t kind : {CAN_ERR_CRTL, CAN_ERR_BUSOFF, CAN_ERR_RESTARTED}) {
    CanFrame error = data_frame({kind, false}, {0, 0, 0, 0, 0, 0, 0, 0});
    error.error = true;
    ASSERT_TRUE(send(controller, error));
    ASSERT_TRUE(send(controller, data_frame(kOther, {0})));
    // The kernel may deliver a moment later, on a thread of its own.
    const std::uint64_t before = source.counters().error_frames;
    while (source.counters().error_frames == before) {
      EXPECT_TRUE(source.receive(kMillisecond_ns).empty());
    }
    EXPECT_EQ(source.bus_off(), kind == CAN_ERR_BUSOFF);
  }
  EXPECT_EQ(source.counters().error_frames, 3U);
  EXPECT_EQ(source.counters().bus_off, 1U);
  EXPECT_EQ(source.counters().restarts, 1U);
}

TEST_F(CanBus, CountsEveryFrameThatTheKernelHadToDrop) {
  auto source = open({.receive_buffer_bytes = 16'384});
  auto car = sender();
  constexpr std::uint64_t kFrames = 3000;
  for (std::uint64_t i = 0; i < kFrames; ++i) ASSERT_TRUE(send(car, data_frame(kSpeed, {1})));
  while (!source.receive(0).empty()) {
  }
  EXPECT_LT(source.counters().delivered, kFrames);
  // The next frame tells how many were dropped before it; some of the others may still be on their
  // way, and then a later one tells the rest.
  const auto known = [&] { return source.counters().delivered + source.counters().kernel_drops; };
  std::uint64_t sent = kFrames;
  do {
    ASSERT_TRUE(send(car, data_frame(kSpeed, {2})));
    ++sent;
    EXPECT_FALSE(receive(source, 1).empty());
  } while (known() != sent && sent < kFrames + 100);
  EXPECT_EQ(known(), sent);
}

TEST_F(CanBus, KeepsUpWithAFloodOfOtherMessages) {
  auto source = open();
  auto car = sender();
  constexpr std::uint32_t kFrames = 40'000, kEvery = 20;
  std::thread flood([&] {
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      send(car, data_frame(i % kEvery == 0 ? kSpeed : kOther, {static_cast<std::uint8_t>(i)}));
    }
    source.wake();
  });
  std::uint64_t delivered = 0;
  for (;;) {
    const auto received = source.receive(kLong_ns);
    if (received.empty()) break;
    delivered += received.size();
  }
  flood.join();
  // The last ones may come a moment later.
  if (delivered < kFrames / kEvery) {
    delivered += receive(source, kFrames / kEvery - delivered).size();
  }
  while (const std::size_t surplus = source.receive(0).size()) delivered += surplus;
  EXPECT_EQ(car.counters().sent, kFrames);
  EXPECT_EQ(delivered, kFrames / kEvery);
  EXPECT_EQ(source.counters().kernel_drops, 0U);
}

TEST_F(CanBus, GoesOnWhenTheInterfaceWasDown) {
  auto source = open();
  auto car = sender();
  ASSERT_TRUE(run("ip link set vcan0 down"));
  EXPECT_TRUE(wait_for(source, LinkState::kDown));
  EXPECT_FALSE(send(car, data_frame(kSpeed, {1})));
  EXPECT_EQ(car.counters().link_down, 1U);
  ASSERT_TRUE(run("ip link set vcan0 up"));
  EXPECT_TRUE(heard_again(source, car));
  EXPECT_EQ(source.link(), LinkState::kUp);
  EXPECT_EQ(source.counters().link_losses, 1U);
  EXPECT_EQ(source.counters().reopened, 0U);
  EXPECT_EQ(source.counters().receive_errors, 0U);
}

TEST_F(CanBus, GoesOnWhenTheInterfaceWasGoneAndIsAnotherOneNow) {
  auto source = open();
  auto car = sender();
  ASSERT_TRUE(run("ip link del vcan0"));
  EXPECT_TRUE(wait_for(source, LinkState::kGone));
  EXPECT_FALSE(send(car, data_frame(kSpeed, {1})));
  EXPECT_EQ(SocketCanSource::open({.interface = "vcan0", .ids = {kSpeed}}, memory_).error().code,
            ErrorCode::kNotFound);
  ASSERT_TRUE(run(kPlugIn));
  EXPECT_TRUE(heard_again(source, car));
  EXPECT_EQ(source.link(), LinkState::kUp);
  EXPECT_EQ(source.counters().link_losses, 1U);
  EXPECT_EQ(source.counters().reopened, 1U);
  EXPECT_EQ(source.counters().receive_errors, 0U);
  EXPECT_EQ(car.counters().failed, 0U);

  // Filters and FD hold on the new one too.
  ASSERT_TRUE(send(car, data_frame(kOther, {1})));
  ASSERT_TRUE(send(car, data_frame(kYaw, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})));
  const auto received = receive(source, 1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].payload().size(), 12U);
}

TEST_F(CanBus, TakesUpAnInterfaceThatWasNotThereAtTheStart) {
  ASSERT_TRUE(run("ip link del vcan0"));
  auto source = open({.wait_for_interface = true});
  auto car = CanSender::open("vcan0", true);
  ASSERT_TRUE(car) << car.error().message;
  EXPECT_EQ(source.link(), LinkState::kGone);
  EXPECT_FALSE(send(*car, data_frame(kSpeed, {1})));
  EXPECT_EQ(car->counters().link_down, 1U);
  ASSERT_TRUE(run(kPlugIn));
  EXPECT_TRUE(heard_again(source, *car));
  EXPECT_EQ(source.link(), LinkState::kUp);
  EXPECT_EQ(source.counters().link_losses, 0U) << "it came, and never went";
  EXPECT_EQ(source.counters().reopened, 0U);
  EXPECT_EQ(source.counters().receive_errors, 0U);
  EXPECT_EQ(car->counters().failed, 0U);
}

TEST_F(CanBus, RefusesAnInterfaceThatHasNoCan) {
  const auto source = SocketCanSource::open({.interface = "lo", .ids = {kSpeed}}, memory_);
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(source.error().message, testing::HasSubstr("'lo' is no CAN interface"));
}

TEST_F(CanBus, BringsTheMotionOfTheVehicle) {
  const auto file = vehicle::parse_dbc(
      "BO_ 291 SPEED: 2 X\n SG_ V : 7|16@0+ (0.01,0) [0|0] \"km/h\" X\n"
      "BO_ 2566844672 YAW: 8 X\n SG_ R : 0|16@1- (0.0002,0) [0|0] \"rad/s\" X\n",
      "car.dbc");
  ASSERT_TRUE(file);
  vehicle::MotionSignalsConfig config;
  config.speed.signals = {"V"};
  config.yaw_rate.signals = {"R"};
  config.max_age_s = 10;
  config.timeout_s = 60;
  auto motion = vehicle::MotionSignals::make(*file, config);
  ASSERT_TRUE(motion) << motion.error().message;
  auto source = open({.ids = {motion->ids().begin(), motion->ids().end()}});
  auto car = sender();
  // Each frame is awaited before the next is sent: the kernel may deliver frames that lie waiting
  // in another order, and stamps the first ones only when they are read. Both make frames out of
  // order.
  const CanFrame speed = data_frame(kSpeed, {0x0E, 0x10});            // 36 km/h
  const CanFrame yaw_rate = data_frame(kYaw, {0x3C, 0xF6, 0, 0, 0});  // -2500
  int samples = 0;
  for (int i = 0; i < 100; ++i) {
    for (const CanFrame& sent : {speed, yaw_rate}) {
      ASSERT_TRUE(send(car, sent));
      const auto received = receive(source, 1);
      ASSERT_EQ(received.size(), 1U);
      const auto sample = motion->take(received[0]);
      if (!sample) continue;
      ++samples;
      EXPECT_NEAR(sample->speed_mps, 10, 1e-9);
      EXPECT_NEAR(sample->yaw_rate_radps, -0.5, 1e-9);
    }
  }
  EXPECT_EQ(samples, 100);
}

// What is printed here, read_health.py compares with what it makes of the frames that candump saw.
TEST_F(CanBus, TellsHealthToOtherReaders) {
  auto terracut = sender();
  for (std::uint32_t i = 0; i < 5; ++i) {
    const health::HealthReport report{
        .frame_number = 1000 + i,
        .returns = 120'000 + 7 * i,
        .level = static_cast<status::Level>(i % 4),
        .missed = i % 2 == 1,
        .cause = static_cast<status::FrameMissCause>(i % 4),
        .latency_ns = 20'000'000 + 1'230'000 * static_cast<std::int64_t>(i),
        .ego_motion = i > 2,
        .link = static_cast<status::LinkState>(i % 4),
        .misses = 300 * i,
        .skipped = i,
        .losses = 100'000 * i,
        .alive = 254 + i};
    EXPECT_EQ(terracut.send(health_frames(report)), 2U);
    const bool skipped = report.level == status::Level::kSkipped;
    fmt::print(
        "health FrameNumber={} Returns={} Level={} Missed={} MissCause={} Latency={:.2f} "
        "EgoMotion={} Link={} Misses={} Skipped={} Losses={} Alive={}\n",
        report.frame_number, report.returns, static_cast<int>(report.level), report.missed ? 1 : 0,
        report.missed ? static_cast<int>(report.cause) : 7,
        skipped ? 655.35 : static_cast<double>(report.latency_ns) / 1e6, report.ego_motion ? 1 : 0,
        static_cast<int>(report.link), report.misses, report.skipped, report.losses,
        report.alive % 256);
  }
}

}  // namespace
}  // namespace terracut::test
