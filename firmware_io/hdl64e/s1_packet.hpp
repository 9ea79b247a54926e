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

/// The data packet of the first HDL-64E, the S1 (docs/reference/sensors.md): the blocks of its
/// successors in another order. The upper lasers fire three times while the lower ones do once, and
/// each block has an azimuth of its own. When within its block a laser fires is not known, so all
/// of them are taken to point where the block's azimuth says. There is no device clock: the last
/// six bytes are text.
namespace terracut::hdl64e {

/// Each block is a column, of which the other bank's lasers have no return.
inline constexpr int kColumnsPerPacketS1 = kBlocksPerPacket;
/// From packet to packet: measured on a capture by the host's stamps; ROS drivers count 2600 a
/// second, 384.6 us.
inline constexpr std::int32_t kS1Packet_ns = 384'300;
/// From a firing of an upper laser to the next, on the average: nine blocks in a packet.
inline constexpr std::int32_t kS1UpperFiring_ns = kS1Packet_ns / 9;
/// Azimuths are multiples of this, the encoder's 4000 marks.
inline constexpr int kS1Mark_cdeg = 9;

/// Reads the azimuths of a packet that is_hdl64e_s1() into `azimuths`, all but the device stamp
/// (S1Reader); otherwise the reason to reject it: kAzimuthOutOfRange, kAzimuthJump (steps beyond
/// those of packet_check.hpp, from block to block), kStationary. `azimuths` holds the azimuths for
/// these, too. Real-time safe; any thread.
[[nodiscard]] std::optional<frame::Reject> check_hdl64e_s1_packet(
    const wire::Packet& packet, packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::hdl64e
