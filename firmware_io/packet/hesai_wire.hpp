// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/sensor/sensor_model.hpp"

/// Hesai's data packets (docs/reference/sensors.md): a header, blocks of one azimuth and a return
/// of each laser, and a tail. Numbers are little-endian but for the two bytes that a packet, or
/// each block of a Pandar40P, starts with.
namespace terracut::hesai {

inline constexpr std::array<std::uint8_t, 2> kPacketStart{0xEE, 0xFF}, kBlockStart{0xFF, 0xEE};
inline constexpr std::size_t kVersionAt = 4;  ///< In a header of 12 bytes.
/// Of all models here; models with a header state it there.
inline constexpr std::uint8_t kMillimetresPerCount = 4;

/// Return modes. In dual return the blocks come in pairs of one azimuth.
inline constexpr std::array<std::uint8_t, 4> kSingleModes{0x33, 0x34, 0x37, 0x38};
inline constexpr std::array<std::uint8_t, 5> kDualModes{0x39, 0x3A, 0x3B, 0x3C, 0x3E};
inline constexpr std::uint8_t kStrongest = 0x37, kLastAndStrongest = 0x39;
inline constexpr std::uint16_t kDataPort = 2368;
/// Operational states: in the first, blocks follow one another twice as fast.
inline constexpr std::uint8_t kHighResolution = 0, kStandardResolution = 2;

/// Where a field stands in the tail, bytes from its beginning.
struct TailLayout {
  std::size_t return_mode_at, stamp_us_at, date_at, bytes;
  int first_year = 1900;     ///< The date's year 0.
  std::size_t state_at = 0;  ///< Of the operational state; 0: none is sent.
};
inline constexpr TailLayout kPandarTail{
    .return_mode_at = 14, .stamp_us_at = 10, .date_at = 16, .bytes = 22, .first_year = 2000};
inline constexpr TailLayout kQt64Tail{
    .return_mode_at = 16, .stamp_us_at = 12, .date_at = 18, .bytes = 28};
inline constexpr TailLayout kXtTail{
    .return_mode_at = 10, .stamp_us_at = 19, .date_at = 13, .bytes = 28};
/// Before it stand a checksum of 4 bytes and 17 on functional safety.
inline constexpr TailLayout kQt128Tail{
    .return_mode_at = 33, .stamp_us_at = 42, .date_at = 36, .bytes = 55};
/// The same, with an inertial unit's data.
inline constexpr TailLayout kOt128Tail{
    .return_mode_at = 33, .stamp_us_at = 42, .date_at = 36, .bytes = 77, .state_at = 32};

/// What differs between the models' packets.
struct PacketLayout {
  sensor::SensorModel model{};
  std::size_t header_bytes = 12;  ///< 0: none, and each block has a start.
  int lasers = 0, blocks = 0;
  std::size_t return_bytes = 4;  ///< Distance, two bytes, and intensity; the rest is not read.
  TailLayout tail = kXtTail;
  std::size_t extra_bytes = 0;      ///< Some units send so many more behind the tail.
  std::int32_t column_ns = 50'000;  ///< Time from one block's first firing to the next one's.
  std::uint16_t least_count = 1;    ///< Of a distance; smaller ones say why there is none.
  std::uint8_t least_version = 0;   ///< Of the model in byte 4, where others send as many bytes ...
  std::uint8_t most_version = 255;  ///< ... and the greatest.

  /// Of the numbers of lasers and blocks in a header; the unit of distances is two bytes behind.
  [[nodiscard]] constexpr std::size_t counts_at() const noexcept {
    return header_bytes == 8 ? 2 : 6;
  }
  [[nodiscard]] constexpr std::size_t azimuth_at() const noexcept {
    return header_bytes == 0 ? kBlockStart.size() : 0;
  }
  [[nodiscard]] constexpr std::size_t returns_at() const noexcept { return azimuth_at() + 2; }
  [[nodiscard]] constexpr std::size_t block_at(int block) const noexcept {
    const std::size_t bytes = returns_at() + return_bytes * static_cast<std::size_t>(lasers);
    return header_bytes + bytes * static_cast<std::size_t>(block);
  }
  [[nodiscard]] constexpr std::size_t tail_at() const noexcept { return block_at(blocks); }
  [[nodiscard]] constexpr std::size_t packet_bytes() const noexcept {
    return tail_at() + tail.bytes;
  }
  [[nodiscard]] constexpr bool fits(std::size_t bytes) const noexcept {
    return bytes == packet_bytes() || bytes == packet_bytes() + extra_bytes;
  }
  /// Returns column_ns for a packet of the model.
  [[nodiscard]] constexpr std::int32_t column_ns_in(
      std::span<const std::uint8_t> payload) const noexcept {
    const bool is_fast = tail.state_at > 0 && payload[tail_at() + tail.state_at] == kHighResolution;
    return is_fast ? column_ns / 2 : column_ns;
  }
};

inline constexpr std::array kLayouts{
    PacketLayout{.model = sensor::SensorModel::kPandar40p,
                 .header_bytes = 0,
                 .lasers = 40,
                 .blocks = 10,
                 .return_bytes = 3,
                 .tail = kPandarTail,
                 .extra_bytes = 4,
                 .column_ns = 55'560},
    PacketLayout{.model = sensor::SensorModel::kPandar64,
                 .header_bytes = 8,
                 .lasers = 64,
                 .blocks = 6,
                 .return_bytes = 3,
                 .tail = kPandarTail,
                 .extra_bytes = 4,
                 .column_ns = 55'560},
    PacketLayout{.model = sensor::SensorModel::kPandarQt64,
                 .lasers = 64,
                 .blocks = 4,
                 .tail = kQt64Tail,
                 .column_ns = 166'667},
    PacketLayout{.model = sensor::SensorModel::kPandarQt128,
                 .lasers = 128,
                 .blocks = 2,
                 .tail = kQt128Tail,
                 .extra_bytes = 32,
                 .column_ns = 111'111},
    PacketLayout{.model = sensor::SensorModel::kPandarXt16, .lasers = 16, .blocks = 8},
    PacketLayout{.model = sensor::SensorModel::kPandarXt32, .lasers = 32, .blocks = 8},
    PacketLayout{.model = sensor::SensorModel::kPandarXt32m, .lasers = 32, .blocks = 6},
    PacketLayout{.model = sensor::SensorModel::kOt128,
                 .lasers = 128,
                 .blocks = 2,
                 .return_bytes = 3,
                 .tail = kOt128Tail,
                 .extra_bytes = 32,
                 .column_ns = 55'556,
                 .least_count = 4,
                 .least_version = 128,
                 .most_version = 136},
    PacketLayout{.model = sensor::SensorModel::kPandar128,
                 .lasers = 128,
                 .blocks = 2,
                 .return_bytes = 3,
                 .tail = kOt128Tail,
                 .extra_bytes = 32,
                 .column_ns = 55'556,
                 .most_version = 127}};

[[nodiscard]] constexpr const PacketLayout& layout_of(sensor::SensorModel model) noexcept {
  return *std::ranges::find(kLayouts, model, &PacketLayout::model);
}

/// True if a payload has the size of the model's data packets, and starts as they do but for the
/// version.
[[nodiscard]] constexpr bool is_of(const PacketLayout& layout,
                                   std::span<const std::uint8_t> payload) noexcept {
  if (!layout.fits(payload.size())) return false;
  const auto starts = [&](std::size_t at, const std::array<std::uint8_t, 2>& with) {
    return payload[at] == with[0] && payload[at + 1] == with[1];
  };
  if (layout.header_bytes == 0) {
    bool are_blocks = true;
    for (int block = 0; block < layout.blocks; ++block) {
      are_blocks &= starts(layout.block_at(block), kBlockStart);
    }
    return are_blocks;
  }
  const std::size_t at = layout.counts_at();
  return starts(0, kPacketStart) && payload[at] == layout.lasers &&
         payload[at + 1] == layout.blocks && payload[at + 3] == kMillimetresPerCount;
}
/// True if the version, too, is one that the model sends.
[[nodiscard]] constexpr bool is_surely_of(const PacketLayout& layout,
                                          std::span<const std::uint8_t> payload) noexcept {
  return is_of(layout, payload) && payload[kVersionAt] >= layout.least_version &&
         payload[kVersionAt] <= layout.most_version;
}

/// Makes `payload`, zeros, a data packet of the model without azimuths, returns and time, at
/// standard resolution.
constexpr void begin_packet(const PacketLayout& layout, bool is_dual,
                            std::span<std::uint8_t> payload) noexcept {
  if (layout.header_bytes > 0) {
    std::ranges::copy(kPacketStart, payload.begin());
    payload[layout.counts_at()] = static_cast<std::uint8_t>(layout.lasers);
    payload[layout.counts_at() + 1] = static_cast<std::uint8_t>(layout.blocks);
    payload[layout.counts_at() + 3] = kMillimetresPerCount;
  } else {
    for (int block = 0; block < layout.blocks; ++block) {
      std::ranges::copy(kBlockStart, payload.subspan(layout.block_at(block)).begin());
    }
  }
  if (layout.least_version > 0) payload[kVersionAt] = layout.least_version;
  if (layout.tail.state_at > 0)
    payload[layout.tail_at() + layout.tail.state_at] = kStandardResolution;
  payload[layout.tail_at() + layout.tail.return_mode_at] = is_dual ? kLastAndStrongest : kStrongest;
}

}  // namespace terracut::hesai
