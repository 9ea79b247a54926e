// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "firmware_io/packet/wire_integer.hpp"

/// The data packet (MSOP) of the RS-Ruby128 as sent in the UDP payload; big endian (RS-Ruby user
/// manual v1.0; docs/reference/sensors.md). Nothing here allocates or throws; everything may be
/// called on the packet path.
namespace terracut::ruby128 {

// --- Numbers of the format ---

inline constexpr std::uint16_t kRubyDataPort = 6699;    ///< UDP destination port; factory setting.
inline constexpr std::uint16_t kRubyDevicePort = 7788;  ///< UDP destination port of DIFOP.

inline constexpr std::size_t kRubyPacketBytes = 1248;  ///< Size of both MSOP and DIFOP packets.
inline constexpr std::array<std::uint8_t, 4> kRubyMagic{0x55, 0xAA, 0x05, 0x5A};
inline constexpr std::uint8_t kRubyBlockId = 0xFE;
inline constexpr int kRubyBlocksPerPacket = 3;
inline constexpr int kRubyChannelsPerBlock = 128;

/// Bits of the wave mode, which says which returns the packet carries.
inline constexpr std::uint8_t kRubyFirstReturnBit = 1, kRubySecondReturnBit = 2;

// --- The bytes ---

namespace ruby128_wire {

struct Return {
  packet::Be16 distance;   ///< Counts of 5 mm; 0 = no return.
  std::uint8_t intensity;  ///< 0..255
};

struct Block {
  std::uint8_t id;         ///< kRubyBlockId
  std::uint8_t return_id;  ///< 1 or 2 in dual return, according to the manual; not relied on.
  /// Azimuth of the block's first firing, 0..35999, clockwise seen from above.
  packet::Be16 azimuth_cdeg;
  std::array<Return, kRubyChannelsPerBlock> returns;
};

struct Packet {
  std::array<std::uint8_t, 4> magic;
  packet::Be16 protocol_version;
  std::uint8_t reserved1;
  std::uint8_t wave_mode;
  packet::Be16 temperature;            ///< See ruby_temperature_deg_c().
  std::array<std::uint8_t, 10> stamp;  ///< Device stamp in one of three encodings (timestamp.hpp).
  std::array<std::uint8_t, 10> reserved2;
  std::uint8_t lidar_type, lidar_model;
  std::array<std::uint8_t, 48> reserved3;
  std::array<Block, kRubyBlocksPerPacket> blocks;
  std::array<std::uint8_t, 4> tail;
};

static_assert(sizeof(Return) == 3 && alignof(Return) == 1);
static_assert(sizeof(Block) == 388 && alignof(Block) == 1);
static_assert(sizeof(Packet) == kRubyPacketBytes && alignof(Packet) == 1);
static_assert(offsetof(Packet, wave_mode) == 7 && offsetof(Packet, temperature) == 8);
static_assert(offsetof(Packet, stamp) == 10 && offsetof(Packet, lidar_type) == 30);
static_assert(offsetof(Packet, blocks) == 80 && offsetof(Packet, tail) == 1244);
static_assert(std::is_trivially_copyable_v<Packet> && std::is_standard_layout_v<Packet>);

}  // namespace ruby128_wire

/// Decodes a temperature field to degrees Celsius: bit 15 is the sign, then eleven bits of 1/16
/// degree (RS-Ruby user manual).
[[nodiscard]] constexpr double ruby_temperature_deg_c(std::uint16_t field) noexcept {
  const int sixteenths = (field & 0x7FFF) >> 4;
  return ((field & 0x8000) != 0 ? -sixteenths : sixteenths) / 16.0;
}
static_assert(ruby_temperature_deg_c(0x12C0) == 18.75);
static_assert(ruby_temperature_deg_c(0x92C0) == -18.75);

/// Encodes a temperature, rounded towards zero; |temperature_deg_c| < 128.
[[nodiscard]] constexpr std::uint16_t ruby_temperature_field(double temperature_deg_c) noexcept {
  const int sixteenths = static_cast<int>(temperature_deg_c * 16.0);
  const int magnitude = sixteenths < 0 ? -sixteenths : sixteenths;
  return static_cast<std::uint16_t>(magnitude << 4 | (sixteenths < 0 ? 0x8000 : 0));
}
static_assert(ruby_temperature_field(18.75) == 0x12C0);
static_assert(ruby_temperature_field(-18.75) == 0x92C0);

// --- Reading ---

/// Returns the packet that `payload` holds, read in place; null unless it is exactly 1248 bytes
/// long. Magic, block ids and azimuths are not checked. Valid as long as the payload is.
[[nodiscard]] inline const ruby128_wire::Packet* packet_in(
    std::span<const std::uint8_t> payload) noexcept {
  // The cast is safe: the packet consists of bytes, which need no alignment.
  return payload.size() == sizeof(ruby128_wire::Packet)
             ? reinterpret_cast<const ruby128_wire::Packet*>(payload.data())
             : nullptr;
}

// --- Writing ---

/// Returns a packet to fill in: three blocks at azimuth 0 without returns, with magic and block
/// ids.
[[nodiscard]] constexpr ruby128_wire::Packet blank_packet() noexcept {
  ruby128_wire::Packet packet{};
  packet.magic = kRubyMagic;
  packet.wave_mode = kRubyFirstReturnBit;
  for (ruby128_wire::Block& block : packet.blocks) block.id = kRubyBlockId;
  return packet;
}

/// Returns a view of `packet` as the payload to send. The view shows later changes and is valid as
/// long as `packet` exists.
[[nodiscard]] inline std::span<const std::uint8_t, kRubyPacketBytes> payload_of(
    const ruby128_wire::Packet& packet) noexcept {
  return std::span<const std::uint8_t, kRubyPacketBytes>(
      reinterpret_cast<const std::uint8_t*>(&packet), kRubyPacketBytes);
}
std::span<const std::uint8_t, kRubyPacketBytes> payload_of(ruby128_wire::Packet&&) = delete;

}  // namespace terracut::ruby128
