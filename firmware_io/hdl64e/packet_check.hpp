// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::hdl64e {

/// Limits of the head's motion inside a packet. If the head advances less than kMinSweep_cdeg from
/// the first to the last column, it stands still. The allowed steps are those of 69 to 3400 rpm at
/// the 48 us cycle (the sensor spins at 300 to 1200); a small backwards jitter is allowed.
inline constexpr int kMinSweep_cdeg = 10;
inline constexpr int kMaxColumnStep_cdeg = 100;
inline constexpr int kMaxJitter_cdeg = 5;  ///< Largest backwards step from column to column.

/// Checks that a payload is an HDL-64E S2, S2.1 or S3 data packet of a rotating head and reads its
/// azimuths and stamp into `azimuths`; otherwise returns the reason to reject it. The checks are
/// made in this order:
///
///   kWrongModel        another Velodyne's or a RoboSense's data packet, told by its block ids or
///                      size and leader (VLP-16, HDL-32E, VLP-32C: upper blocks only; VLS-128: four
///                      ids in turn; HDL-64E S1, see s1_packet.hpp; RS-Ruby)
///   kWrongSize         not 1206 bytes
///   kWrongMagic        block ids that do not alternate upper, lower
///   kAzimuthOutOfRange, kAzimuthMismatch (of a pair), kAzimuthJump (steps beyond those above)
///   kStationary
///
/// If the reason is kStationary or one of the azimuth reasons, `azimuths` also holds the stamp and
/// azimuths, as far as they exist. Real-time safe; any thread.
[[nodiscard]] std::optional<frame::Reject> check_hdl64e_packet(
    std::span<const std::uint8_t> payload,
    packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::hdl64e
