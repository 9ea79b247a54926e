// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The thread of `terracut live` that hears the vehicle, over a socket pair that stands for the bus.
// On a real CAN interface: CanBus (tests/firmware_io/can).
#include "pipeline/live/vehicle_motion.hpp"

#include <gtest/gtest.h>
#include <linux/can/error.h>

#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "tests/firmware_io/can/frames.hpp"
#include "tests/firmware_io/can/socket_pair.hpp"
#include "tests/pipeline/live/vehicle_at_20_mps.hpp"

namespace terracut::live {
namespace {

using can::CanFrame;
using can::SocketCanSource;
using status::MotionState;
using vehicle::PlanarPose;

CanFrame error_frame(std::uint32_t kind) {
  CanFrame frame = test::data_frame({kind, false}, {0, 0, 0, 0, 0, 0, 0, 0});
  frame.error = true;
  return frame;
}

class VehicleMotionTest : public testing::Test {
 protected:
  void hear() {
    auto source = SocketCanSource::adopt(std::move(bus_.here), {.ids = {test::kMotionId}}, memory_);
    ASSERT_TRUE(source) << source.error().message;
    source_.emplace(*std::move(source));
    // The longest age there is, so that a machine that is busy loses no motion.
    vehicle_.emplace(test::signals_of_the_vehicle(60),
                     vehicle::EgoMotion::Config{.max_age_ns = kSecond_ns}, *source_, memory_);
    for (const threads::Grant& grant : vehicle_->start(0)) EXPECT_TRUE(grant.granted);
    EXPECT_FALSE(vehicle_->thread_state().scheduling.empty());
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
  /// Looks again and again until what has to come is there.
  template <class Comes>
  static bool wait_until(const Comes& comes) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!comes()) {
      if (std::chrono::steady_clock::now() > give_up) return false;
      std::this_thread::yield();
    }
    return true;
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

TEST_F(VehicleMotionTest, SaysThatTheControllerLeftTheBusAndCameBack) {
  hear();
  ASSERT_TRUE(bus_.put(error_frame(CAN_ERR_BUSOFF)));
  ASSERT_TRUE(wait_until([&] { return figures().state == MotionState::kBusOff; }));
  EXPECT_EQ(faults()["bus_off"], 1U);
  ASSERT_TRUE(bus_.put(error_frame(CAN_ERR_RESTARTED)));
  ASSERT_TRUE(wait_until([&] { return figures().state == MotionState::kWaiting; }));
  EXPECT_EQ(faults()["controller_restarts"], 1U);
  EXPECT_EQ(faults()["error_frames"], 2U);
}

// With ThreadSanitizer this is the test of who may touch what.
TEST_F(VehicleMotionTest, AFloodIsTakenInWholeWhileTheDecoderAndTheWatchGoOn) {
  hear();
  constexpr std::uint64_t kSent = 20'000;
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  const auto in_time = [&] { return std::chrono::steady_clock::now() < give_up; };
  std::atomic<std::uint64_t> put = 0;
  std::jthread car([&] {
    while (put < kSent && in_time()) {
      if (bus_.put(test::at_20_mps())) {
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
  auto source = SocketCanSource::adopt(std::move(bus_.here), {.ids = {test::kMotionId}}, memory_);
  ASSERT_TRUE(source);
  VehicleMotion vehicle(test::signals_of_the_vehicle(1), {}, *source, memory_);
  vehicle.stop();
  EXPECT_TRUE(bus_.put(test::at_20_mps()));
  EXPECT_EQ(source->receive(0).size(), 1U) << "and woke nobody";
}

}  // namespace
}  // namespace terracut::live
