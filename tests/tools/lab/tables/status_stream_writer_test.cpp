// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/tables/status_stream_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/firmware_io/hdl64e/table_image.hpp"

namespace terracut::tables {
namespace {

constexpr std::int64_t kLeapDay_ns = 1'582'979'696'500'000'000;  // 2020-02-29 12:34:56.5 UTC

TEST(StatusStreamWriter, SendsSixteenTypesInTurn) {
  StatusStreamWriter writer(test::s2_table(), hdl64e::StatusFlavour::kS2);
  std::string types;
  for (int i = 0; i < 32; ++i) types += static_cast<char>(writer.next(kLeapDay_ns).type);
  EXPECT_EQ(types, "HMSDNYGTV1234567HMSDNYGTV1234567");
}

TEST(StatusStreamWriter, TellsDateTimeAndState) {
  StatusStreamWriter writer(test::s2_table(), hdl64e::StatusFlavour::kS2,
                            {.gps = 'P', .temperature_deg_c = -7, .firmware = 0x45});
  std::array<int, 9> values{};
  // The clock moves on inside the cycle; its six bytes must not.
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = writer.next(kLeapDay_ns + static_cast<std::int64_t>(i) * 100'000'000).value;
  }
  EXPECT_THAT(values, testing::ElementsAre(12, 34, 56, 29, 2, 20, 'P', 256 - 7, 0x45));
}

TEST(StatusStreamWriter, SendsTheTableRoundAfterRound) {
  const test::TableImage table = test::s3_table();
  StatusStreamWriter writer(table, hdl64e::StatusFlavour::kS3);
  for (int round = 0; round < 2; ++round) {
    std::vector<std::uint8_t> sent;
    int warnings = 0;
    for (int packet = 0; packet < hdl64e::kStatusRoundPackets; ++packet) {
      const hdl64e::StatusPair pair = writer.next(kLeapDay_ns);
      if (packet % 16 >= 9) sent.push_back(pair.value);
      warnings += pair.type == hdl64e::kWarningType ? 1 : 0;
    }
    EXPECT_THAT(sent, testing::ElementsAreArray(table));
    EXPECT_EQ(warnings, 63);
  }
}

TEST(StatusStreamWriter, OnlyTheS3SendsTypesThatAreNoDigit) {
  StatusStreamWriter writer(test::s2_table(), hdl64e::StatusFlavour::kS2);
  for (int packet = 0; packet < hdl64e::kStatusRoundPackets; ++packet) {
    const hdl64e::StatusPair pair = writer.next(kLeapDay_ns);
    EXPECT_EQ(hdl64e::status_place(pair.type), packet % 16);
  }
}

}  // namespace
}  // namespace terracut::tables
