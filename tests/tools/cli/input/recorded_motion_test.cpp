// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/input/recorded_motion.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "tests/support/scratch_folder.hpp"
#include "tools/lab/drive/vehicle_log.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using vehicle::MotionSample;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;

/// Frames every 10 ms and packets every millisecond, on the same clock or on two.
class RecordedMotionTest : public test::InScratchFolder {
 protected:
  using Clock = std::function<std::int64_t(std::int64_t ms)>;  ///< What it shows at a time.

  void SetUp() override {
    options_.can_recording = folder_ / "car.log";
    options_.motion.dbc = folder_ / "car.dbc";
    write("car.dbc", drive::vehicle_dbc());
  }

  static Clock stepping(std::int64_t at_ms, std::int64_t step_ms) {
    return [=](std::int64_t ms) { return ms + (ms >= at_ms ? step_ms : 0); };
  }
  void record(const Clock& clock, std::int64_t until_ms = 8'000) {
    std::vector<MotionSample> samples;
    for (std::int64_t ms = 5; ms < until_ms; ms += 10) {
      samples.push_back({kStart_ns + clock(ms) * kMillisecond_ns, 20, 0});
    }
    write("car.log", drive::vehicle_log(samples));
  }
  /// By how much the newest sample is ahead of each packet, from the first packet behind `from_ms`.
  std::vector<double> ahead_ms(const Clock& clock, std::int64_t from_ms) {
    memory::FixedMemory memory;
    auto motion = RecordedMotion::open(options_, memory);
    EXPECT_TRUE(motion) << motion.error().message;
    std::vector<double> ahead;
    for (std::int64_t ms = 0; motion && ms < 8'000; ++ms) {
      const std::int64_t stamp_ns = kStart_ns + clock(ms) * kMillisecond_ns;
      motion->hear_until(stamp_ns);
      if (ms < from_ms) continue;
      ahead.push_back(static_cast<double>(motion->motion().newest_ns().value_or(0) - stamp_ns) *
                      1e-6);
    }
    return ahead;
  }
  std::string refusal(ErrorCode code) {
    memory::FixedMemory memory;
    const auto motion = RecordedMotion::open(options_, memory);
    EXPECT_FALSE(motion);
    if (motion) return {};
    EXPECT_EQ(motion.error().code, code);
    return motion.error().message;
  }
  Options options_;
};

constexpr auto kFresh = [](double ahead_ms) { return ahead_ms <= 0 && ahead_ms > -12; };

TEST_F(RecordedMotionTest, IsHeardBesideThePackets) {
  const Clock clock = stepping(0, 0);
  record(clock);
  EXPECT_THAT(ahead_ms(clock, 20), testing::Each(testing::Truly(kFresh)));
}

TEST_F(RecordedMotionTest, IsHeardBesideThePacketsWhenTheClockOfBothIsSet) {
  for (const std::int64_t step_ms : {-3'600'000, -3'000, -400, -60, 60, 3'000, 3'600'000}) {
    for (const std::int64_t apart_ms : {-300, -8, 0, 8, 300}) {
      SCOPED_TRACE(fmt::format("{} ms, the bus {} ms later", step_ms, apart_ms));
      record(stepping(4'000 + apart_ms, step_ms));
      // From two frames of the bus behind the later step on.
      EXPECT_THAT(ahead_ms(stepping(4'000, step_ms), 4'020 + std::max<std::int64_t>(0, apart_ms)),
                  testing::Each(testing::Truly(kFresh)));
    }
  }
}

TEST_F(RecordedMotionTest, StaysBesideThePacketsThroughManySteps) {
  const Clock clock = [](std::int64_t ms) { return ms - ms / 1'000 * 700; };
  record(clock);
  const auto ahead = ahead_ms(clock, 20);
  // Until the first frame behind each of the seven steps.
  EXPECT_GE(std::ranges::count_if(ahead, kFresh), std::ssize(ahead) - 7 * 10);
}

TEST_F(RecordedMotionTest, WaitsAtMostASecondForTheStepOfAClockThatHasNone) {
  // The bus is set back by 2 s: of the time until it is where it was there is no motion to come.
  record(stepping(4'000, -2'000));
  const auto bus_alone = ahead_ms(stepping(0, 0), 4'000);
  EXPECT_NEAR(bus_alone.at(990), -995, 12);
  EXPECT_THAT(std::vector(bus_alone.begin() + 1'010, bus_alone.begin() + 1'990),
              testing::Each(testing::Truly(kFresh)));
  // The packets are: they come to the newest motion again after these 2 s.
  record(stepping(0, 0));
  const auto packets_alone = ahead_ms(stepping(4'000, -2'000), 4'000);
  EXPECT_GT(packets_alone.at(500), 1'000);
  EXPECT_THAT(std::vector(packets_alone.begin() + 3'010, packets_alone.end()),
              testing::Each(testing::Truly(kFresh)));
}

TEST_F(RecordedMotionTest, IsHeardAgainFromTheBeginning) {
  const Clock clock = stepping(4'000, -3'000);
  record(clock);
  memory::FixedMemory memory;
  auto motion = RecordedMotion::open(options_, memory);
  ASSERT_TRUE(motion) << motion.error().message;
  for (int pass = 0; pass < 3; ++pass) {
    for (std::int64_t ms = 0; ms < 8'000; ++ms) {
      motion->hear_until(kStart_ns + clock(ms) * kMillisecond_ns);
      if (ms < 20) continue;
      const double ahead_ms =
          static_cast<double>(*motion->motion().newest_ns() - kStart_ns) * 1e-6 -
          static_cast<double>(clock(ms));
      ASSERT_TRUE(kFresh(ahead_ms) || (ms >= 4'000 && ms < 4'020)) << pass << ": " << ms;
    }
    ASSERT_TRUE(motion->restart());
  }
}

TEST_F(RecordedMotionTest, OfAFileWithoutAFrameIsRefused) {
  write("car.log", "");
  EXPECT_THAT(refusal(ErrorCode::kMalformed), AllOf(HasSubstr("car.log"), HasSubstr("no frame")));
  write("car.log", drive::vehicle_dbc());
  EXPECT_THAT(refusal(ErrorCode::kMalformed), AllOf(HasSubstr("car.log"), HasSubstr("no frame")));
}

TEST_F(RecordedMotionTest, OfAnotherVehicleIsRefused) {
  write("car.log", "(1700000000.000000) can0 7FF#00\n(1700000000.100000) can0 1A0#R8\n");
  EXPECT_THAT(refusal(ErrorCode::kMalformed),
              AllOf(HasSubstr("car.log"), HasSubstr("none of its 2 frames")));
}

}  // namespace
}  // namespace terracut::cli
