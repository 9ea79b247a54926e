// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstdint>

namespace terracut::send {

/// Gives a capture that is played repeatedly one continuous stream of stamps: the gap between
/// passes is the capture's mean gap between packets. With the old stamps, PacketPacer would send a
/// second pass at once.
class PassStamps {
 public:
  /// Returns the stamp, in nanoseconds, of a packet in this pass.
  std::int64_t place(std::int64_t stamp_ns) noexcept {
    if (packets_++ == 0) first_ns_ = last_ns_ = stamp_ns;
    last_ns_ = std::max(last_ns_, stamp_ns);
    return stamp_ns + shift_ns_;
  }
  void next_pass() noexcept {
    const std::int64_t length_ns = last_ns_ - first_ns_;
    shift_ns_ += length_ns + (packets_ > 1 ? length_ns / (packets_ - 1) : 0);
    packets_ = 0;
  }
  /// Returns the number of packets so far in this pass.
  [[nodiscard]] std::int64_t packets() const noexcept { return packets_; }

 private:
  std::int64_t packets_ = 0, first_ns_ = 0, last_ns_ = 0, shift_ns_ = 0;
};

}  // namespace terracut::send
