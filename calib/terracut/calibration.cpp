// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/calibration.hpp"

#include <utility>

#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "calib/ruby128/ruby128_csv.hpp"
#include "calib/terracut/calibration_table.hpp"

namespace terracut {

Calibration::Calibration(std::shared_ptr<const Table> table) noexcept : table_(std::move(table)) {}

Expected<Calibration> Calibration::load(const std::filesystem::path& file) {
  if (file.extension() == ".csv") {
    return ruby128::read_ruby128_csv(file).map(
        [](const auto& unit) { return calibration_of(unit); });
  }
  return hdl64e::load_hdl64e_calibration(file).map(
      [](const auto& unit) { return calibration_of(unit); });
}

Calibration Calibration::nominal(Sensor sensor) {
  switch (sensor) {
    case Sensor::kHdl64e:
      break;
    case Sensor::kRuby128:
      return calibration_of(ruby128::nominal_ruby128());
    case Sensor::kVlp16:
      return calibration_of(velodyne::factory_table(velodyne::VelodyneModel::kVlp16));
    case Sensor::kHdl32e:
      return calibration_of(velodyne::factory_table(velodyne::VelodyneModel::kHdl32e));
    case Sensor::kVlp32c:
      return calibration_of(velodyne::factory_table(velodyne::VelodyneModel::kVlp32c));
    case Sensor::kVls128:
      return calibration_of(velodyne::factory_table(velodyne::VelodyneModel::kVls128));
  }
  return calibration_of(hdl64e::nominal_hdl64e());
}

Sensor Calibration::sensor() const noexcept {
  if (const auto* velodyne = std::get_if<velodyne::VelodyneCalibration>(&table_->unit)) {
    switch (velodyne->model) {
      case velodyne::VelodyneModel::kVlp16:
        return Sensor::kVlp16;
      case velodyne::VelodyneModel::kHdl32e:
        return Sensor::kHdl32e;
      case velodyne::VelodyneModel::kVlp32c:
        return Sensor::kVlp32c;
      case velodyne::VelodyneModel::kVls128:
        return Sensor::kVls128;
    }
  }
  return std::holds_alternative<ruby128::Ruby128Calibration>(table_->unit) ? Sensor::kRuby128
                                                                           : Sensor::kHdl64e;
}

std::uint64_t Calibration::fingerprint() const {
  return calib::fingerprint(table_->unit);
}

const std::string& Calibration::origin() const {
  return calib::origin_of(table_->unit);
}

}  // namespace terracut
