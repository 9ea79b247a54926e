// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>

#include "rt/threads/grant.hpp"

namespace terracut::stream {

/// Gives `socket` a send buffer that takes `bytes` at once: beyond net.core.wmem_max if the process
/// may (CAP_NET_ADMIN), else up to it. Returns the bytes granted. Allocates nothing.
std::size_t request_send_buffer(int socket, std::size_t bytes) noexcept;

/// Describes the grant of `bytes` out of `granted_bytes` for people, with how to mend a refusal.
[[nodiscard]] threads::Grant send_buffer_grant(std::size_t bytes, std::size_t granted_bytes);

/// Returns the bytes written to a stream socket that have not left it: not sent by TCP, or not read
/// by the reader of a Unix socket. 0 if the system does not tell.
[[nodiscard]] std::size_t bytes_waiting_in(int socket, bool is_unix) noexcept;

}  // namespace terracut::stream
