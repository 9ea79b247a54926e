// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/ruby128/ruby128_sensor.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "firmware_io/sensor/stream_survey.hpp"

namespace terracut::sensor {

/// Facts about one RS-Ruby128 from its data packets.
struct Ruby128Facts : StreamFacts {
  std::uint16_t protocol_version = 0;
  ruby128::RubyTimestamp timestamp = ruby128::RubyTimestamp::kUtcMicroseconds;
  bool timestamp_proven = false;
  double ahead_of_capture_s = 0;  ///< Device clock minus capture stamp, of the last packet.
  double temperature_deg_c = 0;   ///< Temperature in the last packet.
};

/// Gathers Ruby128Facts packet by packet. For inspection, not for the receive thread: allocates.
class Ruby128Survey {
 public:
  /// Takes a payload that is an RS-Ruby128's data packet (recognise_sensor()) and its capture
  /// stamp.
  void add(std::span<const std::uint8_t> payload, std::int64_t stamp_ns);
  [[nodiscard]] Ruby128Facts facts() const;

 private:
  StreamSurvey stream_{ruby128::Ruby128Sensor::kClockWrap_us};
  ruby128::RubyTimestampDetector timestamp_;
  std::int32_t step_ticks_ = 0;  ///< Step of the last packet with a rotating head; 0: none yet.
  Ruby128Facts last_;
};

}  // namespace terracut::sensor
