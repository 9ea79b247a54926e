// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/calibration.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "calib/api/calibration_table.hpp"
#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/hesai/hesai_csv.hpp"
#include "calib/ouster/ouster_metadata.hpp"
#include "calib/robosense/unit_table.hpp"
#include "calib/ruby128/ruby128_csv.hpp"
#include "calib/text/bounded_file.hpp"

namespace terracut {

Calibration::Calibration(std::shared_ptr<const Table> table) noexcept : table_(std::move(table)) {}

Expected<Calibration> Calibration::load(const std::filesystem::path& file) {
  if (ouster::is_metadata_name(file)) {
    return ouster::read_ouster_metadata(file).map(
        [](const auto& unit) { return calibration_of(unit); });
  }
  if (file.extension() == ".csv") {
    const auto text = text::read_bounded_file(file, "an angle table");
    if (text && hesai::is_like_hesai_csv(*text)) {
      return hesai::parse_hesai_csv(*text, file.string()).map([](const auto& table) {
        return calibration_of(table);
      });
    }
    if (text) {
      const auto table = robosense::parse_unit_csv(*text, file.string());
      if (table) return calibration_of(*table);
      constexpr std::ptrdiff_t kMostLines = 64;  // for which a spoilt table is one of 32 lasers
      if (std::ranges::count(*text, '\n') <= kMostLines) return tl::unexpected(table.error());
    }
    return ruby128::read_ruby128_csv(file).map(
        [](const auto& unit) { return calibration_of(unit); });
  }
  return hdl64e::load_hdl64e_calibration(file).map(
      [](const auto& unit) { return calibration_of(unit); });
}

Calibration Calibration::nominal(Sensor sensor) {
  return calibration_of(calib::nominal(sensor::model_of(sensor)));
}

Sensor Calibration::sensor() const noexcept {
  return sensor::sensor_of(calib::model_of(table_->unit));
}

std::uint64_t Calibration::fingerprint() const {
  return calib::fingerprint(table_->unit);
}

const std::string& Calibration::origin() const {
  return calib::origin_of(table_->unit);
}

}  // namespace terracut
