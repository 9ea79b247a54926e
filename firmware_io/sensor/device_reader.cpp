// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/device_reader.hpp"

#include <cstring>

namespace terracut::sensor {
namespace {

bool same_angles(const ruby128::ruby128_wire::Difop& a,
                 const ruby128::ruby128_wire::Difop& b) noexcept {
  return std::memcmp(&a.elevations, &b.elevations, sizeof(a.elevations)) == 0 &&
         std::memcmp(&a.azimuth_offsets, &b.azimuth_offsets, sizeof(a.azimuth_offsets)) == 0;
}

}  // namespace

bool Ruby128DeviceReader::add(std::span<const std::uint8_t> payload) {
  const std::optional<ruby128::ruby128_wire::Difop> difop = ruby128::read_difop(payload);
  if (!difop) return false;
  ++counters_.packets;
  const bool new_angles = !newest_ || !same_angles(*newest_, *difop);
  if (newest_) {
    if (new_angles) ++counters_.angle_changes;
    if (newest_->serial != difop->serial) ++counters_.serial_changes;
  }
  newest_ = difop;
  if (new_angles && !has_calibration()) calibration_ = ruby128::calibration_of(*difop);
  return true;
}

}  // namespace terracut::sensor
