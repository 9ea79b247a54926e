// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::can {

/// Counts the frames that a CAN socket received. received == delivered + error_frames + malformed.
struct CanReceiveCounters {
  std::uint64_t received = 0;      ///< Frames received from the kernel.
  std::uint64_t delivered = 0;     ///< Frames returned by receive().
  std::uint64_t error_frames = 0;  ///< Error frames from the local controller: the bus has a fault.
  std::uint64_t malformed = 0;     ///< Frames neither classic nor FD (such as CAN XL).

  std::uint64_t bus_off = 0;   ///< Error frames saying that the controller has gone off the bus.
  std::uint64_t restarts = 0;  ///< Error frames saying that the controller tries the bus again.
  std::uint64_t kernel_drops = 0;  ///< Frames dropped by the kernel: the socket's buffer was full.
  std::uint64_t unstamped = 0;     ///< Frames without a kernel stamp; they were stamped when read.
  /// Failed reads (except for a lost interface) and failed reopens.
  std::uint64_t receive_errors = 0;
  std::uint64_t link_losses = 0;  ///< Times the interface was found down or gone.
  std::uint64_t reopened = 0;     ///< Times the interface was replaced by one of the same name.
};

}  // namespace terracut::can
