// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/sensor_calibration.hpp"

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"

namespace terracut::calib {

SensorCalibration nominal(sensor::SensorModel model) {
  if (sensor::has_built_in_table(model)) return beams::built_in_table(model);
  if (model == sensor::SensorModel::kRuby128) return ruby128::nominal_ruby128();
  if (sensor::is_ouster(model)) return ouster::nominal_ouster(model);
  return hdl64e::nominal_hdl64e();
}

sensor::SensorModel model_of(const SensorCalibration& calibration) noexcept {
  if (const auto* unit = std::get_if<beams::BeamTable>(&calibration)) return unit->model;
  if (const auto* unit = std::get_if<ouster::OusterCalibration>(&calibration)) {
    return ouster::model_of_rows(unit->format.rows);
  }
  return std::holds_alternative<ruby128::Ruby128Calibration>(calibration)
             ? sensor::SensorModel::kRuby128
             : sensor::SensorModel::kHdl64e;
}

std::optional<Rotation> rotation_of(const SensorCalibration& calibration) noexcept {
  const auto* unit = std::get_if<ouster::OusterCalibration>(&calibration);
  if (unit == nullptr) return std::nullopt;
  // Packets are sent whole.
  const int in_packet = unit->format.columns, in_frame = unit->columns_per_frame;
  const int first = unit->window[0] / in_packet * in_packet;
  const int behind = (unit->window[1] / in_packet + 1) * in_packet;
  return Rotation{in_frame, unit->rate_hz, behind, first < behind ? first + in_frame : first};
}

}  // namespace terracut::calib
