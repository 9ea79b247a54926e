// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ruby128/nominal_ruby128.hpp"

#include <cstddef>

#include "calib/beams/angle.hpp"

namespace terracut::ruby128 {
namespace {

/// Elevation of each channel in thousandths of a degree (source: docs/reference/sensors.md).
constexpr std::array<int, kRuby128Lasers> kElevation_mdeg{
    -13565, -1090, -4390, 1910,  -6650,  -290,   -3590, 2710,  -5790,  510,    -2790,  3510,  -4990,
    1310,   -1990, 5060,  -4190, 2110,   -19582, -1290, -3390, 2910,   -7150,  -490,   -2590, 3710,
    -5990,  310,   -1790, 5960,  -5190,  1110,   -990,  -4290, 2010,   -25000, -190,   -3490, 2810,
    -7650,  610,   -2690, 3610,  -6090,  1410,   -1890, 5460,  -5290,  2210,   -16042, -1190, -4490,
    3010,   -6850, -390,  -3690, 3810,   -5890,  410,   -2890, 6560,   -5090,  1210,   -2090, -8352,
    -690,   -3990, 2310,  -6190, 110,    -3190,  3110,  -5390, 910,    -2390,  3960,   -4590, 1710,
    -1590,  7410,  -3790, 2510,  -10346, -890,   -2990, 3310,  -6390,  -90,    -2190,  4410,  -5590,
    710,    -1390, 11500, -4790, 1510,   -590,   -3890, 2410,  -11742, 210,    -3090,  3210,  -6500,
    1010,   -2290, 4160,  -5690, 1810,   -1490,  9000,  -4890, 2610,   -9244,  -790,   -4090, 3410,
    -6290,  10,    -3290, 4710,  -5490,  810,    -2490, 15000, -4690,  1610,   -1690,
};

/// Returns the azimuth offset. Beams stand in four columns, 1.7 degrees apart, in each half of the
/// channels.
constexpr int azimuth_offset_mdeg(std::size_t channel) {
  const int column = static_cast<int>(channel % 4) + (channel < kRuby128Lasers / 2 ? 0 : 4);
  return 5950 - 1700 * column;
}

constexpr double from_mdeg(int mdeg) {
  return beams::deg_to_rad(mdeg / 1000.0);
}

}  // namespace

Ruby128Calibration nominal_ruby128() {
  Ruby128Calibration calibration;
  for (std::size_t i = 0; i < calibration.channels.size(); ++i) {
    calibration.channels[i] = {from_mdeg(kElevation_mdeg[i]), from_mdeg(azimuth_offset_mdeg(i))};
  }
  calibration.origin = "nominal RS-Ruby128 (no real unit)";
  calibration.nominal = true;
  return calibration;
}

}  // namespace terracut::ruby128
