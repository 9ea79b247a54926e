// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/threads/nonblocking.hpp"

/// The data packet of the first HDL-64E, the S1 (docs/reference/sensors.md): it has the same blocks
/// as its successors' packets, in another order. Upper lasers fire three times as often as lower
/// ones, and each block has its own azimuth. When a laser fires within its block is unknown, so all
/// beams are assumed to point along the block's azimuth. There is no device clock: the last six
/// bytes are text.
namespace terracut::hdl64e {

/// Number of columns of a packet. Each block is a column, in which the lasers of the other bank
/// have no return.
inline constexpr int kColumnsPerPacketS1 = kBlocksPerPacket;
/// Packet period, measured on a capture by the host's stamps. ROS drivers assume 2600 packets a
/// second, 384.6 us.
inline constexpr std::int32_t kS1Packet_ns = 384'300;
/// Mean time between firings of an upper laser: nine of a packet's twelve blocks are upper ones.
inline constexpr std::int32_t kS1UpperFiring_ns = kS1Packet_ns / 9;
/// Azimuths are multiples of this, because the encoder has 4000 marks.
inline constexpr int kS1Mark_cdeg = 9;

/// Reads the azimuths of a packet that is_hdl64e_s1() into `azimuths`, except for the device stamp
/// (see S1Reader); otherwise returns the reason to reject the packet: kAzimuthOutOfRange,
/// kAzimuthJump (steps from block to block beyond the limits in packet_check.hpp) or kStationary.
/// In these cases, too, `azimuths` holds the azimuths. Real-time safe; any thread.
[[nodiscard]] std::optional<frame::Reject> check_hdl64e_s1_packet(
    const wire::Packet& packet, packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::hdl64e
