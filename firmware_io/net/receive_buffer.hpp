// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <string>

namespace terracut::net {

/// The size of the kernel's buffer for one socket, in the unit of setsockopt(SO_RCVBUF). The kernel
/// reserves twice this number of bytes, and a datagram of 1.2 kB takes about 2.3 kB with its
/// bookkeeping.
struct ReceiveBuffer {
  std::size_t asked_bytes = 0;
  std::size_t granted_bytes = 0;

  [[nodiscard]] bool capped() const noexcept { return granted_bytes < asked_bytes; }
  /// Returns roughly how many data packets of a sensor the buffer holds.
  [[nodiscard]] std::size_t packets() const noexcept { return 2 * granted_bytes / 2304; }
};

/// Asks for a buffer of `bytes`: beyond the system's limit if the process may (CAP_NET_ADMIN), else
/// up to the limit. If that fails, less is granted. Allocates nothing.
[[nodiscard]] ReceiveBuffer request_receive_buffer(int socket, std::size_t bytes) noexcept;

/// Explains why the buffer is smaller than asked for, and the setting that mends it; empty if it is
/// not.
[[nodiscard]] std::string describe_shortfall(const ReceiveBuffer& buffer);

}  // namespace terracut::net
