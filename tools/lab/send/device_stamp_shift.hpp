// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/ruby128/timestamp.hpp"

namespace terracut::send {

/// Changes the packets of one sensor as if its clock had jumped. One stream, one thread.
class DeviceStampShift {
 public:
  /// Adds `shift_ns`, rounded to the device's unit, to the device stamp of a data packet; a
  /// Velodyne's hour wraps. Returns false, leaving the packet untouched, for payloads other than
  /// data packets of a sensor whose stamp is known.
  ///
  /// To find the encoding of a RoboSense stamp, call this for every packet of the stream, with
  /// shift 0 before the jump.
  bool operator()(std::span<std::uint8_t> payload, std::int64_t shift_ns) noexcept;

 private:
  ruby128::RubyTimestampDetector ruby_encoding_;
};

}  // namespace terracut::send
