// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/capture/stream_survey.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/hdl64e/wire.hpp"

namespace terracut::firmware_io {

/// What the packets of one HDL-64E tell about it.
struct Hdl64eFacts : StreamFacts {
  StatusSnapshot status;
  std::uint64_t status_rounds = 0;
  std::size_t status_holes = 0;                      ///< Bytes of the table that never came.
  std::optional<StatusTableCollector::Table> table;  ///< For calib::parse_stream_table().
};

/// Gathers Hdl64eFacts packet by packet. For inspection, not for the receive thread: allocates.
class Hdl64eSurvey {
 public:
  /// A payload that is an HDL-64E's (recognise_sensor()).
  void add(std::span<const std::uint8_t> payload);
  [[nodiscard]] Hdl64eFacts facts() const;

 private:
  StreamSurvey stream_{kDeviceHour_us};
  StatusStreamReader status_;
};

}  // namespace terracut::firmware_io
