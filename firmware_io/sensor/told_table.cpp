// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/told_table.hpp"

#include <fmt/format.h>

#include "calib/hdl64e/hdl64e_stream_table.hpp"

namespace terracut::sensor {

std::string other_table_warning(const hdl64e::StatusStreamReader& told,
                                const calib::SensorCalibration& in_use) {
  if (!told.has_table()) return {};
  const auto table = hdl64e::parse_stream_table(told.table());
  if (!table || hdl64e::fingerprint(*table) == calib::fingerprint(in_use)) return {};
  return fmt::format(
      "the packets carry another calibration (fingerprint {:016x}) than the one in use ({:016x}); "
      "leave --calibration away to use theirs",
      hdl64e::fingerprint(*table), calib::fingerprint(in_use));
}

std::string ToldTable::take_warning(const calib::SensorCalibration& in_use) {
  if (told_.load(std::memory_order_relaxed)) return {};
  for (StatusByte heard; heard_.try_pop(heard);) {
    reader_.add(heard.type, heard.value, heard.stamp_us);
  }
  if (!reader_.has_table()) return {};
  told_.store(true, std::memory_order_relaxed);
  return other_table_warning(reader_, in_use);
}

}  // namespace terracut::sensor
