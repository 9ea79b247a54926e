// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/deskewer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::decode {
namespace {

using frame::ImageShape;
using frame::RangeImage;

constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;  // the head passes straight ahead
constexpr std::int64_t kFramePeriod_ns = 100'000'000;
constexpr ImageShape kShape{3, 401};
constexpr std::array<std::int32_t, 3> kBeam_ticks{-1'000'000, 0, 1'000'000};  // 10 degrees
constexpr double kSpeed_mps = 20, kYawRate_radps = 0.5;

class DeskewerTest : public testing::Test {
 protected:
  [[nodiscard]] Deskewer deskewer(frame::FrameInstant at) {
    return Deskewer({&motion_, at, kShape, packet::kRevolution_ticks}, kBeam_ticks, memory_);
  }

  void drive(double speed_mps, double yaw_rate_radps) {
    for (int i = -5; i < 45; ++i) {
      EXPECT_TRUE(motion_.add({kStart_ns + i * 10'000'000, speed_mps, yaw_rate_radps}));
    }
  }

  /// Where the head is `share` of a frame after it passed straight ahead.
  static void note(Deskewer& deskewer, double share) {
    deskewer.note(std::llround(share * packet::kRevolution_ticks), instant_ns(share));
  }
  static void note(Deskewer& deskewer, double from, double to) {
    for (double share = from; share <= to; share += 1.0 / 350) note(deskewer, share);
  }
  static std::int64_t instant_ns(double share) {
    return kStart_ns + std::llround(share * static_cast<double>(kFramePeriod_ns));
  }

  frame::DeskewInfo apply(Deskewer& deskewer, std::int64_t frame) {
    const Deskewer::Deskewed deskewed = deskewer.deskew(frame);
    EXPECT_EQ(deskewed.by_row.empty(), deskewed.info.state != frame::DeskewState::kDone);
    image_.move(deskewed.by_row);
    return deskewed.info;
  }

  /// A return in each cell, of which the test knows where it was at the start of the drive.
  void see(int frame, double speed_mps, double yaw_rate_radps) {
    image_.clear();
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        const vehicle::PlanarPose sensor =
            pose(share_of(frame, row, column), speed_mps, yaw_rate_radps);
        const vehicle::PlanarPose seen = vehicle::inverse(sensor) * world(row, column);
        EXPECT_TRUE(image_.place(row, column, point_at(seen)));
      }
    }
  }
  static frame::Return point_at(const vehicle::PlanarPose& seen) {
    const auto x = static_cast<float>(seen.x_m), y = static_cast<float>(seen.y_m);
    return {x, y, 0.5F, std::sqrt(x * x + y * y), 7};
  }
  static vehicle::PlanarPose world(int row, int column) {
    const double azimuth_rad = 2 * std::numbers::pi * column / kShape.columns;
    const double range_m = 10 + 20 * row;
    return {range_m * std::cos(azimuth_rad), -range_m * std::sin(azimuth_rad), 1, 0};
  }
  /// Revolutions of the head until a cell's beam fires: the beam is in the middle of its column.
  static double share_of(int frame, int row, int column) {
    return frame + (column + 0.5) / kShape.columns -
           static_cast<double>(kBeam_ticks[static_cast<std::size_t>(row)]) /
               packet::kRevolution_ticks;
  }
  static vehicle::PlanarPose pose(double share, double speed_mps, double yaw_rate_radps) {
    return vehicle::after_constant_motion(speed_mps, yaw_rate_radps,
                                          share * static_cast<double>(kFramePeriod_ns) * 1e-9);
  }

  /// The farthest that a return lies from where the sensor at `share` would see it.
  [[nodiscard]] double worst_m(double share) const {
    const vehicle::PlanarPose sensor = pose(share, kSpeed_mps, kYawRate_radps);
    double worst = 0;
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        const vehicle::PlanarPose wanted = vehicle::inverse(sensor) * world(row, column);
        const auto cell = static_cast<std::size_t>(row * kShape.stride() + column);
        worst = std::max(
            worst, std::hypot(image_.x_m()[cell] - wanted.x_m, image_.y_m()[cell] - wanted.y_m));
        EXPECT_NEAR(image_.ground_range_m()[cell],
                    std::hypot(image_.x_m()[cell], image_.y_m()[cell]), 1e-5);
        EXPECT_EQ(image_.z_m()[cell], 0.5F);
      }
    }
    return worst;
  }

  memory::FixedMemory memory_;
  vehicle::EgoMotion motion_{{}, memory_};
  RangeImage image_{kShape, 10, memory_};
};

// A column is 0.25 ms here: half of it is 2.5 mm of way and 6 mm of swing at 50 m.
constexpr double kHalfAColumn_m = 0.009;

TEST_F(DeskewerTest, ReturnsLieWhereTheyWereAtTheInstantAskedFor) {
  drive(kSpeed_mps, kYawRate_radps);
  const std::array<std::pair<frame::FrameInstant, double>, 3> instants{
      {{frame::FrameInstant::kStart, 1.0},
       {frame::FrameInstant::kMiddle, 1.5},
       {frame::FrameInstant::kEnd, 2.0}}};
  for (const auto& [at, share] : instants) {
    Deskewer deskewer = this->deskewer(at);
    note(deskewer, 0, 2.1);
    see(1, kSpeed_mps, kYawRate_radps);
    EXPECT_GT(worst_m(share), 0.9);
    const frame::DeskewInfo info = apply(deskewer, 1);
    EXPECT_EQ(info.state, frame::DeskewState::kDone);
    EXPECT_EQ(info.at, at);
    EXPECT_NEAR(static_cast<double>(info.reference_ns - instant_ns(share)), 0, 1000);
    EXPECT_LT(worst_m(share), kHalfAColumn_m);
  }
}

TEST_F(DeskewerTest, PacketsThatWereLostLeaveNoHole) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kEnd);
  note(deskewer, 0, 1.2);
  note(deskewer, 1.7, 2.1);
  see(1, kSpeed_mps, kYawRate_radps);
  EXPECT_EQ(apply(deskewer, 1).state, frame::DeskewState::kDone);
  EXPECT_LT(worst_m(2.0), kHalfAColumn_m);
}

TEST_F(DeskewerTest, EveryFrameOfALongDriveComesOutAsTheFirst) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kStart);
  note(deskewer, -0.1, 0.05);
  for (int frame = 0; frame < 4; ++frame) {
    note(deskewer, frame + 0.06, frame + 1.05);
    see(frame, kSpeed_mps, kYawRate_radps);
    EXPECT_EQ(apply(deskewer, frame).state, frame::DeskewState::kDone);
    EXPECT_LT(worst_m(frame), kHalfAColumn_m) << "frame " << frame;
  }
}

TEST_F(DeskewerTest, AHeadThatChangesItsSpeedIsFollowed) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kStart);
  // The head is ahead of an even frame by up to 3 degrees; instants stay as they are.
  const auto head = [](double share) {
    return share + 0.008 * std::sin(2 * std::numbers::pi * share);
  };
  for (double share = -0.1; share <= 1.1; share += 1.0 / 350) {
    deskewer.note(std::llround(head(share) * packet::kRevolution_ticks), instant_ns(share));
  }
  image_.clear();
  for (int row = 0; row < kShape.rows; ++row) {
    for (int column = 0; column < kShape.columns; ++column) {
      double share = share_of(0, row, column);  // of the head's way; now of the time
      for (int i = 0; i < 20; ++i) share += share_of(0, row, column) - head(share);
      const vehicle::PlanarPose sensor = pose(share, kSpeed_mps, kYawRate_radps);
      EXPECT_TRUE(
          image_.place(row, column, point_at(vehicle::inverse(sensor) * world(row, column))));
    }
  }
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kDone);
  EXPECT_LT(worst_m(0), kHalfAColumn_m);
}

TEST_F(DeskewerTest, BothReturnsOfACellAreMoved) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kStart);
  note(deskewer, -0.1, 1.1);
  see(0, kSpeed_mps, kYawRate_radps);
  const auto cell = static_cast<std::size_t>(2 * kShape.stride() + 300);
  const frame::Return owner{image_.x_m()[cell], image_.y_m()[cell], 0.5F,
                            image_.ground_range_m()[cell], 7};
  ASSERT_TRUE(image_.place(2, 300, owner));
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kDone);
  ASSERT_EQ(image_.overflow().size(), 1U);
  const frame::Return& extra = image_.overflow()[0].point;
  EXPECT_EQ(extra.x_m, image_.x_m()[cell]);
  EXPECT_EQ(extra.y_m, image_.y_m()[cell]);
  EXPECT_EQ(extra.ground_range_m, image_.ground_range_m()[cell]);
  EXPECT_NE(extra.x_m, owner.x_m);
}

TEST_F(DeskewerTest, WithoutMotionReturnsStayAndTheFrameSaysSo) {
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kEnd);
  note(deskewer, -0.1, 1.1);
  see(0, kSpeed_mps, kYawRate_radps);
  const std::vector<float> before(image_.x_m().begin(), image_.x_m().end());
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kNoEgoMotion);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), image_.x_m().begin()));
}

TEST_F(DeskewerTest, MotionThatEndedBeforeTheFrameIsNotUsed) {
  drive(kSpeed_mps, kYawRate_radps);  // until 440 ms
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kEnd);
  note(deskewer, 3.9, 6.1);
  see(4, kSpeed_mps, kYawRate_radps);
  const frame::DeskewInfo info = apply(deskewer, 4);
  EXPECT_EQ(info.state, frame::DeskewState::kDone);
  EXPECT_NEAR(static_cast<double>(info.newest_motion_ns), -60e6, 1e5);
  see(5, kSpeed_mps, kYawRate_radps);
  EXPECT_EQ(apply(deskewer, 5).state, frame::DeskewState::kNoEgoMotion);
}

TEST_F(DeskewerTest, AVehicleThatStandsStillKeepsEveryBitOfItsReturns) {
  drive(0, 0);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kEnd);
  note(deskewer, -0.1, 1.1);
  see(0, 0, 0);
  const std::vector<float> x(image_.x_m().begin(), image_.x_m().end());
  const std::vector<float> range(image_.ground_range_m().begin(), image_.ground_range_m().end());
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kDone);
  EXPECT_TRUE(std::equal(x.begin(), x.end(), image_.x_m().begin()));
  EXPECT_TRUE(std::equal(range.begin(), range.end(), image_.ground_range_m().begin()));
}

TEST_F(DeskewerTest, AStreamThatBeginsAnewResetsTheOneBefore) {
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kStart);
  note(deskewer, 50, 52);
  deskewer.restart();
  drive(kSpeed_mps, kYawRate_radps);
  note(deskewer, -0.1, 1.1);
  see(0, kSpeed_mps, kYawRate_radps);
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kDone);
  EXPECT_LT(worst_m(0), kHalfAColumn_m);
}

TEST_F(DeskewerTest, AHeadThatStandsOrIsSeenAtAnEarlierTimeIsNotNoted) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kEnd);
  note(deskewer, -0.1, 0.4);
  const std::int64_t rotor_ticks = std::llround(0.41 * packet::kRevolution_ticks);
  deskewer.note(rotor_ticks, instant_ns(0.41));
  deskewer.note(rotor_ticks, instant_ns(0.9));              // the same place
  deskewer.note(rotor_ticks - 1'000'000, instant_ns(0.9));  // one before it
  deskewer.note(std::llround(0.45 * packet::kRevolution_ticks),
                instant_ns(0.41) - 1);  // before it in time
  note(deskewer, 0.5, 1.1);
  see(0, kSpeed_mps, kYawRate_radps);
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kDone);
  EXPECT_LT(worst_m(1.0), kHalfAColumn_m);
}

TEST_F(DeskewerTest, AGapOfManyFramesLeavesTheFrameBeforeItAndTheOneBehindItAsTheyAre) {
  for (const int frames : {2, 5, 12, 20}) {
    SCOPED_TRACE(frames);
    vehicle::EgoMotion motion({}, memory_);
    for (std::int64_t i = -5; i < frames * 10 + 25; ++i) {
      motion.add({kStart_ns + i * 10'000'000, kSpeed_mps, kYawRate_radps});
      motion.take_new();
    }
    Deskewer deskewer({&motion, frame::FrameInstant::kEnd, kShape, packet::kRevolution_ticks},
                      kBeam_ticks, memory_);
    note(deskewer, -0.1, 0.7);
    note(deskewer, frames + 0.02);  // handed over with the first packet behind the gap
    see(0, kSpeed_mps, kYawRate_radps);
    frame::DeskewInfo info = apply(deskewer, 0);
    EXPECT_EQ(info.state, frame::DeskewState::kDone);
    EXPECT_NEAR(static_cast<double>(info.reference_ns - instant_ns(1)), 0, 1000);
    EXPECT_LT(worst_m(1.0), kHalfAColumn_m);
    note(deskewer, frames + 0.03, frames + 1.1);
    see(frames, kSpeed_mps, kYawRate_radps);
    info = apply(deskewer, frames);
    EXPECT_EQ(info.state, frame::DeskewState::kDone);
    EXPECT_LT(worst_m(frames + 1.0), kHalfAColumn_m);
    // Of a time that is not remembered any more the first that is stands in.
    constexpr double kRemembered = 256 * 8 / 401.0;
    const double first = std::max(-0.1, frames + 1.1 - kRemembered);
    info = apply(deskewer, frames - 9);
    EXPECT_NEAR(static_cast<double>(info.reference_ns - instant_ns(first)), 0, 5e6);
  }
}

TEST_F(DeskewerTest, WhereAClockWasSetTheFramesBegunHaveNoEgoMotionAndTheNextHasItsOwn) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kEnd);
  note(deskewer, -0.1, 1.4);
  deskewer.begin_anew(std::llround(1.41 * packet::kRevolution_ticks));
  constexpr std::int64_t kSet_ns = -150'000'000;  // where samples are of the time before
  for (double share = 1.41; share <= 3.1; share += 1.0 / 350) {
    deskewer.note(std::llround(share * packet::kRevolution_ticks), instant_ns(share) + kSet_ns);
  }
  see(0, kSpeed_mps, kYawRate_radps);
  const std::vector<float> before(image_.x_m().begin(), image_.x_m().end());
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kNoEgoMotion) << "of the time before";
  EXPECT_EQ(apply(deskewer, 1).state, frame::DeskewState::kNoEgoMotion);
  EXPECT_EQ(apply(deskewer, 2).state, frame::DeskewState::kNoEgoMotion) << "no sample came since";
  EXPECT_TRUE(std::equal(before.begin(), before.end(), image_.x_m().begin()));
  for (int i = 14; i < 32; ++i) {
    EXPECT_TRUE(motion_.add({kStart_ns + kSet_ns + i * 10'000'000, kSpeed_mps, kYawRate_radps}));
  }
  EXPECT_EQ(apply(deskewer, 1).state, frame::DeskewState::kNoEgoMotion) << "begun before";
  see(2, kSpeed_mps, kYawRate_radps);
  EXPECT_EQ(apply(deskewer, 2).state, frame::DeskewState::kDone);
  EXPECT_LT(worst_m(3.0), kHalfAColumn_m);
}

TEST_F(DeskewerTest, AStreamThatBeginsAnewHasNoMotionFromBefore) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kStart);
  note(deskewer, 50, 52);
  deskewer.restart();
  // The clock may have been set back while there was no stream, to where samples are.
  note(deskewer, -0.1, 1.1);
  see(0, kSpeed_mps, kYawRate_radps);
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kNoEgoMotion);
}

TEST_F(DeskewerTest, AStreamThatBeginsAnewIsNotWithoutMotionForAClockThatWasSet) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kStart);
  deskewer.begin_anew(50LL * packet::kRevolution_ticks);
  note(deskewer, 50, 52);
  deskewer.restart();
  for (int i = -5; i < 15; ++i) {
    EXPECT_TRUE(motion_.add({kStart_ns + i * 10'000'000, kSpeed_mps, kYawRate_radps}));
  }
  note(deskewer, -0.1, 1.1);
  see(0, kSpeed_mps, kYawRate_radps);
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kDone);
  EXPECT_LT(worst_m(0), kHalfAColumn_m);
}

TEST_F(DeskewerTest, AFrameOfOnePacketIsLeftWhereItIs) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kEnd);
  note(deskewer, 0.5);
  image_.clear();
  ASSERT_TRUE(image_.place(1, 200, {10, 0, 0, 10, 1}));
  const frame::DeskewInfo info = apply(deskewer, 0);
  EXPECT_EQ(info.reference_ns, instant_ns(0.5));
  EXPECT_EQ(image_.x_m()[static_cast<std::size_t>(kShape.stride() + 200)], 10.0F);
}

TEST_F(DeskewerTest, MotionsOfAFrameStayUntilItsPlaceIsUsedAgain) {
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer({&motion_, frame::FrameInstant::kEnd, kShape, packet::kRevolution_ticks, 2},
                    kBeam_ticks, memory_);
  note(deskewer, -0.1, 3.1);
  const auto first = deskewer.deskew(0, 0).by_row, second = deskewer.deskew(1, 1).by_row;
  (void)deskewer.deskew(2, 1);
  see(0, kSpeed_mps, kYawRate_radps);
  image_.move(first);
  EXPECT_LT(worst_m(1.0), kHalfAColumn_m);
  see(2, kSpeed_mps, kYawRate_radps);
  image_.move(second);
  EXPECT_LT(worst_m(3.0), kHalfAColumn_m);
}

TEST_F(DeskewerTest, SettingsOutsideTheirRangeAreRefused) {
  EXPECT_THROW(Deskewer({nullptr, frame::FrameInstant::kEnd, kShape, packet::kRevolution_ticks},
                        kBeam_ticks, memory_),
               std::invalid_argument);
  EXPECT_THROW(Deskewer({&motion_, frame::FrameInstant::kEnd, {2, 400}, packet::kRevolution_ticks},
                        kBeam_ticks, memory_),
               std::invalid_argument);
  EXPECT_THROW(
      Deskewer({&motion_, frame::FrameInstant::kEnd, kShape, 1'500'000}, kBeam_ticks, memory_),
      std::invalid_argument);
}

TEST_F(DeskewerTest, MovingAFrameAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  drive(kSpeed_mps, kYawRate_radps);
  Deskewer deskewer = this->deskewer(frame::FrameInstant::kEnd);
  see(0, kSpeed_mps, kYawRate_radps);
  const std::uint64_t before = test::allocations_of_this_thread();
  note(deskewer, -0.1, 1.1);
  EXPECT_EQ(apply(deskewer, 0).state, frame::DeskewState::kDone);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::decode
