// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/status_stream_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware_io/packet/hdl64e_wire.hpp"
#include "table_image.hpp"
#include "tools/lab/tables/status_stream_writer.hpp"

namespace terracut::hdl64e {
namespace {

using test::TableImage;

constexpr std::int64_t kStamp_ns = 1'582'979'696'500'000'000;  // 2020-02-29 12:34:56.5 UTC
constexpr std::size_t kRound = kStatusRoundPackets;

struct StreamPacket {
  StatusPair pair;
  std::uint32_t stamp_us = 0;
};

/// `count` packets of a unit, from packet `first` of its stream on, stamps in whole microseconds.
std::vector<StreamPacket> stream(const TableImage& table, StatusFlavour flavour, std::size_t count,
                                 std::size_t first = 0, double period_us = 288.0,
                                 std::int64_t start_us = 1'000'000'000) {
  tables::StatusStreamWriter writer(table, flavour, {.temperature_deg_c = 41, .firmware = 0x47});
  std::vector<StreamPacket> packets;
  for (std::size_t i = 0; i < first + count; ++i) {
    const auto offset_us = static_cast<std::int64_t>(static_cast<double>(i) * period_us);
    const StatusPair pair = writer.next(kStamp_ns + offset_us * 1000);
    if (i < first) continue;
    packets.push_back(
        {pair, static_cast<std::uint32_t>((start_us + offset_us) % std::int64_t{kDeviceHour_us})});
  }
  return packets;
}

void feed(StatusStreamReader& reader, const std::vector<StreamPacket>& packets) {
  for (const StreamPacket& packet : packets) {
    reader.add(packet.pair.type, packet.pair.value, packet.stamp_us);
  }
}

std::vector<StreamPacket> without(std::vector<StreamPacket> packets, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution lost(share);
  std::erase_if(packets, [&](const StreamPacket&) { return lost(random); });
  return packets;
}

struct Mode {
  const char* name;
  StatusFlavour flavour;
  double period_us;
};

class EveryMode : public testing::TestWithParam<Mode> {
 protected:
  [[nodiscard]] static TableImage table(unsigned seed = 1) {
    return GetParam().flavour == StatusFlavour::kS3 ? test::s3_table(seed) : test::s2_table(seed);
  }
  [[nodiscard]] static std::vector<StreamPacket> packets(std::size_t count, std::size_t first = 0,
                                                         unsigned seed = 1) {
    return stream(table(seed), GetParam().flavour, count, first, GetParam().period_us);
  }
  /// Rounds without loss until the table is believed.
  [[nodiscard]] static std::size_t rounds() {
    return GetParam().flavour == StatusFlavour::kS3 ? 1 : 2;
  }
};

TEST_P(EveryMode, AcceptsTheTableWithItsLastByteAndNotBefore) {
  StatusStreamReader reader;
  auto all = packets(rounds() * kRound);
  const StreamPacket last = all.back();
  all.pop_back();
  feed(reader, all);
  EXPECT_FALSE(reader.has_table());
  reader.add(last.pair.type, last.pair.value, last.stamp_us);
  ASSERT_TRUE(reader.has_table());
  EXPECT_EQ(reader.holes(), 0U);
  EXPECT_THAT(reader.table(), testing::ElementsAreArray(table()));
}

TEST_P(EveryMode, MayBeginAnywhereInTheRound) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    StatusStreamReader reader;
    // One cycle more than the rounds, since "UNIT#" itself may be cut at the start.
    feed(reader, packets((rounds() + 1) * kRound, random() % kRound));
    ASSERT_TRUE(reader.has_table());
    EXPECT_THAT(reader.table(), testing::ElementsAreArray(table()));
  }
}

TEST_P(EveryMode, FillsTheHolesOfLostPacketsInLaterRounds) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    StatusStreamReader reader;
    feed(reader, without(packets(kRound), 0.05, seed));
    EXPECT_FALSE(reader.has_table());
    EXPECT_GT(reader.holes(), 0U);
    feed(reader, without(packets(7 * kRound, kRound), 0.05, 100 + seed));
    ASSERT_TRUE(reader.has_table()) << reader.holes();
    EXPECT_THAT(reader.table(), testing::ElementsAreArray(table()));
  }
}

TEST_P(EveryMode, CountsThroughGapsOfHundredsOfPackets) {
  StatusStreamReader reader;
  auto all = packets(12 * kRound);
  std::vector<StreamPacket> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 1500 < 900) kept.push_back(all[i]);  // 600 lost at a time
  }
  feed(reader, kept);
  ASSERT_TRUE(reader.has_table());
  EXPECT_THAT(reader.table(), testing::ElementsAreArray(table()));
}

TEST_P(EveryMode, PutsReorderedAndRepeatedPacketsRight) {
  auto all = packets(4 * kRound);
  std::mt19937 random(5);
  std::vector<StreamPacket> shuffled;
  for (std::size_t i = 0; i + 8 <= all.size(); i += 8) {
    auto from = all.begin() + static_cast<std::ptrdiff_t>(i);
    if (i > 16 && random() % 10 == 0) std::shuffle(from, from + 8, random);
    for (std::size_t k = 0; k < 8; ++k) {
      shuffled.push_back(all[i + k]);
      if (random() % 20 == 0) shuffled.push_back(all[i + k]);
    }
  }
  StatusStreamReader reader;
  feed(reader, shuffled);
  ASSERT_TRUE(reader.has_table());
  EXPECT_THAT(reader.table(), testing::ElementsAreArray(table()));
}

TEST_P(EveryMode, PassesTheTopOfTheHour) {
  StatusStreamReader reader;
  feed(reader, stream(table(), GetParam().flavour, rounds() * kRound, 0, GetParam().period_us,
                      std::int64_t{kDeviceHour_us} - 200'000));
  EXPECT_TRUE(reader.has_table());
}

TEST_P(EveryMode, BeginsAnewWhenTheClockJumps) {
  StatusStreamReader reader;
  feed(reader, packets(kRound / 2));
  auto later = packets(3 * kRound, 100);
  for (auto& packet : later) packet.stamp_us += 50'000'000;
  feed(reader, later);
  ASSERT_TRUE(reader.has_table());
  EXPECT_THAT(reader.table(), testing::ElementsAreArray(table()));
}

TEST_P(EveryMode, NoticesAnotherUnit) {
  StatusStreamReader reader;
  feed(reader, packets(3 * kRound));
  ASSERT_TRUE(reader.has_table());
  feed(reader, packets(4 * kRound, 3 * kRound, 2));
  EXPECT_THAT(reader.table(), testing::ElementsAreArray(table(2)));
}

TEST_P(EveryMode, RefusesATableWithLasersOutOfPlace) {
  TableImage wrong = table();
  std::swap(wrong[test::laser_at(3)], wrong[test::laser_at(4)]);
  StatusStreamReader reader;
  feed(reader, stream(wrong, GetParam().flavour, 3 * kRound, 0, GetParam().period_us));
  EXPECT_FALSE(reader.has_table());
}

INSTANTIATE_TEST_SUITE_P(Hdl64e, EveryMode,
                         testing::Values(Mode{"S3Single48", StatusFlavour::kS3, 288.0},
                                         Mode{"S3Single57", StatusFlavour::kS3, 345.6},
                                         Mode{"S3Dual", StatusFlavour::kS3, 172.8},
                                         Mode{"S2Single", StatusFlavour::kS2, 288.0},
                                         Mode{"S2SlowClock", StatusFlavour::kS2, 289.37}),
                         [](const auto& mode) { return std::string(mode.param.name); });

TEST(StatusStreamReader, RefusesATableWithABrokenCrc) {
  TableImage broken = test::s3_table();
  broken[500] ^= 0x10;
  StatusStreamReader reader;
  feed(reader, stream(broken, StatusFlavour::kS3, 3 * kRound));
  EXPECT_FALSE(reader.has_table());
  EXPECT_EQ(reader.holes(), 0U);
}

TEST(StatusStreamReader, RecoversFromOneWrongByteInTheNextRound) {
  auto packets = stream(test::s3_table(), StatusFlavour::kS3, 2 * kRound);
  packets[16 * 101 + 12].pair.value ^= 0x40;
  StatusStreamReader reader;
  feed(reader, {packets.begin(), packets.begin() + kRound});
  EXPECT_FALSE(reader.has_table());
  feed(reader, {packets.begin() + kRound, packets.end()});
  ASSERT_TRUE(reader.has_table());
  EXPECT_THAT(reader.table(), testing::ElementsAreArray(test::s3_table()));
}

TEST(StatusStreamReader, TheS2NeedsTwoRoundsThatAgree) {
  const auto first = stream(test::s2_table(1), StatusFlavour::kS2, kRound);
  const auto second = stream(test::s2_table(2), StatusFlavour::kS2, 2 * kRound, kRound);
  StatusStreamReader reader;
  feed(reader, first);
  feed(reader, {second.begin(), second.begin() + kRound});
  EXPECT_FALSE(reader.has_table());
  feed(reader, {second.begin() + kRound, second.end()});
  ASSERT_TRUE(reader.has_table());
  EXPECT_THAT(reader.table(), testing::ElementsAreArray(test::s2_table(2)));
}

TEST(StatusStreamReader, AWarningOrHoursRunMayChangeWithoutANewTable) {
  TableImage later = test::s2_table();
  later[1806 - 1] ^= 1;  // hours run
  later[1816] ^= 1;      // warning bits
  StatusStreamReader reader;
  feed(reader, stream(test::s2_table(), StatusFlavour::kS2, 2 * kRound));
  feed(reader, stream(later, StatusFlavour::kS2, kRound + 16, 2 * kRound));
  EXPECT_EQ(reader.table()[1816], later[1816]);
  EXPECT_EQ(reader.latest().warning_bits, later[1816]);
}

TEST(StatusStreamReader, TellsTheStateOfTheUnit) {
  StatusStreamReader reader;
  feed(reader, stream(test::s3_table(), StatusFlavour::kS3, 200));
  const StatusSnapshot& state = reader.latest();
  EXPECT_EQ(state.temperature_deg_c, 41);
  EXPECT_EQ(state.firmware, 0x47);
  EXPECT_EQ(state.warning_bits, 0x20);
}

TEST(StatusStreamReader, FollowsAChangeOfReturnMode) {
  StatusStreamReader reader;
  feed(reader, stream(test::s3_table(), StatusFlavour::kS3, 1000));
  feed(reader, stream(test::s3_table(), StatusFlavour::kS3, 3 * kRound, 1000, 172.8,
                      1'000'000'000 + 115'200));
  EXPECT_TRUE(reader.has_table());
}

TEST(StatusStreamReader, RandomBytesGiveNoTable) {
  std::mt19937 random(11);
  StatusStreamReader reader;
  for (int i = 0; i < 200'000; ++i) {
    reader.add(
        static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
        static_cast<std::uint32_t>(random() % 2 == 0 ? random() : 288U * static_cast<unsigned>(i)));
  }
  EXPECT_FALSE(reader.has_table());
}

TEST(StatusStreamReader, OwnsNoHeapMemory) {
  // Trivially copyable: nothing inside could allocate, so add() cannot either.
  static_assert(std::is_trivially_copyable_v<StatusStreamReader>);
  static_assert(std::is_trivially_copyable_v<tables::StatusStreamWriter>);
  static_assert(noexcept(std::declval<StatusStreamReader&>().add(0, 0, 0)));
}

}  // namespace
}  // namespace terracut::hdl64e
