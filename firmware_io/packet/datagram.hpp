// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

namespace terracut::packet {

/// The payload of one UDP datagram and where it came from.
struct Datagram {
  std::span<const std::uint8_t> payload;  ///< Valid until the source returns the next datagram.
  std::int64_t stamp_ns = 0;  ///< Time of capture or reception, nanoseconds since 1970 (UTC).
  std::uint32_t source_address = 0;  ///< IPv4 address of the sender, host byte order.
  std::uint32_t destination_address = 0;
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
  /// VLAN id, [1, 4094]. Of stacked tags the innermost two: OUTER << 12 | INNER. 0 means none, or
  /// unknown, as on a socket.
  std::uint32_t vlan = 0;
  std::uint64_t source_mac = 0;  ///< 48-bit link-layer address of the last sender; 0: unknown.
};

}  // namespace terracut::packet
