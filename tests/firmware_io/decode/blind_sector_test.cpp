// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sensors with a limited field of view: one complete frame a revolution, in time, and only real
// losses.
#include "firmware_io/decode/blind_sector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "firmware_io/sensor/ruby128_survey.hpp"
#include "heard_stream.hpp"
#include "tests/support/thinned.hpp"

namespace terracut::test {
namespace {

using frame::BlindAzimuths;
using frame::FrameInfo;

/// Degrees of the head; across 0 where `from` is above `to`.
struct Sector {
  double from_deg, to_deg;
  [[nodiscard]] bool has(double deg) const {
    return from_deg < to_deg ? deg >= from_deg && deg < to_deg : deg >= from_deg || deg < to_deg;
  }
};

template <class Sensor>
double first_deg(const Payload& payload) {
  packet::PacketAzimuths azimuths;
  EXPECT_EQ(Sensor::check(payload.bytes, azimuths), std::nullopt);
  return azimuths.first_cdeg() * 0.01;
}

/// What a sensor sends that keeps its rhythm, but is silent while its head is in `blind`.
template <class Sensor>
std::vector<Payload> without(const std::vector<Payload>& payloads, const Sector& blind) {
  std::vector<Payload> sent;
  for (const Payload& payload : payloads) {
    if (!blind.has(first_deg<Sensor>(payload))) sent.push_back(payload);
  }
  return sent;
}

/// Frames from the `first` on that are not complete; the last one never is.
int incomplete(const std::vector<FrameInfo>& frames, std::size_t first) {
  return static_cast<int>(
      std::count_if(frames.begin() + static_cast<std::ptrdiff_t>(std::min(first, frames.size())),
                    frames.end() - 1, [](const FrameInfo& frame) { return !frame.complete; }));
}

/// Two frames of revolutions not seen whole, and those that the sector was learnt in.
constexpr std::size_t kLearnt = decode::BlindSector::kFramesToLearn + 2;

template <class Sensor>
class BlindSensor : public testing::Test {
 protected:
  void expect_blind(const HeardStream<Sensor>& stream, const Sector& blind) {
    const BlindAzimuths known = stream.decoder.blind();
    const double packet_s = Sensor::firing_us(false) * Sensor::firings_per_packet(false) * 1e-6;
    const double packet_deg = 360 * 20 * packet_s * 1.07;  // at 20 Hz
    EXPECT_LT(std::abs(std::remainder(known.from_cdeg * 0.01 - blind.from_deg, 360)), packet_deg);
    EXPECT_LT(std::abs(std::remainder(known.to_cdeg * 0.01 - blind.to_deg, 360)), packet_deg);
  }
  void expect_no_loss(const HeardStream<Sensor>& stream) {
    const auto losses = stream.decoder.losses();
    EXPECT_EQ(losses.network_gap_packets, 0U);
    EXPECT_EQ(losses.azimuth_hole_columns, 0U);
    // One where its end was taken for known and was not; some where a packet is one firing, hardly
    // wider than azimuths are rounded.
    EXPECT_LE(losses.rejected_total(), Sensor::firings_per_packet(true) > 1 ? 1U : 6U);
    EXPECT_EQ(losses.rejected_total(), stream.rejected(frame::Reject::kLate));
    EXPECT_EQ(losses.clock_jumps, 0U);
  }
  Head<Sensor> head;
};

using EverySensor =
    testing::Types<reference::Hdl64e, reference::Ruby128, reference::Hdl32e, reference::Vls128>;
TYPED_TEST_SUITE(BlindSensor, EverySensor);

TYPED_TEST(BlindSensor, GivesACompleteFrameARevolutionWithoutLossWhereverItIsBlind) {
  for (const Sector blind : {Sector{90, 270}, Sector{270, 90}, Sector{355, 3}, Sector{100, 130},
                             Sector{20, 340}, Sector{0, 180}, Sector{180, 359.99}}) {
    for (const bool dual : {false, true}) {
      for (const double spin_hz : thinned({5.0, 10.0, 20.0})) {
        SCOPED_TRACE(std::to_string(blind.from_deg) + ".." + std::to_string(blind.to_deg) +
                     (dual ? " dual " : " single ") + std::to_string(spin_hz));
        // Less than two packets are no sector of five degrees in every frame.
        const double packet_deg =
            360e-6 * spin_hz * TypeParam::firing_us(dual) * TypeParam::firings_per_packet(dual);
        const double blind_deg = std::fmod(blind.to_deg - blind.from_deg + 360, 360);
        if (blind_deg < 2.5 * packet_deg) continue;
        constexpr int kFrames = 12;
        const Head<TypeParam> rotating{spin_hz, dual, 0.02};
        HeardStream<TypeParam> stream(without<TypeParam>(rotating.frames(kFrames), blind),
                                      HeardStream<TypeParam>::hasty());
        this->expect_no_loss(stream);
        EXPECT_EQ(incomplete(stream.frames, kLearnt), 0);
        EXPECT_NEAR(static_cast<double>(stream.frames.size()), kFrames + 1, 1);
        this->expect_blind(stream, blind);
        EXPECT_EQ(stream.packets_unaccounted(), 0);
        EXPECT_EQ(stream.returns_unaccounted(), 0);
      }
    }
  }
}

TYPED_TEST(BlindSensor, HandsAFrameOverWithItsLastPacketWhereTheSeamIsNotSeen) {
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  std::size_t handed = 0;
  int in_time = 0, late = 0;
  for (const Payload& payload : without<TypeParam>(this->head.frames(40), {270, 90})) {
    (void)stream.hear(payload);
    if (stream.frames.size() == handed) continue;
    handed = stream.frames.size();
    if (handed < 15) continue;
    (stream.frames.back().last_packet_ns == payload.stamp_ns ? in_time : late) += 1;
    EXPECT_TRUE(stream.frames.back().complete);
  }
  EXPECT_GE(in_time, 22);
  EXPECT_LE(late, 2);
  stream.flush();
  this->expect_no_loss(stream);
  EXPECT_EQ(stream.returns_unaccounted(), 0);
}

TYPED_TEST(BlindSensor, ColumnsAreCompleteWithTheLastPacketBeforeTheSectorNotTheFirstBehindIt) {
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  const auto payloads = without<TypeParam>(this->head.frames(30), {90, 270});
  const int columns = stream.decoder.shape().columns;
  int at_once = 0, late = 0;
  for (std::size_t n = 0; n + 1 < payloads.size(); ++n) {
    (void)stream.hear(payloads[n]);
    const bool is_last =
        first_deg<TypeParam>(payloads[n]) < 90 && first_deg<TypeParam>(payloads[n + 1]) >= 270;
    if (!is_last || stream.frames.size() < 10) continue;
    const int complete = stream.decoder.arriving().complete_columns;
    (complete > columns * 2 / 3 ? at_once : late) += 1;
  }
  EXPECT_GE(at_once, 16);
  EXPECT_LE(late, 2);
}

TYPED_TEST(BlindSensor, PacketsFromBothSidesOfTheSectorMayArriveAtOnce) {
  auto payloads = without<TypeParam>(this->head.frames(20), {90, 230});
  const std::int64_t from_ns = payloads[payloads.size() / 2].stamp_ns,
                     to_ns = from_ns + 150'000'000;
  std::int64_t arrival_ns = to_ns - 4'000'000;
  for (Payload& payload : payloads) {
    if (payload.stamp_ns >= from_ns && payload.stamp_ns < to_ns)
      payload.stamp_ns = arrival_ns += 2'000;
  }
  HeardStream<TypeParam> stream(payloads, HeardStream<TypeParam>::hasty());
  this->expect_no_loss(stream);
  EXPECT_EQ(incomplete(stream.frames, kLearnt), 0);
  EXPECT_EQ(stream.packets_unaccounted(), 0);
}

TYPED_TEST(BlindSensor, CountsRealLossesBesideItToThePacket) {
  for (const Sector blind : {Sector{90, 270}, Sector{300, 60}}) {
    const auto sent = without<TypeParam>(this->head.frames(40), blind);
    std::mt19937 random(1);
    std::vector<Payload> kept;
    std::uint64_t lost = 0;
    for (std::size_t n = 0; n < sent.size(); ++n) {
      const double deg = first_deg<TypeParam>(sent[n]);
      const bool is_at_the_edge =
          blind.has(std::fmod(deg + 5, 360)) || blind.has(std::fmod(deg + 355, 360));
      if (n > 50 && n + 50 < sent.size() && !is_at_the_edge && random() % 25 == 0) {
        ++lost;
      } else {
        kept.push_back(sent[n]);
      }
    }
    HeardStream<TypeParam> stream(kept, HeardStream<TypeParam>::hasty());
    EXPECT_EQ(stream.decoder.losses().network_gap_packets, lost);
    EXPECT_LE(stream.decoder.losses().rejected_total(), 1U);
    this->expect_blind(stream, blind);
  }
}

TYPED_TEST(BlindSensor, CountsRealLossesAtItsVeryEndsWhereItsPacketsBeginWithItsView) {
  // A sensor that begins a packet where its view does.
  constexpr std::int64_t kFramePeriod_ns = 100'000'000, kStart_ns = 1'767'229'199'000'000'000;
  const auto packet_ns = static_cast<std::int64_t>(1e3 * TypeParam::firing_us(false) *
                                                   TypeParam::firings_per_packet(false));
  const std::int64_t in_view = kFramePeriod_ns * 200 / 360 / packet_ns;
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  std::uint64_t lost = 0;
  for (int frame = 0; frame < 20; ++frame) {
    for (std::int64_t n = 0; n < in_view; ++n) {
      const std::int64_t since_ns =
          frame * kFramePeriod_ns + kFramePeriod_ns * 50 / 360 + n * packet_ns;
      const bool is_lost =
          frame > 5 && frame < 18 && (frame % 3 == 0 ? n < 2 : frame % 3 == 1 && n == in_view - 1);
      lost += is_lost ? 1U : 0U;
      const double deg =
          360.0 * static_cast<double>(since_ns) / static_cast<double>(kFramePeriod_ns);
      if (!is_lost) (void)stream.hear(this->head.packet(deg, kStart_ns + since_ns));
    }
  }
  stream.flush();
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, lost);
}

TYPED_TEST(BlindSensor, DoesNotTakeALossInTwoFramesRunningForASector) {
  const auto sent = this->head.frames(8);
  std::vector<Payload> kept;
  std::uint64_t lost = 0;
  int frame = 0;
  double before_deg = 0;
  for (const Payload& payload : sent) {
    const double deg = first_deg<TypeParam>(payload);
    frame += deg < before_deg ? 1 : 0;
    before_deg = deg;
    if ((frame == 3 || frame == 4) && deg > 100 && deg < 160) {
      ++lost;
    } else {
      kept.push_back(payload);
    }
  }
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  stream.hear_all(kept);
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, lost) << "told before the stream ends";
  stream.flush();
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, lost);
  EXPECT_NEAR(static_cast<double>(stream.decoder.losses().azimuth_hole_columns),
              static_cast<double>(lost) * TypeParam::firings_per_packet(false), 4);
  EXPECT_TRUE(stream.decoder.blind().is_none());
  EXPECT_EQ(incomplete(stream.frames, 1), 2);
}

TYPED_TEST(BlindSensor, CountsLossesBesideItOfTheFramesItIsLearntIn) {
  const Sector blind{90, 270};
  const auto sent = without<TypeParam>(this->head.frames(12), blind);
  HeardStream<TypeParam> stream;
  std::uint64_t lost = 0;
  double before_deg = 0;
  int frame = 0;
  for (const Payload& payload : sent) {
    const double deg = first_deg<TypeParam>(payload);
    if (deg < before_deg) ++frame;
    before_deg = deg;
    if (frame == 2 && deg >= blind.to_deg && deg < blind.to_deg + 15) {
      ++lost;
    } else {
      (void)stream.hear(payload);
    }
  }
  stream.flush();
  EXPECT_GT(lost, 5U);
  // A sensor that keeps its rhythm begins anywhere within a packet's time behind its sector.
  EXPECT_NEAR(static_cast<double>(stream.decoder.losses().network_gap_packets),
              static_cast<double>(lost), 1);
  this->expect_blind(stream, blind);
}

TYPED_TEST(BlindSensor, CountsGapsThatWanderFromFrameToFrame) {
  const auto sent = this->head.frames(14);
  HeardStream<TypeParam> stream;
  std::uint64_t lost = 0;
  double before_deg = 0;
  int frame = 0;
  for (const Payload& payload : sent) {
    const double deg = first_deg<TypeParam>(payload);
    if (deg < before_deg) ++frame;
    before_deg = deg;
    const double gap_deg = 60 + 5 * frame;  // overlaps the one before, but never by much
    if (frame >= 2 && frame < 10 && deg >= gap_deg && deg < gap_deg + 8) {
      ++lost;
    } else {
      (void)stream.hear(payload);
    }
  }
  stream.flush();
  EXPECT_GT(lost, 20U);
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, lost);
  EXPECT_TRUE(stream.decoder.blind().is_none());
}

TYPED_TEST(BlindSensor, CountsAWideLossThatTheStreamEndsBehind) {
  auto sent = this->head.frames(2);
  const auto from = static_cast<std::ptrdiff_t>(sent.size()) * 8 / 10;
  const auto lost = static_cast<std::ptrdiff_t>(sent.size()) / 20;
  sent.erase(sent.begin() + from, sent.begin() + from + lost);
  HeardStream<TypeParam> stream(sent);
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, static_cast<std::uint64_t>(lost));
  EXPECT_GT(stream.frames.back().losses.network_gap_packets +
                stream.frames[stream.frames.size() - 2].losses.network_gap_packets,
            0U)
      << "in a frame, too";
}

TYPED_TEST(BlindSensor, FollowsAFieldOfViewThatIsSetAnew) {
  const auto all = this->head.frames(60);
  const std::size_t third = all.size() / 3;
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  const auto hear = [&](std::size_t from, const Sector& blind) {
    stream.hear_all(without<TypeParam>({all.begin() + static_cast<std::ptrdiff_t>(from),
                                        all.begin() + static_cast<std::ptrdiff_t>(from + third)},
                                       blind));
  };
  hear(0, {90, 270});
  this->expect_blind(stream, {90, 270});
  hear(third, {120, 200});  // it sees more
  this->expect_blind(stream, {120, 200});
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, 0U);
  hear(2 * third, {60, 300});  // it sees less
  this->expect_blind(stream, {60, 300});
  const std::uint64_t lost = stream.decoder.losses().network_gap_packets;
  EXPECT_LE(lost, 3 * third / 20) << "what is not seen any more is lost until that is known";
  EXPECT_EQ(incomplete(stream.frames, stream.frames.size() - 10), 0);
  stream.flush();
  EXPECT_EQ(stream.returns_unaccounted(), 0);
}

TYPED_TEST(BlindSensor, IsBlindNowhereAgainOnceItsWholeViewIsSet) {
  const auto all = this->head.frames(30);
  const auto third = static_cast<std::ptrdiff_t>(all.size() / 3);
  HeardStream<TypeParam> stream(HeardStream<TypeParam>::hasty());
  const Sector blind{90, 270};
  stream.hear_all(without<TypeParam>({all.begin(), all.begin() + third}, blind));
  this->expect_blind(stream, blind);
  stream.hear_all({all.begin() + third, all.begin() + 2 * third});
  EXPECT_TRUE(stream.decoder.blind().is_none());
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, 0U);
  stream.hear_all(without<TypeParam>({all.begin() + 2 * third, all.end()}, blind));
  this->expect_blind(stream, blind);
  EXPECT_EQ(incomplete(stream.frames, stream.frames.size() - 5), 0);
}

TYPED_TEST(BlindSensor, WithItsWholeViewIsBlindNowhere) {
  HeardStream<TypeParam> stream;
  stream.hear_all(this->head.frames(6));
  EXPECT_TRUE(stream.decoder.blind().is_none());
}

TYPED_TEST(BlindSensor, LosesItsViewsShareInAnOutage) {
  auto sent = without<TypeParam>(this->head.frames(30), {90, 270});
  std::erase_if(sent, [&, from = sent[sent.size() / 2].stamp_ns](const Payload& payload) {
    return payload.stamp_ns > from && payload.stamp_ns <= from + 1'400'000'000;
  });
  HeardStream<TypeParam> stream(sent);
  const double packets_a_frame =
      1e5 / (TypeParam::firing_us(false) * TypeParam::firings_per_packet(false));
  EXPECT_NEAR(static_cast<double>(stream.decoder.losses().network_gap_packets),
              14 * packets_a_frame / 2, std::max(packets_a_frame / 20, 14.0));
}

// --- Packets that the sector lies in ---

using Ruby = reference::Ruby128;

/// What an RS-Ruby128 sends that goes on with the packet it was at when its head is back in view:
/// it stamps the first firing, and sends when the packet is full.
std::vector<Payload> filled_across(const std::vector<Payload>& all, bool dual,
                                   const Sector& blind) {
  std::vector<Payload> sent;
  std::vector<std::uint8_t> next;
  int blocks = 0;
  std::int64_t first_ns = 0;
  for (std::size_t n = 0; n < all.size(); ++n) {
    for (int block = 0; block < Ruby::kBlocks; ++block) {
      const std::size_t reading = n * Ruby::kBlocks + static_cast<std::size_t>(block);
      const auto firing = static_cast<std::int64_t>(reading / (dual ? 2 : 1));
      const std::int64_t fired_ns = all[0].stamp_ns + firing * 55'550;
      const auto from = all[n].bytes.begin() + Ruby::kFirstBlock + block * Ruby::kBlockBytes;
      if (blind.has((from[2] * 256 + from[3]) * 0.01)) continue;
      if (blocks == 0) {
        next = all[n].bytes;
        first_ns = fired_ns;
      }
      std::copy_n(from, Ruby::kBlockBytes,
                  next.begin() + Ruby::kFirstBlock + blocks * Ruby::kBlockBytes);
      if (++blocks < Ruby::kBlocks) continue;
      blocks = 0;
      Ruby::set_clock(next, first_ns);
      sent.push_back({next, fired_ns + 55'550});
    }
  }
  return sent;
}

/// Blocks of a packet that its blind sector lies in which were fired before it; 0: of any other.
int blocks_before_the_sector(const Payload& payload) {
  int before = 0;
  for (int block = 1; block < Ruby::kBlocks; ++block) {
    const auto cdeg = [&](int of) {
      const auto at = static_cast<std::size_t>(Ruby::kFirstBlock + of * Ruby::kBlockBytes + 2);
      return payload.bytes[at] * 256 + payload.bytes[at + 1];
    };
    const int ahead_cdeg = (cdeg(block) - cdeg(block - 1) + 36'000) % 36'000;
    if (ahead_cdeg > 200) before = block;
  }
  return before;
}

class RubyAcrossItsSector : public testing::Test {
 protected:
  static constexpr int kFrames = 20;

  /// Calls visit(blind, dual, spin_hz) for all of them.
  template <class Visit>
  static void in_every_mode(std::initializer_list<Sector> sectors, Visit&& visit) {
    for (const bool dual : {false, true}) {
      for (const double spin_hz : {5.03, 9.7, 19.4}) {  // packets begin elsewhere every frame
        const auto whole = Head<Ruby>{spin_hz, dual, 0.02}.frames(kFrames);
        for (const Sector& blind : sectors) {
          SCOPED_TRACE(std::to_string(blind.from_deg) + ".." + std::to_string(blind.to_deg) +
                       (dual ? " dual " : " single ") + std::to_string(spin_hz));
          visit(blind, filled_across(whole, dual, blind));
        }
      }
    }
  }
  /// Those of the frames that the sector was learnt in.
  static void expect_few_rejected(const HeardStream<Ruby>& stream, std::uint64_t most_late = 1) {
    EXPECT_LE(stream.rejected(frame::Reject::kAzimuthJump),
              static_cast<std::uint64_t>(decode::BlindSector::kFramesToLearn));
    EXPECT_EQ(stream.decoder.losses().rejected_total(),
              stream.rejected(frame::Reject::kAzimuthJump) + stream.rejected(frame::Reject::kLate));
    EXPECT_LE(stream.rejected(frame::Reject::kLate), most_late);
  }
};

TEST_F(RubyAcrossItsSector, IsDecodedOnBothSidesOfIt) {
  in_every_mode({{90, 270}, {20, 330}, {200, 206}},
                [](const Sector& blind, const std::vector<Payload>& sent) {
                  HeardStream<Ruby> stream(sent, HeardStream<Ruby>::hasty());
                  expect_few_rejected(stream);
                  EXPECT_EQ(stream.decoder.losses().network_gap_packets, 0U);
                  EXPECT_LE(stream.decoder.losses().azimuth_hole_columns,
                            Ruby::kBlocks * stream.decoder.losses().rejected_total());
                  EXPECT_EQ(stream.decoder.losses().clock_jumps, 0U);
                  EXPECT_EQ(incomplete(stream.frames, kLearnt), 0);
                  EXPECT_NEAR(static_cast<double>(stream.frames.size()), kFrames + 1, 1);
                  EXPECT_EQ(stream.packets_unaccounted(), 0);
                  EXPECT_EQ(stream.returns_unaccounted(), 0);
                  // To the firing.
                  const BlindAzimuths known = stream.decoder.blind();
                  EXPECT_NEAR(known.from_cdeg * 0.01, blind.from_deg, 0.45);
                  EXPECT_NEAR(known.to_cdeg * 0.01, blind.to_deg, 0.45);
                });
}

TEST_F(RubyAcrossItsSector, CostsNoDeadlineWhereTheSeamIsNotSeen) {
  in_every_mode({{270, 90}, {200, 160}}, [](const Sector&, const std::vector<Payload>& sent) {
    HeardStream<Ruby> stream(HeardStream<Ruby>::hasty());
    std::size_t handed = 0;
    int in_time = 0, late = 0;
    for (const Payload& payload : sent) {
      (void)stream.hear(payload);
      if (stream.frames.size() == handed) continue;
      handed = stream.frames.size();
      if (handed < kLearnt + 4) continue;
      (stream.frames.back().last_packet_ns == payload.stamp_ns ? in_time : late) += 1;
    }
    EXPECT_GE(in_time, kFrames - 10);
    EXPECT_EQ(late, 0);
    stream.flush();
    expect_few_rejected(stream, kFrames / 2);  // where a firing is hardly more than the rounding
    EXPECT_EQ(stream.decoder.losses().network_gap_packets, 0U);
    EXPECT_EQ(stream.packets_unaccounted(), 0);
  });
}

TEST_F(RubyAcrossItsSector, CountsTheFiringsThatComeBehindItTooLateForTheirFrame) {
  HeardStream<Ruby> stream(HeardStream<Ruby>::hasty());
  std::uint64_t late_firings = 0, counted_firings = 0, late_returns = 0;
  for (const Payload& payload : filled_across(Head<Ruby>{9.7}.frames(kFrames), false, {270, 90})) {
    const std::size_t frames = stream.frames.size();
    const std::uint64_t holes = stream.decoder.losses().azimuth_hole_columns;
    const bool is_taken = !stream.hear(payload);
    const int before = blocks_before_the_sector(payload);
    const bool its_frame_waited = stream.frames.size() > frames;
    if (!is_taken || before == 0 || its_frame_waited) continue;
    late_firings += static_cast<std::uint64_t>(before);
    counted_firings += stream.decoder.losses().azimuth_hole_columns - holes;
    Payload late = payload;
    for (int block = before; block < Ruby::kBlocks; ++block) {
      for (int laser = 0; laser < Ruby::kLasers; ++laser) {
        Ruby::set_return(late.bytes, block, laser, 0, 0);
      }
    }
    late_returns += returns_in<Ruby>(late);
  }
  stream.flush();
  EXPECT_GT(late_firings, 8U);
  EXPECT_EQ(counted_firings, late_firings);
  EXPECT_EQ(stream.decoder.losses().late_returns, late_returns);
  EXPECT_EQ(stream.returns_unaccounted(), 0);
}

/// Beams lie before and behind the head, so that the first columns begin in the frame before the
/// seam, and the last ones end in the frame behind the next.
TEST_F(RubyAcrossItsSector, TouchesThreeFramesWhereTheViewIsNarrowerThanItsBeamsAreApart) {
  in_every_mode({{4, 356}}, [](const Sector&, const std::vector<Payload>& sent) {
    for (const int reorder_packets : {0, 2}) {
      HeardStream<Ruby>::Config config;
      config.reorder_packets = reorder_packets;
      HeardStream<Ruby> stream(sent, config);
      EXPECT_FALSE(stream.decoder.blind().is_none());
      expect_few_rejected(stream, kFrames);
      EXPECT_EQ(stream.packets_unaccounted(), 0);
      EXPECT_EQ(stream.returns_unaccounted(), 0);
    }
  });
}

TEST_F(RubyAcrossItsSector, LosesNothingOfItWhereAFrameWaitsForLatePackets) {
  in_every_mode({{270, 90}}, [](const Sector&, const std::vector<Payload>& sent) {
    HeardStream<Ruby> stream(sent);
    expect_few_rejected(stream);
    EXPECT_EQ(stream.decoder.losses().network_gap_packets, 0U);
    EXPECT_EQ(stream.decoder.losses().azimuth_hole_columns, 0U);
    EXPECT_EQ(incomplete(stream.frames, kLearnt), 0);
    EXPECT_EQ(stream.returns_unaccounted(), 0);
  });
}

TEST_F(RubyAcrossItsSector, CountsPacketsLostBehindIt) {
  std::vector<Payload> kept;
  std::uint64_t lost = 0;
  int since = 100;
  for (const Payload& payload : filled_across(Head<Ruby>{9.7}.frames(kFrames), false, {90, 270})) {
    since = blocks_before_the_sector(payload) > 0 ? 0 : since + 1;
    const bool is_lost = kept.size() > 2'000 && since >= 1 && since <= 3;
    lost += is_lost ? 1U : 0U;
    if (!is_lost) kept.push_back(payload);
  }
  HeardStream<Ruby> stream(kept, HeardStream<Ruby>::hasty());
  EXPECT_GT(lost, 15U);
  EXPECT_EQ(stream.decoder.losses().network_gap_packets, lost);
}

TEST_F(RubyAcrossItsSector, IsNoLossToTheSurveyOfACapture) {
  in_every_mode({{90, 270}}, [](const Sector& blind, const std::vector<Payload>& sent) {
    sensor::Ruby128Survey survey;
    for (const Payload& payload : sent) survey.add(payload.bytes, payload.stamp_ns);
    const sensor::Ruby128Facts facts = survey.facts();
    EXPECT_EQ(facts.packets_lost, 0U);
    EXPECT_EQ(facts.packets_reordered, 0U);
    EXPECT_NEAR(facts.blind.from_cdeg * 0.01, blind.from_deg, 0.45);
    EXPECT_NEAR(facts.blind.to_cdeg * 0.01, blind.to_deg, 0.45);
  });
}

TEST_F(RubyAcrossItsSector, IsRejectedWhereNoSectorIsKnownToBe) {
  HeardStream<Ruby> stream;
  auto sent = Head<Ruby>{}.frames(8);
  Payload& torn = sent[sent.size() / 2];
  const double last_deg = first_deg<Ruby>(torn) + 90;
  Ruby::set_azimuth(torn.bytes, 2,
                    static_cast<unsigned>(std::lround(std::fmod(last_deg, 360) * 100)));
  stream.hear_all(sent);
  EXPECT_EQ(stream.rejected(frame::Reject::kAzimuthJump), 1U);
  EXPECT_TRUE(stream.decoder.blind().is_none());
}

}  // namespace
}  // namespace terracut::test
