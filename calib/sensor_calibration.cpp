// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/sensor_calibration.hpp"

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"

namespace terracut::calib {

SensorCalibration nominal(sensor::SensorModel model) {
  if (sensor::has_built_in_table(model)) return beams::built_in_table(model);
  if (model == sensor::SensorModel::kRuby128) return ruby128::nominal_ruby128();
  return hdl64e::nominal_hdl64e();
}

sensor::SensorModel model_of(const SensorCalibration& calibration) noexcept {
  if (const auto* unit = std::get_if<beams::BeamTable>(&calibration)) return unit->model;
  return std::holds_alternative<ruby128::Ruby128Calibration>(calibration)
             ? sensor::SensorModel::kRuby128
             : sensor::SensorModel::kHdl64e;
}

}  // namespace terracut::calib
