// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/sensor/sensor_model.hpp"

/// The data packets of RoboSenses with 32 lasers (docs/reference/sensors.md): a header of 42 bytes,
/// 12 blocks of one azimuth and a return of each laser, and a tail. Numbers are big-endian.
namespace terracut::robosense {

inline constexpr std::size_t kPacketBytes = 1'248;
inline constexpr int kBlocks = 12, kLasers = 32;
inline constexpr std::array<std::uint8_t, 2> kBlockStart{0xFF, 0xEE};
inline constexpr std::size_t kStampAt = 20, kStampBytes = 10;
/// Manuals and drivers differ on which of these bytes holds the type; the model is behind it.
inline constexpr std::size_t kOldTypeAt = 30, kTypeAt = 31, kModelAt = 32;
inline constexpr std::uint8_t kHeliosType = 6, kHelios16pModel = 3;

[[nodiscard]] constexpr std::size_t block_at(int block) noexcept {
  return 42 + 100 * static_cast<std::size_t>(block);
}
inline constexpr std::size_t kAzimuthAt = 2, kReturnsAt = 4;  ///< In a block.

/// What differs between the models' packets.
struct PacketLayout {
  sensor::SensorModel model{};
  std::array<std::uint8_t, 8> start{};
  std::size_t start_bytes = 0;
  std::uint8_t type = 0;
  std::int32_t column_ns = 0;      ///< Time from one block's first firing to the next one's.
  double device_angle_deg = 0.01;  ///< Unit of the angles in its DIFOP packets.
  /// Of the byte that is 0 where distances are in counts twice as long; 0: there is none.
  std::size_t resolution_at = 0;
};

inline constexpr std::array kLayouts{
    PacketLayout{.model = sensor::SensorModel::kRs32,
                 .start = {0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5, 0x50, 0xA0},
                 .start_bytes = 8,
                 .type = 2,
                 .column_ns = 55'520,
                 .device_angle_deg = 0.001},
    PacketLayout{.model = sensor::SensorModel::kHelios,
                 .start = {0x55, 0xAA, 0x05, 0x5A},
                 .start_bytes = 4,
                 .type = kHeliosType,
                 .column_ns = 55'560,
                 .resolution_at = 17}};

[[nodiscard]] constexpr const PacketLayout& layout_of(sensor::SensorModel model) noexcept {
  return *std::ranges::find(kLayouts, model, &PacketLayout::model);
}

/// True if a payload starts as the model's data packets do and has their blocks, and is not a
/// Helios-16P's, whose blocks hold two firings of 16 lasers.
[[nodiscard]] constexpr bool is_of(const PacketLayout& layout,
                                   std::span<const std::uint8_t> payload) noexcept {
  if (payload.size() != kPacketBytes ||
      !std::equal(layout.start.begin(),
                  layout.start.begin() + static_cast<std::ptrdiff_t>(layout.start_bytes),
                  payload.begin())) {
    return false;
  }
  for (int block = 0; block < kBlocks; ++block) {
    const std::size_t at = block_at(block);
    if (payload[at] != kBlockStart[0] || payload[at + 1] != kBlockStart[1]) return false;
  }
  return payload[kTypeAt] != kHeliosType || payload[kModelAt] != kHelios16pModel;
}
/// True if the header states the model, too.
[[nodiscard]] constexpr bool is_surely_of(const PacketLayout& layout,
                                          std::span<const std::uint8_t> payload) noexcept {
  return is_of(layout, payload) &&
         (payload[kOldTypeAt] == layout.type || payload[kTypeAt] == layout.type);
}

/// Makes `payload`, zeros, a data packet of the model without azimuths, returns and time.
constexpr void begin_packet(const PacketLayout& layout, std::span<std::uint8_t> payload) noexcept {
  std::copy_n(layout.start.begin(), layout.start_bytes, payload.begin());
  payload[kTypeAt] = layout.type;
  if (layout.resolution_at > 0) payload[layout.resolution_at] = 1;
  for (int block = 0; block < kBlocks; ++block) {
    std::ranges::copy(kBlockStart, payload.subspan(block_at(block)).begin());
  }
}

}  // namespace terracut::robosense
