// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/hdl64e/firing_times.hpp"
#include "firmware_io/hdl64e/status_cycle.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "tools/lab/packets/labelled_return.hpp"

namespace terracut::packets {

/// Writes six columns as one data packet: six firings or, in dual return, three firings with two
/// columns each (the strongest and the last return) that have the same azimuth. `end_stamp_ns`
/// (since 1970) is the time at which the packet ends; the device stamp states it in microseconds of
/// the hour (docs/reference/sensors.md).
void encode_hdl64e_packet(std::span<const FiringColumn, hdl64e::kColumnsPerPacketSingle> columns,
                          std::int64_t end_stamp_ns, hdl64e::StatusPair status,
                          hdl64e::wire::Packet& packet) noexcept;

/// Returns the time at which the packet of these columns ends: one firing period, computed from the
/// columns, after the last one. Two equal azimuths at the start mean dual return.
[[nodiscard]] std::int64_t packet_end_ns(
    std::span<const FiringColumn, hdl64e::kColumnsPerPacketSingle> columns) noexcept;

}  // namespace terracut::packets
