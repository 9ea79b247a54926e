// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// Why a packet was not decoded.
enum class Reject : std::uint8_t {
  kWrongSize,   ///< Payload length is not that of the sensor's data packet.
  kWrongMagic,  ///< Block identifiers are not those of this sensor.
  kDeviceInfo,  ///< The sensor's packet about itself (device information), not a data packet.
  kWrongModel,  ///< A data packet of a model that is recognised but not decoded.
  kAzimuthOutOfRange,  ///< A block azimuth >= 360 degrees.
  kAzimuthMismatch,    ///< Blocks that fire together carry different azimuths.
  kAzimuthJump,        ///< Azimuths inside a packet do not advance like a rotating head.
  kRepeated,           ///< The same packet (device stamp and azimuths) as one already decoded.
  kLate,               ///< The packet is too old for its frame (reordered too far).
  kStationary,         ///< The head is not rotating, so there is no frame to build.
  kClockJump,  ///< The packet's stamp contradicts the stream's, and no other packet confirms it.
  kCount,
};
inline constexpr std::size_t kRejectReasons = static_cast<std::size_t>(Reject::kCount);

/// Returns a stable lower_snake_case name, as in the JSON report.
[[nodiscard]] std::string_view to_string(Reject reason) noexcept;

/// Counts everything that can be lost between the sensor and a label, by cause (docs/design.md,
/// promise 4).
struct LossCounters {
  std::uint64_t kernel_drops = 0;          ///< Datagrams the socket buffer could not hold.
  std::uint64_t network_gap_packets = 0;   ///< Packets missing by the device's own stamps.
  std::uint64_t azimuth_hole_columns = 0;  ///< Firings missing inside a frame, whatever the cause.
  std::array<std::uint64_t, kRejectReasons> rejected{};  ///< Packets rejected, by reason.
  /// Returns for which the frame's overflow list had no room.
  std::uint64_t overflow_full_returns = 0;
  /// Returns that came too late for their frame, because their packet has a blind sector inside and
  /// was completed after it. Their firings also count as holes.
  std::uint64_t late_returns = 0;
  std::uint64_t skipped_frames = 0;  ///< Frames not segmented for lack of time.
  std::uint64_t clock_jumps = 0;  ///< Jumps of device stamps without a loss (replay loop, reset).

  LossCounters& operator+=(const LossCounters& other) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] std::uint64_t rejected_total() const noexcept;
};

}  // namespace terracut::frame
