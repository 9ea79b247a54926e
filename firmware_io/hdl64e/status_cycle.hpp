// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "calib/hdl64e/hdl64e_stream_table.hpp"

/// The last two bytes of each HDL-64E packet hold a type letter and a value (HDL-64E S3 manual Rev
/// K, pp. 32-38; docs/reference/sensors.md). 16 packets make a cycle: nine values about the unit,
/// then seven bytes of a table; 260 cycles make a round, after which the table begins again.
namespace terracut::hdl64e {

struct StatusPair {
  std::uint8_t type = 0;
  std::uint8_t value = 0;
  bool operator==(const StatusPair&) const = default;
};

inline constexpr int kStatusCyclePackets = 16;
inline constexpr int kTableBytesPerCycle = 7;
inline constexpr int kFirstTablePlace = 9;  ///< Places 0..8 are letters, 9..15 table bytes.
inline constexpr int kCyclesPerRound = 260;
inline constexpr int kStatusRoundPackets = kStatusCyclePackets * kCyclesPerRound;  ///< 4160
static_assert(kTableBytesPerCycle * kCyclesPerRound == kStreamTableBytes);

/// Type letters of places 0..8: hour, minute, second, day, month, year since 2000, GPS state,
/// temperature, firmware.
inline constexpr std::string_view kStatusLetters = "HMSDNYGTV";
static_assert(kStatusLetters.size() == kFirstTablePlace);

/// Type of the warning byte between two lasers' entries on the S3; the S2 sends '1' there.
inline constexpr std::uint8_t kWarningType = 'W';

/// Returns the place, 0..15 in the cycle, of a type letter; nothing for a type that has no fixed
/// place (the S3 sends 0xF8..0xFF for some bytes of the table's last groups).
[[nodiscard]] constexpr std::optional<int> status_place(std::uint8_t type) noexcept {
  if (type >= '1' && type <= '7') {
    return kFirstTablePlace + (type - '1');
  }
  if (type == kWarningType) {
    return kFirstTablePlace;
  }
  for (std::size_t place = 0; place < kStatusLetters.size(); ++place) {
    if (static_cast<std::uint8_t>(kStatusLetters[place]) == type) {
      return static_cast<int>(place);
    }
  }
  return std::nullopt;
}

/// The generation of the unit that sends a status stream; only the S3 sends 'W'.
enum class StatusFlavour : std::uint8_t { kS2, kS3 };

}  // namespace terracut::hdl64e
