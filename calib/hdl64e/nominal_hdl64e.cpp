// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/nominal_hdl64e.hpp"

#include "calib/beams/angle.hpp"

namespace terracut::hdl64e {
namespace {

constexpr int kBlockLasers = 32;

/// Returns the rank of laser j of a block by elevation, 0 for the highest. Pairs of neighbours stay
/// together; the order of pairs is mixed (5 and 16 have no common factor, so every rank occurs
/// once).
constexpr int rank_in_block(int j) {
  return 2 * ((5 * (j / 2) + 3) % 16) + j % 2;
}

/// Spaces the elevations of a block evenly from `first` to `last`, plus up to 0.03 deg of made-up
/// assembly error.
constexpr int elevation_cdeg(int j, int first, int last) {
  return first + (last - first) * rank_in_block(j) / (kBlockLasers - 1) + (11 * j) % 7 - 3;
}

/// Places lasers in eight columns 2.5 deg apart, plus made-up assembly error.
constexpr int rotation_cdeg(int j) {
  return 250 * ((3 * j) % 8) - 875 + (7 * j) % 11 - 5;
}

constexpr double from_cdeg(int cdeg) {
  return beams::deg_to_rad(cdeg / 100.0);
}
constexpr double from_mm(int mm) {
  return mm / 1000.0;
}

}  // namespace

Hdl64eCalibration nominal_hdl64e() {
  Hdl64eCalibration calibration;
  calibration.origin = "nominal HDL-64E (no real unit)";
  for (int i = 0; i < kHdl64eLasers; ++i) {
    const bool upper = i < kBlockLasers;
    const int j = i % kBlockLasers;
    const int far_mm = 1100 + (137 * i) % 401;
    Hdl64eLaser& laser = calibration.lasers[static_cast<std::size_t>(i)];
    laser.vert_correction_rad =
        from_cdeg(upper ? elevation_cdeg(j, 200, -830) : elevation_cdeg(j, -880, -2490));
    laser.rot_correction_rad = from_cdeg(rotation_cdeg(j));
    laser.dist_correction_m = from_mm(far_mm);
    laser.dist_correction_x_m = from_mm(far_mm + 5 + (29 * i) % 31);
    laser.dist_correction_y_m = from_mm(far_mm - 10 + (17 * i) % 37);
    laser.two_point = true;
    laser.vert_offset_m = from_mm((upper ? 200 : 144) + rank_in_block(j) / 2);
    laser.horiz_offset_m = from_mm(i % 2 == 0 ? 26 : -26);
    laser.focal_distance_m = from_mm(upper ? 12000 + 500 * (j % 13) : 6000 + 500 * (j % 9));
    laser.focal_slope = (10 + i % 9) / 10.0;
    laser.min_intensity = 5 * (i % 3);
    laser.max_intensity = 255;
  }
  return calibration;
}

}  // namespace terracut::hdl64e
