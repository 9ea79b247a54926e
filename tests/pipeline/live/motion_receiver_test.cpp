// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What is made of the vehicle's bus: its frames and the time of day are the test's.
#include "pipeline/live/motion_receiver.hpp"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <vector>

#include "tests/firmware_io/can/frames.hpp"
#include "tests/pipeline/live/vehicle_at_20_mps.hpp"

namespace terracut::live {
namespace {

using status::MotionState;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000 * kMs;

struct HeldClock {
  const std::int64_t* now_ns;
  [[nodiscard]] std::int64_t realtime_ns() const noexcept { return *now_ns; }
};

/// Gives what was put on the bus since the last look.
struct MadeBus {
  std::vector<can::CanFrame> waiting, given;
  can::CanReceiveCounters counted;
  net::LinkState state = net::LinkState::kUp;
  bool is_off = false;

  std::span<const can::CanFrame> receive(std::int64_t) noexcept {
    given.swap(waiting);
    waiting.clear();
    return given;
  }
  [[nodiscard]] const can::CanReceiveCounters& counters() const noexcept { return counted; }
  [[nodiscard]] net::LinkState link() const noexcept { return state; }
  [[nodiscard]] bool bus_off() const noexcept { return is_off; }
};

class MotionReceiverTest : public testing::Test {
 protected:
  /// The vehicle says its motion, stamped `ms` after the start.
  void say(std::int64_t ms) {
    can::CanFrame frame = test::at_20_mps();
    frame.stamp_ns = kStart_ns + ms * kMs;
    bus_.waiting.push_back(frame);
  }
  /// What is known `ms` after the start.
  const HeardMotion& look(std::int64_t ms) {
    now_ns_ = kStart_ns + ms * kMs;
    receiver_.work_round(0);
    (void)heard_.take_if_new();
    return heard_.newest_taken();
  }
  /// Whether the decoder gets the motion of the 0.1 s up to `ms` after the start.
  bool poses(std::int64_t ms, std::array<vehicle::PlanarPose, 2>& poses) {
    motion_.take_new();
    const std::int64_t end_ns = kStart_ns + ms * kMs;
    return motion_.poses(std::array{end_ns - 100 * kMs, end_ns}, end_ns, poses);
  }

  static constexpr double kTimeout_s = 0.1;
  std::int64_t now_ns_ = kStart_ns;
  memory::FixedMemory memory_;
  vehicle::MotionSignals signals_ = test::signals_of_the_vehicle(kTimeout_s);
  vehicle::EgoMotion motion_{{.max_age_ns = 50 * kMs}, memory_};
  MadeBus bus_;
  queues::LatestValue<HeardMotion> heard_;
  MotionReceiver<MadeBus, HeldClock> receiver_{signals_, motion_, bus_, heard_, {&now_ns_}};
};

TEST_F(MotionReceiverTest, HandsTheMotionOnTheBusToTheDecoder) {
  EXPECT_EQ(look(0).state, MotionState::kWaiting);
  for (std::int64_t ms = 0; ms <= 200; ms += 10) say(ms);
  const HeardMotion& heard = look(200);
  EXPECT_EQ(heard.state, MotionState::kKnown);
  EXPECT_EQ(heard.last_sample_ns, kStart_ns + 200 * kMs);
  EXPECT_EQ(heard.spare_samples, 0U);
  std::array<vehicle::PlanarPose, 2> found;
  ASSERT_TRUE(poses(200, found));
  EXPECT_NEAR(found[0].x_m, -2, 1e-3);
  EXPECT_NEAR(found[1].x_m, 0, 1e-9);
}

TEST_F(MotionReceiverTest, SaysWhetherFramesCame) {
  EXPECT_FALSE(receiver_.work_round(0));
  say(0);
  EXPECT_TRUE(receiver_.work_round(0));
  EXPECT_FALSE(receiver_.work_round(0));
}

TEST_F(MotionReceiverTest, ThatIsNotRenewedIsLostAndNotGuessed) {
  for (std::int64_t ms = 0; ms <= 200; ms += 10) say(ms);
  EXPECT_EQ(look(299).state, MotionState::kKnown);
  EXPECT_EQ(look(301).state, MotionState::kLost);
  EXPECT_EQ(look(302).signals.timeouts, 1U);
  std::array<vehicle::PlanarPose, 2> found;
  EXPECT_FALSE(poses(301, found));
  for (std::int64_t ms = 400; ms <= 600; ms += 10) say(ms);
  EXPECT_EQ(look(600).state, MotionState::kKnown) << "and comes back";
  EXPECT_TRUE(poses(600, found));
}

TEST_F(MotionReceiverTest, ThinsAFloodToASampleEveryTwoMilliseconds) {
  for (std::int64_t ms = 0; ms < 200; ++ms) say(ms);
  EXPECT_EQ(look(199).spare_samples, 100U);
  EXPECT_EQ(look(199).last_sample_ns, kStart_ns + 198 * kMs);
  motion_.take_new();
  EXPECT_EQ(motion_.counters().accepted, 100U);
  EXPECT_EQ(motion_.counters().not_taken, 0U);
}

TEST_F(MotionReceiverTest, ASampleAfterTheClockWasSetBackIsNoSpareOne) {
  for (const std::int64_t ms : {1000, 1010, 0, 10}) say(ms);
  EXPECT_EQ(look(20).spare_samples, 0U);
  EXPECT_EQ(look(20).last_sample_ns, kStart_ns + 10 * kMs);
}

TEST_F(MotionReceiverTest, TellsWhyNothingIsHeard) {
  say(0);
  EXPECT_EQ(look(0).state, MotionState::kKnown);
  bus_.is_off = true;
  EXPECT_EQ(look(0).state, MotionState::kBusOff);
  bus_.state = net::LinkState::kDown;
  EXPECT_EQ(look(0).state, MotionState::kInterfaceDown) << "which explains the other";
  bus_.state = net::LinkState::kGone;
  EXPECT_EQ(look(0).state, MotionState::kInterfaceGone);
  bus_.state = net::LinkState::kUp;
  bus_.is_off = false;
  EXPECT_EQ(look(0).state, MotionState::kKnown);
  bus_.counted.kernel_drops = 7;
  EXPECT_EQ(look(0).bus.kernel_drops, 7U);
}

}  // namespace
}  // namespace terracut::live
