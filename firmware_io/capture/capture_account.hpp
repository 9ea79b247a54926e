// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/frame/loss_counters.hpp"

namespace terracut::capture {

/// Accounts for every record of a capture, once the requested part is decoded. Each record is
/// counted exactly once, as net::DatagramAccount counts the datagrams of a live run.
struct CaptureAccount {
  CaptureCounters read;
  std::uint64_t before_start = 0, behind_end = 0;  ///< records outside the requested part
  std::uint64_t device_info = 0;                   ///< packets without returns
  std::uint64_t decoded = 0;
  frame::LossCounters losses;

  [[nodiscard]] bool balances() const noexcept {
    return read.frames == read.left_out() + read.joined + read.delivered &&
           read.delivered ==
               before_start + behind_end + device_info + losses.rejected_total() + decoded;
  }
};

}  // namespace terracut::capture
