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

/// What the head of an RS-Ruby128 may do inside a packet; it spins at 5 to 20 Hz, 10 to 40
/// hundredths of a degree a firing. A blind sector (field of view) shows as a jump beyond that.
inline constexpr int kRubyMinSweep_cdeg =
    4;  ///< First to last firing; below, the head stands still.
inline constexpr int kRubyMaxStep_cdeg = 100;
inline constexpr int kRubyMaxJitter_cdeg = 2;  ///< Backwards, from firing to firing.

/// Checks that a payload is an RS-Ruby128 data packet of a rotating head and reads its azimuths
/// into `azimuths`, all but the device stamp; otherwise the reason to reject it. The checks, in
/// this order:
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
/// `azimuths` holds the azimuths for the azimuth reasons and kStationary too. Real-time safe; any
/// thread.
[[nodiscard]] std::optional<frame::Reject> check_ruby128_packet(
    std::span<const std::uint8_t> payload,
    packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;

/// A packet that was rejected for kAzimuthJump, and has `azimuths` from there, may be one that the
/// sensor's blind sector lies in: it jumps ahead once. Completes `azimuths` then and returns true.
/// `step_ticks`: from firing to firing in the packet before, there may be none in this one; 0: not
/// known, and the result is false. Whether the sector is there is for the caller to know. Real-time
/// safe; any thread.
[[nodiscard]] bool read_across_sector(packet::PacketAzimuths& azimuths,
                                      std::int32_t step_ticks) noexcept TERRACUT_NONBLOCKING;

/// A device stamp that advances evenly from packet to packet, microseconds >= 0, from the packet's
/// own, which is its first block's: in dual return packets begin with a new firing and with the
/// second return of an old one in turn. `azimuths` as check_ruby128_packet() leaves them;
/// `rotating` when it took them. `stamp_ns` >= 0, as far as 64 bits go.
[[nodiscard]] std::int64_t ruby_even_stamp_us(std::int64_t stamp_ns,
                                              const packet::PacketAzimuths& azimuths,
                                              bool rotating) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::ruby128
