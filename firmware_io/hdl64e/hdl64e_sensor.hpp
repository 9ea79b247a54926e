// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/hdl64e/hdl64e_geometry.hpp"
#include "calib/mount/mount.hpp"
#include "firmware_io/decode/column_returns.hpp"
#include "firmware_io/decode/frame_builder.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/hdl64e/packet_check.hpp"
#include "firmware_io/hdl64e/point_kernel.hpp"
#include "firmware_io/hdl64e/wire.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::hdl64e {

/// What Decoder needs to know of the HDL-64E (see there).
///
/// Single and dual return packets are told apart by their azimuths: in dual return each comes
/// twice, for the strongest and the last return. Both returns of a firing are placed.
class Hdl64eSensor {
 public:
  using Calibration = Hdl64eCalibration;
  struct Config {
    GeometryModel geometry = GeometryModel::kManual;
  };
  static constexpr int kRows = kHdl64eLasers;
  static constexpr std::size_t kPacketBytes = kHdl64ePacketBytes;
  using Column = decode::ColumnReturns<static_cast<std::size_t>(kRows)>;
  static constexpr std::int64_t kClockWrap_us = kDeviceHour_us;
  static constexpr int kDefaultColumns = 2083;  ///< 2083.3 firings a frame, 48 us each.
  static constexpr int kDefaultReturnsPerCell = 2;

  /// columns: in [16, 36000].
  Hdl64eSensor(const Calibration& calibration, const mount::Mount& mount, const Config& config,
               int columns, memory::FixedMemory& memory);

  [[nodiscard]] std::optional<frame::Reject> check(
      std::span<const std::uint8_t> payload, decode::PacketAzimuths& azimuths) const noexcept {
    return check_hdl64e_packet(payload, azimuths);
  }
  [[nodiscard]] decode::BeamSpread spread(std::int32_t step_ticks) const noexcept {
    return {offsets_.hindmost_ticks(), offsets_.foremost_ticks(step_ticks)};
  }
  [[nodiscard]] std::int32_t beam_ticks(int laser) const noexcept {
    return offsets_.offset_ticks(0, laser);
  }
  void begin_packet(const decode::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;
  void read_column(std::span<const std::uint8_t> payload, const decode::PacketAzimuths& azimuths,
                   int column, Column& found) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] std::span<const std::int32_t, kHdl64eLasers> rows() const noexcept { return rows_; }

 private:
  BeamOffsets offsets_;
  PointKernel kernel_;
  std::array<std::int32_t, kHdl64eLasers> rows_;
};

}  // namespace terracut::hdl64e
