// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::can {

/// Counts the frames that a CAN socket received. received == delivered + error_frames + malformed.
struct CanReceiveCounters {
  std::uint64_t received = 0;      ///< Frames the kernel handed over.
  std::uint64_t delivered = 0;     ///< Returned by receive().
  std::uint64_t error_frames = 0;  ///< From the local controller: the bus has a fault.
  std::uint64_t malformed = 0;     ///< Neither a classic nor an FD frame (CAN XL, say).

  std::uint64_t bus_off = 0;   ///< Error frames saying that the controller has gone off the bus.
  std::uint64_t restarts = 0;  ///< Error frames saying that it tries again.
  std::uint64_t kernel_drops = 0;    ///< Dropped by the kernel: the socket's buffer was full.
  std::uint64_t unstamped = 0;       ///< Without a kernel stamp; stamped when read.
  std::uint64_t receive_errors = 0;  ///< Failed reads (not: interface gone) and failed reopens.
  std::uint64_t link_losses = 0;     ///< Times the interface was found down or gone.
  std::uint64_t reopened = 0;        ///< Times the interface was replaced by one of the same name.
};

}  // namespace terracut::can
