// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/ouster/packet_format.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ouster {

/// The port to which units send by the factory's settings.
inline constexpr std::uint16_t kDataPort = 7502;

/// Stamps count nanoseconds from the unit's start or, with PTP, from 1970, and never wrap: this is
/// larger than all.
inline constexpr std::int64_t kClockWrap_us = std::int64_t{1} << 56;

/// How a unit measures: its packets, and the columns of a frame in angle and time.
struct Mode {
  PacketFormat format;
  int columns_per_frame = 1024;
  double rate_hz = 10;

  [[nodiscard]] constexpr std::int32_t column_ns() const noexcept {
    return static_cast<std::int32_t>(1e9 / (rate_hz * columns_per_frame) + 0.5);
  }
};

/// Returns the head's azimuth at a column, rounded up to ticks: a beam on the border of two columns
/// of the image is in the column of its own number. Clockwise, [0, kRevolution_ticks); 0 is where
/// the unit's connector points.
[[nodiscard]] constexpr std::int32_t measurement_ticks(int measurement,
                                                       int columns_per_frame) noexcept {
  return static_cast<std::int32_t>(
      (std::int64_t{measurement} * packet::kRevolution_ticks + columns_per_frame - 1) /
      columns_per_frame);
}

/// Returns the number of the column of an azimuth in hundredths of a degree (PacketAzimuths), which
/// is the head's rounded down.
[[nodiscard]] constexpr int measurement_at(std::int32_t azimuth_cdeg,
                                           int columns_per_frame) noexcept {
  const std::int64_t most_ticks = std::int64_t{azimuth_cdeg + 1} * packet::kTicksPerCdeg - 1;
  return static_cast<int>(most_ticks * columns_per_frame / packet::kRevolution_ticks);
}

/// Returns how far the head is past its azimuth in hundredths of a degree: [0, 1000) ticks.
[[nodiscard]] constexpr std::int32_t rest_ticks(std::int32_t azimuth_cdeg,
                                                int columns_per_frame) noexcept {
  const std::int32_t ticks =
      measurement_ticks(measurement_at(azimuth_cdeg, columns_per_frame), columns_per_frame);
  const std::int32_t rest = ticks - azimuth_cdeg * packet::kTicksPerCdeg;
  return rest < 0 ? 0 : rest;
}

/// Checks the packets of one unit and reads its head's azimuths. In dual return each column counts
/// twice, once for each return. The checks, in this order:
///
///   kDeviceInfo         a packet of the unit's IMU
///   kWrongModel         another sensor's data packet
///   kWrongSize          not the size of the unit's data packets
///   kWrongMagic         another type, or columns that contradict each other
///   kAzimuthOutOfRange  columns beyond those of a frame
///
/// Invalid columns have no returns; their azimuths follow from the valid ones'. Stateless, so any
/// thread; real-time safe.
[[nodiscard]] std::optional<frame::Reject> read_packet(
    const Mode& mode, std::span<const std::uint8_t> payload,
    packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;

/// Reads the returns of a column, which read_packet() has accepted, as frame::TileDistances with
/// counts of 16 mm. `column` counts as in PacketAzimuths. `raw`, `fine` and `intensity` have an
/// element for each row.
void read_returns(const PacketFormat& format, const std::uint8_t* packet, std::size_t column,
                  std::span<std::uint16_t> raw, std::span<std::uint8_t> fine,
                  std::span<std::uint8_t> intensity) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::ouster
