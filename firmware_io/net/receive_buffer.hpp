// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <string>

namespace terracut::net {

/// The kernel's buffer of one socket, by the number setsockopt(SO_RCVBUF) takes. The kernel sets
/// twice that aside and charges a datagram of 1.2 kB with about 2.3 kB, its own bookkeeping
/// included.
struct ReceiveBuffer {
  std::size_t asked_bytes = 0;
  std::size_t granted_bytes = 0;

  [[nodiscard]] bool capped() const noexcept { return granted_bytes < asked_bytes; }
  /// Data packets of either sensor it holds, roughly.
  [[nodiscard]] std::size_t packets() const noexcept { return 2 * granted_bytes / 2304; }
};

/// Asks for `bytes`: beyond the system's limit when the process may (CAP_NET_ADMIN), else up to it.
/// Errors show as less granted. Allocates nothing.
[[nodiscard]] ReceiveBuffer request_receive_buffer(int socket, std::size_t bytes) noexcept;

/// What a capped buffer means and the setting that mends it; empty when it is not capped.
[[nodiscard]] std::string describe_shortfall(const ReceiveBuffer& buffer);

}  // namespace terracut::net
