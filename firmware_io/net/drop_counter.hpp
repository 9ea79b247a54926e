// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::net {

/// Converts a 32-bit count that the kernel keeps and wraps (SO_RXQ_OVFL, SO_MEMINFO, pcap_stats)
/// into its increase since the last reading. If the count is read in two ways, one may lag behind
/// the other: an older reading adds nothing, instead of 2^32.
class DropCounter {
 public:
  /// Returns the increase since the newest reading; 0 for an older one. Exact as long as fewer than
  /// 2^31 drops lie between two readings.
  [[nodiscard]] std::uint32_t advance_to(std::uint32_t reading) noexcept {
    const std::uint32_t step = reading - newest_;
    if (step >= std::uint32_t{1} << 31) return 0;
    newest_ = reading;
    return step;
  }

  /// Notes that the kernel's count starts again from 0, because the socket is new.
  void restart() noexcept { newest_ = 0; }

 private:
  std::uint32_t newest_ = 0;
};

}  // namespace terracut::net
