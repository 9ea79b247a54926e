// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/receive_buffer.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <limits>

namespace terracut::net {

ReceiveBuffer request_receive_buffer(int socket, std::size_t bytes) noexcept {
  constexpr std::size_t kMost = std::numeric_limits<int>::max() / 2;
  const int asked = static_cast<int>(std::min(bytes, kMost));
  if (::setsockopt(socket, SOL_SOCKET, SO_RCVBUFFORCE, &asked, sizeof asked) != 0) {
    ::setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &asked, sizeof asked);
  }
  int doubled = 0;
  socklen_t size = sizeof doubled;
  ::getsockopt(socket, SOL_SOCKET, SO_RCVBUF, &doubled, &size);
  return {bytes, static_cast<std::size_t>(std::max(doubled, 0)) / 2};
}

std::string describe_shortfall(const ReceiveBuffer& buffer) {
  if (!buffer.capped()) return {};
  return fmt::format(
      "the kernel granted {} of the {} bytes asked for as receive buffer: room for about {} "
      "packets, beyond which they are dropped; mend it with: sysctl -w net.core.rmem_max={}",
      buffer.granted_bytes, buffer.asked_bytes, buffer.packets(), buffer.asked_bytes);
}

}  // namespace terracut::net
