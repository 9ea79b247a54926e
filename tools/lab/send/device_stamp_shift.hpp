// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/ruby128/timestamp.hpp"

namespace terracut::send {

/// Makes the packets of one sensor look as if its clock had jumped. One stream, one thread.
class DeviceStampShift {
 public:
  /// Adds `shift_ns`, rounded to the device's unit, to the device stamp of a data packet; the hour
  /// of a Velodyne wraps. False, and the packet untouched, for payloads that are no data packet of
  /// a sensor whose stamp is known.
  ///
  /// Wants to see the stream from its beginning, with shift 0 before the jump: that is how the
  /// encoding of a RoboSense stamp is found out.
  bool operator()(std::span<std::uint8_t> payload, std::int64_t shift_ns) noexcept;

 private:
  ruby128::RubyTimestampDetector ruby_encoding_;
};

}  // namespace terracut::send
