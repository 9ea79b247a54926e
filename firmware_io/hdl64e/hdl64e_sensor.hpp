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
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/hdl64e/packet_check.hpp"
#include "firmware_io/hdl64e/point_kernel.hpp"
#include "firmware_io/hdl64e/s1_packet.hpp"
#include "firmware_io/hdl64e/s1_reader.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::hdl64e {

/// The trait of the HDL-64E for the Decoder.
///
/// Tells single from dual return packets by their azimuths: in dual return each azimuth comes
/// twice, for the strongest and the last return. Both returns of a firing are placed. Packets of an
/// S1 are recognised by their blocks (s1_packet.hpp).
class Hdl64eSensor {
 public:
  using Calibration = Hdl64eCalibration;
  struct Config {
    GeometryModel geometry = GeometryModel::kManual;
  };
  static constexpr int kRows = kHdl64eLasers, kChannels = kRows;
  static constexpr std::size_t kPacketBytes = kHdl64ePacketBytes;
  static constexpr std::size_t kGroups = kLasersPerBlock;  ///< Both blocks fire together.
  using Returns = packet::FiringReturns<static_cast<std::size_t>(kRows)>;
  static constexpr std::int64_t kClockWrap_us = kDeviceHour_us;
  static constexpr int kDefaultColumns = 2083;  ///< A frame has 2083.3 firings of 48 us.
  static constexpr int kDefaultReturnsPerCell = 2;

  Hdl64eSensor(const Calibration& calibration, const mount::Mount& mount, const Config& config);

  [[nodiscard]] std::optional<frame::Reject> check(const packet::Datagram& datagram,
                                                   packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING;
  [[nodiscard]] packet::BeamSpread spread(std::int32_t step_ticks) const noexcept {
    return {offsets_.hindmost_ticks(), offsets_.foremost_ticks(step_ticks)};
  }
  [[nodiscard]] std::int32_t beam_ticks(int laser) const noexcept {
    return offsets_.offset_ticks(0, laser);
  }
  [[nodiscard]] static std::size_t group(std::size_t laser) noexcept { return laser % kGroups; }
  [[nodiscard]] static std::int32_t advance_ticks(std::int32_t step_ticks, std::size_t group,
                                                  bool dual_return) noexcept {
    return firing_advance_ticks(step_ticks, static_cast<int>(group), dual_return);
  }
  void begin_packet(const packet::PacketAzimuths& azimuths) noexcept {
    is_s1_packet_ = azimuths.columns == kColumnsPerPacketS1;
  }
  /// Returns the head's step from firing to firing; 0 for the S1, whose rotation within a block is
  /// unknown.
  [[nodiscard]] std::int32_t step_ticks(const packet::PacketAzimuths& azimuths,
                                        std::size_t) const noexcept {
    return is_s1_packet_ ? 0 : azimuths.step_ticks;
  }
  void read_column(std::span<const std::uint8_t> payload, std::size_t column,
                   const Returns& found) const noexcept TERRACUT_NONBLOCKING;
  void compute_points(std::size_t laser, const packet::LaserHeads& heads,
                      const frame::TileRow<float>& measured_m,
                      const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING {
    kernel_.compute(laser, heads, measured_m, out);
  }
  [[nodiscard]] float metres_per_count() const noexcept { return metres_per_count_; }
  [[nodiscard]] std::span<const std::int32_t, kHdl64eLasers> rows() const noexcept { return rows_; }

 private:
  S1Reader s1_reader_;
  bool is_s1_packet_ = false;
  BeamOffsets offsets_;
  PointKernel kernel_;
  float metres_per_count_;
  std::array<std::int32_t, kHdl64eLasers> rows_;
};

}  // namespace terracut::hdl64e
