// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/mount/mount.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/packet/straight_point_kernel.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ruby128 {

/// The trait of the RS-Ruby128 for the Decoder.
///
/// Tells single from dual return packets by their azimuths: in dual return each azimuth comes
/// twice. If the two returns of a firing are split between packets they are joined (HeldFiring),
/// unless one of the packets is lost.
class Ruby128Sensor {
 public:
  using Calibration = Ruby128Calibration;
  using Config = RubyClockConfig;
  static constexpr int kRows = kRuby128Lasers, kChannels = kRows;
  static constexpr std::size_t kPacketBytes = kRubyPacketBytes;
  static constexpr std::size_t kGroups = kRubyGroups;
  using Returns = packet::FiringReturns<static_cast<std::size_t>(kRows)>;
  /// Device stamps count from 1970 and never wrap: this is larger than all of them.
  static constexpr std::int64_t kClockWrap_us = std::int64_t{1} << 56;
  static constexpr int kDefaultColumns = 1800;  ///< 1800.18 firings a frame at 10 Hz.
  /// Three are enough for dual return: some cells get more than two returns, where two firings
  /// share a column.
  static constexpr int kDefaultReturnsPerCell = 3;

  Ruby128Sensor(const Calibration& calibration, const mount::Mount& mount, const Config& config);

  [[nodiscard]] std::optional<frame::Reject> check(const packet::Datagram& datagram,
                                                   packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING;
  [[nodiscard]] packet::BeamSpread spread(std::int32_t step_ticks) const noexcept {
    return {offsets_.hindmost_ticks(), offsets_.foremost_ticks(step_ticks)};
  }
  [[nodiscard]] std::int32_t beam_ticks(int laser) const noexcept {
    return offsets_.offset_ticks(0, laser);
  }
  [[nodiscard]] static std::size_t group(std::size_t laser) noexcept {
    return static_cast<std::size_t>(ruby_group(static_cast<int>(laser)));
  }
  [[nodiscard]] static std::int32_t advance_ticks(std::int32_t step_ticks, std::size_t group,
                                                  bool /*dual_return*/) noexcept {
    return ruby_advance_ticks(step_ticks, kRubyChannelsPerGroup * static_cast<int>(group));
  }
  void begin_packet(const packet::PacketAzimuths& azimuths) noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] std::int32_t step_ticks(const packet::PacketAzimuths& azimuths,
                                        std::size_t column) const noexcept {
    return column == 0 ? first_step_ticks_ : azimuths.step_ticks;
  }
  static void read_column(std::span<const std::uint8_t> payload, std::size_t column,
                          const Returns& found) noexcept TERRACUT_NONBLOCKING;
  void compute_points(std::size_t laser, const packet::LaserHeads& heads,
                      const frame::TileRow<float>& measured_m,
                      const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING {
    kernel_.compute(laser, heads, measured_m, out);
  }
  [[nodiscard]] static float metres_per_count() noexcept {
    return static_cast<float>(kRuby128MetresPerCount);
  }
  [[nodiscard]] std::span<const std::int32_t, kRuby128Lasers> rows() const noexcept {
    return rows_;
  }

  [[nodiscard]] const RubyTimestampDetector& timestamp() const noexcept {
    return clock_.detector();
  }

 private:
  RubyClock clock_;
  Ruby128BeamOffsets offsets_;
  packet::StraightPointKernel kernel_;
  HeldFiring held_;
  std::int32_t step_ticks_ = 0;  ///< Step of the last packet that had one; 0: none yet.
  /// Step for the packet's first block; the held firing's if the block is its second return.
  std::int32_t first_step_ticks_ = 0;
  std::array<std::int32_t, kRuby128Lasers> rows_;
};

}  // namespace terracut::ruby128
