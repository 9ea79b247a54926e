// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/sensor/stream_survey.hpp"

namespace terracut::sensor {

/// Facts about one HDL-64E from its packets.
struct Hdl64eFacts : StreamFacts {
  hdl64e::StatusSnapshot status;
  std::size_t status_holes = 0;  ///< Bytes of the calibration table that never came.
  /// The table, for hdl64e::parse_stream_table().
  std::optional<hdl64e::StatusTableCollector::Table> table;
};

/// Gathers Hdl64eFacts packet by packet. For inspection, not for the receive thread: allocates.
class Hdl64eSurvey {
 public:
  /// Adds a payload that recognise_sensor() takes for an HDL-64E's.
  void add(std::span<const std::uint8_t> payload);
  [[nodiscard]] Hdl64eFacts facts() const;

 private:
  StreamSurvey stream_{hdl64e::kDeviceHour_us};
  hdl64e::StatusStreamReader status_;
};

}  // namespace terracut::sensor
