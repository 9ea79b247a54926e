// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// Ouster's data packets (docs/reference/sensors.md): a header except in the legacy profile,
/// columns of all lasers that fire at one azimuth, and a footer. Numbers are little-endian.
namespace terracut::ouster {

/// What a packet says of each measurement, as the unit is configured (`udp_profile_lidar`).
enum class Profile : std::uint8_t { kLegacy, kSingle, kDual, kLowRate, kLowRateDual };

struct ProfileRow {
  Profile profile{};
  std::string_view name;            ///< In the unit's metadata.
  std::size_t channel_bytes = 0;    ///< Of one laser in a column.
  std::size_t second_at = 0;        ///< Of the second return in these; 0: there is none.
  std::size_t reflectivity_at = 0;  ///< A byte; counted from the return's first.
  int range_bits = 0;               ///< Of the return's first bytes, from the lowest bit on.
  int range_mm = 1;                 ///< Millimetres in a count of the range.
};

/// The last two rows have one layout and differ in the packet's header, of which nothing is read.
inline constexpr std::array kProfiles{
    ProfileRow{Profile::kLegacy, "LEGACY", 12, 0, 4, 20, 1},
    ProfileRow{Profile::kSingle, "RNG19_RFL8_SIG16_NIR16", 12, 0, 4, 19, 1},
    ProfileRow{Profile::kDual, "RNG19_RFL8_SIG16_NIR16_DUAL", 16, 4, 3, 19, 1},
    ProfileRow{Profile::kLowRate, "RNG15_RFL8_NIR8", 4, 0, 2, 15, 8},
    ProfileRow{Profile::kLowRateDual, "RNG15_RFL8_NIR8_DUAL", 8, 4, 2, 15, 8},
    ProfileRow{Profile::kLowRateDual, "FUSA_RNG15_RFL8_NIR8_DUAL", 8, 4, 2, 15, 8}};

/// Of packets from the unit's IMU, which hold no returns.
inline constexpr std::size_t kImuBytes = 48;

[[nodiscard]] constexpr const ProfileRow& row_of(Profile profile) noexcept {
  return *std::ranges::find(kProfiles, profile, &ProfileRow::profile);
}

/// The numbers of lasers that units have and are read here.
inline constexpr std::array kRows{32, 64, 128};
inline constexpr int kMostColumnsPerPacket = 16;
inline constexpr std::array kColumnsPerFrame{512, 1024, 2048, 4096};

template <class Number>
[[nodiscard]] constexpr Number little_endian(const std::uint8_t* bytes) noexcept {
  Number value = 0;
  for (std::size_t i = sizeof(Number); i-- > 0;) {
    value = static_cast<Number>(value << 8 | bytes[i]);
  }
  return value;
}

/// The head of a column.
struct ColumnHead {
  std::uint64_t stamp_ns = 0;  ///< When it was measured, by the unit's clock.
  int measurement = 0;         ///< Its number in the frame, [0, columns of a frame).
  bool is_valid = false;       ///< False: the unit measured nothing in it.
};

/// Where everything is in a unit's packets.
struct PacketFormat {
  Profile profile{};
  int rows = 0;                         ///< Lasers.
  int columns = kMostColumnsPerPacket;  ///< In a packet.

  bool operator==(const PacketFormat&) const = default;
  [[nodiscard]] constexpr bool is_legacy() const noexcept { return profile == Profile::kLegacy; }
  [[nodiscard]] constexpr bool is_dual() const noexcept { return row_of(profile).second_at != 0; }
  [[nodiscard]] constexpr std::size_t header_bytes() const noexcept { return is_legacy() ? 0 : 32; }
  [[nodiscard]] constexpr std::size_t column_header_bytes() const noexcept {
    return is_legacy() ? 16 : 12;
  }
  [[nodiscard]] constexpr std::size_t column_bytes() const noexcept {
    return column_header_bytes() + static_cast<std::size_t>(rows) * row_of(profile).channel_bytes +
           (is_legacy() ? 4 : 0);
  }
  [[nodiscard]] constexpr std::size_t column_at(int column) const noexcept {
    return header_bytes() + static_cast<std::size_t>(column) * column_bytes();
  }
  [[nodiscard]] constexpr std::size_t channels_at(int column) const noexcept {
    return column_at(column) + column_header_bytes();
  }
  /// Of the number that tells whether a column is valid, by its lowest bit.
  [[nodiscard]] constexpr std::size_t status_at(int column) const noexcept {
    return is_legacy() ? column_at(column + 1) - 4 : column_at(column) + 10;
  }
  [[nodiscard]] constexpr std::size_t packet_bytes() const noexcept {
    return column_at(columns) + (is_legacy() ? 0 : 32);
  }
  [[nodiscard]] constexpr ColumnHead head(const std::uint8_t* packet, int column) const noexcept {
    const std::uint8_t* const at = packet + column_at(column);
    return {little_endian<std::uint64_t>(at), little_endian<std::uint16_t>(at + 8),
            (packet[status_at(column)] & 1U) != 0};
  }
};

/// What the heads of a packet's columns say together.
struct PacketHead {
  int first_measurement = 0;   ///< Number of the first column, valid or not.
  int stamped_column = 0;      ///< The column with the stamp below: the first valid one, or 0.
  std::uint64_t stamp_ns = 0;  ///< Of that column.
  std::uint32_t valid = 0;     ///< A bit for each valid column.
};

/// Returns the head of a packet of that size and format; nothing if its columns contradict each
/// other. The numbers of invalid columns are believed only where no column is valid.
[[nodiscard]] constexpr std::optional<PacketHead> head_of(
    const PacketFormat& format, std::span<const std::uint8_t> payload) noexcept {
  if (payload.size() != format.packet_bytes()) return std::nullopt;
  if (!format.is_legacy() && payload[0] != 1) return std::nullopt;  // the type of data packets
  PacketHead found;
  for (int column = 0; column < format.columns; ++column) {
    found.valid |= std::uint32_t{format.head(payload.data(), column).is_valid} << column;
  }
  found.stamped_column = found.valid == 0 ? 0 : std::countr_zero(found.valid);
  const ColumnHead stamped = format.head(payload.data(), found.stamped_column);
  found.first_measurement = stamped.measurement - found.stamped_column;
  found.stamp_ns = stamped.stamp_ns;
  if (found.first_measurement < 0 || found.first_measurement % format.columns != 0 ||
      found.first_measurement >= kColumnsPerFrame.back()) {
    return std::nullopt;
  }
  for (int column = 0; column < format.columns; ++column) {
    const ColumnHead head = format.head(payload.data(), column);
    const bool is_believed = head.is_valid || found.valid == 0;
    if (is_believed && head.measurement != found.first_measurement + column) return std::nullopt;
  }
  return found;
}

/// Returns the format of a payload that looks like a data packet of 16 columns of so many rows;
/// nothing if it does not. No two profiles have packets of one size then.
[[nodiscard]] constexpr std::optional<PacketFormat> format_of(std::span<const std::uint8_t> payload,
                                                              int rows) noexcept {
  for (const ProfileRow& row : kProfiles) {
    const PacketFormat format{.profile = row.profile, .rows = rows};
    if (head_of(format, payload)) return format;
  }
  return std::nullopt;
}

/// True if what the measurements of a packet hold can be two returns each: no second one is without
/// a first, there are second ones for at most half of these, most signals are of a return, and what
/// is reserved is 0.
[[nodiscard]] constexpr bool may_be_dual(const PacketFormat& format,
                                         std::span<const std::uint8_t> payload) noexcept {
  constexpr std::size_t kSecondSignal = 10, kReserved = 14;  // of Profile::kDual
  const ProfileRow& row = row_of(format.profile);
  const std::uint32_t mask = (1U << row.range_bits) - 1;
  const bool has_signals = format.profile == Profile::kDual;
  int firsts = 0, seconds = 0, stray_signals = 0;
  for (int column = 0; column < format.columns; ++column) {
    if (!format.head(payload.data(), column).is_valid) continue;
    const std::uint8_t* at = payload.data() + format.channels_at(column);
    for (int laser = 0; laser < format.rows; ++laser, at += row.channel_bytes) {
      const bool has_first = (little_endian<std::uint32_t>(at) & mask) != 0;
      const bool has_second = (little_endian<std::uint32_t>(at + row.second_at) & mask) != 0;
      if (has_second && !has_first) return false;
      if (has_signals && at[kReserved] != 0) return false;
      const bool is_stray =
          has_signals && !has_second && little_endian<std::uint16_t>(at + kSecondSignal) != 0;
      stray_signals += is_stray ? 1 : 0;
      firsts += has_first ? 1 : 0;
      seconds += has_second ? 1 : 0;
    }
  }
  return firsts > 0 && 2 * seconds <= firsts && 2 * stray_signals <= firsts;
}

/// Returns the format of a payload that looks like a data packet of 16 columns. Some formats differ
/// in nothing but what the measurements mean (128 rows of one return in 15 bits, 64 rows of two, 32
/// rows of two in 19 bits): then the one in which these make sense, of several the one of fewer
/// rows. That may be wrong for single packets, above all for those without returns.
[[nodiscard]] constexpr std::optional<PacketFormat> format_of(
    std::span<const std::uint8_t> payload) noexcept {
  std::optional<PacketFormat> found;
  for (const int rows : kRows) {
    const std::optional<PacketFormat> format = format_of(payload, rows);
    if (!format) continue;
    if (format->is_dual() && may_be_dual(*format, payload)) return format;
    if (!found || !format->is_dual()) found = format;
  }
  return found;
}

}  // namespace terracut::ouster
