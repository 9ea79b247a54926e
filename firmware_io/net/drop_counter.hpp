// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::net {

/// Frames a 32-bit count that the kernel keeps and wraps (SO_RXQ_OVFL, SO_MEMINFO, pcap_stats) into
/// what was added since the last look. The same count may be read by two ways of which one lags:
/// a reading that is behind the newest one adds nothing, instead of four thousand million.
class DropCounter {
 public:
  /// What came on top since the newest reading so far; 0 for an older one. Exact while fewer than
  /// 2^31 drops lie between two readings.
  [[nodiscard]] std::uint32_t advance_to(std::uint32_t reading) noexcept {
    const std::uint32_t step = reading - newest_;
    if (step >= std::uint32_t{1} << 31) return 0;
    newest_ = reading;
    return step;
  }

  /// The kernel's count starts again from 0: a new socket.
  void restart() noexcept { newest_ = 0; }

 private:
  std::uint32_t newest_ = 0;
};

}  // namespace terracut::net
