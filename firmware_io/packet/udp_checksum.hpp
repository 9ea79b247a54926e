// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/packet/datagram.hpp"

namespace terracut::packet {

/// Returns the internet checksum (RFC 1071) of `bytes`, in which the checksum field must be 0.
[[nodiscard]] std::uint16_t internet_checksum(std::span<const std::uint8_t> bytes) noexcept;

/// Returns the UDP checksum over IPv4 (RFC 768) of pseudo header, UDP header and payload. It is
/// never 0, which would mean that there is no checksum. The payload must fit a UDP datagram.
[[nodiscard]] std::uint16_t udp_checksum(const Datagram& datagram) noexcept;

}  // namespace terracut::packet
