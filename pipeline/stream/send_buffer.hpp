// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>

#include "rt/threads/grant.hpp"

namespace terracut::stream {

/// Requests a send buffer for `socket` that takes `bytes` at once: beyond net.core.wmem_max if the
/// process may (CAP_NET_ADMIN), else up to that limit. Returns the bytes granted. Allocates
/// nothing.
std::size_t request_send_buffer(int socket, std::size_t bytes) noexcept;

/// Describes for people that `granted_bytes` of `bytes` were granted, and how to get the missing
/// ones.
[[nodiscard]] threads::Grant send_buffer_grant(std::size_t bytes, std::size_t granted_bytes);

/// Returns how many bytes written to a stream socket wait in it: not yet sent by TCP, or not yet
/// read from a Unix socket. 0 if the system does not tell.
[[nodiscard]] std::size_t bytes_waiting_in(int socket, bool is_unix) noexcept;

}  // namespace terracut::stream
