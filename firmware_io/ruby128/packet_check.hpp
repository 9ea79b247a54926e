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

/// Limits of the head's motion inside a packet. If the head advances less than kRubyMinSweep_cdeg
/// from the first to the last firing, it stands still. The head spins at 5 to 20 Hz and rotates
/// 0.10 to 0.40 degrees from firing to firing. A blind sector (field of view) shows as a larger
/// jump.
inline constexpr int kRubyMinSweep_cdeg = 4;
inline constexpr int kRubyMaxStep_cdeg = 100;
inline constexpr int kRubyMaxJitter_cdeg = 2;  ///< Largest backwards step from firing to firing.

/// Checks that a payload is an RS-Ruby128 data packet of a rotating head and reads its azimuths
/// into `azimuths`, except for the device stamp; otherwise returns the reason to reject it. The
/// checks are made in this order:
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
/// If the reason is kStationary or one of the azimuth reasons, `azimuths` also holds the azimuths.
/// Real-time safe; any thread.
[[nodiscard]] std::optional<frame::Reject> check_ruby128_packet(
    std::span<const std::uint8_t> payload,
    packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;

/// Completes the `azimuths` of a packet that was rejected for kAzimuthJump, if the azimuth jumps
/// ahead only once: the sensor's blind sector may lie there. Then returns true, and the caller must
/// find out whether the sector is there. `step_ticks` is the step from firing to firing in the
/// packet before, since this one may have none; 0 means unknown and gives false. Real-time safe;
/// any thread.
[[nodiscard]] bool read_across_sector(packet::PacketAzimuths& azimuths,
                                      std::int32_t step_ticks) noexcept TERRACUT_NONBLOCKING;

/// Returns a device stamp that advances evenly from packet to packet, microseconds >= 0. The
/// packet's own stamp `stamp_ns` (>= 0, any 64-bit value) is that of its first block; in dual
/// return packets begin alternately with a new firing and with the second return of an old one.
/// `azimuths` and `rotating` are the result of check_ruby128_packet().
[[nodiscard]] std::int64_t ruby_even_stamp_us(std::int64_t stamp_ns,
                                              const packet::PacketAzimuths& azimuths,
                                              bool rotating) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::ruby128
