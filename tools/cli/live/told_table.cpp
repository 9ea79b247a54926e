// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "told_table.hpp"

#include "tools/cli/calibration_choice.hpp"

namespace terracut::cli {

std::string ToldTable::take_warning(const calib::SensorCalibration& in_use) {
  if (told_.load(std::memory_order_relaxed)) return {};
  for (StatusByte heard; heard_.try_pop(heard);) {
    reader_.add(heard.type, heard.value, heard.stamp_us);
  }
  if (!reader_.has_table()) return {};
  told_.store(true, std::memory_order_relaxed);
  return other_table_warning(reader_, in_use);
}

}  // namespace terracut::cli
