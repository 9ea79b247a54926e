// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What the CAN thread does for ever: receive, make motion of it. Counted heap allocations; and in a
// build with -fsanitize=realtime the program ends at the first call that may wait.

#include "firmware_io/can/can_sender.hpp"
#include "firmware_io/can/socketcan_source.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "frames.hpp"
#include "socket_pair.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::test {
namespace {

using can::CanFrame;
using can::SocketCanSource;
using vehicle::MotionSignals;

constexpr can::CanId kSpeed{291, false}, kYaw{2, true};
constexpr std::int64_t kLong_ns = 60'000'000'000;

MotionSignals make_motion() {
  const auto file = vehicle::parse_dbc(
      "BO_ 291 SPEED: 8 X\n SG_ V : 7|16@0+ (0.01,0) [0|0] \"km/h\" X\n"
      " SG_ W : 23|16@0+ (0.01,0) [0|0] \"km/h\" X\n SG_ BACK : 32|1@1+ (1,0) [0|0] \"\" X\n"
      "BO_ 2147483650 YAW: 64 X\n SG_ R : 3|60@1- (0.0002,0) [0|0] \"rad/s\" X\n"
      " SG_ OK : 511|1@1+ (1,0) [0|0] \"\" X\n",
      "car.dbc");
  EXPECT_TRUE(file);
  vehicle::MotionSignalsConfig config;
  config.speed.signals = {"V", "W"};
  config.speed.sign = "BACK";
  config.yaw_rate.signals = {"R"};
  config.yaw_rate.valid = "OK";
  config.max_age_s = 10;
  config.timeout_s = 60;
  auto motion = MotionSignals::make(*file, config);
  EXPECT_TRUE(motion) << motion.error().message;
  return *std::move(motion);
}

TEST(CanRealtime, ReceivingFramesAndMakingMotionOfThemAllocatesNothingAndDoesNotWait) {
  SocketPair bus;
  memory::FixedMemory memory;
  MotionSignals motion = make_motion();
  auto source = SocketCanSource::adopt(std::move(bus.here), {.ids = {kSpeed, kYaw}}, memory);
  ASSERT_TRUE(source) << source.error().message;
  auto car = can::CanSender::adopt(std::move(bus.there));
  const std::array speed{data_frame(kSpeed, {0x0E, 0x10, 0x0E, 0x10, 0, 0, 0, 0})};
  std::array yaw{data_frame(kYaw, {8})};
  yaw[0].fd = true;
  yaw[0].length = 64;
  yaw[0].data[63] = 0x80;
  CanFrame error_frame = data_frame({0x40, false}, {0, 0, 0, 0, 0, 0, 0, 0});
  error_frame.error = true;
  const std::array error{error_frame};
  const std::size_t planned = memory.total_bytes();

  const std::uint64_t before = allocations_of_this_thread();
  int samples = 0, lost = 0;
  for (int i = 0; i < 100; ++i) {
    car.send(speed);
    car.send(error);
    car.send(yaw);
    for (int heard = 0; heard < 2;) {
      const auto frames = source->receive(kLong_ns);
      if (frames.empty()) break;
      heard += static_cast<int>(frames.size());
      for (const CanFrame& frame : frames) samples += motion.take(frame) ? 1 : 0;
    }
    lost += motion.alive(yaw[0].stamp_ns) ? 0 : 1;
  }
  source->wake();
  static_cast<void>(source->receive(kLong_ns));
  const std::uint64_t allocations = allocations_of_this_thread() - before;

  EXPECT_EQ(samples, 100);
  EXPECT_EQ(lost, 100) << "1970 is not when they came";
  EXPECT_EQ(source->counters().error_frames, 100U);
  EXPECT_EQ(memory.total_bytes(), planned);
  if (allocations_are_counted()) {
    EXPECT_EQ(allocations, 0U);
  }
}

}  // namespace
}  // namespace terracut::test
