// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/send_buffer.hpp"

#include <fmt/format.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <limits>

namespace terracut::stream {

std::size_t request_send_buffer(int socket, std::size_t bytes) noexcept {
  constexpr std::size_t kMost = std::numeric_limits<int>::max() / 2;
  const int asked = static_cast<int>(std::min(bytes, kMost));
  if (::setsockopt(socket, SOL_SOCKET, SO_SNDBUFFORCE, &asked, sizeof asked) != 0) {
    ::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &asked, sizeof asked);
  }
  int doubled = 0;  // the kernel doubles it for its bookkeeping
  ::socklen_t size = sizeof doubled;
  ::getsockopt(socket, SOL_SOCKET, SO_SNDBUF, &doubled, &size);
  return static_cast<std::size_t>(std::max(doubled, 0)) / 2;
}

threads::Grant send_buffer_grant(std::size_t bytes, std::size_t granted_bytes) {
  const bool granted = granted_bytes >= bytes;
  threads::Grant grant{.asked = fmt::format("send buffer of {} bytes a stream reader", bytes),
                       .granted = granted,
                       .error_number = granted ? 0 : EPERM,
                       .in_force = fmt::format("{} bytes", granted_bytes)};
  if (!granted) {
    grant.mend = fmt::format(
        "sudo sysctl -w net.core.wmem_max={}: else a frame takes several rounds of the sink's "
        "thread",
        bytes);
  }
  return grant;
}

std::size_t bytes_waiting_in(int socket, bool is_unix) noexcept {
  int bytes = 0;
  if (::ioctl(socket, is_unix ? SIOCOUTQ : SIOCOUTQNSD, &bytes) != 0) return 0;
  return static_cast<std::size_t>(std::max(bytes, 0));
}

}  // namespace terracut::stream
