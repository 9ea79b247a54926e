// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/capture/pcap_source.hpp"
#include "firmware_io/frame/loss_counters.hpp"

namespace terracut::capture {

/// What became of the records of a capture that was decoded to the end of what was asked for. Each
/// of them is in exactly one place, as the datagrams of a live run are in net::DatagramAccount.
struct CaptureAccount {
  PcapCounters read;
  std::uint64_t before_start = 0, behind_end = 0;  ///< Outside of the part that was asked for.
  std::uint64_t device_info = 0;                   ///< Hold no returns.
  std::uint64_t decoded = 0;
  frame::LossCounters losses;

  [[nodiscard]] bool balances() const noexcept {
    return read.frames == read.left_out() + read.delivered &&
           read.delivered ==
               before_start + behind_end + device_info + losses.rejected_total() + decoded;
  }
};

}  // namespace terracut::capture
