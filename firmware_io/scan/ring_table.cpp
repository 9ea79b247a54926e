// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/ring_table.hpp"

#include <algorithm>
#include <ranges>

namespace terracut::scan {
namespace {

/// The laser numbers of a block from its highest ring down, as in the calibration files of most
/// units.
constexpr std::array<std::int8_t, 32> kBlockFromTheTop{29, 28, 25, 24, 3,  2,  31, 30, 27, 26, 21,
                                                       20, 17, 16, 13, 12, 23, 22, 19, 18, 15, 14,
                                                       9,  8,  5,  4,  1,  0,  11, 10, 7,  6};

}  // namespace

int usual_laser_of_ring(int ring) noexcept {
  const int block = ring / 32 * 32;
  return block + kBlockFromTheTop[static_cast<std::size_t>(ring - block)];
}

std::array<int, kScanRings> lasers_by_ring(const hdl64e::Hdl64eCalibration& calibration) {
  const auto rows = rows_by_elevation(calibration);
  std::array<int, kScanRings> lasers{};
  for (int laser = 0; laser < kScanRings; ++laser) {
    const int ring = kScanRings - 1 - rows[static_cast<std::size_t>(laser)];
    lasers[static_cast<std::size_t>(ring)] = laser;
  }
  return lasers;
}

RingTable ring_table(const hdl64e::Hdl64eCalibration& calibration) {
  const auto lasers = lasers_by_ring(calibration);
  RingTable table(lasers.size());
  for (std::size_t ring = 0; ring < table.size(); ++ring) {
    const auto& laser = calibration.lasers[static_cast<std::size_t>(lasers[ring])];
    table[ring] = {laser.vert_correction_rad, laser.vert_offset_m};
  }
  return table;
}

mount::RingProfile ring_profile(const RingTable& table, const mount::Mount& mount) {
  mount::RingProfile profile{{}, mount};
  for (const RingLine& ring : table | std::views::reverse) {
    profile.rings.push_back(mount::ring(ring.elevation_rad, ring.vert_offset_m, mount));
  }
  if (mount::is_upside_down(mount)) std::ranges::reverse(profile.rings);
  return profile;
}

hdl64e::Hdl64eCalibration hdl64e_calibration(const RingTable& table) {
  hdl64e::Hdl64eCalibration calibration;
  for (int ring = 0; ring < kScanRings; ++ring) {
    auto& laser = calibration.lasers[static_cast<std::size_t>(usual_laser_of_ring(ring))];
    laser.vert_correction_rad = table[static_cast<std::size_t>(ring)].elevation_rad;
    laser.vert_offset_m = table[static_cast<std::size_t>(ring)].vert_offset_m;
  }
  return calibration;
}

}  // namespace terracut::scan
