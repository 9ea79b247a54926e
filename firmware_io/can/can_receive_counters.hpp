// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::can {

/// What a CAN socket took in and what became of it.
/// received == delivered + error_frames + malformed.
struct CanReceiveCounters {
  std::uint64_t received = 0;      ///< Frames the kernel handed over.
  std::uint64_t delivered = 0;     ///< Returned by receive().
  std::uint64_t error_frames = 0;  ///< Of the local controller: something is wrong with the bus.
  std::uint64_t malformed = 0;     ///< Neither a classic nor an FD frame (CAN XL, say).

  std::uint64_t bus_off = 0;         ///< Error frames that said that the controller has given up.
  std::uint64_t restarts = 0;        ///< Error frames that said that it tries again.
  std::uint64_t kernel_drops = 0;    ///< Never handed over: the socket's buffer was full.
  std::uint64_t unstamped = 0;       ///< Without a kernel stamp; the time of reading was taken.
  std::uint64_t receive_errors = 0;  ///< Reads the system refused, but for the interface's going,
                                     ///< and refusals to open it when it came.
  std::uint64_t link_losses = 0;     ///< Times the interface was found down or gone.
  std::uint64_t reopened = 0;        ///< Times the socket was made anew for an interface that is
                                     ///< another one under the same name.
};

}  // namespace terracut::can
