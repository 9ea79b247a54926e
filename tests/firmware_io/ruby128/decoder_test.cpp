// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "random_stream.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut::ruby128 {
namespace {

using test::RubyPacket;
using test::RubyStream;

struct Heard {
  std::vector<frame::FrameInfo> frames;
  std::vector<std::uint64_t> places;  ///< Of the returns by frame, as a checksum.
  frame::LossCounters losses;
  std::uint64_t decoded = 0;
  bool dual = false;

  [[nodiscard]] std::uint64_t returns() const {
    return std::accumulate(
        frames.begin(), frames.end(), std::uint64_t{0},
        [](std::uint64_t sum, const frame::FrameInfo& f) { return sum + f.returns; });
  }
};

std::uint64_t checksum(const frame::RangeImage& image) {
  std::uint64_t sum = 0;
  for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
    if (!image.has_return(cell)) continue;
    sum += cell * 2'654'435'761U ^ static_cast<std::uint64_t>(image.ground_range_m()[cell] * 1e4F);
  }
  return sum;
}

Heard hear(const std::vector<RubyPacket>& packets, decode::Decoder::Config config = {}) {
  memory::FixedMemory memory;
  decode::Decoder decoder(nominal_ruby128(), {}, config, memory);
  Heard heard;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
    EXPECT_EQ(info.returns, image.returns());
    heard.frames.push_back(info);
    heard.places.push_back(checksum(image));
  };
  for (const RubyPacket& packet : packets) test::decode(decoder, packet.datagram(), on_frame);
  heard.dual = decoder.dual_return();
  test::end_stream(decoder, on_frame);
  heard.losses = decoder.losses();
  heard.decoded = decoder.packets_decoded();
  return heard;
}

std::uint64_t returns_in(const std::vector<RubyPacket>& packets) {
  return std::accumulate(
      packets.begin(), packets.end(), std::uint64_t{0},
      [](std::uint64_t sum, const RubyPacket& packet) { return sum + packet.returns; });
}

struct Mode {
  double spin_hz;
  bool dual;
  RubyTimestamp timestamp;
};

class EveryMode : public testing::TestWithParam<Mode> {};

TEST_P(EveryMode, DecodesEveryReturnOfThreeFramesAndLosesNothing) {
  const Mode mode = GetParam();
  const auto packets = test::random_packets({.spin_hz = mode.spin_hz,
                                             .dual = mode.dual,
                                             .first_cdeg = 34'800,
                                             .last_cdeg = 36'000 * 4 + 1'200,
                                             .timestamp = mode.timestamp,
                                             .protocol_version = 0});
  decode::Decoder::Config config;
  config.columns = static_cast<int>(std::lround(18'000 / mode.spin_hz));
  const Heard heard = hear(packets, config);
  EXPECT_EQ(heard.dual, mode.dual);
  EXPECT_EQ(heard.decoded, packets.size());
  EXPECT_EQ(heard.returns(), returns_in(packets));
  EXPECT_EQ(heard.losses.rejected_total(), 0U);
  EXPECT_EQ(heard.losses.network_gap_packets, 0U);
  EXPECT_EQ(heard.losses.azimuth_hole_columns, 0U);
  EXPECT_EQ(heard.losses.overflow_full_returns, 0U);
  EXPECT_EQ(heard.losses.clock_jumps, 0U);
  ASSERT_EQ(heard.frames.size(), 5U);  // three whole ones between two cut ones
  EXPECT_FALSE(heard.frames.front().complete);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(heard.frames[i].complete) << i;
}

INSTANTIATE_TEST_SUITE_P(OfTheSensor, EveryMode,
                         testing::Values(Mode{5, false, RubyTimestamp::kCalendar},
                                         Mode{5, true, RubyTimestamp::kUtcNanoseconds},
                                         Mode{10, false, RubyTimestamp::kUtcMicroseconds},
                                         Mode{10, false, RubyTimestamp::kUtcNanoseconds},
                                         Mode{10, true, RubyTimestamp::kUtcMicroseconds},
                                         Mode{10, true, RubyTimestamp::kCalendar},
                                         Mode{20, false, RubyTimestamp::kUtcNanoseconds},
                                         Mode{20, true, RubyTimestamp::kUtcMicroseconds}),
                         [](const auto& m) {
                           return std::to_string(static_cast<int>(m.param.spin_hz)) + "Hz" +
                                  (m.param.dual ? "Dual" : "Single") +
                                  std::to_string(static_cast<int>(m.param.timestamp));
                         });

TEST(Ruby128Decoder, DecodesTheFramesOfAUnitWhoseCalendarStandsInTheYear2000) {
  const auto packets = test::random_packets({.last_cdeg = 36'000 * 4 + 1'200,
                                             .timestamp = RubyTimestamp::kCalendar,
                                             .start_ns = 946'684'800'500'000'000});
  const Heard heard = hear(packets);
  EXPECT_EQ(heard.losses.clock_jumps, 0U);
  EXPECT_EQ(heard.losses.network_gap_packets, 0U);
  ASSERT_EQ(heard.frames.size(), 5U);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(heard.frames[i].complete) << i;
}

TEST(Ruby128Decoder, EvenAFullSkyInDualReturnFindsRoom) {
  const auto packets = test::random_packets(
      {.dual = true, .first_cdeg = 34'800, .last_cdeg = 36'000 * 9, .share_of_returns = 1});
  const Heard heard = hear(packets);
  EXPECT_EQ(heard.losses.overflow_full_returns, 0U);
  EXPECT_EQ(heard.returns(), returns_in(packets));
}

TEST(Ruby128Decoder, LosesNothingWhereTheUnitOfItsStampsShowsLate) {
  // Nanoseconds below a million are microseconds as far as the first packet can tell.
  for (const std::int64_t into_second_ns : {0, 100'000, 500'000, 990'000}) {
    const auto packets =
        test::random_packets({.first_cdeg = 100,
                              .last_cdeg = 36'000 * 2,
                              .timestamp = RubyTimestamp::kUtcNanoseconds,
                              .start_ns = 1'767'225'601'000'000'000 + into_second_ns});
    const Heard heard = hear(packets);
    EXPECT_EQ(heard.returns(), returns_in(packets));
    EXPECT_EQ(heard.losses.rejected_total(), 0U);
    EXPECT_EQ(heard.losses.network_gap_packets, 0U);
    EXPECT_EQ(heard.losses.clock_jumps, 0U);
    EXPECT_EQ(heard.frames.size(), 4U);  // two frames, beams beyond either end; none torn in two
  }
}

TEST(Ruby128Decoder, TakesDeviceInformationForNoLoss) {
  memory::FixedMemory memory;
  decode::Decoder decoder(nominal_ruby128(), {}, {}, memory);
  std::vector<std::uint8_t> difop(kRubyPacketBytes, 0);
  const std::array<std::uint8_t, 8> start{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55};
  std::copy(start.begin(), start.end(), difop.begin());
  const auto nothing = [](const frame::FrameInfo&, const frame::MeasuredReturns&) noexcept {};
  EXPECT_EQ(test::decode(decoder, packet::Datagram{.payload = difop}, nothing),
            frame::Reject::kDeviceInfo);
  EXPECT_EQ(decoder.losses().rejected_total(), 0U);
}

class LossIn : public testing::TestWithParam<bool> {};

TEST_P(LossIn, PacketsAreCountedExactly) {
  const bool dual = GetParam();
  auto packets =
      test::random_packets({.dual = dual, .first_cdeg = 34'800, .last_cdeg = 36'000 * 4});
  // Every eleventh packet of a stretch, and a gap of twenty.
  std::vector<RubyPacket> kept;
  std::uint64_t lost = 0;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const bool lose = (i > 300 && i < 500 && i % 11 == 0) || (i >= 700 && i < 720);
    if (lose) {
      ++lost;
    } else {
      kept.push_back(packets[i]);
    }
  }
  const Heard heard = hear(kept);
  EXPECT_EQ(heard.losses.network_gap_packets, lost);
  EXPECT_GT(heard.losses.azimuth_hole_columns, lost);
  EXPECT_EQ(heard.losses.rejected_total(), 0U);
  EXPECT_EQ(heard.returns(), returns_in(kept));
}

TEST_P(LossIn, ReorderedAndRepeatedPacketsLoseNothing) {
  const bool dual = GetParam();
  const auto packets =
      test::random_packets({.dual = dual, .first_cdeg = 34'800, .last_cdeg = 36'000 * 3});
  std::vector<RubyPacket> disturbed = packets;
  for (std::size_t i = 100; i + 2 < disturbed.size(); i += 50) {
    std::swap(disturbed[i], disturbed[i + (i % 3 == 0 ? 2 : 1)]);
  }
  disturbed.insert(disturbed.begin() + 400, packets[395]);
  disturbed.insert(disturbed.begin() + 500, packets[490]);
  const Heard heard = hear(disturbed);
  EXPECT_EQ(heard.losses.rejected[static_cast<std::size_t>(frame::Reject::kRepeated)], 2U);
  EXPECT_EQ(heard.losses.rejected_total(), 2U);
  EXPECT_EQ(heard.losses.network_gap_packets, 0U);
  EXPECT_EQ(heard.returns(), returns_in(packets));
}

TEST_P(LossIn, OneFrameLeavesTheOthersAsTheyWere) {
  const bool dual = GetParam();
  const auto packets =
      test::random_packets({.dual = dual, .first_cdeg = 34'800, .last_cdeg = 36'000 * 5});
  auto kept = packets;
  const auto middle = static_cast<std::ptrdiff_t>(packets.size() * 38 / 100);  // half a revolution
  kept.erase(kept.begin() + middle, kept.begin() + middle + 7);
  const Heard whole = hear(packets), disturbed = hear(kept);
  ASSERT_EQ(whole.frames.size(), disturbed.frames.size());
  int changed = 0;
  for (std::size_t i = 0; i < whole.frames.size(); ++i) {
    const bool same = whole.places[i] == disturbed.places[i];
    changed += same ? 0 : 1;
    EXPECT_EQ(disturbed.frames[i].complete, whole.frames[i].complete && same) << i;
  }
  EXPECT_EQ(changed, 1);
}

INSTANTIATE_TEST_SUITE_P(ReturnMode, LossIn, testing::Values(false, true),
                         [](const auto& dual) { return dual.param ? "Dual" : "Single"; });

/// Both returns of one channel, by the policy, in the first firing of a stream.
float owner_range_m(frame::CellOwner owner) {
  auto packets = test::random_packets({.dual = true, .share_of_returns = 0});
  constexpr std::size_t kChannel = 9;
  for (RubyPacket& packet : packets) {
    for (auto& block : packet.bytes.blocks) block.returns[kChannel] = {};
  }
  auto& blocks = packets[30].bytes.blocks;
  blocks[0].returns[kChannel] = {packet::Be16::of(6'000), 10};  // the last return: far, weak
  blocks[1].returns[kChannel] = {packet::Be16::of(2'000), 90};  // the strongest: near
  memory::FixedMemory memory;
  decode::Decoder::Config config;
  config.dual_owner = owner;
  decode::Decoder decoder(nominal_ruby128(), {}, config, memory);
  float found_m = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
    EXPECT_EQ(info.returns, 2U);
    ASSERT_EQ(image.overflow().size(), 1U);
    const std::size_t cell = image.overflow()[0].cell;
    found_m = image.ground_range_m()[cell];
    EXPECT_NE(image.return_index()[cell], image.overflow()[0].return_index);
  };
  for (const RubyPacket& packet : packets) test::decode(decoder, packet.datagram(), on_frame);
  test::end_stream(decoder, on_frame);
  return found_m;
}

TEST(Ruby128Decoder, TheOwnerOfACellIsTheReturnThatThePolicyNames) {
  constexpr float kNear_m = 10, kFar_m = 30;
  EXPECT_NEAR(owner_range_m(frame::CellOwner::kStrongest), kNear_m, 0.2);
  EXPECT_NEAR(owner_range_m(frame::CellOwner::kNearest), kNear_m, 0.2);
  EXPECT_NEAR(owner_range_m(frame::CellOwner::kFarthest), kFar_m, 0.2);
  EXPECT_NEAR(owner_range_m(frame::CellOwner::kFirstArrived), kFar_m, 0.2);
}

TEST(Ruby128Decoder, RefusesSettingsOutsideTheirRange) {
  memory::FixedMemory memory;
  decode::Decoder::Config config;
  config.columns = 15;
  EXPECT_THROW(decode::Decoder(nominal_ruby128(), {}, config, memory), std::invalid_argument);
}

}  // namespace
}  // namespace terracut::ruby128
