// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/velodyne/velodyne_calibration.hpp"
#include "firmware_io/packet/beam_spread.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/straight_point_kernel.hpp"
#include "firmware_io/velodyne/beam_offsets.hpp"
#include "firmware_io/velodyne/packet_layout.hpp"
#include "firmware_io/velodyne/packet_reader.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::velodyne {

struct VelodyneConfig {
  bool is_named = false;  ///< See PacketReader.
};

/// The trait of a Velodyne sensor for the Decoder. `Model` has its constants:
/// - `kModel`, `kLayout`, `kMetresPerCount`, `kDefaultColumns`;
/// - `kLasers`, and `kChannels`, the readings of a column: a multiple of kLasers if these fire more
///   than once for one head azimuth;
/// - `kGroups`, `group(channel)` and `group_ns(group)`: which channels fire together, and when
///   after the column's first firing, [0, kLayout.column_ns).
template <class Model>
class VelodyneSensor {
  static_assert(sensor::row_of(Model::kModel).lasers.size() == std::size_t{Model::kLasers},
                "the table of sensors and the model have as many lasers");

 public:
  using Calibration = VelodyneCalibration;
  using Config = VelodyneConfig;
  static constexpr sensor::SensorModel kModel = Model::kModel;
  static constexpr int kRows = Model::kLasers;
  static constexpr int kChannels = Model::kChannels;
  static constexpr std::size_t kPacketBytes = velodyne::kPacketBytes;
  static constexpr std::size_t kGroups = Model::kGroups;
  static constexpr std::int64_t kClockWrap_us = velodyne::kClockWrap_us;
  static constexpr int kDefaultColumns = Model::kDefaultColumns;
  /// Three are enough for dual return: some cells get more than two returns, where two firings
  /// share a column.
  static constexpr int kDefaultReturnsPerCell = 3;
  using Returns = packet::FiringReturns<static_cast<std::size_t>(kChannels)>;

  VelodyneSensor(const Calibration& calibration, const mount::Mount& mount, const Config& config)
      : reader_(Model::kLayout, config.is_named),
        kernel_(calibration.lasers, mount),
        offsets_(calibration) {
    const std::vector<int> rows = mount::rows_upward(rows_by_elevation(calibration), mount);
    for (std::size_t channel = 0; channel < rows_.size(); ++channel) {
      rows_[channel] = rows[laser_of(channel)];
    }
  }

  [[nodiscard]] std::optional<frame::Reject> check(const packet::Datagram& datagram,
                                                   packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING {
    return reader_.read(datagram.payload, azimuths);
  }
  [[nodiscard]] packet::BeamSpread spread(std::int32_t step_ticks) const noexcept {
    return {offsets_.hindmost_ticks(), offsets_.foremost_ticks(step_ticks)};
  }
  [[nodiscard]] std::int32_t beam_ticks(int channel) const noexcept {
    return offsets_.beam_ticks(channel);
  }
  [[nodiscard]] static std::size_t group(std::size_t channel) noexcept {
    return Model::group(channel);
  }
  [[nodiscard]] static std::int32_t advance_ticks(std::int32_t step_ticks, std::size_t group,
                                                  bool /*dual_return*/) noexcept {
    return velodyne::advance_ticks<Model>(step_ticks, group);
  }
  void begin_packet(const packet::PacketAzimuths& azimuths) noexcept {
    is_dual_packet_ = azimuths.dual_return;
  }
  [[nodiscard]] static std::int32_t step_ticks(const packet::PacketAzimuths& azimuths,
                                               std::size_t) noexcept {
    return azimuths.step_ticks;
  }
  void read_column(std::span<const std::uint8_t> payload, std::size_t column,
                   const Returns& found) const noexcept TERRACUT_NONBLOCKING {
    const auto* packet = hdl64e::packet_in(payload);
    if (packet == nullptr) return;  // cannot happen: check() has accepted the packet
    for (int part = 0; part < Model::kLayout.blocks_per_column; ++part) {
      const std::size_t block =
          Model::kLayout.block(static_cast<int>(column), part, is_dual_packet_);
      const auto first = static_cast<std::size_t>(part * kBlockReturns);
      packet::split_returns(&packet->blocks[block].returns[0].distance.bytes[0],
                            packet::ByteOrder::kLittle, found.raw.subspan(first, kBlockReturns),
                            &found.intensity[first]);
    }
  }
  void compute_points(std::size_t channel, const packet::LaserHeads& heads,
                      const frame::TileRow<float>& measured_m,
                      const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING {
    kernel_.compute(laser_of(channel), heads, measured_m, out);
  }
  [[nodiscard]] static float metres_per_count() noexcept {
    return static_cast<float>(Model::kMetresPerCount);
  }
  [[nodiscard]] std::span<const std::int32_t, static_cast<std::size_t>(kChannels)> rows()
      const noexcept {
    return rows_;
  }

 private:
  [[nodiscard]] static std::size_t laser_of(std::size_t channel) noexcept {
    return channel % Model::kLasers;
  }

  PacketReader reader_;
  packet::StraightPointKernel kernel_;
  BeamOffsets<Model> offsets_;
  std::array<std::int32_t, kChannels> rows_{};
  bool is_dual_packet_ = false;
};

}  // namespace terracut::velodyne
