// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Tables of a Hesai as files; what the input bends, and what must hold: csv_table.hpp.
#include "calib/hesai/hesai_csv.hpp"
#include "csv_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  fuzz::check_csv(
      data, size, beams::built_in_table(sensor::SensorModel::kPandar40p),
      [](const auto&... text) { return hesai::parse_hesai_csv(text...); },
      [](const auto& table) { return hesai::hesai_csv_text(table); });
  return 0;
}
