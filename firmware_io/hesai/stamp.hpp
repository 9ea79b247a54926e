// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/packet/hesai_wire.hpp"

/// The device's time in the tail: year, month, day, hour, minute and second, a byte each, and the
/// microseconds of the second. For tools; decoding needs differences only (packet_reader.hpp).
namespace terracut::hesai {

/// Returns the time of a data packet of the model, microseconds since 1970 (UTC); any number for a
/// date that there is not.
[[nodiscard]] std::int64_t read_stamp_us(const PacketLayout& layout,
                                         std::span<const std::uint8_t> payload);
/// Writes the time into a data packet.
void write_stamp_us(const PacketLayout& layout, std::int64_t stamp_us,
                    std::span<std::uint8_t> payload);

}  // namespace terracut::hesai
