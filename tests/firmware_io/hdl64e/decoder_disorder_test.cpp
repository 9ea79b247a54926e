// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What the decoder does with streams that are not as they should be.
#include <gtest/gtest.h>

#include <algorithm>

#include "random_drive.hpp"

namespace terracut::test {
namespace {

using frame::LossCounters;
using frame::Reject;

std::uint64_t returns_in(std::span<const Packet> packets) {
  std::uint64_t sum = 0;
  for (const Packet& packet : packets) {
    for (std::size_t block = 0; block < 12; ++block) {
      for (std::size_t j = 0; j < 32; ++j) {
        const std::size_t at = 100 * block + 4 + 3 * j;
        sum += packet.bytes[at] != 0 || packet.bytes[at + 1] != 0;
      }
    }
  }
  return sum;
}

std::vector<Packet> long_drive(unsigned seed = 1) {
  return random_packets({.last_cdeg = 37'100 + 4 * 36'000, .share_of_returns = 0.3, .seed = seed});
}

TEST(Disorder, LostPacketsAreCountedExactlyByDeviceStamps) {
  auto packets = long_drive();
  std::mt19937 random(1);
  std::size_t lost = 0;
  std::vector<Packet> kept;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    const bool inside = n > 20 && n + 1 < packets.size();
    if (inside && random() % 10 == 0) {
      ++lost;
    } else {
      kept.push_back(packets[n]);
    }
  }
  Recorder recorder(kept);
  const LossCounters losses = recorder.decoder.losses();
  EXPECT_EQ(losses.network_gap_packets, lost);
  // Azimuths are rounded, and holes are told in whole firings a frame.
  EXPECT_NEAR(static_cast<double>(losses.azimuth_hole_columns), static_cast<double>(6 * lost), 6.0);
  EXPECT_EQ(recorder.returns(), returns_in(kept));
  EXPECT_EQ(losses.rejected_total(), 0U);
  std::uint64_t in_frames = 0;
  for (const Frame& frame : recorder.frames) {
    EXPECT_FALSE(frame.info.complete);
    in_frames += frame.info.losses.network_gap_packets;
  }
  EXPECT_EQ(in_frames, lost);
}

TEST(Disorder, LossesBeforeThePeriodIsKnownAreCountedToo) {
  auto packets = long_drive();
  packets.erase(packets.begin() + 3, packets.begin() + 5);
  packets.erase(packets.begin() + 8);
  Recorder recorder(packets);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 3U);
}

TEST(Disorder, TheSlowerCycleHasItsOwnPeriod) {
  auto packets = random_packets({.step_deg = 0.20736, .column_ns = 57'600});
  packets.erase(packets.begin() + 100, packets.begin() + 103);
  Recorder recorder(packets);
  EXPECT_NEAR(static_cast<double>(recorder.decoder.packet_period_ns()), 345'600, 100);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 3U);
}

TEST(Disorder, AMissingSectorSpoilsItsFrameOnly) {
  auto packets = long_drive();
  packets.erase(packets.begin() + 450, packets.begin() + 500);
  Recorder recorder(packets);
  ASSERT_EQ(recorder.frames.size(), 6U);  // five frames and what leads and trails
  EXPECT_TRUE(recorder.frames[1].info.complete);
  EXPECT_FALSE(recorder.frames[2].info.complete);
  EXPECT_TRUE(recorder.frames[3].info.complete);
  // That it is no blind sector shows when the head is there again.
  EXPECT_EQ(recorder.frames[2].info.losses.network_gap_packets, 0U);
  EXPECT_EQ(recorder.frames[3].info.losses.azimuth_hole_columns, 300U);
  EXPECT_EQ(recorder.frames[3].info.losses.network_gap_packets, 50U);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
}

TEST(Disorder, AGapOfMoreThanHalfARevolutionDoesNotLoseCountOfFrames) {
  auto packets = long_drive();
  packets.erase(packets.begin() + 450, packets.begin() + 450 + 600);  // 1.73 frames
  Recorder recorder(packets);
  const LossCounters losses = recorder.decoder.losses();
  EXPECT_EQ(losses.network_gap_packets, 600U);
  EXPECT_NEAR(static_cast<double>(losses.azimuth_hole_columns), 3600.0, 2.0);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
  EXPECT_EQ(losses.rejected_total(), 0U);
}

TEST(Disorder, ReorderedPacketsStillFindTheirFrameAndAreNotMissing) {
  auto packets = long_drive();
  std::mt19937 random(2);
  for (std::size_t n = 30; n + 3 < packets.size(); n += 3) {
    if (random() % 2 == 0) std::swap(packets[n], packets[n + 1 + random() % 2]);
  }
  Recorder recorder(packets);
  const LossCounters losses = recorder.decoder.losses();
  EXPECT_EQ(losses.network_gap_packets, 0U);
  EXPECT_EQ(losses.azimuth_hole_columns, 0U);
  EXPECT_EQ(losses.rejected_total(), 0U);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
  ASSERT_EQ(recorder.frames.size(), 6U);
  for (std::size_t n = 1; n < 5; ++n) EXPECT_TRUE(recorder.frames[n].info.complete);
}

TEST(Disorder, AnyPacketMayComeAsManyPacketsLateAsIsWaitedFor) {
  for (std::size_t phase = 0; phase < 3; ++phase) {  // each packet comes late once
    auto packets = long_drive();
    for (std::size_t n = 30 + phase; n + 3 <= packets.size(); n += 3) {
      std::rotate(&packets[n], &packets[n + 1], &packets[n] + 3);
    }
    Recorder recorder(packets);
    EXPECT_EQ(recorder.decoder.losses().rejected_total(), 0U) << phase;
    EXPECT_EQ(recorder.returns(), returns_in(packets)) << phase;
  }
}

Recorder::Config waiting_for(int reorder_packets) {
  Recorder::Config config;
  config.reorder_packets = reorder_packets;
  return config;
}

/// Numbers of the packets with which frames are handed over.
std::vector<std::size_t> ends_of_frames(Recorder& recorder, std::span<const Packet> packets) {
  std::vector<std::size_t> ends;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    recorder.decode(packets[n]);
    if (recorder.frames.size() > ends.size()) ends.push_back(n);
  }
  recorder.flush();
  return ends;
}

TEST(Disorder, WithoutWaitingForLatePacketsFramesAreTheSameAndThreePacketsEarlier) {
  const auto packets = long_drive();
  Recorder waiting(waiting_for(2)), hasty(waiting_for(0));
  const auto late_ends = ends_of_frames(waiting, packets);
  const auto ends = ends_of_frames(hasty, packets);
  ASSERT_EQ(late_ends.size(), 4U);  // the capture ends before the fifth is complete
  for (std::size_t n = 0; n < late_ends.size(); ++n) EXPECT_EQ(ends.at(n) + 3, late_ends[n]) << n;
  EXPECT_EQ(hasty.decoder.losses().rejected_total(), 0U);
  ASSERT_EQ(hasty.frames.size(), waiting.frames.size());
  for (std::size_t n = 0; n < hasty.frames.size(); ++n) {
    EXPECT_EQ(hasty.frames[n].info.returns, waiting.frames[n].info.returns) << n;
  }
}

TEST(Disorder, WithoutWaitingNothingIsLostWhereTheHeadRotatesUnevenly) {
  auto firings = random_firings({.last_cdeg = 37'100 + 40 * 36'000, .share_of_returns = 0.1});
  std::mt19937 random(3);
  std::uniform_int_distribution<int> jitter_cdeg(-3, 3);  // recorded sensors: 1
  for (FiringColumn& firing : firings) firing.unwrapped_azimuth_cdeg += jitter_cdeg(random);
  const auto packets = to_packets(firings);
  Recorder recorder(packets, waiting_for(0));
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), 0U);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
}

TEST(Disorder, WithoutWaitingALatePacketIsLostOnlyWhereItsFrameIsOver) {
  const auto packets = long_drive();
  Recorder ordered(waiting_for(0));
  const std::size_t end = ends_of_frames(ordered, packets).at(1);
  auto shuffled = packets;
  std::swap(shuffled[end - 200], shuffled[end - 199]);  // in the middle of a frame
  std::swap(shuffled[end], shuffled[end + 1]);          // where one ends
  Recorder recorder(shuffled, waiting_for(0));
  EXPECT_EQ(recorder.rejected(Reject::kLate), 1U);
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), 1U);
  EXPECT_EQ(returns_in(packets) - recorder.returns(), returns_in({&packets[end], 1}));
}

TEST(Disorder, AnySmallShuffleGivesTheSameFramesAsTheOrderedStream) {
  const auto packets = long_drive();
  Recorder ordered(packets);
  for (unsigned seed = 0; seed < 5; ++seed) {
    auto shuffled = packets;
    std::mt19937 random(seed);
    for (std::size_t n = 0; n + 1 < shuffled.size(); n += 2) {
      if (random() % 2 == 0) std::swap(shuffled[n], shuffled[n + 1]);
    }
    Recorder recorder(shuffled);
    ASSERT_EQ(recorder.frames.size(), ordered.frames.size());
    for (std::size_t n = 0; n < ordered.frames.size(); ++n) {
      EXPECT_EQ(recorder.frames[n].info.returns, ordered.frames[n].info.returns);
    }
  }
}

TEST(Disorder, APacketTooLateForItsFrameIsRefusedAsLate) {
  auto packets = long_drive();
  // The packet just before the first seam comes 50 packets (15 ms) later.
  const auto seam = static_cast<std::size_t>(
      std::distance(packets.begin(), packets.begin() + (11 + 350) * 100 / 104));
  std::rotate(packets.begin() + static_cast<std::ptrdiff_t>(seam),
              packets.begin() + static_cast<std::ptrdiff_t>(seam) + 1,
              packets.begin() + static_cast<std::ptrdiff_t>(seam) + 50);
  Recorder recorder(packets);
  EXPECT_EQ(recorder.rejected(Reject::kLate), 1U);
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), 1U);
  EXPECT_EQ(recorder.decoder.losses().azimuth_hole_columns, 6U);
  EXPECT_EQ(recorder.frames.size(), 6U);
}

TEST(Disorder, RepeatedPacketsAreRefusedAtOnceOrLater) {
  const auto packets = long_drive();
  std::vector<Packet> doubled;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    doubled.push_back(packets[n]);
    doubled.push_back(packets[n]);
    if (n >= 40) doubled.push_back(packets[n - 40]);
  }
  Recorder plain, recorder;
  plain.decode_all(packets);
  plain.flush();
  recorder.decode_all(doubled);
  recorder.flush();
  EXPECT_EQ(recorder.rejected(Reject::kRepeated), doubled.size() - packets.size());
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), doubled.size() - packets.size());
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
  ASSERT_EQ(recorder.frames.size(), plain.frames.size());
  for (std::size_t n = 0; n < plain.frames.size(); ++n) {
    EXPECT_EQ(recorder.frames[n].info.returns, plain.frames[n].info.returns);
    EXPECT_EQ(recorder.frames[n].info.complete, plain.frames[n].info.complete);
  }
}

TEST(Disorder, ADuplicatedFrameIsRepeatedPacketsAndNoSecondFrame) {
  auto packets = long_drive();
  std::vector<Packet> twice(packets.begin(), packets.begin() + 700);
  twice.insert(twice.end(), packets.begin() + 353, packets.begin() + 700);
  twice.insert(twice.end(), packets.begin() + 700, packets.end());
  Recorder recorder(twice);
  EXPECT_EQ(recorder.frames.size(), 6U);
  EXPECT_EQ(recorder.rejected(Reject::kRepeated), 347U);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
}

TEST(Disorder, TheDeviceClockWrapsAtTheHour) {
  // The second device hour begins in the middle of the drive.
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  const auto packets =
      random_packets({.first_stamp_ns = 472'222 * kHour_ns - 150'000'000, .share_of_returns = 0.3});
  Recorder recorder(packets);
  const LossCounters losses = recorder.decoder.losses();
  EXPECT_EQ(losses.network_gap_packets, 0U);
  EXPECT_EQ(losses.clock_jumps, 0U);
  EXPECT_EQ(recorder.frames.size(), 4U);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
}

TEST(Disorder, ALossAcrossTheHourIsStillExact) {
  auto packets = random_packets({.share_of_returns = 0.3});
  for (std::size_t n = 0; n < packets.size(); ++n) {
    packets[n].set_device_stamp_us(static_cast<std::uint32_t>(
        (3'599'999'900LL - 288 * 400 + 288 * static_cast<int>(n)) % 3'600'000'000LL));
  }
  // Packet 400 is stamped 3 599 999 900, the next one 188.
  packets.erase(packets.begin() + 399, packets.begin() + 402);
  Recorder recorder(packets);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 3U);
  EXPECT_EQ(recorder.decoder.losses().clock_jumps, 0U);
}

TEST(Disorder, ASetDeviceClockDoesNotBreakTheFrame) {
  auto packets = long_drive();
  for (std::size_t n = 500; n < packets.size(); ++n) {
    packets[n].set_device_stamp_us(static_cast<std::uint32_t>(2'000'000'000U + 288 * n));
  }
  Recorder recorder(packets);
  EXPECT_EQ(recorder.decoder.losses().clock_jumps, 1U);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
  EXPECT_EQ(recorder.frames.size(), 6U);
  EXPECT_TRUE(recorder.frames[2].info.complete);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
}

TEST(Disorder, ALoopHandsOverTheOpenFramesAndStartsAfresh) {
  const auto packets = long_drive();
  Recorder once, looped;
  once.decode_all(packets);
  once.flush();
  for (int loop = 0; loop < 3; ++loop) looped.decode_all(packets);
  looped.flush();
  ASSERT_EQ(looped.frames.size(), 3 * once.frames.size());
  EXPECT_EQ(looped.decoder.losses().clock_jumps, 2U);
  EXPECT_EQ(looped.decoder.losses().network_gap_packets, 0U);
  EXPECT_EQ(looped.decoder.losses().azimuth_hole_columns, 0U);
  EXPECT_EQ(looped.decoder.losses().rejected_total(), 0U);
  for (std::size_t n = 0; n < looped.frames.size(); ++n) {
    EXPECT_EQ(looped.frames[n].info.returns, once.frames[n % once.frames.size()].info.returns);
    EXPECT_EQ(looped.frames[n].info.complete, once.frames[n % once.frames.size()].info.complete);
  }
}

TEST(Disorder, AFlushedStreamMayComeAgainAtOnce) {
  const auto packets = random_packets({.last_cdeg = 40'000});  // too short for a loop to be told
  Recorder recorder;
  for (int loop = 0; loop < 2; ++loop) {
    recorder.decode_all(packets);
    recorder.flush();
  }
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), 0U);
  EXPECT_EQ(recorder.returns(), 2 * returns_in(packets));
}

TEST(Disorder, AnOutageOfSecondsIsLossAndNoClockJump) {
  auto packets = long_drive();
  constexpr std::int64_t kOutage_us = 288 * 20'000;  // 5.76 s
  for (std::size_t n = 700; n < packets.size(); ++n) {
    packets[n].stamp_ns += 1000 * kOutage_us;
    packets[n].set_device_stamp_us(
        static_cast<std::uint32_t>(packets[n].stamp_ns / 1000 % 3'600'000'000LL));
  }
  Recorder recorder(packets);
  const LossCounters losses = recorder.decoder.losses();
  EXPECT_EQ(losses.clock_jumps, 0U);
  EXPECT_EQ(losses.network_gap_packets, 20'000U);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
}

TEST(Disorder, AStationaryHeadGivesNoFramesAndNoGrowth) {
  auto packets = long_drive();
  Recorder recorder;
  recorder.decode_all(std::span(packets).first(500));
  const std::size_t frames_before = recorder.frames.size();
  Packet still = packets[500];
  for (std::size_t c = 0; c < 6; ++c) {
    still.set_u16(200 * c + 2, 4'321);
    still.set_u16(200 * c + 102, 4'321);
  }
  for (int n = 0; n < 50'000; ++n) {
    still.set_device_stamp_us(static_cast<std::uint32_t>(1'000'000'000 + 288 * n));
    recorder.decode(still);
  }
  EXPECT_EQ(recorder.rejected(Reject::kStationary), 50'000U);
  EXPECT_EQ(recorder.frames.size(), frames_before);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
}

TEST(Disorder, AHeadThatStopsAndRotatesOnLosesNothingElse) {
  auto firings = random_firings({.last_cdeg = 37'100 + 2 * 36'000, .share_of_returns = 0.3});
  auto packets = to_packets(firings);
  std::vector<Packet> stream(packets.begin(), packets.begin() + 400);
  std::uint32_t stamp_us = 0;
  std::memcpy(&stamp_us, &packets[399].bytes[1200], 4);
  Packet still = packets[399];
  for (std::size_t c = 0; c < 12; ++c) {
    still.set_u16(100 * c + 2, packets[400].bytes[2] + 256U * packets[400].bytes[3]);
  }
  for (int n = 0; n < 1'000; ++n) {
    stamp_us += 288;
    still.set_device_stamp_us(stamp_us);
    stream.push_back(still);
  }
  for (std::size_t n = 400; n < packets.size(); ++n) {
    stamp_us += 288;
    stream.push_back(packets[n]);
    stream.back().set_device_stamp_us(stamp_us);
  }
  Recorder recorder(stream);
  EXPECT_EQ(recorder.rejected(Reject::kStationary), 1'000U);
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), 1'000U);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
  EXPECT_EQ(recorder.frames.size(), 4U);
}

TEST(Disorder, AHeadThatJittersBackAtTheSeamStartsNoFalseFrame) {
  auto firings = random_firings({.share_of_returns = 0.3});
  std::mt19937 random(8);
  for (auto& firing : firings) firing.unwrapped_azimuth_cdeg -= static_cast<int>(random() % 20);
  const auto packets = to_packets(firings);
  Recorder recorder(packets);
  EXPECT_EQ(recorder.frames.size(), 4U);
  EXPECT_EQ(recorder.rejected(Reject::kAzimuthJump) + recorder.decoder.packets_decoded(),
            packets.size());
}

TEST(Disorder, ForeignAzimuthsAreRefusedWhileTheStreamGoesOn) {
  auto packets = long_drive();
  std::vector<Packet> stream;
  std::size_t foreign = 0;
  for (std::size_t n = 0; n < packets.size(); ++n) {
    stream.push_back(packets[n]);
    if (n % 10 == 5) {  // another head, half a revolution away, with the same clock
      Packet other = packets[(n + 170) % packets.size()];
      other.set_device_stamp_us(
          static_cast<std::uint32_t>(packets[n].stamp_ns / 1000 % 3'600'000'000LL + 100));
      stream.push_back(other);
      ++foreign;
    }
  }
  Recorder recorder(stream);
  EXPECT_EQ(recorder.rejected(Reject::kAzimuthJump), foreign);
  EXPECT_EQ(recorder.frames.size(), 6U);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
}

TEST(Disorder, AHeadThatIsElsewhereForGoodIsFollowed) {
  auto packets = long_drive();
  std::vector<Packet> stream(packets.begin(), packets.begin() + 500);
  for (std::size_t n = 500; n + 170 < packets.size();
       ++n) {  // no time passes, half a revolution does
    stream.push_back(packets[n + 170]);
    stream.back().set_device_stamp_us(
        static_cast<std::uint32_t>(packets[n].stamp_ns / 1000 % 3'600'000'000LL));
  }
  Recorder recorder(stream);
  EXPECT_EQ(recorder.decoder.losses().rejected_total(), 0U);
  EXPECT_EQ(recorder.decoder.packets_decoded(), stream.size());
}

TEST(Disorder, RejectedPacketsAreNotCountedAsMissingToo) {
  auto packets = long_drive();
  for (std::size_t n = 50; n < packets.size(); n += 50) packets[n].set_u16(102, 40'000);
  Recorder recorder(packets);
  EXPECT_EQ(recorder.rejected(Reject::kAzimuthOutOfRange), (packets.size() - 1) / 50);
  EXPECT_EQ(recorder.decoder.losses().network_gap_packets, 0U);
  EXPECT_EQ(recorder.decoder.losses().azimuth_hole_columns, 6 * ((packets.size() - 1) / 50));
}

TEST(Disorder, AFrozenDeviceClockIsCountedAndDecodedAnyway) {
  auto packets = random_packets({.share_of_returns = 0.3});
  for (auto& packet : packets) packet.set_device_stamp_us(5);
  Recorder recorder(packets);
  EXPECT_EQ(recorder.returns(), returns_in(packets));
  EXPECT_EQ(recorder.decoder.losses().clock_jumps, packets.size() - 1);
  EXPECT_EQ(recorder.frames.size(), 4U);
}

TEST(Disorder, NoStreamMakesAFrameLargerThanItsMemory) {
  // The same sector over and over, with running stamps: the head "rotates" but gets nowhere.
  const auto packets = random_packets({.last_cdeg = 35'100, .share_of_returns = 1.0});
  Recorder recorder;
  std::uint64_t sent = 0;
  for (std::uint32_t n = 0; n < 20'000; ++n) {
    Packet packet = packets[n % packets.size()];
    packet.set_device_stamp_us(1'000'000 + 288 * n);
    if (!recorder.decode(packet)) sent += returns_in({&packet, 1});
  }
  recorder.flush();
  const std::uint64_t most = recorder.decoder.return_capacity();
  for (const Frame& frame : recorder.frames) EXPECT_LE(frame.info.returns, most);
  EXPECT_EQ(recorder.returns() + recorder.decoder.losses().overflow_full_returns, sent);
}

}  // namespace
}  // namespace terracut::test
