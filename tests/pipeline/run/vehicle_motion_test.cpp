// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The thread of `terracut live` that hears the vehicle, over a socket pair that stands for the bus.
// On a real CAN interface: CanBus (tests/firmware_io/can).
#include "pipeline/run/vehicle_motion.hpp"

#include <gmock/gmock.h>
#include <linux/can/error.h>

#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "firmware_io/vehicle/dbc_file.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tests/firmware_io/can/frames.hpp"
#include "tests/firmware_io/can/socket_pair.hpp"
#include "tools/lab/drive/vehicle_log.hpp"

namespace terracut::run {
namespace {

using can::CanFrame;
using can::SocketCanSource;
using status::MotionState;
using vehicle::MotionSignals;
using vehicle::PlanarPose;

constexpr can::CanId kMotion{0x1A0, false};

MotionSignals signals(double timeout_s) {
  const auto dbc = vehicle::parse_dbc(drive::vehicle_dbc(), "vehicle.dbc");
  EXPECT_TRUE(dbc);
  vehicle::MotionSignalsConfig config;
  config.speed.signals = {"SPEED"};
  config.yaw_rate.signals = {"YAW_RATE"};
  config.timeout_s = timeout_s;
  auto made = MotionSignals::make(*dbc, config);
  EXPECT_TRUE(made) << made.error().message;
  return *std::move(made);
}

/// 72 km/h straight on.
CanFrame at_20_mps() {
  return test::data_frame(kMotion, {0x1C, 0x20, 0, 0, 0, 0, 0, 0});
}

CanFrame error_frame(std::uint32_t kind) {
  CanFrame frame = test::data_frame({kind, false}, {0, 0, 0, 0, 0, 0, 0, 0});
  frame.error = true;
  return frame;
}

class VehicleMotionTest : public testing::Test {
 protected:
  /// Hears the bus, whose motion is lost without a sample for so long.
  void hear(double timeout_s) {
    auto source = SocketCanSource::adopt(std::move(bus_.here), {.ids = {kMotion}}, memory_);
    ASSERT_TRUE(source) << source.error().message;
    source_.emplace(*std::move(source));
    start(timeout_s);
  }
  void start(double timeout_s) {
    // The longest age there is, so that a machine that is busy loses no motion.
    vehicle_.emplace(signals(timeout_s), vehicle::EgoMotion::Config{.max_age_ns = kSecond_ns},
                     *source_, memory_);
    for (const threads::Grant& grant : vehicle_->start(0)) EXPECT_TRUE(grant.granted);
  }
  status::MotionFigures figures() {
    status::MotionFigures figures;
    vehicle_->show(figures);
    return figures;
  }
  [[nodiscard]] std::map<std::string, std::uint64_t, std::less<>> faults() {
    const status::MotionFigures shown = figures();
    std::map<std::string, std::uint64_t, std::less<>> faults;
    for (const status::NamedCount& fault : shown.faults_in_use()) {
      faults[std::string(fault.name.view())] = fault.count;
    }
    return faults;
  }
  /// Waits for what has to come; `meanwhile` is called now and then.
  static bool wait_until(
      const std::function<bool()>& comes, const std::function<void()>& meanwhile = [] {}) {
    for (int i = 0; i < 12'000; ++i) {
      if (comes()) return true;
      meanwhile();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  /// Whether the decoder's thread, which this one stands for, gets the motion of the last 0.1 s.
  bool motion_of_last_frame(std::array<PlanarPose, 2>& poses) {
    vehicle_->motion().take_new();
    const auto newest_ns = vehicle_->motion().newest_ns();
    if (!newest_ns) return false;
    const std::array instants_ns{*newest_ns - kSecond_ns / 10, *newest_ns};
    return vehicle_->motion().poses(instants_ns, instants_ns[1], poses);
  }

  static constexpr std::int64_t kSecond_ns = 1'000'000'000;

  test::SocketPair bus_;
  memory::FixedMemory memory_;
  std::optional<SocketCanSource> source_;
  std::optional<VehicleMotion> vehicle_;
};

TEST_F(VehicleMotionTest, HandsTheMotionOnTheBusToTheDecoder) {
  hear(60);
  EXPECT_EQ(figures().state, MotionState::kWaiting);
  std::array<PlanarPose, 2> poses;
  ASSERT_TRUE(wait_until([&] { return figures().samples > 30 && motion_of_last_frame(poses); },
                         [&] { bus_.put(at_20_mps()); }));
  EXPECT_NEAR(poses[0].x_m, -2, 1e-3);
  EXPECT_NEAR(poses[1].x_m, 0, 1e-9);
  const status::MotionFigures shown = figures();
  EXPECT_EQ(shown.state, MotionState::kKnown);
  EXPECT_NEAR(static_cast<double>(measure::realtime_ns() - shown.last_sample_ns), 0, 60e9);
  EXPECT_EQ(faults()["samples_not_taken"], 0U);
  EXPECT_FALSE(vehicle_->thread_state().scheduling.empty());
}

TEST_F(VehicleMotionTest, ThatIsNotRenewedIsLostAndNotGuessed) {
  hear(0.1);
  ASSERT_TRUE(wait_until([&] { return figures().samples > 0; }, [&] { bus_.put(at_20_mps()); }));
  ASSERT_TRUE(wait_until([&] { return figures().state == MotionState::kLost; }));
  EXPECT_GE(faults()["timeouts"], 1U);
  vehicle_->motion().take_new();
  const std::int64_t later_ns = *vehicle_->motion().newest_ns() + 2 * kSecond_ns;
  std::array<PlanarPose, 1> poses;
  EXPECT_FALSE(vehicle_->motion().poses(std::array{later_ns}, later_ns, poses));
  ASSERT_TRUE(wait_until([&] { return figures().state == MotionState::kKnown; },
                         [&] { bus_.put(at_20_mps()); }))
      << "and comes back";
}

TEST_F(VehicleMotionTest, SaysThatTheControllerLeftTheBusAndCameBack) {
  hear(60);
  ASSERT_TRUE(bus_.put(error_frame(CAN_ERR_BUSOFF)));
  ASSERT_TRUE(wait_until([&] { return figures().state == MotionState::kBusOff; }));
  EXPECT_EQ(faults()["bus_off"], 1U);
  ASSERT_TRUE(bus_.put(error_frame(CAN_ERR_RESTARTED)));
  ASSERT_TRUE(wait_until([&] { return figures().state == MotionState::kWaiting; }));
  EXPECT_EQ(faults()["controller_restarts"], 1U);
  EXPECT_EQ(faults()["error_frames"], 2U);
}

TEST_F(VehicleMotionTest, WaitsForAnInterfaceThatIsNotThere) {
  auto source = SocketCanSource::open(
      {.interface = "nosuchcan0", .ids = {kMotion}, .wait_for_interface = true}, memory_);
  ASSERT_TRUE(source) << source.error().message;
  source_.emplace(*std::move(source));
  start(60);
  ASSERT_TRUE(wait_until([&] { return figures().state == MotionState::kInterfaceGone; }));
  EXPECT_EQ(faults()["link_losses"], 0U) << "it never was there";
  vehicle_->motion().take_new();
  EXPECT_FALSE(vehicle_->motion().newest_ns());
}

// With ThreadSanitizer this is the test of who may touch what.
TEST_F(VehicleMotionTest, AFloodIsTakenInWholeWhileTheDecoderAndTheWatchGoOn) {
  hear(60);
  constexpr std::uint64_t kSent = 20'000;
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  const auto in_time = [&] { return std::chrono::steady_clock::now() < give_up; };
  std::atomic<std::uint64_t> put = 0;
  std::jthread car([&] {
    while (put < kSent && in_time()) {
      if (bus_.put(at_20_mps())) {
        ++put;
      } else {
        std::this_thread::yield();  // the socket is full: so floods a bus
      }
    }
  });
  std::uint64_t known = 0;
  std::array<PlanarPose, 2> poses;
  const auto heard = [&] {
    auto counts = faults();
    const status::MotionFigures shown = figures();
    return shown.samples + shown.spare_samples + counts["samples_not_taken"] +
           counts["late_frames"] + counts["late_samples"];
  };
  while (heard() < kSent && in_time()) {
    if (motion_of_last_frame(poses)) ++known;
  }
  EXPECT_EQ(put, kSent);
  EXPECT_EQ(heard(), kSent) << "what is not used is counted";
  EXPECT_GT(known, 0U);
  EXPECT_EQ(faults()["samples_not_taken"], 0U) << "the decoder's queue is not flooded";
}

TEST_F(VehicleMotionTest, EndsThoughItsThreadNeverBegan) {
  auto source = SocketCanSource::adopt(std::move(bus_.here), {.ids = {kMotion}}, memory_);
  ASSERT_TRUE(source);
  VehicleMotion vehicle(signals(1), {}, *source, memory_);
  vehicle.stop();
  EXPECT_TRUE(bus_.put(at_20_mps()));
  EXPECT_EQ(source->receive(0).size(), 1U) << "and woke nobody";
}

}  // namespace
}  // namespace terracut::run
