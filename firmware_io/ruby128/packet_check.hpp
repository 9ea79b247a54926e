// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ruby128 {

/// Limits of the head's motion inside a packet; it spins at 5 to 20 Hz, 10 to 40 hundredths of a
/// degree a firing. A blind sector (field of view) shows as a larger jump.
inline constexpr int kRubyMinSweep_cdeg = 4;  ///< First to last firing; less means a standing head.
inline constexpr int kRubyMaxStep_cdeg = 100;
inline constexpr int kRubyMaxJitter_cdeg = 2;  ///< Backwards, from firing to firing.

/// Checks that a payload is an RS-Ruby128 data packet of a rotating head and reads its azimuths
/// into `azimuths`, all but the device stamp; otherwise returns the reason to reject it. The
/// checks, in this order:
///
///   kWrongModel         another sensor's data packet: any Velodyne's, a Ruby Lite's (four
///                       blocks of 80 channels), a Ruby Plus's (the same layout; told by its type
///                       bytes)
///   kWrongSize          not 1248 bytes
///   kDeviceInfo         a DIFOP packet
///   kWrongMagic         other leading bytes or block ids
///   kAzimuthOutOfRange, kAzimuthJump (steps beyond those above)
///   kStationary
///
/// For the azimuth reasons and kStationary `azimuths` holds the azimuths as well. Real-time safe;
/// any thread.
[[nodiscard]] std::optional<frame::Reject> check_ruby128_packet(
    std::span<const std::uint8_t> payload,
    packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;

/// Completes `azimuths` of a packet that was rejected for kAzimuthJump but jumps ahead only once:
/// the sensor's blind sector may lie in it. Returns true then. `step_ticks` is the step from firing
/// to firing of the packet before, since this one may have none; with 0, unknown, the result is
/// false. The caller must know whether the sector is there. Real-time safe; any thread.
[[nodiscard]] bool read_across_sector(packet::PacketAzimuths& azimuths,
                                      std::int32_t step_ticks) noexcept TERRACUT_NONBLOCKING;

/// Returns a device stamp that advances evenly from packet to packet, microseconds >= 0. The
/// packet's own is of its first block, and in dual return packets begin alternately with a new
/// firing and with the second return of an old one. `azimuths` and `rotating` are the result of
/// check_ruby128_packet(). `stamp_ns` >= 0, any 64-bit value.
[[nodiscard]] std::int64_t ruby_even_stamp_us(std::int64_t stamp_ns,
                                              const packet::PacketAzimuths& azimuths,
                                              bool rotating) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::ruby128
