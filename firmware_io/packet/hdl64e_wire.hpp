// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/wire_integer.hpp"

/// The data packet of the HDL-64E (S2, S2.1, S3) as sent in the UDP payload; little endian (HDL-64E
/// S3 user manual, appendix "data packet format"; docs/reference/sensors.md). Nothing here
/// allocates or throws; everything may be called on the packet path.
namespace terracut::hdl64e {

// --- Numbers of the format ---

inline constexpr std::uint16_t kHdl64eDataPort = 2368;   ///< UDP destination port; factory setting.
inline constexpr std::uint16_t kHdl64eSourcePort = 443;  ///< UDP source port of factory units.

inline constexpr std::uint16_t kUpperBlockId = 0xEEFF;  ///< Block of lasers 0..31 (bytes FF EE).
inline constexpr std::uint16_t kLowerBlockId = 0xDDFF;  ///< Block of lasers 32..63 (bytes FF DD).
/// Blocks of lasers 64..95 and 96..127, which only the VLS-128 sends.
inline constexpr std::uint16_t kVls128ThirdId = 0xCCFF, kVls128FourthId = 0xBBFF;

inline constexpr std::size_t kHdl64ePacketBytes = 1206;
inline constexpr int kBlocksPerPacket = 12;
inline constexpr int kLasersPerBlock = 32;

/// The device clock counts microseconds since the top of the hour: 0 .. kDeviceHour_us - 1.
inline constexpr std::uint32_t kDeviceHour_us = 3'600'000'000U;

// --- The bytes ---

namespace wire {

struct Return {
  packet::Le16 distance;   ///< Counts of 2 mm; 0 = no return.
  std::uint8_t intensity;  ///< Intensity as measured, not corrected.
};

struct Block {
  packet::Le16 id;            ///< kUpperBlockId or kLowerBlockId.
  packet::Le16 azimuth_cdeg;  ///< 0..35999, clockwise seen from above.
  std::array<Return, kLasersPerBlock> returns;
};

struct Packet {
  std::array<Block, kBlocksPerPacket> blocks;
  packet::Le32 stamp_us;     ///< Device clock at the end of the packet (hdl64e/firing_times.hpp).
  std::uint8_t status_type;  ///< Type of the status byte; each packet has one (type, value) pair.
  std::uint8_t status_value;
};

static_assert(sizeof(Return) == 3 && alignof(Return) == 1);
static_assert(sizeof(Block) == 100 && alignof(Block) == 1);
static_assert(sizeof(Packet) == kHdl64ePacketBytes && alignof(Packet) == 1);
static_assert(offsetof(Packet, stamp_us) == 1200);
static_assert(offsetof(Packet, status_type) == 1204 && offsetof(Packet, status_value) == 1205);
static_assert(std::is_trivially_copyable_v<Packet> && std::is_standard_layout_v<Packet>);

}  // namespace wire

// --- Reading ---

/// Returns the packet that `payload` holds, read in place; null unless it is exactly 1206 bytes
/// long. Block ids and azimuths are not checked. Valid as long as the payload is.
[[nodiscard]] inline const wire::Packet* packet_in(std::span<const std::uint8_t> payload) noexcept {
  // The cast is safe: the packet consists of bytes, which need no alignment.
  return payload.size() == sizeof(wire::Packet)
             ? reinterpret_cast<const wire::Packet*>(payload.data())
             : nullptr;
}

/// True for the HDL-64E S2/S3 in either return mode and for no other Velodyne model: block 1 is a
/// lower and block 2 an upper one. Smaller models send only upper blocks, the VLS-128 has other ids
/// in block 2, and the S1 sends about three upper blocks for each lower one.
[[nodiscard]] constexpr bool is_hdl64e(const wire::Packet& packet) noexcept {
  return packet.blocks[1].id.value() == kLowerBlockId &&
         packet.blocks[2].id.value() == kUpperBlockId;
}

/// True for an HDL-64E S1: all blocks are upper or lower ones, both occur, and upper ones at least
/// twice as often.
[[nodiscard]] constexpr bool is_hdl64e_s1(const wire::Packet& packet) noexcept {
  int upper = 0, lower = 0;
  for (const wire::Block& block : packet.blocks) {
    upper += block.id.value() == kUpperBlockId ? 1 : 0;
    lower += block.id.value() == kLowerBlockId ? 1 : 0;
  }
  return upper + lower == kBlocksPerPacket && lower > 0 && upper >= 2 * lower;
}

// --- Writing ---

/// Returns a packet to fill in: 12 blocks with the HDL-64E's block ids, at azimuth 0, without
/// returns.
[[nodiscard]] constexpr wire::Packet blank_packet() noexcept {
  wire::Packet packet{};
  for (std::size_t block = 0; block < packet.blocks.size(); ++block) {
    packet.blocks[block].id = block % 2 == 0 ? kUpperBlockId : kLowerBlockId;
  }
  return packet;
}

/// Returns a view of `packet` as the payload to send. The view shows later changes and is valid as
/// long as `packet` exists.
[[nodiscard]] inline std::span<const std::uint8_t, kHdl64ePacketBytes> payload_of(
    const wire::Packet& packet) noexcept {
  return std::span<const std::uint8_t, kHdl64ePacketBytes>(
      reinterpret_cast<const std::uint8_t*>(&packet), kHdl64ePacketBytes);
}
std::span<const std::uint8_t, kHdl64ePacketBytes> payload_of(wire::Packet&&) = delete;

// --- The device clock ---

/// Returns the device time from `earlier_us` to `later_us`. The clock wraps each hour; of the two
/// possible steps the shorter one is returned, in [-30 min, 30 min).
[[nodiscard]] constexpr std::int64_t device_step_us(std::uint32_t earlier_us,
                                                    std::uint32_t later_us) noexcept {
  return packet::clock_step_us(earlier_us, later_us, kDeviceHour_us);
}
static_assert(device_step_us(kDeviceHour_us - 88, 200) == 288);
static_assert(device_step_us(200, kDeviceHour_us - 88) == -288);

}  // namespace terracut::hdl64e
