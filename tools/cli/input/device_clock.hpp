// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "firmware_io/decode/decoder.hpp"

namespace terracut::cli {

/// Compares an RS-Ruby128's clock with the clock of the capture, for a message at the end of a run.
class DeviceClock {
 public:
  /// `offset_s` is added to the device's stamps (--clock-offset).
  explicit DeviceClock(double offset_s) : offset_ns_(static_cast<std::int64_t>(offset_s * 1e9)) {}

  /// Notes a decoded packet; call it after each packet. Does nothing unless the sensor is an
  /// RS-Ruby128.
  void note(const decode::Decoder& decoder, std::int64_t host_stamp_ns) noexcept {
    const ruby128::RubyTimestampDetector* timestamp = decoder.ruby_timestamp();
    if (timestamp == nullptr) return;
    encoding_ = timestamp->encoding();
    proven_ = timestamp->complete();
    ahead_ns_ = decoder.device_stamp_us() * 1000 + offset_ns_ - host_stamp_ns;
    noted_ = true;
  }

  [[nodiscard]] bool noted() const noexcept { return noted_; }
  /// Returns "UTC seconds and microseconds (proven), 0.3 ms behind the capture".
  [[nodiscard]] std::string text() const;
  /// Returns advice if the clock is 37 s off, as those of sensors under PTP may be; else an empty
  /// text.
  [[nodiscard]] std::string warning() const;

 private:
  std::int64_t offset_ns_;
  bool noted_ = false, proven_ = false;
  ruby128::RubyTimestamp encoding_{};
  std::int64_t ahead_ns_ = 0;  ///< Device time minus host time.
};

}  // namespace terracut::cli
