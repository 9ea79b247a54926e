// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/device_reader.hpp"

#include <cstring>

#include "firmware_io/ruby128/difop_angles.hpp"

namespace terracut::sensor {
namespace {

bool same_angles(const ruby128::ruby128_wire::Difop& a,
                 const ruby128::ruby128_wire::Difop& b) noexcept {
  return std::memcmp(&a.elevations, &b.elevations, sizeof(a.elevations)) == 0 &&
         std::memcmp(&a.azimuth_offsets, &b.azimuth_offsets, sizeof(a.azimuth_offsets)) == 0;
}

Expected<calib::SensorCalibration> calibration_in(const ruby128::ruby128_wire::Difop& difop,
                                                  SensorModel model) {
  if (model == SensorModel::kRuby128) return ruby128::calibration_of(difop);
  return ruby128::table_of(difop, model);
}

}  // namespace

bool DeviceReader::add(std::span<const std::uint8_t> payload) {
  const std::optional<ruby128::ruby128_wire::Difop> difop = ruby128::read_difop(payload);
  if (!difop) return false;
  ++counters_.packets;
  const bool new_angles = !newest_ || !same_angles(*newest_, *difop);
  if (newest_) {
    if (new_angles) ++counters_.angle_changes;
    if (newest_->serial != difop->serial) ++counters_.serial_changes;
  }
  newest_ = difop;
  if (!new_angles) return true;
  for (const SensorModel model : kDecodedModels) {
    if (!is_robosense(model) || has_calibration(model)) continue;
    calibrations_.insert_or_assign(model, calibration_in(*difop, model));
  }
  return true;
}

const Expected<calib::SensorCalibration>& DeviceReader::calibration(SensorModel model) const {
  static const Expected<calib::SensorCalibration> kNone =
      fail(ErrorCode::kNoCalibration,
           "no DIFOP packet has come; they come about once a second, by factory setting to UDP "
           "port 7788");
  const auto found = calibrations_.find(model);
  return found == calibrations_.end() ? kNone : found->second;
}

}  // namespace terracut::sensor
