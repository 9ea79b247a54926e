// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/status_stream_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "table_image.hpp"

namespace terracut::firmware_io {
namespace {

constexpr std::int64_t kStamp_ns = 1'582'979'696'500'000'000;  // 2020-02-29 12:34:56.5 UTC

TEST(StatusStreamWriter, SendsSixteenTypesInTurn) {
  StatusStreamWriter writer(test::s2_table(), StatusFlavour::kS2);
  std::string types;
  for (int i = 0; i < 32; ++i) types += static_cast<char>(writer.next(kStamp_ns).type);
  EXPECT_EQ(types, "HMSDNYGTV1234567HMSDNYGTV1234567");
}

TEST(StatusStreamWriter, TellsDateTimeAndState) {
  StatusStreamWriter writer(test::s2_table(), StatusFlavour::kS2,
                            {.gps = GpsState::kPpsOnly, .temperature_deg_c = -7, .firmware = 0x45});
  std::array<int, 9> values{};
  // The clock moves on inside the cycle; its six bytes must not.
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = writer.next(kStamp_ns + static_cast<std::int64_t>(i) * 100'000'000).value;
  }
  EXPECT_THAT(values, testing::ElementsAre(12, 34, 56, 29, 2, 20, 'P', 256 - 7, 0x45));
}

TEST(StatusStreamWriter, SendsTheTableRoundAfterRound) {
  const test::TableImage table = test::s3_table();
  StatusStreamWriter writer(table, StatusFlavour::kS3);
  for (int round = 0; round < 2; ++round) {
    std::vector<std::uint8_t> sent;
    int warnings = 0;
    for (int packet = 0; packet < kStatusRoundPackets; ++packet) {
      const StatusPair pair = writer.next(kStamp_ns);
      if (packet % 16 >= 9) sent.push_back(pair.value);
      warnings += pair.type == kWarningType ? 1 : 0;
    }
    EXPECT_THAT(sent, testing::ElementsAreArray(table));
    EXPECT_EQ(warnings, 63);
  }
}

TEST(StatusStreamWriter, OnlyTheS3SendsTypesThatAreNoDigit) {
  StatusStreamWriter writer(test::s2_table(), StatusFlavour::kS2);
  for (int packet = 0; packet < kStatusRoundPackets; ++packet) {
    const StatusPair pair = writer.next(kStamp_ns);
    EXPECT_EQ(status_place(pair.type), packet % 16);
  }
}

}  // namespace
}  // namespace terracut::firmware_io
