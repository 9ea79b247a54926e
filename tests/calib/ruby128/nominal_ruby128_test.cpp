// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/nominal_ruby128.hpp"

#include <array>
#include <cmath>
#include <set>

#include "calib/beams/angle.hpp"
#include "tests/calib/calib_test_support.hpp"

namespace terracut::ruby128 {
namespace {

double elevation_deg(int channel_from_1) {
  const Ruby128Calibration table = nominal_ruby128();
  return beams::rad_to_deg(
      table.channels[static_cast<std::size_t>(channel_from_1 - 1)].elevation_rad);
}
double offset_deg(int channel_from_1) {
  const Ruby128Calibration table = nominal_ruby128();
  return beams::rad_to_deg(
      table.channels[static_cast<std::size_t>(channel_from_1 - 1)].azimuth_offset_rad);
}

TEST(NominalRuby128, IsPlausibleAndSaysThatItIsNominal) {
  const Status status = validate(nominal_ruby128());
  EXPECT_TRUE(status.has_value()) << status.error().message;
  EXPECT_TRUE(nominal_ruby128().nominal);
}

TEST(NominalRuby128, ChannelsStandAboveEachOtherInTheMakersOrder) {
  // The maker numbers channels from 1; from the lowest beam to the highest. Known apart from the
  // angles, so that a slip in either shows.
  constexpr int kUpwards[] = {
      36,  19,  50, 1,   100, 83,  114, 65, 40,  23,  54, 5,   104, 87, 118, 69, 44,  27,  58,
      9,   108, 91, 122, 73,  48,  31,  62, 13,  112, 95, 126, 77,  52, 3,   34, 17,  116, 67,
      98,  81,  56, 7,   38,  21,  120, 71, 102, 85,  60, 11,  42,  25, 124, 75, 106, 89,  64,
      15,  46,  29, 128, 79,  110, 93,  20, 51,  2,   33, 84,  115, 66, 97,  24, 55,  6,   37,
      88,  119, 70, 101, 28,  59,  10,  41, 92,  123, 74, 105, 32,  63, 14,  45, 96,  127, 78,
      109, 4,   35, 18,  49,  68,  99,  82, 113, 8,   39, 22,  53,  72, 103, 86, 117, 12,  43,
      26,  57,  76, 107, 90,  121, 16,  47, 30,  61,  80, 111, 94,  125};
  static_assert(std::size(kUpwards) == kRuby128Lasers);
  const auto rows = rows_by_elevation(nominal_ruby128());
  for (int row = 0; row < kRuby128Lasers; ++row) {
    EXPECT_EQ(rows[static_cast<std::size_t>(kUpwards[row] - 1)], row)
        << "channel " << kUpwards[row];
  }
}

TEST(NominalRuby128, HasTheModelsSpansAndPitch) {
  EXPECT_NEAR(elevation_deg(36), -25.0, 1e-12);
  EXPECT_NEAR(elevation_deg(19), -19.582, 1e-12);
  EXPECT_NEAR(elevation_deg(125), 15.0, 1e-12);
  // A tenth of a degree from -6.39 to 3.81, 103 beams.
  int fine = 0;
  for (int channel = 1; channel <= kRuby128Lasers; ++channel) {
    const double tenths = (elevation_deg(channel) + 6.39) / 0.1;
    if (elevation_deg(channel) < -6.395 || elevation_deg(channel) > 3.815) continue;
    EXPECT_NEAR(tenths, std::round(tenths), 1e-9) << channel;
    ++fine;
  }
  EXPECT_EQ(fine, 103);
}

TEST(NominalRuby128, RowsWidenBelowAndAboveTheFinePitch) {
  const Ruby128Calibration table = nominal_ruby128();
  const auto rows = rows_by_elevation(table);
  std::array<double, kRuby128Lasers> row_deg{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    row_deg[static_cast<std::size_t>(rows[i])] = beams::rad_to_deg(table.channels[i].elevation_rad);
  }
  // From row 12 (-6.5 degrees) downwards, to hundredths.
  const double below_deg[] = {0.15, 0.2, 0.3, 0.5, 0.70, 0.89, 1.10, 1.40, 1.82, 2.48, 3.54, 5.42};
  for (std::size_t i = 0; i < std::size(below_deg); ++i) {
    EXPECT_NEAR(row_deg[12 - i] - row_deg[11 - i], below_deg[i], 0.006) << "row " << 11 - i;
  }
  double gap_deg = 0.1;
  for (std::size_t row = 116; row < row_deg.size(); ++row) {
    EXPECT_GT(row_deg[row] - row_deg[row - 1], gap_deg) << "row " << row;
    gap_deg = row_deg[row] - row_deg[row - 1];
  }
  EXPECT_NEAR(gap_deg, 3.5, 1e-9);
}

TEST(NominalRuby128, BeamsStandInEightColumns) {
  EXPECT_NEAR(offset_deg(1), 5.95, 1e-12);
  EXPECT_NEAR(offset_deg(64), 0.85, 1e-12);
  EXPECT_NEAR(offset_deg(65), -0.85, 1e-12);
  EXPECT_NEAR(offset_deg(128), -5.95, 1e-12);
  std::multiset<long> hundredths;
  for (int channel = 1; channel <= kRuby128Lasers; ++channel) {
    hundredths.insert(std::lround(100 * offset_deg(channel)));
  }
  for (const long column : {595, 425, 255, 85, -85, -255, -425, -595}) {
    EXPECT_EQ(hundredths.count(column), 16U) << column;
  }
}

}  // namespace
}  // namespace terracut::ruby128
