// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Metadata of an Ouster as files; what the input bends, and what must hold: csv_table.hpp.
#include "calib/ouster/ouster_metadata.hpp"
#include "csv_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  fuzz::check_csv(
      data, size, ouster::nominal_ouster(sensor::SensorModel::kOuster32),
      [](const auto&... text) { return ouster::parse_ouster_metadata(text...); },
      [](const auto& unit) { return ouster::ouster_metadata_text(unit); });
  return 0;
}
